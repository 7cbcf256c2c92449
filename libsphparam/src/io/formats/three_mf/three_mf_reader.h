#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

bool looks_like_three_mf(std::string_view bytes);

/// 3MF, as slicers and CAD programs write it: all objects of the build where it puts them, with the
/// components of objects (of other parts of the file as well, as Bambu Studio and Orca Slicer have
/// them). Where there are several, property `object` of faces counts them in the order of the
/// build, and comments name them. Base materials are materials, colours of triangles and corners
/// colours. Objects that are no part of the model (modifiers, supports) are left, and told.
/// Source: 3MF Core Specification 1.3, Materials 1.2, Production 1.1.
/// Throws: ReadError.
MeshFile read_three_mf(std::string_view bytes, const std::string& name,
                       const ReadOptions& options = {});

}  // namespace sphparam
