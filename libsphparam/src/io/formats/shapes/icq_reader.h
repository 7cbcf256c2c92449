#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True for one count q and more than q lines of vectors.
bool looks_like_icq(std::string_view text);

/// Reads a shape model of implicitly connected quadrilaterals (R. Gaskell's ICQ): q, then the
/// (q + 1)² vectors of each of the six faces of a cube, row after row; "x y z", or "x y z albedo",
/// which becomes the property `albedo`.
///
/// Points along the edges of the cube stand in the file two or three times. They become one vertex
/// where their positions are the same; others are left apart, and noted. `source_vertex` is the
/// vector of the file, from 0. Grids may stand column after column too, where more points are the
/// same then. Quads look outwards, and are cut as others are; where rows and
/// columns run the other way, so that all would look inwards, they are turned, and that is noted.
/// Exponents may have Fortran's D; commas and labels as in plate tables. Throws: ReadError with the
/// line.
MeshFile read_icq(std::string_view text, const std::string& name, const ReadOptions& options = {});

}  // namespace sphparam
