// ISO/IEC 15948: a signature and three chunks, each with its length, name and CRC; rows begin with
// the number of their filter, here 2: each byte is the difference to that of the row before, which
// is mostly nothing in pictures of triangles and of squares.

#include "io/files/png.h"

#include <zlib.h>

#include <cstdint>
#include <new>

namespace sphparam {

namespace {

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255U);
  return bytes;
}

std::string chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  const uLong crc =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(static_cast<std::uint32_t>(crc));
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  constexpr int level = 4;  // beyond it files of this kind hardly shrink
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), level) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

}  // namespace

std::string png_bytes(std::string_view pixels, int width, int height) {
  constexpr char up = 2;  // the filter
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  std::string filtered;
  filtered.reserve((row + 1) * static_cast<std::size_t>(height));
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    filtered += up;
    for (std::size_t x = 0; x < row; ++x) {
      const int before = y == 0 ? 0 : pixels[(y - 1) * row + x];
      filtered += static_cast<char>(pixels[y * row + x] - before);
    }
  }
  const std::string header = big_endian(static_cast<std::uint32_t>(width)) +
                             big_endian(static_cast<std::uint32_t>(height)) +
                             std::string("\x08\x02\0\0\0", 5);  // 8 bits, RGB
  return std::string("\x89PNG\r\n\x1A\n", 8) + chunk("IHDR", header) +
         chunk("IDAT", deflated(filtered)) + chunk("IEND", "");
}

}  // namespace sphparam
