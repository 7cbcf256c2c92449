#include "io/attributes/source_attributes.h"

#include "srgb_curves.h"

namespace sphparam {

std::optional<Points> linear_colours(const MeshFile& file) {
  std::optional<Points> colours = vertex_colours(file);
  if (!colours) return std::nullopt;
  const SrgbCurves& curves = SrgbCurves::get();
  return colours->unaryExpr([&](double stored) {
    return static_cast<double>(curves.to_linear(static_cast<float>(stored)));
  });
}

}  // namespace sphparam
