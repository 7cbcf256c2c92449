#include <catch2/catch.hpp>
#include <sstream>

#include "sphparam/correspondence/landmark_file.h"
#include "sphparam/io/mesh_reader.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;

std::vector<LandmarkPair> parse(const std::string& text) {
  MeshFile first, second;
  first.mesh = icosahedron();
  second.mesh = octahedron();
  return LandmarkFile(text, "pairs.txt").pairs(first, second).pairs;
}

}  // namespace

TEST_CASE("landmark files: a pair a line, with comments") {
  const std::vector<LandmarkPair> pairs = parse("# nose and tail\n0 5\n\n11 2 # tail\n");
  REQUIRE(pairs.size() == 2);
  CHECK((pairs[0].from == 0 && pairs[0].to == 5));
  CHECK((pairs[1].from == 11 && pairs[1].to == 2));
}

TEST_CASE("landmark files: a byte order mark before the first number is no part of it") {
  CHECK(parse("\xEF\xBB\xBF"
              "0 5\n")
            .size() == 1);
}

TEST_CASE("landmark files: points are taken for the vertices nearest to them, and told how far") {
  MeshFile first, second;
  first.mesh = octahedron();
  second.mesh = octahedron();
  second.mesh.positions *= 10;
  const Points &a = first.mesh.positions, &b = second.mesh.positions;
  const auto text = [](const Vector3& x, const Vector3& y) {
    std::ostringstream line;
    line << x.transpose() << "  " << y.transpose() << " # nose\n";
    return line.str();
  };
  const LandmarkFile file(
      "1 2\n" + text(1.25 * a.row(3), b.row(5)) + text(a.row(0), 1.5 * b.row(4)), "points.txt");
  const LandmarkFile::Found found = file.pairs(first, second);
  REQUIRE(found.pairs.size() == 3);
  CHECK((found.pairs[0].from == 1 && found.pairs[0].to == 2));
  CHECK((found.pairs[1].from == 3 && found.pairs[1].to == 5));
  CHECK((found.pairs[2].from == 0 && found.pairs[2].to == 4));
  CHECK(found.snapped.words() ==
        "4 points are taken for the vertices nearest to them, at most 5 away (14.4 % of the "
        "diagonal; line 3, second mesh)");
  CHECK(found.snapped.is_far());
  const LandmarkFile near(text(1.01 * a.row(3), b.row(5)), "points.txt");
  CHECK_FALSE(near.pairs(first, second).snapped.is_far());
  CHECK(LandmarkFile("1 2\n", "x").pairs(first, second).snapped.words().empty());
  const LandmarkFile twice(text(a.row(3), b.row(5)) + text(1.01 * a.row(3), b.row(4)),
                           "points.txt");
  CHECK_THROWS_WITH(
      twice.pairs(first, second),
      Contains("points.txt:2:") && Contains("vertex 3 of the first mesh is in two pairs, "
                                            "first in line 1"));
  CHECK_THROWS_WITH(LandmarkFile("1 2 3 4 5 x\n", "points.txt"), Contains("points.txt:1:"));
}

TEST_CASE("landmark files: what is no pair is told before there are meshes") {
  CHECK_THROWS_WITH(LandmarkFile("0 1\n0 x\n", "pairs.txt"), Contains("pairs.txt:2:"));
  CHECK_THROWS_AS(LandmarkFile("/nowhere/pairs.txt"), ReadError);
  CHECK_NOTHROW(LandmarkFile("0 1000000\n", "pairs.txt"));
}

TEST_CASE("landmark files: what is wrong is said with its line") {
  CHECK_THROWS_WITH(parse("0 1\n12 2\n"),
                    Contains("pairs.txt:2:") && Contains("first mesh") && Contains("no vertex 12"));
  CHECK_THROWS_WITH(parse("0 1\n\n1 6\n"),
                    Contains("pairs.txt:3:") && Contains("second mesh") && Contains("no vertex 6"));
  CHECK_THROWS_WITH(parse("0 1\n0 2\n"), Contains("pairs.txt:2:") && Contains("first in line 1"));
  CHECK_THROWS_WITH(parse("0 1\n3 1\n"), Contains("second mesh") && Contains("first in line 1"));
  CHECK_THROWS_WITH(parse("0 1 2\n"), Contains("pairs.txt:1:") && Contains("then nothing"));
  CHECK_THROWS_WITH(parse("0\n"), Contains("pairs.txt:1:"));
  CHECK_THROWS_WITH(
      parse("0 x\n"),
      Contains(
          "pairs.txt:1: expected a whole number, found 'x': a line is a vertex of the "
          "first mesh and one of the second, by their numbers in the files, from 0, as in `512 "
          "90`, or a point of each, in six numbers"));
  CHECK_THROWS_WITH(parse("0.5 0.25 1\n"),
                    Contains("found '0.5': a line is a vertex of the first"));
  CHECK_THROWS_WITH(parse("# nothing\n"), Contains("no pair"));
}

}  // namespace sphparam::tests
