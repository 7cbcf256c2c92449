#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "bake/texels/texel_owners.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

using Rational = boost::multiprecision::cpp_rational;

SphericalChart chart_of(const TriangleMesh& mesh) {
  const Topology topology(mesh);
  return spherical_chart(mesh, topology, parameterize(mesh, {.threads = 1}).map);
}

/// The sign of det(b − a, p − a) by other means; points are (u, v).
int side(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Eigen::RowVector2d& p) {
  const auto r = [](double x) { return Rational(x); };
  const Rational det =
      (r(b[0]) - r(a[0])) * (r(p[1]) - r(a[1])) - (r(b[1]) - r(a[1])) * (r(p[0]) - r(a[0]));
  return det.sign();
}

/// Is the point in the closed triangle, or in the closed trapezoid of a pole triangle?
bool holds(const SphericalChart& chart, Face f, const Eigen::RowVector2d& p) {
  std::vector<Eigen::RowVector2d> corners;
  const int pole = chart.pole_corner(f);
  for (int k = 0; k < 3; ++k) {
    const Eigen::RowVector2d corner = chart.uv.row(chart.wedges(f, k));
    if (k != pole) {
      corners.push_back(corner);
      continue;
    }
    corners.emplace_back(chart.uv(chart.wedges(f, (k + 2) % 3), 0), corner[1]);
    corners.emplace_back(chart.uv(chart.wedges(f, (k + 1) % 3), 0), corner[1]);
  }
  for (size_t k = 0; k < corners.size(); ++k) {  // clockwise in (u, v): v points south
    if (side(corners[k], corners[(k + 1) % corners.size()], p) > 0) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("TexelOwners: every texel's owner holds it, by rational arithmetic") {
  for (const TriangleMesh& mesh :
       {tetrahedron(), icosphere(2), tube(30, 5), random_sphere_mesh(80, 3)}) {
    const SphericalChart chart = chart_of(mesh);
    const TexelOwners owners(chart, 64, 37);
    for (int b = 0; b < owners.band_count(); ++b) {
      const OwnerBand band = owners.band(b);
      for (int row = band.first_row; row < band.first_row + band.rows; ++row) {
        for (int column = 0; column < 64; ++column) {
          const Eigen::RowVector2d p((column + 0.5) / 64, (row + 0.5) / 37);
          REQUIRE(holds(chart, band.faces[band.index(row, column)], p));
        }
      }
    }
  }
}

TEST_CASE("TexelOwners: bands have all rows, also where one is left over") {
  const SphericalChart chart = chart_of(icosphere(1));
  for (const int height : {1, 31, 32, 33, 64, 65}) {
    const TexelOwners owners(chart, 16, height);
    int rows = 0;
    for (int b = 0; b < owners.band_count(); ++b) {
      CHECK(owners.first_row(b) == rows);
      CHECK(owners.rows(b) > 0);
      rows += owners.rows(b);
    }
    CHECK(rows == height);
  }
}

TEST_CASE("TexelOwners: no gap and no double where texels lie exactly on edges and vertices") {
  // Vertices of the grid sphere sit at multiples of 1/16 and 1/8: centres of 8 × 4 texels.
  const TriangleMesh mesh = uv_sphere(16, 7);
  const Topology topology(mesh);
  const SphericalChart chart = spherical_chart(mesh, topology, SphereMap{mesh.positions});
  REQUIRE(chart.certificate.one_to_one());
  const TexelOwners owners(chart, 8, 4);
  CHECK_NOTHROW(owners.band(0));  // throws at a gap or a double
}

TEST_CASE("TexelOwners: what is linear in (u, v) is reproduced within triangles") {
  const SphericalChart chart = chart_of(icosphere(3));
  const TexelOwners owners(chart, 256, 128);
  for (int b = 0; b < owners.band_count(); ++b) {
    const OwnerBand band = owners.band(b, 0.25, 0.75);
    for (size_t i = 0; i < band.faces.size(); ++i) {
      const Face f = band.faces[i];
      if (chart.pole_corner(f) >= 0) continue;
      const int row = band.first_row + static_cast<int>(i) / 256,
                column = static_cast<int>(i) % 256;
      Eigen::RowVector2d uv(0, 0);
      for (int k = 0; k < 3; ++k) uv += band.barycentric(i)[k] * chart.uv.row(chart.wedges(f, k));
      REQUIRE(std::abs(uv[0] - (column + 0.25) / 256) < 1e-12);
      REQUIRE(std::abs(uv[1] - (row + 0.75) / 128) < 1e-12);
    }
  }
}

TEST_CASE("TexelOwners: weights run on across the sides of neighbouring pole trapezoids") {
  const SphericalChart chart = chart_of(icosphere(3));
  // Height of the carried point above the equator is 1 at the pole and falls away from it.
  const TexelOwners owners(chart, 4096, 512);
  const OwnerBand band = owners.band(0);
  for (int column = 1; column < 4096; ++column) {
    const auto z = [&](int c) {
      const size_t i = band.index(0, c);
      double sum = 0;
      for (int k = 0; k < 3; ++k) {
        sum += band.barycentric(i)[k] * chart.points(chart.triangles(band.faces[i], k), 2);
      }
      return sum;
    };
    REQUIRE(std::abs(z(column) - z(column - 1)) < 1e-3);
  }
}

TEST_CASE("TexelOwners: an image without texels and a chart that is not one-to-one are refused") {
  SphericalChart chart = chart_of(icosphere(1));
  CHECK_THROWS_AS(TexelOwners(chart, 0, 4), std::invalid_argument);
  chart.certificate.folded.push_back(0);
  CHECK_THROWS_AS(TexelOwners(chart, 8, 4), std::invalid_argument);
}
