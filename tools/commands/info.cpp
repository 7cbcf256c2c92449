// `sphparam info`: what a file holds, and everything that is wrong with it.

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "arguments/common_options.h"
#include "commands/command.h"
#include "commands/source.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/paths.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/records/inspection_record.h"
#include "sphparam/stopwatch.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Say what a mesh is, and everything that is wrong with it.\n"
    "\n"
    "Examples:\n"
    "  sphparam info statue.obj\n"
    "  sphparam info statue.ply --json -\n"
    "  cat statue.off | sphparam info -\n"
    "\n"
    "The exit status is 0 when the mesh can be mapped to a sphere, 4 when it cannot.\n";

struct InfoArguments {
  std::string input;
  std::string json;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

int run_info(const InfoArguments& arguments) {
  const Stopwatch stopwatch;
  require_report_place({arguments.input}, arguments.json);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  console.progress("inspection", 0);
  const MeshSource source = read_source(arguments.input);
  InspectionRecord record = {.source = source};
  if (!source.inspection.is_sphere()) record.repair = try_repair(source);
  record.seconds = stopwatch.seconds();
  console.clear_progress();
  if (!arguments.json.empty()) write_file(arguments.json, to_json(record));
  if (!is_stream(arguments.json) && !arguments.loudness.quiet) write_file("-", to_text(record));
  if (source.inspection.is_sphere()) return Ok;
  if (arguments.loudness.quiet) {
    print_error(display_name(arguments.input) + ": this is not a closed genus-0 mesh");
  }
  return MeshUnusable;
}

}  // namespace

Command declare_info(CLI::App& program) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = program.add_subcommand("info", summary);
  command->add_option("MESH", arguments->input, readable_formats("or") + "; - for standard input")
      ->type_name(" ")
      ->required();
  add_json(*command, arguments->json);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_info(*arguments); }};
}

}  // namespace sphparam::cli
