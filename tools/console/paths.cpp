#include "console/paths.h"

#include <filesystem>

#include "commands/command.h"
#include "console/files_read.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Devices and pipes take what two outputs have to say.
bool holds_one_output(const std::string& path) {
  std::error_code hidden;
  const std::filesystem::file_status status = std::filesystem::status(path, hidden);
  return is_stream(path) || !std::filesystem::exists(status) ||
         std::filesystem::is_regular_file(status) || std::filesystem::is_directory(status);
}

void require_not_input(const std::string& input, const std::string& output,
                       const std::string& option) {
  if (input.empty() || is_stream(input) || is_stream(output) || output.empty()) return;
  std::error_code missing;  // a file that is not there is no other file
  const bool regular = std::filesystem::is_regular_file(output, missing);
  if (!regular || !std::filesystem::equivalent(input, output, missing)) return;
  throw UsageMistake(option + ": " + output + " is the input; it would be replaced");
}

void require_distinct(const Outputs& outputs) {
  for (size_t i = 0; i < outputs.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const auto& [option, path] = outputs[i];
      const auto& [other, place] = outputs[j];
      if (!is_same_place(path, place) || !holds_one_output(path)) continue;
      throw UsageMistake((other == option ? option + " twice: " : other + " and " + option + ": ") +
                         "the same file, " + output_name(path));
    }
  }
}

}  // namespace

bool is_same_place(const std::string& one, const std::string& other) {
  if (one.empty() || other.empty()) return false;
  if (is_stream(one) || is_stream(other)) return one == other;
  const auto one_spelling = [](const std::string& path) {
    std::error_code hidden;
    const std::filesystem::path absolute = std::filesystem::absolute(path, hidden);
    return std::filesystem::weakly_canonical(absolute, hidden);
  };
  return one_spelling(one) == one_spelling(other);
}

void check_places(const std::vector<std::string>& inputs, const Outputs& outputs,
                  const std::string& new_folder) {
  for (const auto& [option, path] : outputs) {
    for (const std::string& input : inputs) require_not_input(input, path, option);
    require_not_read(option, path);
  }
  require_distinct(outputs);
  for (const auto& [option, path] : outputs) {
    const std::filesystem::path in_new = std::filesystem::path(new_folder) / file_name(path);
    const bool is_there = new_folder.empty() || !is_same_place(path, in_new.string());
    if (!path.empty() && is_there) require_writable(path);
  }
}

}  // namespace sphparam::cli
