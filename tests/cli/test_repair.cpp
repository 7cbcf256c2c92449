#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

TriangleMesh with_a_hole() {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  return mesh;
}

/// A ball and, away from it, a coarser one whose first vertex is number 162.
TriangleMesh two_bodies() {
  const TriangleMesh ball = icosphere(2), other = icosphere(1);
  TriangleMesh mesh;
  mesh.positions.resize(ball.vertex_count() + other.vertex_count(), 3);
  mesh.positions << ball.positions, (other.positions.array() + 5).matrix();
  mesh.triangles.resize(ball.face_count() + other.face_count(), 3);
  mesh.triangles << ball.triangles,
      (other.triangles.array() + static_cast<int>(ball.vertex_count())).matrix();
  return mesh;
}

/// Quads 0 1 2 3 and 2 1 0 4 of a box-like surface share the edges 0-1 and 1-2.
const std::string doublet =
    "v 0 0 0\nv 0.5 0 0\nv 1 0 0\nv 0.5 1 0.2\nv 0.5 -1 0.2\nv 0.5 0 1\n"
    "f 1 2 3 4\nf 3 2 1 5\nf 1 4 6\nf 4 3 6\nf 3 5 6\nf 5 1 6\n";

}  // namespace

TEST_CASE("repair: a refusal says that --repair would mend it, and how, only where it would") {
  const Ended refused = sphparam_program({"map", "-", "-o", "-"}, obj_text(with_a_hole()));
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("3 boundary edges in 1 loop"));
  CHECK_THAT(refused.err, Contains("--repair would mend it") && Contains("1 hole filled"));

  // An octahedron and two of its faces: a second component, but no surface comes of one face.
  const Ended hopeless = sphparam_program({"map", "-", "-o", "-"}, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  CHECK(hopeless.code == 4);
  CHECK_THAT(hopeless.err, Contains("--repair cannot mend it"));
  CHECK_THAT(hopeless.err, !Contains("--repair would"));
}

TEST_CASE("repair: map --repair mends, certifies, and tells what it did") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply", json = folder / "map.json";
  const Ended mapped = sphparam_program({"map", "-", "-o", map, "--json", json, "--repair"},
                                        obj_text(with_a_hole()));
  INFO(mapped.err);
  REQUIRE(mapped.code == 0);
  CHECK_THAT(mapped.err, Contains("1 hole filled"));
  CHECK(sphparam_program({"verify", map, "-q"}).code == 0);
  const Json repairs = Json::parse(bytes_of(json))["repairs"];
  REQUIRE(repairs.size() == 1);
  CHECK(repairs[0]["kind"] == "hole-filled");
  CHECK(repairs[0]["count"] == 1);
  CHECK(repairs[0]["first"].size() == 1);
}

TEST_CASE("repair: a mesh that needs none is mapped to the same bytes with and without") {
  const std::string ball = obj_text(icosphere(2));
  const Ended plain = sphparam_program({"map", "-", "-o", "-"}, ball);
  const Ended repaired = sphparam_program({"map", "-", "-o", "-", "--repair"}, ball);
  REQUIRE(plain.code == 0);
  CHECK(plain.out == repaired.out);
}

TEST_CASE("repair: single repairs do only what they say") {
  const std::string open = obj_text(with_a_hole()), two = obj_text(two_bodies());
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=holes"}, open).code == 0);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--max-hole", "3"}, open).code == 0);
  const Ended other =
      sphparam_program({"map", "-", "-o", "-", "--repair=components,orientation"}, open);
  CHECK(other.code == 4);
  CHECK_THAT(other.err, Contains("3 boundary edges"));
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=holes"}, two).code == 4);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=components"}, two).code == 0);
}

TEST_CASE("repair: --component keeps the one that is asked for, with the numbers of the file") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply", sphere = folder / "map.json";
  const std::string two = obj_text(two_bodies());
  const Ended mapped =
      sphparam_program({"map", "-", "-o", map, "--json", sphere, "--component", "2"}, two);
  INFO(mapped.err);
  REQUIRE(mapped.code == 0);
  const Json report = Json::parse(bytes_of(sphere));
  CHECK(report["input"]["triangles"] == 80);
  CHECK_THAT(report["input"]["vertex_properties"].dump(), Contains("source_vertex"));
  CHECK_THAT(report["input"]["face_properties"].dump(), Contains("source_face"));
  // Vertices of the coarser one are known by their numbers in the file.
  CHECK(sphparam_program({"map", "-", "-o", "-", "--component", "2", "--poles", "162,165"}, two)
            .code == 0);
  CHECK(
      sphparam_program({"map", "-", "-o", "-", "--component", "2", "--poles", "0,165"}, two).code ==
      2);
  const Ended absent = sphparam_program({"map", "-", "-o", "-", "--component", "3"}, two);
  CHECK(absent.code == 2);
  CHECK_THAT(absent.err, Contains("no component 3") && Contains("has 2"));
}

TEST_CASE("repair: polygons that share two edges in a row are refused, and mended") {
  const Ended refused = sphparam_program({"map", "-", "-o", "-"}, doublet);
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("1 edge has three or more faces") &&
                              Contains("1 face has the same three vertices as another") &&
                              Contains("--repair would mend it"));
  CHECK_THAT(sphparam_program({"info", "-"}, doublet).out,
             Contains("two polygons share two edges in a row about vertices 1"));
  const Ended mapped = sphparam_program({"map", "-", "-o", "-", "--repair"}, doublet);
  CHECK(mapped.code == 0);
  CHECK_THAT(mapped.err, Contains("1 diagonal turned"));
}

TEST_CASE("repair: faces that name a vertex twice go with duplicates, and are refused without") {
  const std::string faulty = obj_text(icosphere(1)) + "f 1 2 1\nf 3 4 5 4 6\n";
  for (const char* repair : {"", "--repair=holes,unused"}) {
    std::vector<std::string> arguments = {"map", "-", "-o", "-"};
    if (*repair) arguments.emplace_back(repair);
    const Ended refused = sphparam_program(arguments, faulty);
    CHECK(refused.code == 3);
    CHECK_THAT(refused.err, Contains(":123: face names a vertex twice; `sphparam map "
                                     "--repair=duplicates` removes such faces"));
  }
  const Ended asked = sphparam_program({"info", "-"}, faulty);
  CHECK(asked.code == 3);
  CHECK_THAT(asked.err, Contains("`sphparam map --repair=duplicates` removes such faces"));
  const Folder folder;
  const std::string map = folder / "map.ply";
  for (const char* repair : {"--repair", "--repair=duplicates"}) {
    const Ended mended = sphparam_program({"map", "-", "-o", map, "--json", "-", repair}, faulty);
    INFO(mended.err);
    REQUIRE(mended.code == 0);
    CHECK_THAT(mended.err, Contains("2 faces that named a vertex twice removed"));
    const Json report = Json::parse(mended.out);
    CHECK(report["repairs"][0]["kind"] == "invalid-face-removed");
    CHECK(report["repairs"][0]["count"] == 2);
    CHECK(report["options"]["repair"][0] == "duplicates");
    CHECK(report["options"]["repair"].size() == (std::string(repair) == "--repair" ? 7 : 2));
    CHECK(sphparam_program({"verify", map}).code == 0);
  }
  const Ended unasked =
      sphparam_program({"map", "-", "-o", map, "--json", "-"}, obj_text(icosphere(1)));
  const Json options = Json::parse(unasked.out)["options"];
  CHECK(options["repair"].empty());
  CHECK(options["repair_map"] == false);
}

TEST_CASE("repair: triangles that are written as quads stay") {
  const TriangleMesh ball = icosphere(1);
  std::string quads = obj_text(ball);
  quads.resize(quads.find("f "));
  for (Face f = 0; f < ball.face_count(); ++f) {
    quads += "f";
    for (const int k : {0, 1, 2, 2})
      quads.append(" ").append(std::to_string(ball.triangles(f, k) + 1));
    quads += "\n";
  }
  const Folder folder;
  CHECK(sphparam_program({"map", "-", "-o", folder / "map.ply"}, quads).code == 3);
  const Ended mended = sphparam_program(
      {"map", "-", "-o", folder / "map.ply", "--json", "-", "--repair=duplicates"}, quads);
  INFO(mended.err);
  REQUIRE(mended.code == 0);
  const Json report = Json::parse(mended.out);
  CHECK(report["input"]["triangles"] == ball.face_count());
  CHECK(report["repairs"].empty());
  CHECK_THAT(report["notes"].dump(), Contains("80 faces name a vertex twice in a row: taken once"));
}

TEST_CASE("repair: info says what --repair would do") {
  const Ended text = sphparam_program({"info", "-"}, obj_text(with_a_hole()));
  CHECK(text.code == 4);
  CHECK_THAT(text.out, Contains("--repair would mend it") && Contains("1 hole filled"));
  const Json json =
      Json::parse(sphparam_program({"info", "-", "--json"}, obj_text(with_a_hole())).out);
  CHECK(json["repair"]["mends"] == true);
  CHECK(json["repair"]["actions"][0]["kind"] == "hole-filled");
  CHECK(Json::parse(sphparam_program({"info", "-", "--json"}, obj_text(icosphere(1))).out)["repair"]
            .is_null());
}

TEST_CASE("repair: what makes no sense is a usage error with a suggestion") {
  const std::string ball = obj_text(icosphere(1));
  const Ended misspelt = sphparam_program({"map", "-", "-o", "-", "--repair=hole"}, ball);
  CHECK(misspelt.code == 2);
  CHECK_THAT(misspelt.err, Contains("did you mean holes?"));
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair="}, ball).code != 1);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--component", "0"}, ball).code == 2);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--max-hole", "2"}, ball).code == 2);
}

}  // namespace sphparam::tests
