#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True for counts, lines of vertices, and where these end, lines of plates.
bool looks_like_plates(std::string_view text);

/// Reads a plate table (.plt, .tab, .ver), as the Small Bodies Node of the PDS, NAIF and others
/// have shape models: lines "x y z" or "NUMBER x y z" of vertices, then "a b c" or "NUMBER a b c"
/// of plates, before each of them a line "3" or not (OSIRIS's .ver). Both counts come first, on a
/// line or on two, or each before its lines. One more number after three that have none before them
/// becomes the property `albedo` of vertices or faces.
///
/// Numbers run on from 1 or from 0. Plates name vertices from 1; from 0, which is noted, where one
/// names 0 and the largest is the number of vertices less 1. Exponents may have Fortran's D.
/// Numbers may have commas between them; a label of PDS3 may stand before the counts, and is told.
/// Throws: ReadError with the line.
MeshFile read_plates(std::string_view text, const std::string& name,
                     const ReadOptions& options = {});

}  // namespace sphparam
