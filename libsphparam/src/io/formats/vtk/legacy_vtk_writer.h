#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_writer.h"

namespace sphparam {

/// A legacy VTK file of version 4.2, POLYDATA, BINARY: reading it gives the mesh back bit for bit,
/// with the properties of vertices and faces in their own types, comments and names of materials.
/// Polygons are faces where options name them. What corners have finds no place in it.
std::string serialise_legacy_vtk(const MeshFile& file, const WriteOptions& options = {});

}  // namespace sphparam
