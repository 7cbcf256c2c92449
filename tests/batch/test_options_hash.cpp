#include <catch2/catch.hpp>
#include <fstream>

#include "batch/options_hash.h"
#include "support/folder.h"

/// Whether what runs for an item is what ran before.
namespace sphparam::tests {

TEST_CASE("options hash: the content of a file counts wherever a word names it from the root") {
  const Folder folder;
  const std::string file = folder / "c.png", other = folder / "d.png";
  const auto write = [](const std::string& path, const std::string& text) {
    std::ofstream(path) << text;
  };
  const auto hash_of = [](const std::string& word) {
    const BatchPlan plan{.steps = {{"map", "{input}", word}}};
    return OptionsHash(plan).of({.id = "a", .path = "/a.ply"});
  };
  write(other, "1");
  for (const std::string& word :
       {file, "--pin=" + file, "--attribute-image=color=" + file, "m=" + file, "--add=m:" + file,
        other + "," + file, "--data=" + file + "," + other, "--x=a=" + other + ",b=" + file}) {
    write(file, "1");
    const std::string before = hash_of(word);
    write(file, "2");
    CHECK(hash_of(word) != before);
    write(file, "1");
    CHECK(hash_of(word) == before);
  }
  write(file, "1");
  const std::string before = hash_of("x" + file);
  write(file, "2");
  CHECK(hash_of("x" + file) == before);  // another file's name
}

}  // namespace sphparam::tests
