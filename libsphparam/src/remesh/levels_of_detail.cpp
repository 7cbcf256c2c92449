// Grids that were made by halving edges are halved back.

#include "remesh/levels_of_detail.h"

namespace sphparam {

namespace {

/// n halved so often, where it is a power of two and large enough.
std::optional<int> halved(int n, int halvings) {
  const bool power_of_two = n > 0 && (n & (n - 1)) == 0;
  if (!power_of_two || halvings > 30 || n >> halvings == 0) return std::nullopt;
  return n >> halvings;
}

}  // namespace

std::optional<GridSpec> coarser_grid(const GridSpec& spec, int halvings) {
  GridSpec coarse = spec;
  if (spec.kind == GridKind::Icosahedron) {
    coarse.size = spec.size - halvings;
    return coarse.size >= 0 ? std::optional(coarse) : std::nullopt;
  }
  const bool octahedron = spec.kind == GridKind::Octahedron;
  if (!octahedron && spec.kind != GridKind::Cube) return std::nullopt;
  const std::optional<int> edges = halved(octahedron ? (spec.size - 1) / 2 : spec.size, halvings);
  if (!edges) return std::nullopt;
  coarse.size = octahedron ? 2 * *edges + 1 : *edges;
  return coarse;
}

}  // namespace sphparam
