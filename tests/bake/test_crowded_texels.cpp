#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bake/fields/attribute_fields.h"
#include "scenes.h"
#include "sphparam/sphere/sphere_locator.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/test_meshes.h"

// Texels that hold many triangles, against sums over many points of each.

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double pi = std::numbers::pi;
constexpr int width = 16, height = 8, points = 48;  // points of a texel, to the east and south

/// Another shape than its sphere: a texel shows parts that are enlarged and parts that are not.
TriangleMesh lopsided() {
  TriangleMesh mesh = icosphere(4);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(static_cast<Vertex>(v));
    mesh.positions.row(v) = (1 + 0.5 * std::sin(6 * x[0]) * std::cos(5 * x[1] + x[2])) * x;
  }
  return mesh;
}

double area(const Vector3& a, const Vector3& b, const Vector3& c) {
  return (b - a).cross(c - a).norm() / 2;
}

/// Means of the position over a texel, one a texel.
class Means {
 public:
  void add(int row, int column, double weight, const Vector3& position) {
    const auto at = static_cast<size_t>(row * width + column);
    sums_[at] += weight * position;
    weights_[at] += weight;
  }
  Vector3 of(size_t texel) const { return sums_[texel] / weights_[texel]; }

 private:
  std::vector<Vector3> sums_{width * height, Vector3::Zero()};
  std::vector<double> weights_ = std::vector<double>(width * height, 0.0);
};

double greatest_error(const std::vector<float>& image, const Means& means) {
  double greatest = 0;
  for (size_t i = 0; i < size_t{height} * width; ++i) {
    const Vector3 shown(image[3 * i], image[3 * i + 1], image[3 * i + 2]);
    greatest = std::max(greatest, (shown - means.of(i)).norm());
  }
  return greatest;
}

}  // namespace

TEST_CASE("crowded texels: the mean over the part of the surface that a texel shows") {
  const auto scene = sphere_scene(lopsided());
  const SphericalChart& chart = scene->target.chart;
  const TexelOwners owners(chart, width * points, height * points);
  std::vector<OwnerBand> bands;
  std::vector<int> owned(static_cast<size_t>(chart.triangles.rows()), 0);
  for (int b = 0; b < owners.band_count(); ++b) {
    bands.push_back(owners.band(b));
    for (const Face f : bands.back().faces) ++owned[static_cast<size_t>(f)];
  }
  Means means;
  for (const OwnerBand& band : bands) {
    for (size_t i = 0; i < band.faces.size(); ++i) {
      const Face f = band.faces[i];
      std::array<Vector3, 3> x;
      for (size_t k = 0; k < 3; ++k)
        x[k] = scene->target.positions.row(chart.triangles(f, static_cast<int>(k)));
      const Vector3 weights = band.barycentric(i);
      const int row = (band.first_row + static_cast<int>(i) / band.width) / points;
      means.add(row, static_cast<int>(i) % band.width / points,
                area(x[0], x[1], x[2]) / owned[static_cast<size_t>(f)],
                weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2]);
    }
  }
  const auto image =
      baked(*scene, make_position(*scene, ""), {.width = width, .height = height, .threads = 1});
  CHECK(greatest_error(image, means) < 0.01);
}

TEST_CASE("crowded texels: what is shown does not depend on how large the mesh is") {
  MeshFile file;
  file.mesh = lopsided();
  const SphereMap map = normalised(file.mesh.positions);
  Property heights{"height", ScalarType::Float64, {}};
  for (const double z : map.points.col(2)) heights.values.push_back(std::sin(9 * z));
  file.vertex_properties.push_back(heights);
  for (const Interpolation interpolation : {Interpolation::Uv, Interpolation::Sphere}) {
    const auto shown = [&](int exponent) {
      MeshFile scaled = file;
      scaled.mesh.positions *= std::ldexp(1.0, exponent);
      const auto scene = scene_of(scaled, map);
      return baked(
          *scene, make_scalar(*scene, "height"),
          {.width = width, .height = height, .interpolation = interpolation, .threads = 1});
    };
    for (const int exponent : {-533, 3, 533}) CHECK(shown(exponent) == shown(0));
  }
}

TEST_CASE("crowded texels: by direction too, as far as the poles") {
  const auto scene = sphere_scene(lopsided());
  const MappedMesh& source = *scene->source.mapped;
  const SphereLocator locator(source.topology(), source.map());
  Means means;
  for (int row = 0; row < height * points; ++row) {
    for (int column = 0; column < width * points; ++column) {
      const double phi = pi * (row + 0.5) / (height * points);
      const SurfacePoint at =
          locator.locate(to_cartesian({2 * pi * (column + 0.5) / (width * points), phi}));
      std::array<Vector3, 3> x, q;
      Vector3 position = Vector3::Zero();
      for (size_t k = 0; k < 3; ++k) {
        const int corner = static_cast<int>(k);
        x[k] = source.mesh().position(source.mesh().triangles(at.face, corner));
        q[k] = x[k].normalized();
        position += at.barycentric[corner] * x[k];
      }
      means.add(row / points, column / points,
                std::sin(phi) * area(x[0], x[1], x[2]) / area(q[0], q[1], q[2]), position);
    }
  }
  const auto image = baked(
      *scene, make_position(*scene, ""),
      {.width = width, .height = height, .interpolation = Interpolation::Sphere, .threads = 1});
  CHECK(greatest_error(image, means) < 0.02);
}

// ∫φ sin φ dφ / ∫sin φ dφ over the rows of a sphere: 14.961°, 34.855°, 56.743°, 78.897° and
// mirrored.
TEST_CASE("crowded texels: of a texel near a pole what is nearer to it counts less") {
  MeshFile file;
  file.mesh = icosphere(6);
  const SphereMap map = normalised(file.mesh.positions);
  Property colatitude{"colatitude", ScalarType::Float64, {}};
  for (const auto& q : map.points.rowwise())
    colatitude.values.push_back(180 / pi * std::acos(q[2]));
  file.vertex_properties.push_back(colatitude);
  const auto scene = scene_of(file, map);
  for (const Interpolation interpolation : {Interpolation::Uv, Interpolation::Sphere}) {
    const auto image =
        baked(*scene, make_scalar(*scene, "colatitude"),
              {.width = width, .height = height, .interpolation = interpolation, .threads = 1});
    for (size_t row = 0; row < height; ++row) {
      const double top = pi * static_cast<double>(row) / height, bottom = top + pi / height;
      const auto whole = [](double phi) { return std::sin(phi) - phi * std::cos(phi); };
      const double mean =
          180 / pi * (whole(bottom) - whole(top)) / (std::cos(top) - std::cos(bottom));
      for (size_t column = 0; column < width; ++column)
        CHECK(std::abs(image[row * width + column] - mean) < 0.01);  // triangles of 1°
    }
  }
}
