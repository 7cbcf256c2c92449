#include "gltf/compact_order.h"

#include <cstdint>
#include <vector>

#include "gltf/gathered_surface.h"
#include "gltf/meshopt_encoding.h"

namespace sphparam {
namespace {

/// Renames the vertices in the order of first use; the old numbers in that order.
std::vector<Eigen::Index> name_by_first_use(std::vector<std::uint32_t>& indices,
                                            std::size_t vertex_count) {
  constexpr std::uint32_t unseen = UINT32_MAX;
  std::vector<std::uint32_t> name(vertex_count, unseen);
  std::vector<Eigen::Index> kept;
  for (std::uint32_t& index : indices) {
    if (name[index] == unseen) {
      name[index] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(index);
    }
    index = name[index];
  }
  return kept;
}

}  // namespace

Asset in_compact_order(Asset asset) {
  for (Surface& surface : asset.levels) {
    surface.indices = strip_order(surface.indices, surface.vertex_count());
    keep_vertices(surface, name_by_first_use(surface.indices, surface.vertex_count()));
  }
  return asset;
}

}  // namespace sphparam
