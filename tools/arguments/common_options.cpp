#include "arguments/common_options.h"

#include <CLI/CLI.hpp>

#include "arguments/choice.h"
#include "console/paths.h"
#include "sphparam/io/mesh_reader.h"

namespace sphparam::cli {

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "How many threads (0: all cores); same bytes")
      ->check(between(0, 4096, "0 to 4096"))
      ->type_name("N")
      ->capture_default_str();
}

void add_progress(CLI::App& command, ProgressStyle& progress) {
  add_choice<ProgressStyle>(
      command, "--progress", progress,
      {{"auto", ProgressStyle::Auto}, {"none", ProgressStyle::None}, {"json", ProgressStyle::Json}},
      "How far it is; auto: on a terminal (default: auto)");
}

void add_json(CLI::App& command, std::string& json, const std::string& what) {
  command.add_option("--json", json, what + "; - for standard output")->type_name("FILE");
}

void require_report_place(const std::vector<std::string>& inputs, const std::string& json) {
  check_places(inputs, {{"--json", json}});
  if (is_mesh_name(json)) {
    throw UsageMistake("--json: " + json +
                       " is the name of a mesh, not of a report; `--json -` is standard output");
  }
}

void add_loudness(CLI::App& command, Loudness& loudness) {
  command.add_flag("-q,--quiet", loudness.quiet, "Errors only");
  command.add_flag("-v,--verbose", loudness.verbose, "Every stage");
}

}  // namespace sphparam::cli
