#include "cli/level_path.h"

#include <filesystem>

namespace sphparam::tools {

std::string level_path(const std::string& path, int level) {
  const std::string number = std::to_string(level);
  if (const size_t at = path.find("{n}"); at != std::string::npos)
    return path.substr(0, at) + number + path.substr(at + 3);
  if (level == 0) return path;
  const std::filesystem::path whole(path);
  return (whole.parent_path() /
          (whole.stem().string() + "_lod" + number + whole.extension().string()))
      .string();
}

}  // namespace sphparam::tools
