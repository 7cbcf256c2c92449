#include "batch/options_hash.h"

#include <filesystem>
#include <sstream>

#include "batch/content_hash.h"
#include "batch/steps.h"

namespace sphparam {

std::string OptionsHash::of(const BatchItem& item) {
  std::vector<BatchStep> steps = plan_.steps;
  for (BatchStep& step : steps)
    for (std::string& word : step) word = substituted(word, plan_, item, false);
  add_options_of_row(steps, plan_, item);
  std::string text;
  for (const BatchStep& step : steps) {
    text += '\n';
    for (const std::string& word : step) text += word + '\0' + content_of(word) + '\0';
  }
  return content_hash(text);
}

/// Of the files that a word names with their whole paths, alone or behind an equals sign or a
/// colon; several have commas between them.
std::string OptionsHash::content_of(const std::string& word) {
  const std::size_t joint = word.find_first_of("=:");
  const std::string path =
      word.starts_with('/') || joint == std::string::npos ? word : word.substr(joint + 1);
  std::string contents = content_of_file(path);
  if (!contents.empty()) return contents;
  std::istringstream parts(path);
  for (std::string part; std::getline(parts, part, ',');) contents += content_of_file(part);
  return contents;
}

std::string OptionsHash::content_of_file(const std::string& path) {
  if (!path.starts_with('/')) return "";
  const auto [known, is_new] = contents_.emplace(path, "");
  std::error_code hidden;
  if (is_new && std::filesystem::is_regular_file(path, hidden)) known->second = hash_of_file(path);
  return known->second;
}

}  // namespace sphparam
