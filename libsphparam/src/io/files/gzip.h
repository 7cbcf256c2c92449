#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sphparam {

/// True for the first bytes of a gzip file.
bool looks_like_gzip(std::string_view bytes);

/// What a gzip file held.
struct Unzipped {
  std::string bytes;
  bool trailing_data = false;  // after the last member, other than zeros
};

/// Unpacks a gzip file, of one member or several (RFC 1952). Memory grows with what comes out, up
/// to twice that; nothing is believed of what the file says of its size.
/// Throws: ReadError where the data is corrupt, cut short or unpacks to more than `max_bytes`.
Unzipped unzip(std::string_view bytes, const std::string& name, std::uint64_t max_bytes);

/// Of what the first member of a gzip file holds, as much as that, or less where it ends or is
/// damaged. Requires: `most` is below 2³². Cost: that of what comes out, whatever the file's size.
std::string beginning_of_gzip(std::string_view bytes, std::size_t most);

/// Unpacks what deflate made (RFC 1951), without a header, as it stands in ZIP archives. As `unzip`,
/// but nothing checks what comes out. Data behind its end is left.
std::string inflated(std::string_view packed, const std::string& name, std::uint64_t max_bytes);

/// A gzip file of one member, without name and time: the same bytes give the same file.
std::string zip(std::string_view bytes);

// One block of zlib's own format (RFC 1950), as it stands within other files:

std::string packed_block(std::string_view bytes);

/// Puts a block that unpacks to exactly `size` bytes at the end of `bytes`. False where it does
/// not. Requires: the size can be afforded.
bool unpack_block(std::string_view packed, std::uint64_t size, std::string& bytes);

}  // namespace sphparam
