#pragma once

#include "mesh/enclosed_volume.h"
#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// Whether the faces of a closed mesh look inward: what they enclose is less than nothing, by more
/// than rounding. Of any size. Requires: a vertex. Cost: a pass over the faces.
inline bool is_inside_out(const TriangleMesh& mesh) {
  constexpr double rounding = 1e-9;
  return enclosed(mesh) < -rounding;
}

/// The same of a surface with kept holes: a sheet has no inside, and no repair turns it over.
inline bool is_inside_out(const MappedMesh& mapped) {
  return !is_sheet(mapped.mesh(), mapped.fillers()) && is_inside_out(mapped.mesh());
}

}  // namespace sphparam
