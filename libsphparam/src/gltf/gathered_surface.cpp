#include "gltf/gathered_surface.h"

#include <utility>

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

}  // namespace

void keep_vertices(Surface& surface, const std::vector<Eigen::Index>& kept) {
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

}  // namespace sphparam
