#include "bake/fields/curvature_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

#include "bake/field_registry.h"
#include "bake/fields/heat_field.h"
#include "bake/fields/linear_field.h"
#include "mesh/float32_size.h"
#include "sphparam/mesh/curvature.h"

namespace sphparam {
namespace {

constexpr double relative_scale = 0.02;  // of the radius of the sphere of the same area
constexpr double within = 0.98;          // share of the area that the range holds

/// The |value| that all but the rest of the area stay within.
double weighted_quantile(const VectorX& values, const VectorX& weights, double share) {
  std::vector<Vertex> order(static_cast<size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Vertex a, Vertex b) {
    return std::abs(values[a]) != std::abs(values[b]) ? std::abs(values[a]) < std::abs(values[b])
                                                      : a < b;
  });
  double sum = 0;
  const double enough = share * weights.sum();
  for (const Vertex v : order) {
    sum += weights[v];
    if (sum >= enough) return std::abs(values[v]);
  }
  return std::abs(values[order.back()]);
}

/// The least and the greatest of what is on the surface.
std::pair<double, double> extent_of(const VectorX& values, const VectorX& weights) {
  const VectorX told = (weights.array() > 0).select(values.array(), 0.0);
  return {told.minCoeff(), told.maxCoeff()};
}

std::string about(bool gauss, double scale) {
  char text[160];
  std::snprintf(
      text, sizeof text,
      "%s, positive where convex, averaged over %.4g (2 %% of the radius of the sphere "
      "of the same area)",
      gauss ? "Gauss curvature k1*k2 in 1/length^2" : "mean curvature (k1+k2)/2 in 1/length",
      scale);
  return text;
}

}  // namespace

SurfaceField curvature_field(const BakeScene& scene, const std::string& argument) {
  const bool gauss = argument == "gauss";
  if (!gauss && argument != "mean" && !argument.empty()) {
    throw FieldError("curvature: there are curvature:mean and curvature:gauss, not " + argument);
  }
  const TriangleMesh& mesh = scene.source.mesh();
  constexpr double least_squared = 1e-15;  // of Gauss curvature: one over the square of a length
  require_float32_size(mesh.positions, "curvature", gauss ? least_squared : least_float32_size);
  const MappedMesh& mapped = scene.source.map_for("curvature");
  const double scale = relative_scale * equal_area_radius(mapped.surface(), scene.threads);
  const Curvature curvature =
      measure_curvature(mesh, mapped.topology(), scale, scene.threads, mapped.fillers());
  const VectorX& values = gauss ? curvature.gauss : curvature.mean;
  const double reach = weighted_quantile(values, curvature.area, within);
  const double high = reach > 0 ? reach : 1;
  SurfaceField field = linear_field<1>(
      {.name = gauss ? "curvature:gauss" : "curvature:mean",
       .about = about(gauss, scale),
       .range = {{-high, high}}},
      [values, &triangles = mesh.triangles](Face face, int k, std::array<double, 1>& value) {
        value[0] = values[triangles(face, k)];
      });
  if (scene.options.heat) return as_heat(std::move(field), extent_of(values, curvature.area));
  if (std::string unit = unit_of_lengths(scene.options); !unit.empty()) {
    if (unit.find(' ') != std::string::npos) unit = "(" + unit + ")";  // "0.3 m"
    field.unit = "1/" + unit + (gauss ? "^2" : "");
  }
  return field;
}

}  // namespace sphparam
