#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// Two open boxes of which nothing fits: a sheet with a hole, and a ball without its top.
std::string soup() {
  TriangleMesh ball = icosphere(2);
  ball.triangles.conservativeResize(ball.face_count() - 40, 3);
  return obj_text(ball) +
         "v 3 0 0\nv 5 0 0\nv 5 0 2\nv 3 0 2\nf -4 -3 -2\nf -4 -2 -1\nf -3 -2 -4\n";
}

}  // namespace

TEST_CASE("wrap command: a soup becomes a surface that is mapped and certified") {
  const Folder folder;
  const std::string out = folder / "wrapped.ply", map = folder / "wrapped.sph.ply";
  const Ended ended = sphparam_program({"wrap", "-", "-o", out, "--resolution", "40"}, soup());
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("voxel 0.15, at distance 0.3") &&
                            Contains("2 parts are apart at this distance: joined by bridges") &&
                            Contains("walls and bridges are") &&
                            Contains("0 of 159 vertices are outside") &&
                            Contains("it can be mapped → wrapped.ply"));
  CHECK(inspect_mesh(read_mesh(out).mesh).defects.empty());
  CHECK(sphparam_program({"map", out, "-o", map, "-q"}).code == 0);
  CHECK(sphparam_program({"verify", map}).code == 0);
}

TEST_CASE("wrap command: --faces leaves so many, and which axis is up goes along") {
  const Folder folder;
  const std::string glb = folder / "a.glb", out = folder / "w.ply";
  REQUIRE(sphparam_program({"export", "-", "-o", glb}, obj_text(icosphere(3))).code == 0);
  const Ended ended =
      sphparam_program({"wrap", glb, "-o", out, "--resolution", "40", "--faces", "500"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("of the lattice became 500"));
  const MeshFile file = read_mesh(out);
  CHECK(file.mesh.face_count() == 500);
  CHECK(inspect_mesh(file.mesh).is_sphere());
  CHECK(sphparam::noted_up(file).direction == Vector3::UnitY());
  CHECK(sphparam_program({"wrap", glb, "-o", out, "--faces", "-1"}).code == 2);
}

TEST_CASE("wrap command: --gap draws it in, which is told, and a solid has its size again") {
  const Folder folder;
  const std::string out = folder / "w.ply";
  const Ended ended = sphparam_program(
      {"wrap", "-", "-o", out, "--resolution", "40", "--gap", "0.001", "--json", "-"},
      obj_text(icosphere(3)));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("at distance 0.1, drawn in to 0.001"));
  CHECK(read_mesh(out).mesh.positions.cwiseAbs().maxCoeff() == Approx(1.0005).margin(6e-4));
  const Json json = Json::parse(ended.out);
  CHECK(json["gap"] == 0.001);
  CHECK(json["insides"] == 1);
  CHECK(json["cavities"] == 0);
  CHECK(sphparam_program({"wrap", "-", "-o", out, "--gap", "1"}, obj_text(icosphere(1))).code == 2);
}

TEST_CASE("wrap command: the largest part alone, in the report too") {
  const Folder folder;
  const std::string out = folder / "wrapped.ply";
  const Ended ended = sphparam_program(
      {"wrap", "-", "-o", out, "--voxel", "0.15", "--largest", "--json", "-"}, soup());
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err,
             Contains("the largest is kept, ") && Contains("4 of 159 vertices are outside"));
  const Json report = Json::parse(ended.out);
  CHECK(report["parts"] == 2);
  CHECK(report["outside"] == 4);
  CHECK(report["kept_share"].get<double>() < 0.9);
  CHECK(report["triangles"] == read_mesh(out).mesh.face_count());
}

TEST_CASE("wrap command: a skin about an open ball is told, with the distance that closes it") {
  const Folder folder;
  const std::string out = folder / "w.ply";
  TriangleMesh ball = icosphere(3);
  ball.triangles = ball.triangles.bottomRows(ball.face_count() - 100).eval();
  const auto wrapped = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line = {"wrap", "-", "-o", out, "--voxel", "0.1", "--json", "-"};
    line.insert(line.end(), more.begin(), more.end());
    return sphparam_program(line, obj_text(ball));
  };
  const Ended ended = wrapped({});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  CHECK(report["skin"] == true);
  const double volume = inspect_mesh(read_mesh(out).mesh).volume;
  CHECK(report["volume"].get<double>() == Approx(volume).epsilon(1e-6));
  CHECK(report["soup_area"].get<double>() == Approx(inspect_mesh(ball).area).epsilon(1e-6));
  CHECK_THAT(ended.err, Contains("encloses no more than a skin about open sheets") &&
                            Contains("; about --distance " + report["closing_distance"].dump()));
  const Ended closed = wrapped({"--distance", report["closing_distance"].dump()});
  CHECK(Json::parse(closed.out)["skin"] == false);
  CHECK(Json::parse(closed.out)["closing_distance"].is_null());
  CHECK_THAT(closed.err, !Contains("skin") && Contains("the wrap encloses "));
}

TEST_CASE("wrap command: a voxel larger than the soup is told") {
  const Folder folder;
  const auto said = [&](const char* voxel) {
    return sphparam_program({"wrap", "-", "-o", folder / "w.ply", "--voxel", voxel},
                            obj_text(icosphere(2)))
        .err;
  };
  CHECK_THAT(said("2.5"), Contains("a voxel of 2.5 is larger than all of the soup, 2: "));
  CHECK_THAT(said("1.5"), Contains("a distance of 3 is larger than all of the soup, 2: "));
  CHECK_THAT(said("0.5"), !Contains("larger than"));
}

TEST_CASE("wrap command: the same file for any number of threads") {
  const Folder folder;
  for (const char* threads : {"1", "2"}) {
    REQUIRE(sphparam_program({"wrap", "-", "-o", folder / (std::string(threads) + ".ply"),
                              "--threads", threads, "--resolution", "40"},
                             soup())
                .code == 0);
  }
  CHECK(bytes_of(folder / "1.ply") == bytes_of(folder / "2.ply"));
}

TEST_CASE("wrap command: what the soup carries is told to stay behind") {
  const Ended ended =
      sphparam_program({"wrap", "-", "-o", "-", "--resolution", "10"},
                       "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err,
             Contains("stays with the soup: 3 properties of vertices, texture coordinates"));
}

TEST_CASE("wrap command: vertices without a place are left out with their faces, and told") {
  const Folder folder;
  const std::string out = folder / "wrapped.ply";
  const TriangleMesh ball = icosphere(2);
  const std::string lost = "v nan 0 0\n", face = std::to_string(ball.vertex_count() + 1);
  const Ended ended = sphparam_program({"wrap", "-", "-o", out, "--resolution", "16"},
                                       obj_text(ball) + lost + "f 1 2 " + face + "\n");
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err,
             Contains("  1 face removed that had a vertex without a place: faces 320\n") &&
                 Contains("  1 vertex dropped whose coordinates were no finite numbers") &&
                 !Contains("stays with the soup"));
  CHECK(bytes_of(out).size() > 1000);
}

TEST_CASE("wrap command: what makes no sense is refused, and nothing is written") {
  const Folder folder;
  const std::string out = folder / "wrapped.ply";
  const auto refused = [&](const std::vector<std::string>& more, const std::string& mesh) {
    std::vector<std::string> line = {"wrap", "-", "-o", out};
    line.insert(line.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(line, mesh);
    CHECK(folder.names().empty());
    return ended;
  };
  CHECK_THAT(refused({"--voxel", "1e-5"}, soup()).err,
             Contains("--voxel is 1e-05: it must be about"));
  CHECK(refused({"--voxel", "1e-5"}, soup()).code == 2);
  CHECK_THAT(refused({"--resolution", "50000"}, soup()).err,
             Contains("--resolution is 50000: it must be about ") && Contains(" or less here"));
  CHECK_THAT(refused({"--distance", "1e-5"}, soup()).err,
             Contains("--distance is 1e-05: it must be about "));
  CHECK_THAT(refused({"--voxel", "0.1", "--distance", "0.05"}, soup()).err,
             Contains("--distance is 0.05: it must be a finite number, at least 0.1"));
  CHECK(refused({"--voxel", "1", "--resolution", "9"}, soup()).code == 2);
  for (const char* option : {"--voxel", "--distance", "--resolution"}) {  // not what is usual
    CHECK(refused({option, "0"}, soup()).code == 2);
    CHECK_THAT(refused({option, "0"}, soup()).err, Contains(option));
  }
  CHECK(refused({}, "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n").code == 3);
  CHECK(refused({}, "v 0 0 0\n").code == 3);
  CHECK(refused({}, "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n").code == 4);
}

}  // namespace sphparam::tests
