#include <catch2/catch.hpp>
#include <random>
#include <utility>

#include "../chart/maps.h"
#include "bake/shared_sphere.h"
#include "sphparam/sphere/sphere_locator.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

struct Egg {
  TriangleMesh mesh;
  SphereMap map;
  Topology topology;

  /// An egg on its own sphere, no two axes alike.
  explicit Egg(int level) : mesh(icosphere(level)), map{mesh.positions}, topology(mesh) {
    stretch();
  }
  void stretch() {
    mesh.positions.col(0) *= 1.5;
    mesh.positions.col(2) *= 0.75;
  }
  MappedMesh view() const {
    MeshFile file;
    file.mesh = mesh;
    return MappedMesh({.file = std::move(file), .map = map}, 1);
  }
  double diagonal() const {
    return (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  }
};

/// Puts the vertices of a mesh where the other's map has their directions.
Egg remeshed(const Egg& high, int level) {
  Egg low(level);
  const SphereLocator locator(high.topology, high.map);
  for (Vertex v = 0; v < low.mesh.vertex_count(); ++v) {
    const SurfacePoint at = locator.locate(low.map.point(v));
    low.mesh.positions.row(v).setZero();
    for (int k = 0; k < 3; ++k)
      low.mesh.positions.row(v) +=
          at.barycentric[k] * high.mesh.positions.row(high.mesh.triangles(at.face, k));
  }
  return low;
}

}  // namespace

TEST_CASE("shared sphere: a mesh made on a sphere agrees with it, however coarse") {
  std::mt19937 random(3);
  Egg high(4);
  high.map = rotated(high.map, random_rotation(random));
  for (const int level : {0, 1, 3, 5})
    CHECK(disagreement(high.view(), remeshed(high, level).view(), 1) < 1e-14);
}

TEST_CASE("shared sphere: a mesh with a map of its own does not") {
  std::mt19937 random(4);
  const Egg high(4);
  Egg low(3);
  CHECK(disagreement(high.view(), low.view(), 1) < doubtful_disagreement);
  low.map = rotated(low.map, random_rotation(random));
  CHECK(disagreement(high.view(), low.view(), 1) > other_sphere_disagreement);
}

TEST_CASE("shared sphere: what is told is the distance, in diagonals, whatever the size") {
  const Egg high(4);
  Egg low = remeshed(high, 3);
  low.mesh.positions.col(1).array() += 0.02 * high.diagonal();
  CHECK(disagreement(high.view(), low.view(), 1) == Approx(0.02).epsilon(0.05));
  for (const double size : {1e-300, 1e300}) {
    Egg large = high, moved = low;
    large.mesh.positions *= size;
    moved.mesh.positions *= size;
    CHECK(disagreement(large.view(), moved.view(), 1) == Approx(0.02).epsilon(0.05));
  }
  Egg point = high;
  point.mesh.positions.setOnes();
  CHECK(disagreement(point.view(), low.view(), 1) == 0);
}
