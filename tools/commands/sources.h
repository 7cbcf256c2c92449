#pragma once

#include <string>

#include "console/session.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam::cli {

/// A mesh within the limits of the command line.
MeshSource read_source(const std::string& path);

/// `load_mapped` within the limits of the command line, from where on signals are held; what the
/// file loses is told, and so is a map that had to be made, with the λ given.
MappedMesh read_mapped(const std::string& path, const std::string& sphere, Session& session,
                       double lambda = 1);

}  // namespace sphparam::cli
