// Extensions are ASCII only: no locale has a say in what a file is.

#include "sphparam/io/paths.h"

#include <filesystem>

namespace sphparam {

namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

std::string display_name(const std::string& path) {
  return is_stream(path) ? "standard input" : file_name(path);
}

std::string output_name(const std::string& path) {
  return is_stream(path) ? "standard output" : file_name(path);
}

std::string stem_of(const std::string& path) {
  std::filesystem::path name = std::filesystem::path(path).filename();
  if (extension_of(name.string()) == ".gz") name = name.stem();
  name = name.stem();
  if (extension_of(name.string()) == ".sph") name = name.stem();
  return name.string();
}

}  // namespace sphparam
