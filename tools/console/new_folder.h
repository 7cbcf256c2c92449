#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sphparam::cli {

/// The folder of a subcommand's outputs, made when they are about to be written. What was made is
/// gone again where nothing came into it: a run that fails leaves no folder. Outlives the outputs
/// that wait in it under names of their own.
class NewFolder {
 public:
  explicit NewFolder(std::string path) : path_(std::move(path)) {}
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Makes it, and those above it, where they are not there. Throws: WriteError.
  void make();

 private:
  std::string path_;
  std::vector<std::filesystem::path> made_;  // the innermost first
};

}  // namespace sphparam::cli
