#pragma once

#include <string>

namespace sphparam {

/// Rows of a vertex buffer as EXT_meshopt_compression stores them in mode ATTRIBUTES, lossless.
/// Requires: `count` rows of `stride` bytes, a multiple of 4 up to 256.
std::string encode_vertices(const std::string& bytes, std::size_t count, std::size_t stride);

/// Indices of triangles in mode TRIANGLES; a decoder may rotate the corners of a triangle.
/// Requires: `count` indices, a multiple of 3, of 2 or 4 bytes each.
std::string encode_triangles(const std::string& bytes, std::size_t count, std::size_t stride);

}  // namespace sphparam
