#pragma once

#include <optional>
#include <string>

#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// How far a map's longitudes and latitudes are from those of the body that the mesh is, seen from
/// the centre, why, and what would have them; empty where they are the same, and, of bodies only,
/// of what is none: neither mapped as one, nor star-shaped but for little.
/// Cost: two passes, and a certificate of what is not mapped as a body where it is asked for.
std::string longitudes_off(const MappedMesh& mapped, const Vector3& centre, bool of_bodies_only,
                           int threads);

/// The same, from the centre given, else that of a radial map or the origin, of bodies only and
/// where a map is turned against its body by 45° and more (RMS): whatever is told by directions of
/// the map, as images and harmonics of scalars, is not where the body has it. Cost: the same.
std::string directions_turned(const MappedMesh& mapped, const std::optional<Vector3>& centre,
                              int threads);

}  // namespace sphparam
