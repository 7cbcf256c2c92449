#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "program.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/joined.h"
#include "support/test_meshes.h"
#include "support/torus.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

}  // namespace

TEST_CASE("info: a sphere is mappable, its figures are right") {
  const Ended ended = sphparam_program({"info", "-", "--json", "-"}, obj_text(icosphere(3)));
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  for (const char* key :
       {"sphparam", "command", "input", "inspection", "welded", "provenance", "notes", "seconds"}) {
    CHECK(report.contains(key));
  }
  const Json& inspection = report["inspection"];
  CHECK(inspection["mappable"] == true);
  CHECK(inspection["vertices"] == 642);
  CHECK(inspection["triangles"] == 1280);
  CHECK(inspection["euler_characteristic"] == 2);
  CHECK(inspection["area"].get<double>() == Approx(12.5).margin(0.1));
  CHECK(inspection["volume"].get<double>() == Approx(4.15).margin(0.1));
}

TEST_CASE("info: cavities are told, not sent to a wrap, and not called inside out") {
  const Folder folder;
  TriangleMesh cavity = icosphere(1);
  cavity.positions *= 0.1;
  cavity.triangles.col(1).swap(cavity.triangles.col(2));
  const std::string mesh = folder / "hollow.obj";
  write_bytes(mesh, obj_text(joined(icosphere(3), cavity, {0.5, 0, 0})));
  CHECK_THAT(sphparam_program({"info", mesh}).out,
             Contains("components    2, 1 of them a cavity within the largest: volume 0.0036"));
  const Json found = Json::parse(sphparam_program({"info", mesh, "--json", "-"}).out)["cavities"];
  CHECK(found["count"] == 1);
  CHECK(found["share"].get<double>() ==
        Approx(inspect_mesh(icosphere(1)).volume / inspect_mesh(icosphere(3)).volume / 1000));
  const Ended kept = sphparam_program({"map", mesh, "--repair", "-o", folder / "a.sph.ply"});
  CHECK_THAT(kept.err, Contains("1 component dropped, a cavity within what was kept (volume ") &&
                           !Contains("sphparam asset"));
  const Ended all = sphparam_program({"map", mesh, "--all-components", "-o", folder / "b.sph.ply"});
  CHECK(all.code == 0);
  CHECK_THAT(all.err, Contains("a cavity within component 1)") && !Contains("inside out"));
}

TEST_CASE(
    "info: a mesh whose faces look both ways has no volume, one inside out is told what turns it") {
  TriangleMesh mixed = icosphere(1);
  mixed.triangles.row(5).reverseInPlace();
  const std::string text = obj_text(mixed);
  CHECK_THAT(sphparam_program({"info", "-"}, text).out, Contains("area") && !Contains("volume"));
  const Json inspection =
      Json::parse(sphparam_program({"info", "-", "--json", "-"}, text).out)["inspection"];
  CHECK(inspection["volume"].is_null());
  TriangleMesh inward = icosphere(1);
  inward.triangles.col(1).swap(inward.triangles.col(2));
  CHECK_THAT(sphparam_program({"info", "-"}, obj_text(inward)).out,
             Contains("  volume        -") &&
                 Contains("it can be mapped.\nIts faces point inwards: --repair=orientation turns "
                          "them.\n"));
}

TEST_CASE(
    "info: what parts share counts twice, which is told, and length, width and thickness are") {
  const Folder folder;
  TriangleMesh limb = icosphere(3), small = icosphere(1);
  limb.positions *= Eigen::Vector3d(2, 8, 4).asDiagonal();
  small.positions *= 0.5;
  const std::string mesh = folder / "m.obj";
  const auto reported = [&](const TriangleMesh& written) {
    write_bytes(mesh, obj_text(written));
    return Json::parse(sphparam_program({"info", mesh, "--json", "-"}).out);
  };
  const Json alone = reported(limb);
  for (const auto& [axis, extent] : {std::pair(0, 16.0), {1, 8.0}, {2, 4.0}})
    CHECK(alone["body"]["extents"][axis].get<double>() == Approx(extent).epsilon(1e-12));
  CHECK(alone["counted_twice"] == false);
  CHECK_THAT(sphparam_program({"info", mesh}).out,
             Contains("\n  extents       16, 8, 4 along these\n") && !Contains("counted twice"));
  CHECK(reported(joined(limb, small, {9, 0, 0}))["counted_twice"] == false);
  CHECK(reported(joined(limb, small, {2.3, 0, 0}))["counted_twice"] == true);
  CHECK_THAT(sphparam_program({"info", mesh}).out,
             Contains("\n  counted twice what parts share, in volume, centroid and inertia: "
                      "triangles of it cross; `sphparam wrap` makes one body of them\n"));
  CHECK_THAT(sphparam_program({"info", mesh, "--no-crossings"}).out, !Contains("counted twice"));
  CHECK(reported(joined(limb, small, {0, 0, 0}))["counted_twice"] == true);
  CHECK_THAT(sphparam_program({"info", mesh, "--no-crossings"}).out,
             Contains("inertia: 1 part lies within the largest, with faces that look out as well"));
  small.triangles.col(1).swap(small.triangles.col(2));
  CHECK(reported(joined(limb, small, {0, 0, 0}))["counted_twice"] == false);  // a cavity
}

TEST_CASE("info: an open mesh has no volume") {
  TriangleMesh open = icosphere(1);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  const std::string text = obj_text(open);
  CHECK_THAT(sphparam_program({"info", "-"}, text).out, Contains("area") && !Contains("volume"));
  const Json inspection =
      Json::parse(sphparam_program({"info", "-", "--json", "-"}, text).out)["inspection"];
  CHECK(inspection["volume"].is_null());
  CHECK(inspection["area"] > 10);
  CHECK_THAT(sphparam_program({"info", "-"}, obj_text(icosphere(1))).out, Contains("volume"));
}

TEST_CASE("info: a torus ends with 4 and its genus is named") {
  const Ended ended = sphparam_program({"info", "-"}, obj_text(torus(12, 8, 2, 1)));
  CHECK(ended.code == 4);
  CHECK_THAT(ended.out, Contains("genus 1"));
  CHECK(sphparam_program({"map", "-", "-o", "-"}, obj_text(torus(12, 8, 2, 1))).code == 4);
}

TEST_CASE("info: lists every defect of a bad mesh with ids") {
  TriangleMesh bad = icosphere(1);
  bad.triangles.row(3) = bad.triangles.row(4);
  const Ended ended = sphparam_program({"info", "-", "--json", "-"}, obj_text(bad));
  REQUIRE(ended.code == 4);
  const Json defects = Json::parse(ended.out)["inspection"]["defects"];
  CHECK(defects.size() >= 2);
  for (const Json& defect : defects) {
    CHECK(defect["count"].get<long>() > 0);
    CHECK_FALSE(defect["message"].get<std::string>().empty());
  }
}

TEST_CASE("info: an unreadable file ends with 3") {
  CHECK(sphparam_program({"info", "/nonexistent.obj"}).code == 3);
  CHECK(sphparam_program({"info", "-"}, "solid nonsense").code == 3);
}

TEST_CASE("info: coordinates that float32 makes coarse are a warning, told once") {
  const Folder folder;
  TriangleMesh mesh = icosphere(2);
  mesh.positions.col(1).array() += 5e6;  // metres of UTM
  mesh.positions = mesh.positions.cast<float>().cast<double>().eval();
  write_bytes(folder / "utm.obj", obj_text(mesh));
  const Ended ended =
      sphparam_program({"info", folder / "utm.obj", "--json", folder / "r.json", "-q"});
  const Json report = Json::parse(bytes_of(folder / "r.json"));
  REQUIRE(report["warnings"].size() == 1);
  CHECK_THAT(
      report["warnings"][0].get<std::string>(),
      Contains("utm.obj: coordinates: so far from the origin, numbers of 32 bits are 0.5 apart"));
  CHECK(sphparam_program({"info", folder / "utm.obj", "--fail-on-warnings"}).code ==
        (ended.code == 0 ? 6 : ended.code));
}

TEST_CASE("info: shows the provenance of a written map") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  REQUIRE(
      sphparam_program({"map", "-", "-o", map, "--method", "curvilinear"}, obj_text(icosphere(2)))
          .code == 0);
  const Ended ended = sphparam_program({"info", map, "--json", "-"});
  REQUIRE(ended.code == 0);
  const Json provenance = Json::parse(ended.out)["provenance"];
  CHECK(provenance["method"] == "curvilinear");
  CHECK(provenance["verdict"] == "one-to-one");
}

TEST_CASE("info: loads few shared objects and nothing of OpenImageIO") {
  // The dynamic loader itself lists what the program needs before its first line runs.
  REQUIRE(setenv("LD_TRACE_LOADED_OBJECTS", "1", 1) == 0);
  const Ended listed = sphparam_program({"info", "-"});
  unsetenv("LD_TRACE_LOADED_OBJECTS");
  CHECK_THAT(listed.out, Contains("libc.so") && !Contains("OpenImageIO"));
  // Those of the C++ runtime, and of tinygltf, libgiftiio, expat, zlib, Embree, OpenSubdiv and
  // meshoptimizer: a millisecond each, and less.
  CHECK(std::count(listed.out.begin(), listed.out.end(), '\n') <= 18);

  // And what it maps while it runs.
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(1)));
  REQUIRE(setenv("LD_DEBUG", "files", 1) == 0);
  const Ended ran = sphparam_program({"info", folder / "ball.obj"});
  unsetenv("LD_DEBUG");
  CHECK(ran.code == 0);
  CHECK_THAT(ran.err, Contains("calling init") && !Contains("OpenImageIO"));
}

}  // namespace sphparam::tests
