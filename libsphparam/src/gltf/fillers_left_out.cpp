#include "gltf/fillers_left_out.h"

#include <utility>

// The chart is of the whole sphere, and proved so; what is shown is the surface.

namespace sphparam {
namespace {

void gather(FloatRows& rows, const std::vector<Eigen::Index>& kept) {
  if (rows.size() == 0) return;
  FloatRows gathered(std::ssize(kept), rows.cols());
  for (Eigen::Index i = 0; i < gathered.rows(); ++i) {
    gathered.row(i) = rows.row(kept[static_cast<size_t>(i)]);
  }
  rows = std::move(gathered);
}

void gather(Surface& surface, const std::vector<Eigen::Index>& kept) {
  gather(surface.positions, kept);
  gather(surface.normals, kept);
  gather(surface.tangents, kept);
  for (FloatRows& texcoords : surface.texcoords) gather(texcoords, kept);
  for (CustomAttribute& custom : surface.custom) gather(custom.values, kept);
  for (MorphTarget& target : surface.targets) {
    gather(target.positions, kept);
    gather(target.normals, kept);
    gather(target.tangents, kept);
  }
  if (surface.colours.empty()) return;
  std::vector<std::array<std::uint16_t, 4>> colours;
  for (const Eigen::Index i : kept) colours.push_back(surface.colours[static_cast<size_t>(i)]);
  surface.colours = std::move(colours);
}

}  // namespace

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
  gather(surface, kept);
}

}  // namespace sphparam
