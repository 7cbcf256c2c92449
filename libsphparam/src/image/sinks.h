#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "image/image_codec.h"

namespace sphparam {

// What the module gives to its sinks (`oiio_module.h`), appended to the context.

inline void append_bytes(void* bytes, const char* more, std::size_t size) {
  auto& all = *static_cast<std::vector<char>*>(bytes);
  all.insert(all.end(), more, more + size);
}

inline void append_text(void* text, const char* more, std::size_t size) {
  static_cast<std::string*>(text)->append(more, size);
}

inline void append_pair(void* texts, const char* name, const char* value) {
  static_cast<ImageTexts*>(texts)->emplace_back(name, value);
}

}  // namespace sphparam
