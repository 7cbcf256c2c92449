// One option for all limits: there are many, and hardly anybody needs one.

#include "arguments/input_limits.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "arguments/suggestion.h"
#include "console/memory_limit.h"

namespace sphparam::cli {

namespace {

ReadOptions limits;

struct NamedLimit {
  const char* name;
  std::int64_t ReadOptions::*value;
};

constexpr NamedLimit named_limits[] = {{"vertices", &ReadOptions::max_vertices},
                                       {"faces", &ReadOptions::max_faces},
                                       {"degree", &ReadOptions::max_polygon_degree},
                                       {"line", &ReadOptions::max_line_bytes},
                                       {"ply-elements", &ReadOptions::max_ply_elements},
                                       {"ply-properties", &ReadOptions::max_ply_properties},
                                       {"json", &ReadOptions::max_json_bytes},
                                       {"json-depth", &ReadOptions::max_json_depth},
                                       {"json-values", &ReadOptions::max_json_values},
                                       {"json-objects", &ReadOptions::max_json_objects}};

std::vector<std::string> limit_names() {
  std::vector<std::string> names = {"file"};
  for (const NamedLimit& limit : named_limits) names.emplace_back(limit.name);
  return names;
}

std::string join(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

/// Sets the limit; returns what is wrong with the text.
std::string set_limit(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::vector<std::string> names = limit_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    const std::string meant = nearest_word(name, names);
    return "no " + name + " among " + join(names) +
           (meant.empty() ? "" : "; did you mean " + meant + "?");
  }
  const auto size =
      equals == std::string::npos ? std::nullopt : parse_size(text.substr(equals + 1));
  if (!size || *size > std::numeric_limits<std::int64_t>::max()) {
    return "expected " + name + "=N, as in vertices=500000 or file=4G";
  }
  if (name == "file") limits.max_file_bytes = *size;
  for (const NamedLimit& limit : named_limits) {
    if (name == limit.name) limits.*limit.value = static_cast<std::int64_t>(*size);
  }
  return "";
}

}  // namespace

void add_input_limits(CLI::App& command) {
  command
      .add_option_function<std::vector<std::string>>(
          "--limit",
          [](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              const std::string wrong = set_limit(text);
              if (!wrong.empty()) throw CLI::ValidationError("--limit", wrong);
            }
          },
          "Of input files: " + join(limit_names()))
      ->type_name("NAME=N")
      ->type_size(1)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

const ReadOptions& input_limits() { return limits; }

}  // namespace sphparam::cli
