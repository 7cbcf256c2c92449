// One option for all limits: there are many, and hardly anybody needs one.

#include "arguments/input_limits.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <string>

#include "arguments/words.h"
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

Words limit_names() {
  Words names = names_of(named_limits, &NamedLimit::name);
  names.insert(names.begin(), "file");
  return names;
}

void set_limit(const std::string& text) {
  const auto refuse = [](const std::string& why) { throw CLI::ValidationError("--limit", why); };
  const std::string name = text.substr(0, text.find('='));
  if (std::ranges::count(limit_names(), name) == 0) refuse(no_such_word(name, limit_names()));
  const auto parts = name_and_file(text);
  const auto size = parts ? parse_size(parts->second) : std::nullopt;
  if (!size || *size > std::numeric_limits<std::int64_t>::max())
    refuse("expected " + name + "=N, as in vertices=500000 or file=4G");
  if (name == "file") limits.max_file_bytes = *size;
  for (const NamedLimit& limit : named_limits) {
    if (name == limit.name) limits.*limit.value = static_cast<std::int64_t>(*size);
  }
}

}  // namespace

void add_input_limits(CLI::App& command) {
  command
      .add_option_function<Words>(
          "--limit", [](const Words& texts) { std::ranges::for_each(texts, set_limit); },
          "Of input files: " + joined(limit_names()))
      ->type_name("NAME=N")
      ->type_size(1)
      ->expected(1)
      ->take_all();
}

const ReadOptions& input_limits() { return limits; }

}  // namespace sphparam::cli
