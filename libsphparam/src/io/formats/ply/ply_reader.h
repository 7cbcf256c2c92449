#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True when the bytes start with the magic word.
bool looks_like_ply(std::string_view bytes);

/// Reads a PLY file: ASCII, binary little-endian or binary big-endian.
///
/// Kept: all scalar properties of vertices and faces in their own types (coordinates of a text that
/// says more than the float which the header declares as Float64), polygons, the face lists
/// `texcoord` (two numbers a corner, as MeshLab writes them) and `normal` (three a corner, as
/// serialise_ply writes them), comments, materials; where `folder` is given, images that comments
/// name (texture_pages.h), which are looked for below it. `diffuse_red` and so on are colours, and
/// so are floats from 0 to 255 (other_colours.h); obj_info lines are comments, which is noted.
/// Where there are no faces, the element `tristrips` is read in their stead, as Stanford's files
/// have it: every other triangle of a strip is turned over, −1 starts a new one. Other lists and
/// other elements are told as not carried, and so are scalar properties with values that are not
/// finite. Throws: ReadError with the line, or with the byte in a binary body; with the property
/// where a ray of a map (sx, sy, sz) is not finite.
MeshFile read_ply(std::string_view bytes, const std::string& name,
                  const std::optional<std::filesystem::path>& folder,
                  const ReadOptions& options = {});

/// Comments of this form carry the names of MeshFile::materials, in order.
inline constexpr std::string_view material_comment = "sphparam material ";

}  // namespace sphparam
