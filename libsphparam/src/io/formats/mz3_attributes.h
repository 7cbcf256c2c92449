#pragma once

#include <cstdint>

namespace sphparam {

/// Bits of the second word of an MZ3 file.
struct Mz3Attributes {
  static constexpr std::uint16_t faces = 1, vertices = 2, colours = 4, floats = 8, doubles = 16,
                                 occlusion = 32, lookup = 64, all = 127;
};
inline constexpr char mz3_magic[] = "MZ";
inline constexpr std::size_t mz3_header_bytes = 16;

}  // namespace sphparam
