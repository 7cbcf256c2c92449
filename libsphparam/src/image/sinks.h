#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "image/image_codec.h"
#include "image/oiio_module.h"

namespace sphparam {

// Sinks of the image module that append what they take.

inline SphparamBytesSink into(std::vector<char>& bytes) {
  return {[](void* all, const char* more, std::size_t size) {
            auto& before = *static_cast<std::vector<char>*>(all);
            before.insert(before.end(), more, more + size);
          },
          &bytes};
}

inline SphparamBytesSink into(std::string& text) {
  return {[](void* all, const char* more, std::size_t size) {
            static_cast<std::string*>(all)->append(more, size);
          },
          &text};
}

inline SphparamTextSink into(ImageTexts& texts) {
  return {[](void* all, const char* name, const char* value) {
            static_cast<ImageTexts*>(all)->emplace_back(name, value);
          },
          &texts};
}

}  // namespace sphparam
