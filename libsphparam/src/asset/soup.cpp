#include "asset/soup.h"

namespace sphparam {

MeshSource without_lost(const MeshSource& asset) {
  RepairOptions finite = RepairOptions::none();
  finite.non_finite = true;
  return mended(asset, finite);
}

MeshFile with_places(const MeshSource& asset) {
  return asset.file.mesh.positions.allFinite() ? asset.file : without_lost(asset).file;
}

}  // namespace sphparam
