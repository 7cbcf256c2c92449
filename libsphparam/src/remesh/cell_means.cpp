// Counting sort by grid vertex: within one, source vertices come in order.

#include "remesh/cell_means.h"

#include <optional>

#include "mesh/unit_size.h"
#include "sphparam/sphere/sphere_locator.h"

namespace sphparam {

namespace {

constexpr std::int64_t seen_by_a_point = 3;

struct Gift {
  Vertex to;
  double weight;
};

/// Calls give(source vertex, gift) for every weight that is not zero.
template <class Give>
void for_each_gift(const std::vector<SurfacePoint>& places, const VectorX& areas,
                   const Topology& grid, const Give& give) {
  for (size_t v = 0; v < places.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      const double weight = places[v].barycentric[k] * areas[static_cast<Eigen::Index>(v)];
      if (weight > 0) give(static_cast<Vertex>(v), Gift{grid.vertex(places[v].face, k), weight});
    }
  }
}

}  // namespace

VectorX relative_areas(const TriangleMesh& mesh) {
  const std::optional<Rescaled> unit = at_unit_size(mesh);
  return vertex_areas(unit ? unit->mesh : mesh);
}

Gather gather_cells(const TriangleMesh& source, const SphereMap& map, const Topology& grid,
                    const SphereMap& grid_map, int threads) {
  const std::vector<SurfacePoint> places =
      SphereLocator(grid, grid_map, threads).locate_all(map.points, threads);
  const VectorX areas = relative_areas(source);
  const auto count = static_cast<size_t>(grid.vertex_count());
  std::vector<std::int64_t> gifts(count, 0);
  for_each_gift(places, areas, grid,
                [&](Vertex, const Gift& gift) { ++gifts[static_cast<size_t>(gift.to)]; });
  Gather result;
  result.starts.assign(count + 1, 0);
  for (size_t g = 0; g < count; ++g) {
    result.starts[g + 1] = result.starts[g] + (gifts[g] > seen_by_a_point ? gifts[g] : 0);
  }
  std::vector<std::int64_t> next(result.starts.begin(), result.starts.end() - 1);
  result.vertices.resize(static_cast<size_t>(result.starts.back()));
  result.weights.resize(result.vertices.size());
  for_each_gift(places, areas, grid, [&](Vertex v, const Gift& gift) {
    const auto g = static_cast<size_t>(gift.to);
    if (gifts[g] <= seen_by_a_point) return;
    const auto at = static_cast<size_t>(next[g]++);
    result.vertices[at] = v;
    result.weights[at] = gift.weight;
  });
  for (size_t g = 0; g < count; ++g) {
    double sum = 0;
    for (auto e = result.starts[g]; e < result.starts[g + 1]; ++e)
      sum += result.weights[static_cast<size_t>(e)];
    for (auto e = result.starts[g]; e < result.starts[g + 1]; ++e)
      result.weights[static_cast<size_t>(e)] /= sum;
  }
  return result;
}

}  // namespace sphparam
