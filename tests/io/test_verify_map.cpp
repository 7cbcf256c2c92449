#include <catch2/catch.hpp>

#include "folder.h"
#include "reading.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

std::string write(const Folder& folder, const std::string& name, const MeshFile& file) {
  write_mesh(folder.file(name), file);
  return folder.file(name);
}

MeshFile file_of(TriangleMesh mesh) {
  MeshFile file;
  file.mesh = std::move(mesh);
  return file;
}

MeshFile egg() {
  MeshFile file = file_of(icosphere(2));
  file.mesh.positions.col(2) *= 2;
  return file;
}

MeshFile sphere(double radius) {
  MeshFile file = file_of(icosphere(2));
  file.mesh.positions *= radius;
  return file;
}

}  // namespace

TEST_CASE("verify_map: rays of a mesh are found and proved, with what they distort") {
  const Folder folder;
  const SphereMap map{icosphere(2).positions};
  const VerifiedMap verified = verify_map(write(folder, "egg.ply", attach_map(egg(), map, {})));
  CHECK(verified.certificate.bijective());
  CHECK(verified.place == RayPlace::Rays);
  CHECK(verified.is_round());
  REQUIRE(verified.distortion);
  CHECK(verified.distortion->mean_abs_ln_area > 0.1);
}

TEST_CASE("verify_map: a bare sphere of any radius is its own map") {
  const Folder folder;
  const VerifiedMap verified = verify_map(write(folder, "sphere.obj", sphere(100)));
  CHECK(verified.certificate.bijective());
  CHECK(verified.place == RayPlace::Positions);
  CHECK(verified.mean_length == Approx(100));
  CHECK_FALSE(verified.distortion);
}

TEST_CASE("verify_map: a mesh and its sphere are two files of one connectivity") {
  const Folder folder;
  const std::string shape = write(folder, "egg.obj", egg());
  const VerifiedMap verified = verify_map(shape, {.sphere = write(folder, "s.off", sphere(1))});
  CHECK(verified.of_two_files);
  CHECK(verified.certificate.bijective());
  CHECK(verified.distortion);
  const std::string other = write(folder, "other.off", file_of(icosphere(1)));
  CHECK_THROWS_AS(verify_map(shape, {.sphere = other}), ReadError);
}

TEST_CASE("verify_map: a sphere seen from inside is one-to-one, its faces turned over") {
  const Folder folder;
  MeshFile inside = sphere(1);
  inside.mesh.triangles.col(1).swap(inside.mesh.triangles.col(2));
  const VerifiedMap verified = verify_map(write(folder, "inside.off", inside));
  CHECK(verified.certificate.bijective());
  CHECK(verified.certificate.reversed);
  CHECK(verified.mesh.triangles == icosphere(2).triangles);
}

TEST_CASE("verify_map: a fold is a value, and what is no sphere is said to be none") {
  const Folder folder;
  MeshFile folded = sphere(1);
  folded.mesh.positions.row(5) *= -1;
  CHECK_FALSE(verify_map(write(folder, "folded.off", folded)).certificate.bijective());
  CHECK_FALSE(verify_map(write(folder, "egg.off", egg())).is_round());
}

TEST_CASE("verify_map: where there are no faces nothing is mapped") {
  const Folder folder;
  CHECK_THROWS_AS(verify_map(write(folder, "nothing.ply", {})), MeshError);
}
