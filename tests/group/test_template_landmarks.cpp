#include <catch2/catch.hpp>

#include "sphparam/group/template_landmarks.h"
#include "sphparam/io/read_options.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("template_landmarks: a vertex a line, by its number in the file, and a name or none") {
  MeshFile file;
  file.mesh = icosphere(1);
  const auto found =
      parse_template_landmarks("# two\n3 tip of the nose # here\n\n7\n", "x", FileNumbers(file));
  REQUIRE(found.size() == 2);
  CHECK(found[0].name == "tip of the nose");
  CHECK(found[0].vertex == 3);
  CHECK(found[1].name == "7");
  CHECK(found[1].vertex == 7);
}

TEST_CASE("template_landmarks: a byte order mark before the first number is no part of it") {
  MeshFile file;
  file.mesh = icosphere(1);
  const auto found = parse_template_landmarks(
      "\xEF\xBB\xBF"
      "3 nose\n",
      "x", FileNumbers(file));
  REQUIRE(found.size() == 1);
  CHECK(found[0].vertex == 3);
}

TEST_CASE("template_landmarks: what is none is refused with its line") {
  MeshFile file;
  file.mesh = icosphere(1);
  const FileNumbers numbers(file);
  const auto complaint = [&](const char* text) -> std::string {
    try {
      parse_template_landmarks(text, "marks.txt", numbers);
    } catch (const ReadError& error) {
      return error.what();
    }
    return "nothing";
  };
  using Catch::Contains;
  CHECK_THAT(complaint("\n99\n"), Contains("marks.txt:2") && Contains("no vertex 99"));
  CHECK_THAT(complaint("1 a\n2 a\n"), Contains("marks.txt:2") && Contains("line 1"));
  CHECK_THAT(complaint("nose 3\n"), Contains("whole number"));
  CHECK_THAT(
      complaint("0.5 1 2\n"),
      Contains("marks.txt:1: expected a whole number, found '0.5': a line is a vertex of the "
               "template, by its number in the file, from 0, and a name if you like, as in "
               "`512 nose`; coordinates are not taken"));
  CHECK_THAT(complaint("# nothing\n"), Contains("no landmark"));
}
