#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sphparam {

/// Rows of a vertex buffer as EXT_meshopt_compression stores them in mode ATTRIBUTES, lossless.
/// Requires: `count` rows of `stride` bytes, a multiple of 4 up to 256.
std::string encode_vertices(const std::string& bytes, std::size_t count, std::size_t stride);

/// Unit vectors, four floats a row, as four bytes each for the filter OCTAHEDRAL; the fourth
/// number, of [−1, 1], is kept apart. Off by less than 1°. Source: KHR and
/// EXT_meshopt_compression, "Filters"; meshoptimizer.
std::string octahedral(const std::vector<float>& rows);

/// The triangles in an order in which few bits say each, with corners rotated.
std::vector<std::uint32_t> strip_order(const std::vector<std::uint32_t>& indices,
                                       std::size_t vertex_count);

/// Indices of triangles in mode TRIANGLES; a decoder may rotate the corners of a triangle.
/// Requires: `count` indices, a multiple of 3, of 2 or 4 bytes each.
std::string encode_triangles(const std::string& bytes, std::size_t count, std::size_t stride);

}  // namespace sphparam
