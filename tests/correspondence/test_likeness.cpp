#include <catch2/catch.hpp>

#include "sphparam/correspondence/likeness.h"
#include "sphparam/correspondence/surface_map.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

/// Three bumps, one of them an arm: no symmetry, and sides that lie near one another.
Vector3 bumpy(const Vector3& x) {
  const Vector3 bumps[] = {{1, 0.2, 0.1}, {-0.3, 1, 0.2}, {0.1, -0.4, 1}};
  double radius = 1, height = 1.4;
  for (const Vector3& bump : bumps) {
    radius += height * std::exp(-8 * (x - bump.normalized()).squaredNorm());
    height *= 0.6;
  }
  return radius * x;
}

TriangleMesh bumpy(TriangleMesh mesh) {
  for (Vertex v = 0; v < mesh.vertex_count(); ++v)
    mesh.positions.row(v) = bumpy(Vector3(mesh.position(v).normalized()));
  return mesh;
}

MappedMesh mapped(TriangleMesh mesh, const Vector3& turn_by = Vector3::Zero()) {
  SphereMap map = parameterize(mesh).map;
  if (!turn_by.isZero()) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(turn_by.norm(), turn_by.normalized()).toRotationMatrix();
    map.points = (map.points * turn.transpose()).eval();
  }
  MeshFile file;
  file.mesh = std::move(mesh);
  return MappedMesh({.file = std::move(file), .map = std::move(map)});
}

/// Other triangles than those of any level: turned before the surface is bent.
TriangleMesh other_triangles(int level) {
  TriangleMesh mesh = icosphere(level);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(2, -1, 3).normalized()).matrix();
  mesh.positions = (mesh.positions * turn.transpose()).eval();
  return bumpy(std::move(mesh));
}

}  // namespace

TEST_CASE("a mesh mapped like itself has its own map") {
  const MappedMesh other = mapped(bumpy(icosphere(3)), {0.3, -1, 0.4});
  const Likeness like = map_like(mapped(other.mesh()), other);
  CHECK(like.in_place == 1);  // no rounding beyond all of the area
  CHECK(like.nowhere == 0);
  CHECK(like.farthest < 1e-12);
  CHECK((like.mapped.map().points - other.map().points).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE(
    "a coarse mesh with triangles of its own lies in each direction where the fine one does") {
  const MappedMesh fine = mapped(bumpy(icosphere(5)), {-1, 0.5, 2});
  const MappedMesh low = mapped(other_triangles(3));
  const double before =
      (SurfaceMap(low, fine).from_on_to().positions - low.mesh().positions).rowwise().norm().mean();
  const Likeness like = map_like(low, fine);
  const double after = (SurfaceMap(like.mapped, fine).from_on_to().positions - low.mesh().positions)
                           .rowwise()
                           .norm()
                           .mean();
  CHECK(before > 0.5);
  CHECK(after < 0.01);
  CHECK(like.in_place > 0.99);
  CHECK(like.farthest < 0.02);
  CHECK(like.mapped.certificate().bijective());
}

TEST_CASE("likeness is the same for any number of threads") {
  const MappedMesh fine = mapped(bumpy(icosphere(4))), low = mapped(other_triangles(3));
  const Points one = map_like(low, fine, {.threads = 1}).mapped.map().points;
  CHECK(one == map_like(low, fine, {.threads = 3}).mapped.map().points);
}

TEST_CASE("a mesh that is elsewhere is like nothing there") {
  const MappedMesh fine = mapped(bumpy(icosphere(3)));
  TriangleMesh away = other_triangles(2);
  away.positions.col(0).array() += 3;
  CHECK_THROWS_AS(map_like(mapped(away), fine), UnlikeSurfaces);
}

TEST_CASE("a mesh that is near to a little of another one is not like it") {
  const MappedMesh fine = mapped(bumpy(icosphere(4)));
  TriangleMesh small = other_triangles(3);  // of some 2
  small.positions *= 0.05;
  small.positions.col(2).array() += 0.95;
  CHECK_THROWS_WITH(map_like(mapped(small), fine),
                    Catch::Contains("half of it is more than") && Catch::Contains("scaled?"));
}

TEST_CASE("what is nearest to a side that faces another way is told, and one-to-one all the same") {
  const MappedMesh fine = mapped(bumpy(icosphere(4)));
  TriangleMesh low = other_triangles(3);
  low.positions *= 0.6;  // beneath the surface; within the arm nearer to its other side
  const Likeness like = map_like(mapped(low), fine);
  CHECK(like.nowhere > 0);
  CHECK(like.nowhere < 0.5);
  CHECK(like.mapped.certificate().bijective());
}

}  // namespace sphparam::tests
