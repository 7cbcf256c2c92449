#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sphparam {

/// A ZIP archive of these names and bytes, in their order, nothing compressed, the bytes of each
/// from a multiple of `alignment` on: what has it in memory has every file as it is. Of one day for
/// all, so that the same files make the same bytes.
/// Requires: names in ASCII; `alignment` a power of two up to 2¹⁵. Throws: std::length_error where
/// Zip64 would be needed: beyond 4 GiB or 65,535 files.
/// Source: PKWARE's APPNOTE.TXT 6.3.
std::string stored_zip(const std::vector<std::pair<std::string, std::string>>& files,
                       std::size_t alignment = 1);

}  // namespace sphparam
