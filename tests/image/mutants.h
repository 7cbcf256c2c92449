#pragma once

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "image/image_codec.h"

namespace sphparam::tests {

/// Files of which up to three bytes from `first` on are others are read or refused: some are this,
/// some that, and no image is larger than files so small can have.
template <class Read>
void check_mutants(const std::vector<std::string>& files, std::size_t first, const Read& read) {
  std::uint32_t state = 1;
  const auto random = [&] { return (state = state * 1664525 + 1013904223) >> 8; };
  int read_all_the_same = 0;
  for (int i = 0; i < 30000; ++i) {
    std::string file = files[random() % files.size()];
    for (unsigned change = 0; change <= random() % 3; ++change)
      file[first + random() % (file.size() - first)] = static_cast<char>(random());
    try {
      const Image image = read(file);
      REQUIRE(image.pixels.size() < 1000000);
      ++read_all_the_same;
    } catch (const ImageError&) {
    }
  }
  CHECK(read_all_the_same > 1000);
  CHECK(read_all_the_same < 29000);
}

}  // namespace sphparam::tests
