#include <catch2/catch.hpp>
#include <sstream>

#include "sphparam/group/template_landmarks.h"
#include "sphparam/io/read_options.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("template_landmarks: a vertex a line, by its number in the file, and a name or none") {
  MeshFile file;
  file.mesh = icosphere(1);
  const auto found =
      parse_template_landmarks("# two\n3 tip of the nose # here\n\n7\n", "x", file).landmarks;
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
                         "x", file)
                         .landmarks;
  REQUIRE(found.size() == 1);
  CHECK(found[0].vertex == 3);
}

TEST_CASE("template_landmarks: what is none is refused with its line") {
  MeshFile file;
  file.mesh = icosphere(1);
  const auto complaint = [&](const char* text) -> std::string {
    try {
      parse_template_landmarks(text, "marks.txt", file);
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
      complaint("0.5 1 nose\n"),
      Contains("marks.txt:1: expected a whole number, found '0.5': a line is a vertex of the "
               "template, by its number in the file, from 0, and a name if you like, as in "
               "`512 nose`, or a point, as in `0.5 1 2 nose`"));
  CHECK_THAT(complaint("# nothing\n"), Contains("no landmark"));
}

TEST_CASE("template_landmarks: a point is taken for the vertex nearest to it, and told how far") {
  MeshFile file;
  file.mesh = octahedron();
  file.mesh.positions *= 8;
  const Points& x = file.mesh.positions;
  std::ostringstream text;
  text << std::fixed << 1.125 * x.row(4) << " tip 2 # here\n2 3 4\n0.5e1 0 0\n";
  const TemplateLandmarks found = parse_template_landmarks(text.str(), "x", file);
  REQUIRE(found.landmarks.size() == 3);
  CHECK(found.landmarks[0].name == "tip 2");
  CHECK(found.landmarks[0].vertex == 4);
  CHECK(found.landmarks[0].distance == 1.0);
  CHECK(found.landmarks[1].name == "3 4");  // whole numbers: a vertex and its name
  CHECK(found.landmarks[1].vertex == 2);
  CHECK_FALSE(found.landmarks[1].distance);
  const Vertex along_x = found.landmarks[2].vertex;
  CHECK(x.row(along_x) == Eigen::RowVector3d(8, 0, 0));
  CHECK(found.landmarks[2].name == std::to_string(along_x));
  CHECK(found.landmarks[2].distance == 3.0);
  CHECK(found.snapped.words() ==
        "2 points are taken for the vertices nearest to them, at most 3 away (10.8 % of the "
        "diagonal; line 3)");
}
