#pragma once

#include <cstdint>
#include <span>

#include "gltf/format/buffer_views.h"
#include "sphparam/gltf/asset.h"

namespace sphparam {

enum class Bounds { Omit, Store };

/// Rows as float32. Bounds are exact for the numbers stored.
PackedRows pack_floats(const FloatRows& rows, Bounds bounds = Bounds::Omit);

/// Numbers in [−1, 1] as normalised 16-bit integers, each row padded to a multiple of 4 bytes.
PackedRows pack_signed(const FloatRows& rows);
/// Unit vectors of 3 components, or of 4 with the last in [−1, 1], as normalised 8-bit integers for
/// the filter OCTAHEDRAL.
PackedRows pack_octahedral(const FloatRows& rows);
/// As `pack_signed` for [0, 1], unsigned.
PackedRows pack_unsigned(const FloatRows& rows);

PackedRows pack_colours(std::span<const std::array<std::uint16_t, 4>> colours);

/// 16-bit where no index is above 65,534.
PackedRows pack_indices(std::span<const std::uint32_t> indices, std::size_t vertex_count);

/// One scale for all axes, so that normals keep their angles: position = offset + scale · integer.
struct Quantisation {
  Eigen::RowVector3d offset = Eigen::RowVector3d::Zero();
  double scale = 1;
};
Quantisation quantisation_of(const FloatRows& positions);

/// Positions as 16-bit integers with exact bounds.
PackedRows pack_quantised(const FloatRows& positions, const Quantisation& quantisation);

/// Whether `pack_unsigned` can have these: normalised integers end at 1, so that (u, v) that wrap
/// beyond stay floats.
bool fits_integers(const FloatRows& uv);

/// What pack_unsigned makes of a number: q of q / 65,535.
std::uint16_t to_unsigned16(double value);

}  // namespace sphparam
