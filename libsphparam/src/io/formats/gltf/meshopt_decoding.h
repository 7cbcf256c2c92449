#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace sphparam {

/// The bytes that a buffer view compressed by EXT_meshopt_compression stands for: `count` rows of
/// `stride` bytes. `mode` and `filter` are the words of the extension; no filter is "NONE" or
/// empty. Throws: std::runtime_error that says what is wrong.
std::vector<unsigned char> decode_meshopt(std::span<const unsigned char> bytes, std::uint64_t count,
                                          std::uint64_t stride, std::string_view mode,
                                          std::string_view filter);

}  // namespace sphparam
