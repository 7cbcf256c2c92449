// ASCII only: no locale has a say in what a file is.

#include "image/file_extension.h"

#include <filesystem>

namespace sphparam::tools {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace sphparam::tools
