#include "io/attributes/source_attributes.h"

#include "io/attributes/corner_colours.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

double linear(double stored) {
  return static_cast<double>(SrgbCurves::get().to_linear(static_cast<float>(stored)));
}

}  // namespace

std::optional<Points> linear_colours(const MeshFile& file) {
  std::optional<Points> colours = vertex_colours(file);
  if (!colours) return std::nullopt;
  return colours->unaryExpr([](double stored) { return linear(stored); });
}

std::optional<CornerLight> corner_light(const MeshFile& file) {
  const char* const names[] = {"red", "green", "blue", "alpha"};
  CornerLight light;
  if (auto corners = corner_colours(file)) {
    light = {std::move(*corners), true};
  } else {
    light.rows.setOnes(file.mesh.vertex_count(), 4);
  }
  for (int c = 0; c < 4; ++c) {
    const Property* const property = file.find_vertex_property(names[c]);
    auto column = light.rows.col(c);
    if (!property && c < 3) return std::nullopt;
    if (!property) {
      column.setOnes();
      break;
    }
    if (!light.of_corners)
      column = Eigen::Map<const VectorX>(property->values.data(), light.rows.rows());
    column /= brightest(property->type);
    if (c < 3) column = column.unaryExpr([](double stored) { return linear(stored); }).eval();
  }
  return light;
}

}  // namespace sphparam
