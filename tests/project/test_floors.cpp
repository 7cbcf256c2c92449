#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
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

const fs::path private_headers = "libsphparam/src", public_headers = "libsphparam/include/sphparam";

/// The room of a file of the library, "" above all rooms: "io" of src/io/formats/ply/ply_reader.h.
std::string library_room(const fs::path& file) {
  for (const fs::path& home : {private_headers, public_headers}) {
    const fs::path inside = file.lexically_relative(home);
    if (*inside.begin() == "..") continue;
    return inside.has_parent_path() ? inside.begin()->string() : "";
  }
  return "";
}

/// The room that an include names; "" for what is above all rooms and for other libraries.
std::string included_room(const std::string& target) {
  const std::string inside = starts_with(target, "sphparam/") ? target.substr(9) : target;
  const size_t slash = inside.find('/');
  if (slash == std::string::npos) return "";
  return fs::exists(root / private_headers / inside.substr(0, slash)) ? inside.substr(0, slash)
                                                                      : "";
}

/// What each room may know, besides itself.
const std::map<std::string, std::set<std::string>> below{
    {"mesh", {}},
    {"sphere", {"mesh"}},
    {"curvilinear", {"sphere", "mesh"}},
    {"embedding", {"sphere", "mesh"}},
    {"baselines", {"sphere", "mesh"}},
    {"chart", {"sphere", "mesh"}},
    {"pipeline", {"curvilinear", "embedding", "sphere", "mesh"}},
    {"io", {"chart", "embedding", "sphere", "mesh"}},
    {"image", {"io", "mesh"}},
    {"texture", {"image", "io", "sphere", "mesh"}},
    {"rays", {"mesh"}},
    {"measure", {"rays", "embedding", "sphere", "mesh"}},
    {"render", {"texture", "image", "io", "chart", "sphere", "mesh"}},
    {"bake", {"render", "rays", "texture", "image", "io", "chart", "sphere", "mesh"}},
    {"paint", {"bake", "texture", "image", "io", "chart", "sphere", "mesh"}},
    {"remesh", {"embedding", "rays", "measure", "image", "texture", "io", "sphere", "mesh"}},
    {"displace", {"remesh", "rays", "measure", "image", "io", "sphere", "mesh"}},
    {"wrap", {"measure", "rays", "mesh"}},
    {"correspondence", {"io", "measure", "rays", "embedding", "sphere", "mesh"}},
    {"group", {"correspondence", "remesh", "io", "embedding", "sphere", "mesh"}},
    {"gltf", {"correspondence", "bake", "texture", "image", "io", "chart", "sphere", "mesh"}},
    {"report", {"correspondence", "gltf", "texture", "image", "io", "sphere"}},
    {"compare", {"baselines", "report", "render", "image", "io", "sphere", "mesh"}},
    {"showcase",
     {"compare", "correspondence", "records", "group", "gltf", "report", "bake", "render",
      "texture", "image", "io", "embedding", "sphere", "mesh"}},
    {"records",
     {"compare", "correspondence", "group", "wrap", "gltf", "bake", "remesh", "measure", "io",
      "chart", "baselines", "sphere", "mesh"}},
    {"asset",
     {"records", "report", "gltf", "bake", "wrap", "remesh", "render", "rays", "texture", "io",
      "chart", "sphere", "mesh"}},
    {"batch", {"report", "render", "io", "mesh"}},
    {"survey", {"batch", "records", "report", "render", "io", "mesh"}}};

void require_in_no_line(const std::vector<std::string>& folders, const std::regex& pattern) {
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        if (!std::regex_search(line, pattern)) continue;
        INFO(entry.path().string() << ": " << line);
        CHECK_FALSE(std::regex_search(line, pattern));
      }
    }
  }
}

}  // namespace

TEST_CASE("floors: no include of the library runs back up, and siblings do not know each other") {
  const std::vector<Include> includes = includes_below("libsphparam");
  REQUIRE(includes.size() > 1000);
  for (const auto& [file, target] : includes) {
    INFO(file.string() << " includes " << target);
    const std::string room = library_room(file), other = included_room(target);
    if (room.empty() || other.empty() || other == room) continue;
    REQUIRE(below.contains(room));
    CHECK(below.at(room).contains(other));
  }
}

TEST_CASE("floors: every room of the library has its floor") {
  for (const auto& entry : fs::directory_iterator(root / private_headers)) {
    INFO(entry.path().string());
    if (entry.is_directory()) CHECK(below.contains(entry.path().filename().string()));
  }
}

TEST_CASE("floors: rooms below the pipeline do not know it, nor it the methods of others") {
  const std::set<std::string> lower = {"mesh",      "sphere", "curvilinear",
                                       "embedding", "chart",  "baselines"};
  for (const auto& [file, target] : includes_below("libsphparam/src")) {
    INFO(file.string() << " includes " << target);
    if (lower.contains(library_room(file))) {
      CHECK(target.find("parameterize.h") == std::string::npos);
    }
    if (file.stem() == "parameterize" || library_room(file) == "pipeline") {
      CHECK(included_room(target) != "baselines");
    }
  }
}

TEST_CASE("floors: the library knows nothing of the command line") {
  for (const auto& [file, target] : includes_below("libsphparam")) {
    INFO(file.string() << " includes " << target);
    for (const char* room : {"arguments/", "commands/", "console/", "reports/", "CLI/"}) {
      CHECK_FALSE(starts_with(target, room));
    }
  }
}

TEST_CASE("floors: folders stay small enough to be read") {
  const auto files_in = [](const fs::path& folder) {
    return std::count_if(fs::directory_iterator(folder), {},
                         [](const fs::directory_entry& entry) { return entry.is_regular_file(); });
  };
  for (const auto& [top, most] : {std::pair("libsphparam", 45), std::pair("tools", 45),
                                  std::pair("samples", 45), std::pair("tests", 45)}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (!entry.is_directory() || entry.path().string().find("/hostile/") != std::string::npos)
        continue;
      INFO(entry.path().string());
      CHECK(files_in(entry.path()) <= most);
    }
  }
}

TEST_CASE("floors: third-party headers stay in their rooms") {
  const std::map<std::string, std::vector<std::string>> homes{
      {"OpenImageIO/", {"libsphparam/src/image/oiio"}},
      {"webp/", {"libsphparam/src/image/oiio"}},
      {"assimp/", {"libsphparam/src/io/assimp/"}},
      {"CLI/", {"tools/"}},
      {"nlohmann/",
       {"libsphparam/src/records/", "libsphparam/src/batch/",
        "libsphparam/src/io/formats/gltf/gltf_json",
        "libsphparam/src/io/formats/gltf/gltf_authorship",
        "libsphparam/src/io/attributes/authorship",
        "libsphparam/src/io/formats/gltf/gltf_compression", "libsphparam/src/gltf/gltf_writer",
        "libsphparam/src/survey/survey_record", "libsphparam/src/asset/asset_record"}},
      {"tiny_gltf", {"libsphparam/src/io/formats/gltf/gltf_document"}},
      {"meshoptimizer",
       {"libsphparam/src/gltf/meshopt_encoding",
        "libsphparam/src/io/formats/gltf/meshopt_decoding"}},
      {"draco/", {"libsphparam/src/io/formats/gltf/draco/"}},
      {"gifti/", {"libsphparam/src/io/formats/gifti/gifti_image"}},
      {"expat", {"libsphparam/src/io/formats/xml_events"}},
      {"zlib",
       {"libsphparam/src/io/formats/gifti/gifti_data", "libsphparam/src/io/files/gzip",
        "libsphparam/src/io/files/zip_archive", "libsphparam/src/io/files/stored_zip",
        "libsphparam/src/io/files/png"}},
      {"boost/", {"libsphparam/src/exact_integers.h"}},
      {"embree3/", {"libsphparam/src/rays/ray_scene"}},
      {"opensubdiv/", {"libsphparam/src/remesh/"}},
      {"xxhash", {"libsphparam/src/batch/content_hash"}},
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
  require_in_no_line({"libsphparam", "tools"}, foreign);
}

TEST_CASE("floors: constants are written as other variables are") {
  const std::regex prefixed("\\bk[A-Z][a-z][A-Za-z0-9]*\\b");
  CHECK(std::regex_search("constexpr int " + std::string("k") + "Longest = 64;", prefixed));
  CHECK_FALSE(std::regex_search("constexpr int longest = 64;", prefixed));
  require_in_no_line({"libsphparam", "tools", "samples", "tests"}, prefixed);
}

TEST_CASE("floors: no two headers of the library have a class by one name") {
  // What a linker keeps of templates on the one would be run on the other.
  const std::regex definition("^(struct|class) (\\w+)( final)?( : .*)? \\{.*");
  std::map<std::string, fs::path> home;
  for (const auto& entry : fs::recursive_directory_iterator(root / "libsphparam")) {
    if (entry.path().extension() != ".h") continue;
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (!std::regex_match(line, match, definition)) continue;
      const auto [other, is_new] = home.emplace(match[2], entry.path());
      INFO(match[2] << " in " << other->second.string() << " and " << entry.path().string());
      CHECK(is_new);
    }
  }
  CHECK(home.count("TriangleMesh") == 1);
}
