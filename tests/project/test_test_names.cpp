#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "support/places.h"

// A case runs by its name, which CMake keeps in lists and Catch reads as a pattern.

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("test names: none is cut in two by a semicolon, or taken for a tag by its brackets") {
  const std::regex name(R"re(TEST_CASE\(\s*((?:"[^"\n]*"\s*)+))re");
  long names = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(sphparam::tests::source_folder() / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), name), end; match != end; ++match) {
      ++names;
      INFO(entry.path().string() << ": " << (*match)[1]);
      CHECK((*match)[1].str().find_first_of(";[]") == std::string::npos);
    }
  }
  CHECK(names > 1000);
}
