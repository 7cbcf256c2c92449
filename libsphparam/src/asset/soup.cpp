#include "asset/soup.h"

namespace sphparam {

MeshFile with_places(const MeshSource& asset) {
  if (asset.file.mesh.positions.allFinite()) return asset.file;
  RepairOptions finite = RepairOptions::none();
  finite.non_finite = true;
  return mended(asset, finite).file;
}

}  // namespace sphparam
