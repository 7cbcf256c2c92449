#pragma once

#include <string>
#include <string_view>

#include "mesh_io/mesh_file.h"
#include "mesh_io/read_options.h"

namespace sphparam::tools {

/// Reads a PLY file: ASCII, binary little-endian or binary big-endian.
///
/// Kept: all scalar properties of vertices and faces in their own types, polygons, the face lists
/// `texcoord` (two numbers a corner, as MeshLab writes them) and `normal` (three a corner, as
/// serialise_ply writes them), comments, materials. Other lists and other elements are skipped and
/// noted; triangle strips are refused.
/// Throws: ReadError with the line, or with the byte in a binary body.
MeshFile read_ply(std::string_view bytes, const std::string& name, const ReadOptions& options = {});

/// Comments of this form carry the names of MeshFile::materials, in order.
inline constexpr std::string_view kMaterialComment = "sphparam material ";

}  // namespace sphparam::tools
