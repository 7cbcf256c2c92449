#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "rays/ray_scene.h"
#include "support/joined.h"
#include "support/test_meshes.h"
#include "wrap/distance_field.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// How far a field is off, in voxels: where its zero is looked for, and elsewhere outside.
struct Errors {
  double near = 0, beyond = 0;
  long interpolated = 0;
};

Errors errors_of(const TriangleMesh& soup, const Lattice& lattice, double distance) {
  const std::vector<float> field = distance_field(soup, lattice, distance, 1, {});
  const RayScene scene(soup);
  Errors errors;
  for (int z = 0; z < lattice.points[2]; ++z) {
    for (int y = 0; y < lattice.points[1]; ++y) {
      for (int x = 0; x < lattice.points[0]; ++x) {
        const double found = field[static_cast<size_t>(lattice.index(x, y, z))];
        const NearestPoint nearest = scene.nearest(lattice.position(x, y, z));
        const double exact = (std::sqrt(nearest.squared_distance) - distance) / lattice.voxel;
        const double off = std::abs(found - exact);
        if (std::abs(exact) <= std::sqrt(3.0)) {
          errors.near = std::max(errors.near, off);
        } else if (exact < 0) {
          CHECK(found < 0);
        } else {
          CHECK(found > 0);
          errors.beyond = std::max(errors.beyond, off);
          errors.interpolated += off > 1e-5;
        }
      }
    }
  }
  return errors;
}

TriangleMesh two_balls() { return joined(icosphere(2), icosphere(2), {-3, 0, 0}); }

}  // namespace

TEST_CASE("distance field: exact near its zero, and nearly so where distances are smooth") {
  const Lattice lattice = {Vector3(0.6, -2.5, -2.5), 0.05, {61, 101, 101}};  // not the centre
  const Errors errors = errors_of(icosphere(4), lattice, 0.1);
  CHECK(errors.near < 1e-4);
  CHECK(errors.beyond < 0.1);
  CHECK(errors.interpolated > lattice.size() / 4);
}

TEST_CASE(
    "distance field: exact near its zero at ten voxels from a ball, where all is smooth too") {
  const Lattice lattice = {Vector3(0.9, -0.5, -0.5), 0.05, {21, 21, 21}};
  CHECK(errors_of(icosphere(4), lattice, 0.5).near < 1e-5);
}

TEST_CASE("distance field: where two parts are equally near, it is off by some voxels at most") {
  const Lattice lattice = {Vector3::Constant(-2.5), 0.05, {101, 101, 101}};
  const Errors errors = errors_of(two_balls(), lattice, 0.1);
  CHECK(errors.near < 1e-4);
  CHECK(errors.beyond < 3);
}

TEST_CASE("distance field: of a plane exact, also in blocks that are two points wide") {
  for (int axis = 0; axis < 3; ++axis) {
    TriangleMesh plane{Points::Zero(4, 3), Triangles(2, 3)};
    plane.positions.col((axis + 1) % 3) << -500, 500, 500, -500;
    plane.positions.col((axis + 2) % 3) << -500, -500, 500, 500;
    plane.triangles << 0, 1, 2, 0, 2, 3;
    Lattice lattice = {Vector3::Unit(axis), 0.5, {18, 18, 18}};
    lattice.points[static_cast<size_t>(axis)] = 34;
    const std::vector<float> field = distance_field(plane, lattice, 0.25, 1, {});
    for (int z = 0; z < lattice.points[2]; ++z) {
      for (int y = 0; y < lattice.points[1]; ++y) {
        for (int x = 0; x < lattice.points[0]; ++x) {
          // From 1 on, half a unit a voxel, less the distance of half a voxel.
          const double expected = 2 + std::array{x, y, z}[static_cast<size_t>(axis)] - 0.5;
          CHECK(field[static_cast<size_t>(lattice.index(x, y, z))] == Approx(expected));
        }
      }
    }
  }
}
