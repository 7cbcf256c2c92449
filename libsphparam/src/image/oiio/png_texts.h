#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Texts of PNG that are not ASCII. OpenImageIO writes all as tEXt, whose bytes are Latin-1 to every
// reader: UTF-8 has a chunk of its own, iTXt. ISO/IEC 15948, 11.3.4.

namespace sphparam {

/// The bytes before the first chunk that may be one of texts: the signature and IHDR.
constexpr std::int64_t png_head_size = 33;

/// Whether it is UTF-8 that is not ASCII.
inline bool needs_utf8(std::string_view text) {
  bool beyond_ascii = false;
  for (size_t i = 0; i < text.size();) {
    const auto byte = [&text](size_t k) {
      return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
    };
    const unsigned first = byte(i);
    if (first < 0x80) {
      ++i;
      continue;
    }
    const size_t more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
    if (first < 0xc2 || first > 0xf4) return false;
    for (size_t k = 1; k <= more; ++k)
      if ((byte(i + k) & 0xc0) != 0x80) return false;
    beyond_ascii = true;
    i += 1 + more;
  }
  return beyond_ascii;
}

inline std::string png_big_endian(std::uint32_t x) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(x >> shift & 255);
  return bytes;
}

/// The checksum of a chunk's name and data.
inline std::uint32_t png_crc(std::string_view bytes) {
  std::uint32_t value = ~0U;
  for (const char c : bytes) {
    value ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) value = value & 1 ? (value >> 1) ^ 0xedb88320U : value >> 1;
  }
  return ~value;
}

/// The chunk of a text in UTF-8, not compressed, in no language. Requires: a keyword as PNG has
/// them, 1 to 79 characters.
inline std::string itxt_chunk(std::string_view keyword, std::string_view text) {
  std::string body = "iTXt" + std::string(keyword);
  body.append(5, '\0');  // after the keyword: the two of compression, no language, no translation
  body += text;
  return png_big_endian(static_cast<std::uint32_t>(body.size() - 4)) + body +
         png_big_endian(png_crc(body));
}

}  // namespace sphparam
