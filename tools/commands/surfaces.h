#pragma once

#include <optional>
#include <string>

#include "arguments/limits.h"
#include "arguments/repair_arguments.h"
#include "console/session.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam::cli {

/// What is surface of a mesh, any triangles: fillers are left out, which is told.
MeshFile read_surface(const std::string& path, Session& session,
                      const ReadOptions& options = input_limits());

/// The same after the repairs that are wanted, as far as they go: what they leave that no map takes
/// is told. As it is where none are wanted. `with_fillers` gets the mesh as it was before fillers
/// were left out, if it had any.
MeshFile read_surface(const std::string& path, const RepairArguments& repair, Session& session,
                      std::optional<TriangleMesh>* with_fillers = nullptr);

}  // namespace sphparam::cli
