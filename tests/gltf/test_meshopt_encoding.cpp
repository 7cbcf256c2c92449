#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "gltf/meshopt_encoding.h"
#include "sphparam/mesh/triangle_mesh.h"

using namespace sphparam;

namespace {

/// As the extension says that a reader does: bytes of a unit vector, rounded.
Vector3 decoded(int x, int y, int one) {
  const double z = one - std::abs(x) - std::abs(y), below = std::max(-z, 0.0);
  const Vector3 p(x < 0 ? x + below : x - below, y < 0 ? y + below : y - below, z);
  return (127 * p / p.norm()).array().round().matrix().normalized();
}

/// Cosine to the nearest of all places within two of one.
double best_about(int x, int y, int one, const Vector3& wanted) {
  double best = -1;
  for (int u = std::max(x - 2, -one); u <= std::min(x + 2, one); ++u) {
    for (int v = std::max(y - 2, -one); v <= std::min(y + 2, one); ++v)
      best = std::max(best, decoded(u, v, one).dot(wanted));
  }
  return best;
}

}  // namespace

TEST_CASE("meshopt encoding: no place of the octahedral grid about a unit vector's is nearer") {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  std::vector<float> rows;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3f q =
        Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    rows.insert(rows.end(), {q.x(), q.y(), q.z(), i % 2 ? 1.0F : -1.0F});
  }
  const std::string bytes = octahedral(rows);
  REQUIRE(bytes.size() == rows.size());
  const auto* const at = reinterpret_cast<const signed char*>(bytes.data());
  double worst = 1;
  for (std::size_t i = 0; i < rows.size(); i += 4) {
    const Vector3 wanted(rows[i], rows[i + 1], rows[i + 2]);
    const double cosine = decoded(at[i], at[i + 1], at[i + 2]).dot(wanted);
    CHECK(cosine >= best_about(at[i], at[i + 1], at[i + 2], wanted) - 1e-12);
    CHECK(at[i + 2] == 127);
    CHECK(at[i + 3] == (i / 4 % 2 ? 127 : -127));
    worst = std::min(worst, cosine);
  }
  CHECK(std::acos(worst) < 0.01745);  // 1°
}
