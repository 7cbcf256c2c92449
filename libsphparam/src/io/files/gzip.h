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

}  // namespace sphparam
