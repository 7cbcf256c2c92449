#include "asset/soup.h"

namespace sphparam {

MeshFile with_places(const MeshSource& asset) {
  if (asset.file.mesh.positions.allFinite()) return asset.file;
  RepairOptions finite = RepairOptions::none();
  finite.non_finite = true;
  return mended(asset, finite).file;
}

double longest_side(const TriangleMesh& mesh) {
  if (mesh.vertex_count() == 0) return 0;
  return (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).maxCoeff();
}

}  // namespace sphparam
