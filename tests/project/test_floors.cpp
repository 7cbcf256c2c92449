#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/places.h"

// The floors of ARCHITECTURE.md, read off the #include lines.

namespace {

namespace fs = std::filesystem;

const fs::path root = sphparam::tests::source_folder();

struct Include {
  fs::path file;  // relative to the root
  std::string target;
};

std::vector<Include> includes_below(const std::string& folder) {
  static const std::regex pattern("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (std::regex_match(line, match, pattern)) {
        includes.push_back({fs::relative(entry.path(), root), match[1]});
      }
    }
  }
  return includes;
}

bool starts_with(const std::string& text, const std::string& beginning) {
  return text.rfind(beginning, 0) == 0;
}

/// The room of a library header or source: "mesh", …, or "" for those above all rooms.
std::string library_room(const fs::path& file) {
  for (const char* room : {"mesh", "sphere", "curvilinear", "embedding", "chart", "rivals"}) {
    if (file.parent_path().filename() == room) return room;
  }
  return "";
}

}  // namespace

TEST_CASE("floors: no include of the library runs back up, and siblings do not know each other") {
  const std::map<std::string, std::set<std::string>> below{
      {"mesh", {"mesh"}},
      {"sphere", {"sphere", "mesh"}},
      {"curvilinear", {"curvilinear", "sphere", "mesh"}},
      {"embedding", {"embedding", "sphere", "mesh"}},
      {"rivals", {"rivals", "sphere", "mesh"}},
      {"chart", {"chart", "sphere", "mesh"}}};
  const std::vector<Include> includes = includes_below("libsphparam");
  REQUIRE(includes.size() > 100);
  for (const auto& [file, target] : includes) {
    INFO(file.string() << " includes " << target);
    const std::string room = library_room(file);
    if (room.empty()) continue;
    CHECK(target.find("parameterize.h") == std::string::npos);
    CHECK_FALSE(starts_with(target, "pipeline/"));
    for (const auto& [other, unused] : below) {
      if (starts_with(target, "sphparam/" + other + "/") || starts_with(target, other + "/")) {
        CHECK(below.at(room).contains(other));
      }
    }
  }
}

TEST_CASE("floors: the pipeline does not know the methods of others") {
  for (const auto& [file, target] : includes_below("libsphparam")) {
    if (file.stem() != "parameterize" && file.parent_path().filename() != "pipeline") continue;
    INFO(file.string() << " includes " << target);
    CHECK(target.find("baselines/") == std::string::npos);
  }
}

TEST_CASE("floors: the library knows nothing of the tools") {
  for (const auto& [file, target] : includes_below("libsphparam")) {
    INFO(file.string() << " includes " << target);
    for (const char* room : {"mesh_io/", "image/", "render/", "report/", "compare/", "cli/"}) {
      CHECK_FALSE(starts_with(target, room));
    }
  }
}

TEST_CASE("floors: third-party headers stay in their rooms") {
  const std::map<std::string, std::vector<std::string>> homes{
      {"OpenImageIO/", {"tools/image/oiio"}},
      {"CLI/", {"tools/cli"}},
      {"nlohmann/", {"tools/cli", "tools/mesh_io/gltf_json", "tools/gltf/gltf_writer"}},
      {"tiny_gltf", {"tools/mesh_io/gltf_document"}},
      {"meshoptimizer", {"tools/gltf/meshopt_encoding"}},
      {"gifti/", {"tools/mesh_io/gifti_writer"}},
      {"expat", {"tools/mesh_io/gifti_xml"}},
      {"zlib", {"tools/mesh_io/gifti_data", "tools/mesh_io/gzip"}},
      {"boost/", {"libsphparam/src/sphere"}},
      {"embree3/", {"tools/rays/ray_scene"}},
      {"opensubdiv/", {"tools/remesh/"}},
      {"unsupported/", {}}};
  for (const char* folder : {"libsphparam", "tools", "samples"}) {
    for (const auto& [file, target] : includes_below(folder)) {
      for (const auto& [library, rooms] : homes) {
        if (!starts_with(target, library)) continue;
        INFO(file.string() << " includes " << target);
        bool at_home = false;
        for (const std::string& room : rooms) at_home |= starts_with(file.string(), room);
        CHECK(at_home);
      }
    }
  }
}

TEST_CASE("floors: public headers of the library need Eigen and nothing else") {
  for (const auto& [file, target] : includes_below("libsphparam/include")) {
    INFO(file.string() << " includes " << target);
    const bool standard =
        target.find('/') == std::string::npos && target.find('.') == std::string::npos;
    CHECK((standard || starts_with(target, "sphparam/") || starts_with(target, "Eigen/")));
  }
}

TEST_CASE("floors: sines and logarithms are our own, for the C library's depend on the processor") {
  const std::regex foreign(
      "(std|Eigen::numext)::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p|b)?|pow|cbrt|hypot|"
      "[lt]gamma|erfc?|polar|arg)\\(|\\.(log(10)?|exp|a?(sin|cos|tan)h?)\\(\\)|\\.pow\\(|"
      "Eigen::(AngleAxis|Rotation2D)");
  CHECK(std::regex_search("x = std::sin(y);", foreign));
  CHECK(std::regex_search("values.array().log()", foreign));
  CHECK(std::regex_search("Eigen::AngleAxisd(angle, axis)", foreign));
  CHECK_FALSE(std::regex_search("elementary::sin(y) + std::sqrt(z) + std::ilogb(x)", foreign));
  for (const char* folder : {"libsphparam", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        INFO(entry.path().string() << ": " << line);
        CHECK_FALSE(std::regex_search(line, foreign));
      }
    }
  }
}
