#include <catch2/catch.hpp>

#include "rays/distinct_faces.h"

using namespace sphparam;

namespace {

/// Triangles with corners of their own.
TriangleMesh of_corners(const std::vector<std::array<Vector3, 3>>& triangles) {
  const auto count = static_cast<Eigen::Index>(triangles.size());
  TriangleMesh mesh{Points(3 * count, 3), Triangles(count, 3)};
  for (Eigen::Index f = 0; f < count; ++f) {
    for (int k = 0; k < 3; ++k) {
      mesh.positions.row(3 * f + k) =
          triangles[static_cast<size_t>(f)][static_cast<size_t>(k)].transpose();
      mesh.triangles(f, k) = static_cast<int>(3 * f) + k;
    }
  }
  return mesh;
}

const Vector3 a(0.1, 0.2, 0.3), b(1, 0.2, 0.5), c(0.4, 1, 0.7);

}  // namespace

TEST_CASE("distinct faces: where some edge has no length, triangles at one place are one") {
  using Three = std::array<Vector3, 3>;
  for (const Three& needle : {Three{a, a, b}, Three{b, a, a}, Three{a, b, a}}) {
    const TriangleMesh mesh = of_corners({{a, b, c}, needle, {a, b, c}, needle, {b, c, a}});
    CHECK(distinct_faces(mesh) == std::vector<Face>{0, 1, 4});
  }
}

TEST_CASE("distinct faces: without such an edge all are told, also those that are the same") {
  CHECK(distinct_faces(of_corners({{a, b, c}, {a, b, c}})) == std::vector<Face>{0, 1});
}

TEST_CASE("distinct faces: corners that differ in one coordinate are at different places") {
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 beside = c + 0.01 * Vector3::Unit(axis);
    const TriangleMesh mesh = of_corners({{a, b, c}, {a, b, beside}, {a, a, b}});
    CHECK(distinct_faces(mesh) == std::vector<Face>{0, 1, 2});
  }
}
