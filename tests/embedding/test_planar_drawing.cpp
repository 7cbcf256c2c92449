#include <catch2/catch.hpp>
#include <random>

#include "embedding/constructions/planar_drawing.h"
#include "sphparam/sphere/orientation.h"
#include "support/all_triangulations.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

std::vector<std::int64_t> random_weights(const Topology& topology, int greatest, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::int64_t> weights;
  for (Face f = 0; f < topology.face_count(); ++f) {
    weights.push_back(1 + static_cast<std::int64_t>(random() % static_cast<unsigned>(greatest)));
  }
  return weights;
}

/// Faces whose determinant has not the sign it must have.
int count_wrong_faces(const Topology& topology, const PlanarDrawing& drawing, Face outer) {
  int wrong = 0;
  const auto point = [&](Face f, int k) -> Vector3 {
    return drawing.coordinates.row(topology.vertex(f, k)).cast<double>();
  };
  for (Face f = 0; f < topology.face_count(); ++f) {
    const int sign = orientation(point(f, 0), point(f, 1), point(f, 2));
    wrong += sign != (f == outer ? -1 : 1);
  }
  return wrong;
}

}  // namespace

TEST_CASE("draw_inside: every triangulation up to 9 vertices, every outer face, any weights") {
  unsigned seed = 0;
  for (int vertices = 4; vertices <= 9; ++vertices) {
    for (const Rotations& rotations : all_triangulations(vertices)) {
      const Topology topology(mesh_of(rotations, 1));
      for (Face outer = 0; outer < topology.face_count(); ++outer) {
        const auto weights = random_weights(topology, outer % 2 ? 1 : 1000, ++seed);
        const PlanarDrawing drawing = draw_inside(topology, outer, weights);
        REQUIRE(count_wrong_faces(topology, drawing, outer) == 0);
      }
    }
  }
}

TEST_CASE("draw_inside: coordinates count faces, so they add up and the corners have them all") {
  const TriangleMesh mesh = random_sphere_mesh(500, 3);
  const Topology topology(mesh);
  const auto weights = random_weights(topology, 100, 9);
  const Face outer = 17;
  const PlanarDrawing drawing = draw_inside(topology, outer, weights);
  std::int64_t total = -weights[outer];
  for (const std::int64_t w : weights) total += w;
  CHECK(drawing.total == total);
  CHECK((drawing.coordinates.rowwise().sum().array() == total).all());
  CHECK(drawing.coordinates.minCoeff() == 0);
  for (int k = 0; k < 3; ++k) {
    CHECK(drawing.coordinates.row(topology.vertex(outer, k)).maxCoeff() == total);
  }
}

TEST_CASE("draw_inside: long tubes and vertices with many neighbours") {
  for (const TriangleMesh& mesh :
       {tube(3000, 3), uv_sphere(20000, 1), random_sphere_mesh(5000, 1)}) {
    const Topology topology(mesh);
    const PlanarDrawing drawing = draw_inside(topology, 5, random_weights(topology, 1, 1));
    CHECK(count_wrong_faces(topology, drawing, 5) == 0);
  }
}
