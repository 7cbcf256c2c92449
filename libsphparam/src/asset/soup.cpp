#include "asset/soup.h"

#include <algorithm>
#include <vector>

namespace sphparam {
namespace {

bool uses_all_vertices(const TriangleMesh& mesh) {
  std::vector<char> used(static_cast<size_t>(mesh.vertex_count()), 0);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
    used[static_cast<size_t>(mesh.triangles.data()[i])] = 1;
  return std::ranges::count(used, 0) == 0;
}

}  // namespace

MeshSource without_lost(const MeshSource& asset) {
  RepairOptions finite = RepairOptions::none();
  finite.non_finite = true;
  return mended(asset, finite);
}

MeshFile with_places(const MeshSource& asset) {
  const TriangleMesh& mesh = asset.file.mesh;
  if (mesh.positions.allFinite() && uses_all_vertices(mesh)) return asset.file;
  RepairOptions placed = RepairOptions::none();
  placed.non_finite = placed.unused = true;
  return mended(asset, placed).file;
}

}  // namespace sphparam
