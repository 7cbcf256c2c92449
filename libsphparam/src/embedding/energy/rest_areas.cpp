#include "embedding/energy/rest_areas.h"

#include <stdexcept>

// A triangle of area A and density ρ counts as one of the same shape with area cρA, where
// c = ΣA / ΣρA. All densities equal: ρ/ρ_0 = 1 and c = 1, both exactly.

namespace sphparam {

RestTriangles with_density(const Topology& topology, RestTriangles source, const VectorX& density) {
  if (density.size() != topology.vertex_count() || !density.allFinite() ||
      !(density.array() > 0).all()) {
    throw std::invalid_argument("with_density: not one positive finite density a vertex");
  }
  const VectorX relative = density / density[0];
  const auto of_face = [&](Face f) {
    return (relative[topology.vertex(f, 0)] + relative[topology.vertex(f, 1)] +
            relative[topology.vertex(f, 2)]) /
           3;
  };
  double area = 0, weighted = 0;
  for (Face f = 0; f < topology.face_count(); ++f) {
    area += source[static_cast<size_t>(f)].area;
    weighted += of_face(f) * source[static_cast<size_t>(f)].area;
  }
  for (Face f = 0; f < topology.face_count(); ++f) {
    RestTriangle& triangle = source[static_cast<size_t>(f)];
    triangle = scaled(triangle, of_face(f) * (area / weighted));
  }
  return source;
}

}  // namespace sphparam
