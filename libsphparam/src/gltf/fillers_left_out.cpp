#include "gltf/fillers_left_out.h"

#include <utility>

#include "gltf/gathered_surface.h"

// The chart is of the whole sphere, and proved so; what is shown is the surface.

namespace sphparam {

FillerMarks fillers_of_chart(const SphericalChart& chart, const FillerMarks& of_source) {
  if (of_source.empty()) return {};
  FillerMarks fillers;
  for (const Face f : chart.source_faces) fillers.push_back(of_source[static_cast<size_t>(f)]);
  return fillers;
}

void leave_out(Surface& surface, const FillerMarks& fillers) {
  if (fillers.empty()) return;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> name(surface.vertex_count(), 0);
  for (size_t i = 0; i < surface.indices.size(); ++i) {
    if (fillers[i / 3]) continue;
    indices.push_back(surface.indices[i]);
    name[surface.indices[i]] = 1;
  }
  std::vector<Eigen::Index> kept;
  for (size_t v = 0; v < name.size(); ++v) {
    if (!name[v]) continue;
    name[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(static_cast<Eigen::Index>(v));
  }
  for (std::uint32_t& index : indices) index = name[index];
  surface.indices = std::move(indices);
  keep_vertices(surface, kept);
}

}  // namespace sphparam
