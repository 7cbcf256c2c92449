#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "sphparam/image/image.h"

namespace sphparam::tests {

inline std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text.push_back(static_cast<char>(value));
  return text;
}

/// In 255ths, row after row.
using Samples = std::vector<int>;

inline Samples samples(const Image& image) {
  Samples all;
  for (const float x : image.pixels) all.push_back(static_cast<int>(x * 255 + 0.5F));
  return all;
}

}  // namespace sphparam::tests
