#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"

/// `sphparam remesh --adaptive`, and the map that `remesh` makes where there is none.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// A ball with a thin spike: most of its bending is in the spike.
TriangleMesh spiked_ball() {
  TriangleMesh mesh = icosphere(4);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions(v, 2) > 0.97) mesh.positions(v, 2) += 60 * (mesh.positions(v, 2) - 0.97);
  }
  return mesh;
}

double rms_between(const std::string& one, const std::string& other, const std::string& json) {
  REQUIRE(sphparam_program({"measure", one, other, "--samples", "20000", "--json", json}).code ==
          0);
  return Json::parse(bytes_of(json))["two_sided"]["RMS"];
}

}  // namespace

TEST_CASE("remesh: --adaptive is nearer to the source, certified, and reported") {
  const Folder folder;
  const std::string mesh = folder / "shape.obj", mapped = folder / "shape.sph.ply",
                    plain = folder / "plain.ply", adaptive = folder / "adaptive.ply",
                    json = folder / "report.json";
  write_bytes(mesh, obj_text(spiked_ball()));
  REQUIRE(sphparam_program({"map", mesh, "-o", mapped}).code == 0);
  for (const std::string& source : {mesh, mapped}) {  // without a map, and with one
    INFO(source);
    REQUIRE(sphparam_program({"remesh", source, "--grid", "ico:3", "-o", plain}).code == 0);
    REQUIRE(sphparam_program(
                {"remesh", source, "--grid", "ico:3", "-o", adaptive, "--adaptive", "--json", json})
                .code == 0);
    const Json report = Json::parse(bytes_of(json))["adaptive"];
    CHECK(report["steps"] > 0);
    CHECK(report["least_density"] < 1);
    CHECK(report["greatest_density"] > 1);
    CHECK(sphparam_program({"verify", adaptive}).code == 0);
    CHECK_THAT(bytes_of(adaptive), Contains("--adaptive"));
    CHECK(rms_between(mesh, adaptive, json) < 0.95 * rms_between(mesh, plain, json));
  }
}

TEST_CASE("remesh: --lambda is that of the map that is made, or adapted") {
  const Folder folder;
  const std::string mesh = folder / "shape.obj", mapped = folder / "shape.sph.ply",
                    out = folder / "new.xyz.csv";
  write_bytes(mesh, obj_text(spiked_ball()));
  const auto rows_of = [&](const std::string& source, const std::vector<std::string>& more) {
    std::vector<std::string> line = {"remesh", source, "--grid", "ico:3", "--csv", out};
    line.insert(line.end(), more.begin(), more.end());
    REQUIRE(sphparam_program(line).code == 0);
    return bytes_of(out);
  };
  for (const char* lambda : {"1", "5", "20"}) {
    INFO(lambda);
    REQUIRE(sphparam_program({"map", mesh, "--lambda", lambda, "-o", mapped}).code == 0);
    CHECK(rows_of(mesh, {"--lambda", lambda}) == rows_of(mapped, {}));
  }
  CHECK(rows_of(mesh, {}) == rows_of(mesh, {"--lambda", "5"}));
  CHECK(rows_of(mapped, {"--adaptive"}) == rows_of(mapped, {"--adaptive", "--lambda", "5"}));
  CHECK(rows_of(mapped, {"--adaptive"}) != rows_of(mapped, {"--adaptive", "--lambda", "1"}));
}

TEST_CASE("remesh: --lambda is refused where a map is there, and of numbers that are none") {
  const Folder folder;
  const std::string mesh = folder / "shape.obj", mapped = folder / "shape.sph.ply";
  write_bytes(mesh, obj_text(icosphere(2)));
  REQUIRE(sphparam_program({"map", mesh, "-o", mapped}).code == 0);
  const Ended there = sphparam_program(
      {"remesh", mapped, "--grid", "ico:2", "--lambda", "1.5", "-o", folder / "new.ply"});
  CHECK(there.code == 2);
  CHECK_THAT(there.err, Contains("shape.sph.ply has one: map the mesh anew, as by `sphparam map "
                                 "--lambda 1.5`, or leave --lambda out"));
  const Ended none = sphparam_program(
      {"remesh", mesh, "--grid", "ico:2", "--lambda", "0", "-o", folder / "new.ply"});
  CHECK(none.code == 2);
  CHECK_THAT(none.err, Contains("1e-10 to 1e6"));
}

TEST_CASE("remesh: --adaptive has the same bytes for one thread and three") {
  const Folder folder;
  const std::string mesh = folder / "shape.obj", out = folder / "new.ply";
  write_bytes(mesh, obj_text(spiked_ball()));
  std::string first;
  for (const char* threads : {"1", "3"}) {
    REQUIRE(sphparam_program({"remesh", mesh, "--grid", "octa:17", "--adaptive", "-o", out,
                              "--threads", threads})
                .code == 0);
    if (first.empty()) first = bytes_of(out);
    CHECK(bytes_of(out) == first);
  }
}

TEST_CASE("remesh: a mesh without a map gets the one that spreads a grid's vertices best") {
  const Folder folder;
  const std::string mesh = folder / "shape.obj", mapped = folder / "shape.sph.ply",
                    from_mesh = folder / "a.csv", from_map = folder / "b.csv";
  write_bytes(mesh, obj_text(spiked_ball()));
  REQUIRE(sphparam_program({"map", mesh, "--lambda", "5", "-o", mapped}).code == 0);
  REQUIRE(sphparam_program({"remesh", mesh, "--grid", "ico:2", "--csv", from_mesh}).code == 0);
  REQUIRE(sphparam_program({"remesh", mapped, "--grid", "ico:2", "--csv", from_map}).code == 0);
  CHECK(bytes_of(from_mesh) == bytes_of(from_map));
}

}  // namespace sphparam::tests
