#pragma once

#include <string>

#include "arguments/limits.h"
#include "console/session.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam::cli {

/// What is surface of a mesh, any triangles: fillers are left out, which is told.
MeshFile read_surface(const std::string& path, Session& session,
                      const ReadOptions& options = input_limits());

}  // namespace sphparam::cli
