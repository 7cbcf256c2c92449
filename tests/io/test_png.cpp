#include <catch2/catch.hpp>
#include <string>

#include "io/files/gzip.h"
#include "io/files/png.h"

namespace sphparam::tests {

TEST_CASE("png: signature, size, and chunks with their sums") {
  const std::string png = png_bytes(std::string(3 * 5 * 2, '\x40'), 5, 2);
  CHECK(png.substr(0, 16) == std::string("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR", 16));
  CHECK(png.substr(16, 8) == std::string("\0\0\0\5\0\0\0\2", 8));
  CHECK(png.substr(png.size() - 12) == std::string("\0\0\0\0IEND\xAE\x42\x60\x82", 12));
}

TEST_CASE("png: a row is its difference to the one before, the first to nothing") {
  const std::string png = png_bytes(std::string("\x01\x02\xff\x03\x01\x01", 6), 1, 2);
  const std::size_t data = png.find("IDAT") + 4, end = png.find("IEND") - 8;
  std::string rows;
  REQUIRE(unpack_block(png.substr(data, end - data), 8, rows));
  CHECK(rows == std::string("\x02\x01\x02\xff\x02\x02\xff\x02", 8));
}

}  // namespace sphparam::tests
