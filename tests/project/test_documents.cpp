#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/places.h"

// What the documents say of the tree, held against the tree.

namespace {

namespace fs = std::filesystem;

const fs::path root = sphparam::tests::source_folder();

std::string text_of(const fs::path& name) {
  std::ifstream in(root / name);
  INFO(name.string());
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
  for (const char* folder :
       {"", "libsphparam/include", "libsphparam/include/sphparam", "libsphparam/src", "tools"}) {
    for (const char* extension : {"", ".h", ".cpp"}) {
      if (fs::exists(root / folder / (name + extension))) return true;
    }
  }
  return false;
}

void check_names(const fs::path& page, size_t least) {
  const std::vector<std::string> names =
      all_in(text_of(page), "`([a-z_0-9]+/[a-z_0-9/]+(\\.cpp|\\.h|\\.cmake)?)");
  CHECK(names.size() >= least);
  for (const std::string& name : names) {
    INFO(page.string() << " names " << name);
    CHECK(names_something(name));
  }
}

/// All pages, by their names from the root.
std::vector<fs::path> all_pages() {
  std::vector<fs::path> pages{"README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md",
                              "textures/README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(fs::relative(entry.path(), root));
  }
  return pages;
}

/// The lines of a page that are not in a fenced block.
std::vector<std::string> prose_of(const fs::path& page) {
  std::istringstream in(text_of(page));
  std::vector<std::string> lines;
  bool fenced = false;
  for (std::string line; std::getline(in, line);) {
    const bool fence = line.rfind("```", 0) == 0;
    if (!fenced && !fence) lines.push_back(line);
    if (fence) fenced = !fenced;
  }
  return lines;
}

/// The anchor of a heading, as GitHub makes it: small letters, blanks as hyphens, no punctuation.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ' || c == '-') {
      anchor += '-';
    } else if (std::isalnum(byte) || c == '_' || byte >= 0x80) {
      anchor += static_cast<char>(std::tolower(byte));
    }
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  for (const std::string& line : prose_of(page)) {
    const size_t level = line.find_first_not_of('#');
    if (level == 0 || level == std::string::npos || line[level] != ' ') continue;
    anchors.insert(anchor_of(line.substr(level + 1)));
  }
  return anchors;
}

/// Whether a link that stands on a page leads somewhere within the tree.
bool leads_somewhere(const fs::path& page, const std::string& link) {
  const size_t hash = link.find('#');
  const std::string file = link.substr(0, hash);
  const fs::path target = file.empty() ? page : (page.parent_path() / file).lexically_normal();
  if (!fs::exists(root / target)) return false;
  return hash == std::string::npos || anchors_of(target).contains(link.substr(hash + 1));
}

}  // namespace

TEST_CASE("documents: what ARCHITECTURE.md names by room and file is there") {
  check_names("ARCHITECTURE.md", 60);
}

TEST_CASE("documents: the proofs and formulas that the mathematics names are there") {
  check_names("docs/mathematics.md", 20);
}

TEST_CASE("documents: the headers that the pages of components name are there") {
  for (const auto& entry : fs::directory_iterator(root / "docs/components")) {
    check_names(fs::relative(entry.path(), root), 1);
  }
}

TEST_CASE("documents: every room has its line in ARCHITECTURE.md") {
  const std::string text = text_of("ARCHITECTURE.md");
  for (const char* floor : {"libsphparam/include/sphparam", "libsphparam/src", "tools"}) {
    for (const auto& entry : fs::directory_iterator(root / floor)) {
      if (!entry.is_directory()) continue;
      INFO(entry.path().string());
      CHECK(text.find("\n    " + entry.path().filename().string() + "/ ") != std::string::npos);
    }
  }
}

TEST_CASE("documents: every component is in the tables of ARCHITECTURE.md and docs/building.md") {
  const std::string plan = text_of("libsphparam/components.cmake");
  const std::vector<std::string> lists = all_in(plan, "set\\(all_components ([a-z ]+)\\)");
  REQUIRE(lists.size() == 1);
  std::istringstream components(lists.front());
  int count = 0;
  for (std::string component; components >> component; ++count) {
    for (const char* page : {"ARCHITECTURE.md", "docs/building.md"}) {
      INFO(component << " in " << page);
      CHECK(text_of(page).find("\n| `" + component + "` |") != std::string::npos);
    }
    // What it stands on, as the table says it.
    std::string needs;
    for (const std::string& words : all_in(plan, "set\\(needs_" + component + " ([a-z ]+)\\)")) {
      needs = std::regex_replace(words, std::regex(" "), ", ");
    }
    INFO(component << " needs " << needs);
    const std::regex row("\n\\| `" + component + "` \\|[^|\n]*\\|[^|\n]*\\| " + needs +
                         (needs.empty() ? "" : " ") + "\\|");
    CHECK(std::regex_search(text_of("docs/building.md"), row));
  }
  CHECK(count >= 8);
}

TEST_CASE("documents: the ten lines of README.md are those that tests compile") {
  const std::string readme = text_of("README.md");
  const size_t begin = readme.find("```cpp\n");
  REQUIRE(begin != std::string::npos);
  std::istringstream lines(readme.substr(begin + 7, readme.find("```", begin + 7) - begin - 7));
  int count = 0;
  for (std::string line; std::getline(lines, line); count += !line.empty()) {
    for (const char* place : {"tests/consumer/ten_lines.cpp", "docs/tutorials/ten-lines.md"}) {
      INFO(place << " has not: " << line);
      CHECK(text_of(place).find(line) != std::string::npos);
    }
  }
  CHECK(count == 11);
}

TEST_CASE("documents: a mesh of vectors in docs/components/io.md is made as a test makes it") {
  const std::string page = text_of("docs/components/io.md");
  const std::string test = text_of("tests/io/test_mapped_mesh.cpp");
  const size_t begin = page.find("sphparam::MeshSource own;");
  REQUIRE(begin != std::string::npos);
  std::istringstream lines(page.substr(begin, page.find("```", begin) - begin));
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    CHECK(test.find("  " + line + "\n") != std::string::npos);
  }
}

TEST_CASE("documents: every program that measures has its place in docs/results.md") {
  const std::string text = text_of("docs/results.md");
  const std::vector<std::string> programs =
      all_in(text_of("tests/bench/CMakeLists.txt"), "add_executable\\(\\s*([a-z_]+)");
  REQUIRE(programs.size() > 10);
  for (const std::string& program : programs) {
    INFO(program);
    const std::regex named("[`/]" + program + "[ `]");
    CHECK(std::regex_search(text, named));
  }
}

TEST_CASE("documents: every figure of distortion has its formula in docs/mathematics.md") {
  const std::string page = text_of("docs/mathematics.md");
  const std::string record = text_of("libsphparam/src/records/json_parts.cpp");
  const std::vector<std::string> keys = all_in(record, "\\{\"([a-z_0-9]+)\", d\\.");
  REQUIRE(keys.size() >= 17);
  const size_t begin = page.find("## The figures of distortion");
  REQUIRE(begin != std::string::npos);
  const std::string section = page.substr(begin, page.find("\n## ", begin) - begin);
  for (const std::string& key : keys) {
    INFO(key);
    CHECK(section.find("`" + key + "`") != std::string::npos);
  }
}

TEST_CASE("documents: README.md is read in a few minutes") {
  CHECK(text_of("README.md").size() <= 9000);
}

TEST_CASE("documents: every link within the tree leads to a file, and to a heading that is there") {
  int count = 0;
  for (const fs::path& page : all_pages()) {
    for (const std::string& line : prose_of(page)) {
      for (const std::string& link : all_in(line, "\\]\\(([^)\\s]+)\\)")) {
        if (link.find("://") != std::string::npos) continue;
        INFO(page.string() << " links to " << link);
        CHECK(leads_somewhere(page, link));
        ++count;
      }
    }
  }
  CHECK(count > 100);
}

TEST_CASE("documents: every page of docs is linked from another, every picture is shown") {
  std::string all;
  for (const fs::path& page : all_pages()) {
    for (const std::string& line : prose_of(page)) {
      for (const std::string& link : all_in(line, "\\]\\(([^)#\\s]+)[)#]")) {
        all += (page.parent_path() / link).lexically_normal().string() + "\n";
      }
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    const std::string extension = entry.path().extension();
    if (extension != ".md" && extension != ".png") continue;
    const std::string name = fs::relative(entry.path(), root);
    INFO(name);
    CHECK((name == "docs/index.md" || all.find(name + "\n") != std::string::npos));
  }
}
