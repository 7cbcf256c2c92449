#include <catch2/catch.hpp>
#include <vector>

#include "rays/cosine_rays.h"
#include "rays/random_numbers.h"
#include "support/test_meshes.h"

namespace sphparam {

namespace {

std::vector<Eigen::Vector3f> aimed(const CosineRays& rays, const Eigen::Vector3f& axis,
                                   std::uint64_t seed) {
  std::vector<Eigen::Vector3f> directions(static_cast<size_t>(rays.count()));
  rays.aim(axis, seed, directions);
  return directions;
}

}  // namespace

TEST_CASE("cosine rays: unit vectors above the plane of any axis, their mean along it") {
  const CosineRays rays(64);
  const TriangleMesh axes = tests::icosphere(2);
  for (int v = 0; v < axes.vertex_count(); ++v) {
    const Eigen::Vector3f axis = axes.position(v).normalized().cast<float>();
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const auto& d : aimed(rays, axis, static_cast<std::uint64_t>(v))) {
      CHECK(d.norm() == Approx(1).epsilon(1e-6));
      CHECK(d.dot(axis) >= -1e-6f);
      sum += d;
    }
    CHECK(sum.normalized().dot(axis) == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("cosine rays: as dense as the cosine") {
  // Over a hemisphere with density cosθ/π the means are E cosθ = 2/3, E cos²θ = 1/2, E x² = 1/4.
  const CosineRays rays(64);
  double cosine = 0, square = 0, x_square = 0, xy = 0;
  constexpr int seeds = 500;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    for (const auto& d : aimed(rays, Eigen::Vector3f::UnitZ(), seed)) {
      cosine += d.z();
      square += d.z() * d.z();
      x_square += d.x() * d.x();
      xy += d.x() * d.y();
    }
  }
  const double count = seeds * rays.count();
  CHECK(cosine / count == Approx(2.0 / 3).margin(2e-3));
  CHECK(square / count == Approx(0.5).margin(2e-3));
  CHECK(x_square / count == Approx(0.25).margin(2e-3));
  CHECK(xy / count == Approx(0).margin(2e-3));
}

TEST_CASE("cosine rays: the seed decides, and an odd number becomes even") {
  const CosineRays rays(7);
  CHECK(rays.count() == 8);
  CHECK(CosineRays(1).count() == 2);
  const Eigen::Vector3f axis = Eigen::Vector3f::UnitX();
  CHECK(aimed(rays, axis, 5) == aimed(rays, axis, 5));
  CHECK(aimed(rays, axis, 5) != aimed(rays, axis, 6));
}

TEST_CASE("random numbers: from 0 to below 1, even, neighbours have nothing in common") {
  double sum = 0, product = 0;
  constexpr std::uint64_t count = 20000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double a = random_fraction(i, 0), b = random_fraction(i + 1, 0);
    CHECK((a >= 0 && a < 1));
    sum += a;
    product += (a - 0.5) * (b - 0.5);
  }
  CHECK(sum / count == Approx(0.5).margin(0.01));
  CHECK(product / count == Approx(0).margin(0.003));
}

}  // namespace sphparam
