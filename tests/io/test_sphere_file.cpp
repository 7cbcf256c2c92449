#include <catch2/catch.hpp>

#include "reading.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

MeshFile icosphere_file() {
  MeshFile file;
  file.mesh = icosphere(2);
  file.mesh.positions *= 3;
  return file;
}

const Provenance provenance = {
    {"version", "0.1.0"}, {"options", "--method paper --kappa 1"}, {"verdict", "certified"}};

}  // namespace

TEST_CASE("sphere_file: a written map is read back bit for bit") {
  const SphereMap map{icosphere(2).positions};
  const MeshFile back = read(serialise_ply(attach_map(icosphere_file(), map, provenance)));
  REQUIRE(read_sphere(back));
  CHECK(read_sphere(back)->points == map.points);
  CHECK(read_provenance(back) == provenance);
  for (const char* name : {"theta", "phi", "sx", "sy", "sz"})
    CHECK(back.find_vertex_property(name)->type == ScalarType::Float64);
}

TEST_CASE("sphere_file: theta and phi follow the convention") {
  const SphereMap map{icosphere(2).positions};
  const MeshFile file = attach_map(icosphere_file(), map, {});
  for (int v = 0; v < 162; ++v) {
    const Vector3 ray = to_cartesian({file.find_vertex_property("theta")->values[v],
                                      file.find_vertex_property("phi")->values[v]});
    CHECK((ray - map.point(v)).norm() < 1e-15);
  }
}

TEST_CASE("sphere_file: an earlier map is replaced, other comments stay") {
  MeshFile file = icosphere_file();
  file.comments = {"scanned by hand"};
  const SphereMap first{icosphere(2).positions}, second{Points(-first.points)};
  const MeshFile twice =
      attach_map(attach_map(file, first, provenance), second, {{"stage", "x y"}});
  CHECK(twice.vertex_properties.size() == 5);
  CHECK(read_sphere(twice)->points == second.points);
  CHECK(twice.comments == std::vector<std::string>{"scanned by hand", "sphparam stage x y"});
}

TEST_CASE("sphere_file: without its map a mesh has no verdict on one") {
  const SphereMap map{icosphere(2).positions};
  MeshFile file = attach_map(icosphere_file(), map, provenance);
  file.comments.push_back("scanned by hand");
  CHECK(has_map(file));
  const MeshFile bare = without_map(file);
  CHECK_FALSE(has_map(bare));
  CHECK(bare.vertex_properties.empty());
  CHECK(bare.comments == std::vector<std::string>{"sphparam version 0.1.0",
                                                  "sphparam options --method paper --kappa 1",
                                                  "scanned by hand"});
  CHECK(has_map(sphere_mesh(file, map, provenance)));
  CHECK(has_map(sphere_mesh(file, {100 * map.points}, provenance)));
}

TEST_CASE("sphere_file: of what surface a sphere is, it keeps which structure, not which layer") {
  MeshFile file = icosphere_file();
  file.comments = {"gifti AnatomicalStructurePrimary CortexLeft",
                   "gifti AnatomicalStructureSecondary GrayWhite", "gifti label 1 - sulcus"};
  const MeshFile sphere = sphere_mesh(file, {icosphere(2).positions}, {});
  CHECK(sphere.comments == std::vector<std::string>{"gifti AnatomicalStructurePrimary CortexLeft"});
}

TEST_CASE("sphere_file: a mesh without all three coordinates carries no map") {
  MeshFile file = attach_map(icosphere_file(), {icosphere(2).positions}, {});
  remove_properties(file.vertex_properties, {"sy"});
  CHECK_FALSE(read_sphere(file));
  CHECK_FALSE(read_sphere(icosphere_file()));
}

TEST_CASE("sphere_file: provenance is read from any comment of its form") {
  MeshFile file;
  file.comments = {"sphparam stage", "sphparam", "sphparam a b c", "sphparamx y"};
  CHECK(read_provenance(file) == Provenance{{"stage", ""}, {"a", "b c"}});
}

TEST_CASE("sphere_file: the bare sphere is the mesh of the rays in every format") {
  const SphereMap map{icosphere(2).positions};
  const MeshFile sphere = sphere_mesh(icosphere_file(), map, provenance);
  for (const auto serialise : {serialise_ply, serialise_obj, serialise_off}) {
    const MeshFile back = read(serialise(sphere));
    CHECK(back.mesh.positions == map.points);
    CHECK(back.mesh.triangles == icosphere(2).triangles);
    CHECK(read_provenance(back) == provenance);
  }
}
