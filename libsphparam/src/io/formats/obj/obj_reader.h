#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// OBJ has no magic word: true when the first line that is no comment starts with a statement.
bool looks_like_obj(std::string_view bytes);

/// Reads a Wavefront OBJ file.
///
/// Kept: v with optional colours (x y z r g b [a], fractions; whole numbers up to 255 where one is
/// more than 1), vt per corner, vn per vertex where each vertex has one normal and per corner where
/// not, polygons, usemtl as the face property `material` (none where it says "(null)", which no
/// library has), the comments in lines of their own (behind the first statement up to 1000); where
/// `folder` is given, the base colours of materials from their libraries (obj_materials.h), which
/// are looked for below it. Told as not carried: groups, objects, smoothing groups, third texture
/// coordinates, lines, points, free-form geometry, libraries that are not read, what else materials
/// say, statements that OBJ does not have. A text with such a statement and no face is no OBJ.
/// Indices count from 1; from 0, which is noted, where a file without vt and vn in its faces names
/// 0 and as the largest the number of vertices less 1. Throws: ReadError with the line.
MeshFile read_obj(std::string_view text, const std::string& name,
                  const std::optional<std::filesystem::path>& folder,
                  const ReadOptions& options = {});

}  // namespace sphparam
