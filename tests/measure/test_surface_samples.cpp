#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <set>

#include "measure/surface_samples.h"
#include "support/test_meshes.h"

namespace sphparam {

using namespace sphparam::tests;

TEST_CASE("weighted draw: every element gets its share, none without weight is drawn") {
  const std::vector<double> weights = {0, 1, 0, 3, 0.5, 0, 5.5, 0};
  const WeightedDraw draw(weights, 10000, 3);
  std::vector<int> drawn(weights.size(), 0);
  std::int64_t before = 0;
  for (std::int64_t i = 0; i < draw.count(); ++i) {
    const std::int64_t element = draw(i);
    CHECK(element >= before);
    before = element;
    ++drawn[static_cast<size_t>(element)];
  }
  // An equal share of the total has one draw: counts are exact to the two shares at the ends.
  for (size_t i = 0; i < weights.size(); ++i) {
    CHECK(std::abs(drawn[i] - 1000 * weights[i]) <= (weights[i] > 0 ? 1 : 0));
  }
}

TEST_CASE("weighted draw: what has no size cannot be drawn from") {
  CHECK_THROWS_AS(WeightedDraw({}, 5, 1), std::invalid_argument);
  CHECK_THROWS_AS(WeightedDraw({0, 0}, 5, 1), std::invalid_argument);
}

TEST_CASE("face samples: uniform over each triangle and over the mesh") {
  // Two triangles of a square, one of them cut from a larger mesh's corner: areas ½ and 2.
  TriangleMesh mesh{Points(6, 3), Triangles(2, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 7, 0, 0, 5, 2, 0;
  mesh.triangles << 0, 1, 2, 3, 4, 5;
  const FaceSamples samples(mesh, 20000, 9);
  Vector3 sum = Vector3::Zero();
  double second = 0;
  int left = 0;
  for (std::int64_t i = 0; i < samples.count(); ++i) {
    const Vector3 p = samples(i);
    CHECK(p.z() == 0);
    if (p.x() > 4) continue;
    ++left;
    CHECK((p.x() >= 0 && p.y() >= 0 && p.x() + p.y() <= 1 + 1e-15));
    sum += p;
    second += p.x() * p.x();
  }
  CHECK(left == Approx(4000).margin(1));
  CHECK(sum.x() / left == Approx(1.0 / 3).margin(0.02));
  CHECK(sum.y() / left == Approx(1.0 / 3).margin(0.02));
  CHECK(second / left == Approx(1.0 / 6).margin(0.02));
}

TEST_CASE("edge samples: on edges, each edge once however many triangles have it") {
  const TriangleMesh box = octahedron();  // 12 equal edges
  const EdgeSamples samples(box, 12000, 1);
  std::vector<int> per_edge(12, 0);
  std::int64_t on_an_edge = 0;
  for (std::int64_t i = 0; i < samples.count(); ++i) {
    const Vector3 p = samples(i);
    // On |x| + |y| + |z| = 1 with one coordinate 0.
    on_an_edge += std::abs(p.cwiseAbs().sum() - 1) < 1e-12 && p.cwiseAbs().minCoeff() == 0;
    int axis = 0;
    p.cwiseAbs().minCoeff(&axis);
    const int quadrant = (p[(axis + 1) % 3] > 0 ? 1 : 0) + (p[(axis + 2) % 3] > 0 ? 2 : 0);
    ++per_edge[static_cast<size_t>(4 * axis + quadrant)];
  }
  CHECK(on_an_edge == samples.count());
  for (const int count : per_edge) CHECK(count == Approx(1000).margin(1));
}

TEST_CASE("samples: where on an edge a point lies has nothing to do with which edge it is") {
  TriangleMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.triangles << 0, 1, 2;
  double along = 0;
  int on_first = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const Vector3 p = EdgeSamples(mesh, 1, seed)(0);
    if (p.y() != 0) continue;
    along += p.x();
    ++on_first;
  }
  CHECK(on_first == Approx(3000 / (2 + std::sqrt(2))).margin(90));
  CHECK(along / on_first == Approx(0.5).margin(0.04));  // 0.15 if one number did both
}

TEST_CASE("samples: a function of the seed and their number") {
  const TriangleMesh ball = icosphere(1);
  const FaceSamples some(ball, 100, 4), same(ball, 100, 4), other(ball, 100, 5);
  for (std::int64_t i = 99; i >= 0; --i) CHECK(some(i) == same(i));
  CHECK(some(42) != other(42));
}

}  // namespace sphparam
