#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// True for the magic number FF FF FF of FreeSurfer's files of one number a vertex.
bool looks_like_curv(std::string_view bytes);

/// Reads a FreeSurfer file of one number a vertex (lh.curv, lh.thickness): FF FF FF, the numbers of
/// vertices and of triangles, 1, big-endian float32. Throws: ReadError with the byte.
VertexData read_curv(std::string_view bytes, const std::string& name, const ReadOptions& options);

/// The same file. Throws: WriteError for labels, several columns, and numbers beyond float32.
std::string serialise_curv(const VertexData& data);

}  // namespace sphparam
