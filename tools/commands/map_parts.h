#pragma once

#include <functional>

#include "arguments/map_arguments.h"
#include "console/session.h"
#include "reports/map_outcome.h"
#include "sphparam/io/components.h"

namespace sphparam::cli {

/// Maps each connected part of a mesh, the largest first, into a file of its own:
/// NAME_0001.sph.ply, … All of them or none. A part that cannot be mapped is left out, and told,
/// where all of these together have no more of the area than --min-kept leaves (with --repair 2 %,
/// else nothing). map: mends and maps one part. Throws: MeshRefusal of the first part that
/// cannot be mapped, if they have more.
int run_map_of_parts(const MapArguments& arguments, Session& session,
                     const std::function<MapOutcome(MeshPart)>& map);

}  // namespace sphparam::cli
