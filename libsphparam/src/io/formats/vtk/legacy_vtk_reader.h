#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True when the text opens as a legacy VTK file does: "# vtk DataFile Version", a title, and ASCII
/// or BINARY.
bool looks_like_legacy_vtk(std::string_view bytes);

/// Reads a legacy VTK file with DATASET POLYDATA, ASCII or BINARY, of versions 1 to 5.
///
/// Kept: POLYGONS and TRIANGLE_STRIPS; arrays of points and cells, as properties: normals, texture
/// coordinates and colours under their conventional names, each other component as one of its own;
/// of field data the strings that `serialise_legacy_vtk` writes. Told as not carried: vertices,
/// lines, lookup tables, other field data, arrays with values that are not finite.
/// Refused by name: other datasets. Throws: ReadError, with the line in ASCII, the byte in BINARY.
MeshFile read_legacy_vtk(std::string_view bytes, const std::string& name,
                         const ReadOptions& options = {});

}  // namespace sphparam
