#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "support/places.h"

// What the documents say of the tree, held against the tree.

namespace {

namespace fs = std::filesystem;

const fs::path root = sphparam::tests::source_folder();

std::string text_of(const std::string& name) {
  std::ifstream in(root / name);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What the pattern's group has caught, match by match.
std::vector<std::string> all_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) {
    found.push_back((*i)[1]);
  }
  return found;
}

bool names_something(const std::string& name) {
  for (const char* folder : {"", "libsphparam/include/sphparam", "libsphparam/src", "tools"}) {
    for (const char* extension : {"", ".h", ".cpp"}) {
      if (fs::exists(root / folder / (name + extension))) return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("documents: what ARCHITECTURE.md names by room and file is there") {
  const std::vector<std::string> names =
      all_in(text_of("ARCHITECTURE.md"), "`([a-z_]+/[a-z_/]+(\\.cpp|\\.h)?)");
  REQUIRE(names.size() > 30);
  for (const std::string& name : names) {
    INFO(name);
    CHECK(names_something(name));
  }
}

TEST_CASE("documents: every room has its line in ARCHITECTURE.md") {
  const std::string text = text_of("ARCHITECTURE.md");
  for (const char* floor : {"libsphparam/include/sphparam", "tools"}) {
    for (const auto& entry : fs::directory_iterator(root / floor)) {
      if (!entry.is_directory()) continue;
      INFO(entry.path().string());
      CHECK(text.find("\n    " + entry.path().filename().string() + "/ ") != std::string::npos);
    }
  }
}

TEST_CASE("documents: every program that measures has its place in README.md") {
  const std::string text = text_of("README.md");
  const std::vector<std::string> programs =
      all_in(text_of("tests/bench/CMakeLists.txt"), "add_executable\\(\\s*([a-z_]+)");
  REQUIRE(programs.size() > 10);
  for (const std::string& program : programs) {
    INFO(program);
    const std::regex named("[`/]" + program + "[ `]");
    CHECK(std::regex_search(text, named));
  }
}
