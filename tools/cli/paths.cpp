#include "cli/paths.h"

#include <filesystem>

namespace sphparam::tools {

namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

std::string display_name(const std::string& path) {
  return is_stream(path) ? "standard input" : file_name(path);
}

std::string output_name(const std::string& path) {
  return is_stream(path) ? "standard output" : file_name(path);
}

}  // namespace sphparam::tools
