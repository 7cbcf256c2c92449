#include "batch/options_hash.h"

#include <filesystem>
#include <string_view>

#include "batch/content_hash.h"
#include "batch/steps.h"

namespace sphparam {

namespace {

constexpr std::string_view joints = "=:,";

}  // namespace

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

/// Of the files that a word names with their whole paths: alone, or behind a sign that joins them
/// to a name or to others, to the end of the word or to a comma.
std::string OptionsHash::content_of(const std::string& word) {
  std::string contents;
  for (std::size_t at = word.find('/'); at != std::string::npos; at = word.find('/', at + 1)) {
    const bool begins = at == 0 || joints.find(word[at - 1]) != std::string_view::npos;
    if (!begins) continue;
    std::string content = content_of_file(word.substr(at));
    const std::size_t comma = word.find(',', at);
    if (content.empty() && comma != std::string::npos)
      content = content_of_file(word.substr(at, comma - at));
    contents += content;
  }
  return contents;
}

std::string OptionsHash::content_of_file(const std::string& path) {
  const auto [known, is_new] = contents_.emplace(path, "");
  std::error_code hidden;
  if (is_new && std::filesystem::is_regular_file(path, hidden)) known->second = hash_of_file(path);
  return known->second;
}

}  // namespace sphparam
