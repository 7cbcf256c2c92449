#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/joined.h"
#include "support/test_meshes.h"

/// What is told of surfaces that cross themselves in space.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// The corner of a block, cut off where its edges are 4 long.
TriangleMesh block_corner() {
  TriangleMesh mesh{Points::Zero(4, 3), Triangles(4, 3)};
  for (int k = 0; k < 3; ++k) mesh.positions(k + 1, k) = 4;
  mesh.triangles << 0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3;
  return mesh;
}

/// An L of 20 large triangles: 80 × 60 × 25, walls 8 thick.
TriangleMesh bracket() {
  TriangleMesh mesh{Points(12, 3), Triangles(20, 3)};
  mesh.positions << 0, 0, 0, 80, 0, 0, 80, 8, 0, 8, 8, 0, 8, 60, 0, 0, 60, 0,  //
      0, 0, 25, 80, 0, 25, 80, 8, 25, 8, 8, 25, 8, 60, 25, 0, 60, 25;
  mesh.triangles << 0, 1, 7, 0, 7, 6, 1, 2, 8, 1, 8, 7, 2, 3, 9, 2, 9, 8, 3, 4, 10, 3, 10, 9,  //
      4, 5, 11, 4, 11, 10, 5, 0, 6, 5, 6, 11, 3, 5, 4, 9, 10, 11, 3, 0, 5, 9, 11, 6, 3, 1, 0,  //
      9, 6, 7, 3, 2, 1, 9, 7, 8;
  return mesh;
}

}  // namespace

TEST_CASE("info: the pairs of triangles that cross are counted, and where the first is") {
  const std::string ball = obj_text(icosphere(2));
  CHECK_THAT(sphparam_program({"info", "-"}, ball).out, Contains("crossings     none: "));
  const Json none = Json::parse(sphparam_program({"info", "-", "--json", "-"}, ball).out);
  CHECK(none["crossings"] == Json::parse(R"({"pairs": 0, "triangles": 0, "first": null,
                                             "all_looked_at": true})"));
  const std::string blocks = obj_text(joined(block_corner(), block_corner(), {1, 1, 1}));
  CHECK_THAT(
      sphparam_program({"info", "-"}, blocks).out,
      Contains("crossings     3 pairs of 4 triangles, the first 3 and 4 at (2.5, 2.5, 1)\n"));
  const Json found = Json::parse(sphparam_program({"info", "-", "--json", "-"}, blocks).out);
  CHECK(found["crossings"] == Json::parse(R"({"pairs": 3, "triangles": 4,
      "first": {"triangles": [3, 4], "place": [2.5, 2.5, 1]}, "all_looked_at": true})"));
}

TEST_CASE("info --no-crossings: they are not looked for, and everything else is told as ever") {
  const std::string ball = obj_text(icosphere(2));
  const std::string all = sphparam_program({"info", "-"}, ball).out;
  const std::string counted = all.substr(all.find("  crossings"));
  std::string expected = all;
  expected.replace(all.find("  crossings"), counted.find('\n'), "  crossings     not looked for");
  const Ended ended = sphparam_program({"info", "-", "--no-crossings"}, ball);
  CHECK(ended.code == sphparam_program({"info", "-"}, ball).code);
  CHECK(ended.out == expected);
  const Ended json = sphparam_program({"info", "-", "--no-crossings", "--json", "-"}, ball);
  CHECK(Json::parse(json.out)["crossings"].is_null());
}

TEST_CASE("remesh: faces that cross or lie inverted in space are warned of, and info finds them") {
  const Folder folder;
  const std::string part = folder / "part.obj", out = folder / "new.obj";
  write_bytes(part, obj_text(bracket()));
  const Ended ended =
      sphparam_program({"remesh", part, "--grid", "ico:3", "-o", out, "--json", "-"});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("warning: ico:3: ") &&
                            Contains("what is proved is the map; a map bends at the "));
  const Json report = Json::parse(ended.out);
  REQUIRE(report["warnings"].size() == 1);
  const Json& found = report["in_space"];
  CHECK(found["triangles"] >= found["crossings"]["triangles"]);
  CHECK(found["turned_over"] > 0);
  CHECK((found["area_share"] > 0 && found["area_share"] < 0.1));
  CHECK(found["crossings_of_mesh"] == 0);
  const Json again = Json::parse(sphparam_program({"info", out, "--json", "-"}).out);
  CHECK(again["crossings"] == found["crossings"]);
  CHECK(again["crossings"]["pairs"] > 0);
}

TEST_CASE("remesh: where all faces lie well nothing is said of it") {
  const Folder folder;
  const std::string ball = folder / "ball.obj";
  write_bytes(ball, obj_text(icosphere(4)));
  const Ended ended = sphparam_program(
      {"remesh", ball, "--grid", "ico:3", "--lods", "1", "-o", folder / "new.ply", "--json", "-"});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, !Contains("warning"));
  const Json report = Json::parse(ended.out);
  CHECK(report["warnings"].empty());
  CHECK(report["in_space"]["triangles"] == 0);
  CHECK(report["lods"][1]["in_space"]["crossings"]["pairs"] == 0);
}

TEST_CASE("wrap: triangles that cross are counted where there are fewer than the lattice has") {
  const Folder folder;
  const std::string soup = folder / "soup.obj", out = folder / "wrap.obj";
  write_bytes(soup, obj_text(joined(block_corner(), block_corner(), {1, 1, 1})));
  const auto wrapped = [&](const std::string& faces) {
    const Ended ended = sphparam_program(
        {"wrap", soup, "--resolution", "24", "--faces", faces, "-o", out, "--json", "-"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return Json::parse(ended.out);
  };
  CHECK(wrapped("0")["crossings"].is_null());
  CHECK(wrapped("0")["warnings"].empty());
  const Json found = wrapped("500");
  CHECK(found["warnings"].size() == (found["crossings"]["pairs"] > 0 ? 1 : 0));
  const Json again = Json::parse(sphparam_program({"info", out, "--json", "-"}).out);
  CHECK(again["crossings"] == found["crossings"]);
}

}  // namespace sphparam::tests
