// Extensions are ASCII only: no locale has a say in what a file is.

#include "sphparam/io/paths.h"

#include <algorithm>
#include <filesystem>

#include "lower_case.h"

namespace sphparam {

namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

std::string extension_of(const std::string& path) {
  return in_lower_case(std::filesystem::path(path).extension().string());
}

bool is_packed_name(const std::string& path) { return extension_of(path) == ".gz"; }

std::string inner_extension_of(const std::string& path) {
  return extension_of(is_packed_name(path) ? std::filesystem::path(path).stem().string() : path);
}

std::string display_name(const std::string& path) {
  return is_stream(path) ? "standard input" : file_name(path);
}

std::string output_name(const std::string& path) {
  return is_stream(path) ? "standard output" : file_name(path);
}

std::string stem_of(const std::string& path) {
  std::filesystem::path name = std::filesystem::path(path).filename();
  if (is_packed_name(name.string())) name = name.stem();
  name = name.stem();
  if (extension_of(name.string()) == ".sph") name = name.stem();
  return name.string();
}

std::string path_of_part(const std::string& path, int part) {
  constexpr size_t digits = 4;
  std::string number = std::to_string(part);
  number.insert(0, digits - std::min(digits, number.size()), '0');
  const std::string name = file_name(path), stem = stem_of(path);
  return std::filesystem::path(path)
      .replace_filename(stem + "_" + number + name.substr(stem.size()))
      .string();
}

std::string level_path(const std::string& path, int level) {
  const std::string number = std::to_string(level);
  if (const size_t at = path.find("{n}"); at != std::string::npos)
    return path.substr(0, at) + number + path.substr(at + 3);
  if (level == 0) return path;
  const std::string name = file_name(path), stem = stem_of(path);
  return std::filesystem::path(path)
      .replace_filename(stem + "_lod" + number + name.substr(stem.size()))
      .string();
}

}  // namespace sphparam
