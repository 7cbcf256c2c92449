#include <catch2/catch.hpp>
#include <cmath>

#include "../bake/scenes.h"
#include "bake/baked_chart.h"
#include "bake/field_registry.h"
#include "charted.h"
#include "sphparam/chart/carry_attributes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

constexpr int width = 1024, height = width / 2;

/// The egg's positions, baked for its chart with triangles at the poles cut in so many.
std::vector<float> baked_positions(const Charted& egg, int wedges) {
  const MappedMesh mapped({.file = egg.file, .map = egg.map}, 1);
  const Points normals = egg.file.mesh.positions.rowwise().normalized();
  const BakeScene scene{{mapped, normals, {}}, make_target(mapped, true, 1, wedges), {}, 1};
  return baked(scene, make_field("position", scene), {.width = width, .height = height});
}

/// What a viewer that takes the nearest texel is wrong by on the triangles at the poles, as a
/// multiple of what half a texel to the side and half a texel down change there.
double worst_at_poles(const Charted& egg, const std::vector<float>& image) {
  const SphericalChart& chart = egg.chart.chart;
  const Attributes positions =
      carry_vertex_attribute(chart, egg.file.mesh.triangles, egg.file.mesh.positions);
  double worst = 0;
  for (Face f = 0; f < static_cast<Face>(chart.triangles.rows()); ++f) {
    if (chart.pole_corner(f) < 0) continue;
    Eigen::Matrix3d at;
    Eigen::Matrix<double, 2, 3> uv;
    for (int k = 0; k < 3; ++k) {
      at.col(k) = positions.row(chart.triangles(f, k)).transpose();
      uv.col(k) = chart.uv.row(chart.wedges(f, k)).transpose();
    }
    Eigen::Matrix<double, 3, 2> sides;
    Eigen::Matrix2d uv_sides;
    sides << at.col(1) - at.col(0), at.col(2) - at.col(0);
    uv_sides << uv.col(1) - uv.col(0), uv.col(2) - uv.col(0);
    const Eigen::Matrix<double, 3, 2> slope = sides * uv_sides.inverse();
    const double half_texels =
        0.5 * slope.col(0).norm() / width + 0.5 * slope.col(1).norm() / height;
    constexpr int steps = 12;
    for (int i = 1; i < steps; ++i) {
      for (int j = 1; i + j < steps; ++j) {
        const Vector3 weights = Vector3(i, j, steps - i - j) / steps;
        const Eigen::Vector2d place = uv * weights;
        const auto texel = static_cast<size_t>(static_cast<int>(place[1] * height) * width +
                                               static_cast<int>(place[0] * width));
        Vector3 there;
        for (size_t c = 0; c < 3; ++c)
          there[static_cast<int>(c)] = static_cast<double>(image[3 * texel + c]);
        worst = std::max(worst, (there - at * weights).norm() / half_texels);
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("baked chart: at the poles an image shows the truth on the chart it was baked for") {
  for (const int wedges : {1, 6}) {
    INFO(wedges);
    const Charted egg({.refine_poles = wedges});
    CHECK(worst_at_poles(egg, baked_positions(egg, wedges)) < 1.001);
    CHECK(worst_at_poles(egg, baked_positions(egg, 7 - wedges)) > 4);
  }
}

TEST_CASE("baked chart: images say which one it is, those of strangers suit any") {
  for (const int wedges : {1, 6, 1024})
    CHECK(pole_wedges_of(texts_of_chart(true, wedges)) == wedges);
  CHECK(pole_wedges_of({{"ImageDescription",
                         "sphparam:map=position\nsphparam:interpolation=uv\n"
                         "sphparam:refine_poles=12"}}) == 12);
  CHECK(pole_wedges_of({{"sphparam:interpolation", "uv"}}) == 1);
  CHECK_FALSE(pole_wedges_of(texts_of_chart(false, 6)));
  CHECK_FALSE(pole_wedges_of({{"Software", "a camera"}, {"ImageDescription", "the Earth"}}));
}
