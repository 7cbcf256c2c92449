#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "reading.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

std::string write(const Folder& folder, const std::string& name, const MeshFile& file) {
  write_mesh(folder / name, file);
  return folder / name;
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

TEST_CASE("verify_map: no finite radius is too large or too small, one in the file or beside it") {
  const Folder folder;
  const std::string shape = write(folder, "egg.ply", egg());
  const VerifiedMap usual = verify_map(shape, {.sphere = write(folder, "s.ply", sphere(1))});
  for (const double radius : {0x1p600, 0x1p70, 0x1p-600, 1e20, 1e-161, 1e-170, 1e300}) {
    INFO(radius);
    const std::string path = write(folder, "sphere.ply", sphere(radius));
    for (const VerifiedMap& map : {verify_map(path), verify_map(shape, {.sphere = path})}) {
      CHECK(map.certificate.bijective());
      CHECK(map.is_round());
      CHECK(map.mean_length == Approx(radius).epsilon(1e-9));
      if (radius > 1e15) CHECK(map.certificate.max_length_error == Approx(radius).epsilon(1e-9));
    }
    if (std::log2(radius) != std::round(std::log2(radius))) continue;
    const VerifiedMap map = verify_map(shape, {.sphere = path});
    CHECK(map.length_deviation == usual.length_deviation);
    CHECK(map.distortion->symmetric_dirichlet == usual.distortion->symmetric_dirichlet);
  }
}

TEST_CASE("verify_map: rays of any length are certified either way round, and told as they were") {
  TriangleMesh mesh = icosphere(2);
  const TriangleMesh outside = mesh;
  SphereMap map{mesh.positions * -1e100};
  const Certificate certificate = certify_either_way(mesh, map);
  CHECK(certificate.bijective());
  CHECK(certificate.reversed);
  CHECK(certificate.max_length_error == Approx(1e100));
  CHECK(mesh.triangles.col(1) == outside.triangles.col(2));
  CHECK(map.points.cwiseAbs().maxCoeff() <= 0x1p64);
  TriangleMesh open = outside;
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  CHECK_THROWS_AS(certify_either_way(open, map), MeshError);
  TriangleMesh nothing;
  SphereMap none;
  CHECK_FALSE(certify_either_way(nothing, none).bijective());
}

TEST_CASE("verify_map: theta and phi beside the rays are held against them") {
  const Folder folder;
  const SphereMap map{icosphere(2).positions};
  MeshFile file = attach_map(egg(), map, {});
  const VerifiedMap right = verify_map(write(folder, "right.ply", file));
  REQUIRE(right.angles);
  CHECK(right.angles->off == 0);
  CHECK(right.holds());
  CHECK(right.warnings.empty());
  Property theta = *file.find_vertex_property("theta");
  theta.type = ScalarType::Float32;
  for (double& value : theta.values) value = static_cast<double>(static_cast<float>(value));
  theta.values[7] += 2 * std::numbers::pi;  // the same place
  file.set_vertex_property(theta);
  CHECK(verify_map(write(folder, "rounded.ply", file)).holds());
  Property phi = *file.find_vertex_property("phi");
  phi.values[5] += 0.25;
  phi.values[9] += 1e-4;
  file.set_vertex_property(phi);
  const VerifiedMap wrong = verify_map(write(folder, "wrong.ply", file));
  CHECK(wrong.certificate.bijective());
  CHECK_FALSE(wrong.holds());
  REQUIRE(wrong.angles);
  CHECK(wrong.angles->off == 2);
  CHECK(wrong.angles->farthest == Approx(0.25));
  REQUIRE(wrong.warnings.size() == 1);
  CHECK_THAT(wrong.warnings[0], Catch::Contains("theta and phi of 2 vertices are not those"));
  CHECK_FALSE(verify_map(write(folder, "sphere.obj", sphere(1))).angles);
}

TEST_CASE(
    "verify_map: what a header says of poles, meridian and verdict is held against the rays") {
  const Folder folder;
  SphereMap map{icosphere(2).positions};
  map.points = (map.points * (Eigen::Quaterniond::FromTwoVectors(map.point(3), Vector3::UnitZ()))
                                 .toRotationMatrix()
                                 .transpose())
                   .eval();
  map.points.row(3) = Vector3::UnitZ().transpose();
  Vertex south = 0;
  map.points.col(2).minCoeff(&south);
  const auto warnings_of = [&](const Provenance& said) {
    return verify_map(write(folder, "said.ply", attach_map(egg(), map, said))).warnings;
  };
  const std::string poles = "3 " + std::to_string(south);
  CHECK(warnings_of({{"poles", poles}, {"verdict", "one-to-one"}}).empty());
  CHECK(warnings_of({{"poles", "none"}}).empty());
  CHECK_THAT(warnings_of({{"verdict", "folded 3"}}).at(0),
             Catch::Contains("says: folded 3; it is one-to-one"));
  CHECK_THAT(warnings_of({{"poles", "9999992585 " + std::to_string(south)}}).at(0),
             Catch::Contains("vertex 9999992585 is the north pole, and there is none"));
  CHECK_THAT(warnings_of({{"poles", "4 " + std::to_string(south)}}).at(0),
             Catch::Contains("radians from +z"));
  CHECK(warnings_of({{"method", "paper"}, {"poles", "4 5"}}).empty());  // of its date line
  Vertex east = 0;
  map.points.col(1).maxCoeff(&east);
  CHECK_THAT(warnings_of({{"meridian", std::to_string(east)}}).at(0),
             Catch::Contains("from theta = 0"));
}

TEST_CASE("verify_map: what we say of a welded, a split or a repaired mesh is not warned of") {
  const Folder folder;
  SphereMap map{icosphere(2).positions};
  const auto turn = [&](const Eigen::Quaterniond& by) {
    map.points = (map.points * by.toRotationMatrix().transpose()).eval();
  };
  const Vertex north = 3;
  turn(Eigen::Quaterniond::FromTwoVectors(map.point(north), Vector3::UnitZ()));
  Vertex south = 0, front = 0, back = 0;
  map.points.col(2).minCoeff(&south);
  map.points.col(0).maxCoeff(&front);
  const double theta = std::atan2(map.point(front).y(), map.point(front).x());
  turn(Eigen::Quaterniond(Eigen::AngleAxisd(-theta, Vector3::UnitZ())));
  map.points.row(north) = Vector3(-1e-7, 2e-8, 1).transpose();  // as rounding has it
  map.points.col(0).minCoeff(&back);
  Vertex other = 0;  // before the pole, and in no place of these
  while (other == south || other == front || other == back) ++other;
  REQUIRE(other < north);

  std::vector<double> welded;
  for (Vertex v = 0; v < map.points.rows(); ++v) welded.push_back(v + 1000.0);
  std::vector<double> split = welded, repaired = welded;
  split[other] = split[north];
  repaired[other] = repaired[north] = -1;
  for (const std::vector<double>& numbers : {welded, split, repaired}) {
    MeshFile file = egg();
    file.set_vertex_property({"source_vertex", ScalarType::Int32, numbers});
    const auto number = [&](Vertex v) { return std::to_string(std::lround(numbers[v])); };
    const auto said = [&](Vertex meridian) {
      return Provenance{{"poles", number(north) + " " + number(south)},
                        {"meridian", number(meridian)},
                        {"verdict", "one-to-one"}};
    };
    const std::string mesh = write(folder, "mesh.ply", file);
    for (const Vertex meridian : {front, north}) {  // near a pole, every longitude is near
      CHECK(verify_map(write(folder, "m.ply", attach_map(file, map, said(meridian))))
                .warnings.empty());
      for (const char* name : {"s.ply", "s.gii"}) {
        INFO(name);
        save_sphere(folder / name,
                    MappedMesh({.file = file, .map = map, .provenance = said(meridian)}));
        CHECK(verify_map(folder / name).warnings.empty());
        CHECK(verify_map(mesh, {.sphere = folder / name}).warnings.empty());
      }
    }
    save_sphere(folder / "w.ply", MappedMesh({.file = file, .map = map, .provenance = said(back)}));
    CHECK(verify_map(folder / "w.ply").warnings.empty());  // nothing says which vertex it is
    CHECK_THAT(verify_map(mesh, {.sphere = folder / "w.ply"}).warnings.at(0),
               Catch::Contains("from theta = 0"));
  }
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
