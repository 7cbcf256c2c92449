#pragma once

#include <initializer_list>
#include <optional>

#include "sphparam/io/polygons.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/parallel.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

// What families of grids share.

inline void add_face(Polygons& faces, std::initializer_list<int> corners) {
  faces.corners.insert(faces.corners.end(), corners);
  faces.starts.push_back(static_cast<int>(faces.corners.size()));
}
/// k where n = 2^k.
inline std::optional<int> exponent_of_two(int n) {
  int k = 0;
  while (n >> k > 1) ++k;
  return n == 1 << k ? std::optional(k) : std::nullopt;
}

/// n halved so often, where it is a power of two and large enough.
inline std::optional<int> halved(int n, int halvings) {
  const bool power_of_two = n > 0 && (n & (n - 1)) == 0;
  if (!power_of_two || halvings > 30 || n >> halvings == 0) return std::nullopt;
  return n >> halvings;
}

/// Points of a flat polyhedron to the sphere, by way of `place`.
template <class Place>
void place_all(SphereGrid& grid, int threads, const Place& place) {
  constexpr std::int64_t grain = 8192;
  parallel_for(grid.directions.rows(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      const Vector3 flat = grid.directions.row(v);
      grid.directions.row(v) = place(flat).normalized();
    }
  });
}

}  // namespace sphparam
