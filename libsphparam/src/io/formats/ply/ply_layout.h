#pragma once

#include <string>

#include "io/formats/ply/ply_header.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// Which parts of a PLY file are the mesh; pointers into its header.
struct PlyLayout {
  const PlyElement* vertices = nullptr;  // never null; x, y and z are scalars
  const PlyElement* faces = nullptr;     // null: there are none, or strips stand in for them
  const PlyElement* strips = nullptr;    // of triangles; not where there are faces
  const PlyProperty* corners = nullptr;  // the list of vertices of faces, or else of strips
};

/// Requires: the header outlives the layout.
/// Throws: ReadError with the line, where the header declares no mesh that can be read or more
/// records than the options allow.
PlyLayout find_layout(const PlyHeader& header, const std::string& name, const ReadOptions& options);

}  // namespace sphparam
