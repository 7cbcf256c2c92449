#include "console/level_path.h"

#include <filesystem>

#include "console/paths.h"

namespace sphparam::cli {

std::string level_path(const std::string& path, int level) {
  const std::string number = std::to_string(level);
  if (const size_t at = path.find("{n}"); at != std::string::npos)
    return path.substr(0, at) + number + path.substr(at + 3);
  if (level == 0) return path;
  const std::string name = std::filesystem::path(path).filename().string(), stem = stem_of(path);
  return std::filesystem::path(path)
      .replace_filename(stem + "_lod" + number + name.substr(stem.size()))
      .string();
}

}  // namespace sphparam::cli
