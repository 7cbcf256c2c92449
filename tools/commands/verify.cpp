// `sphparam verify`: proves a written map again, ours or a peer's.

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "arguments/common_options.h"
#include "arguments/input_limits.h"
#include "commands/command.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/records/verification_record.h"
#include "sphparam/stopwatch.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Prove a written map again, ours or anybody's.\n"
    "\n"
    "Examples:\n"
    "  sphparam verify statue.sph.ply                 a map with sx sy sz, as `map` writes it\n"
    "  sphparam verify sphere.obj                     a bare sphere about the origin\n"
    "  sphparam verify statue.obj sphere.obj --json -   a mesh and its sphere, with figures\n"
    "  sphparam verify statue.glb                     what `export --theta-phi` wrote\n"
    "  sphparam verify statue.sph.ply --chart         the texture chart too\n"
    "\n"
    "The exit status is 0 when the map (and with --chart its chart) is one-to-one, 5 when it is\n"
    "not, and 3 when the two files are not of one connectivity: the same vertices in every\n"
    "triangle.\n";

struct VerifyArguments {
  std::string file;
  std::string sphere;  // empty: the map is in `file`
  bool chart = false;
  std::string json;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

/// Of the map, or of its mirror image, as it was certified.
std::optional<ChartReport> chart_of(const VerifiedMap& map, int threads) {
  if (!map.certificate.bijective()) return std::nullopt;
  return report_chart(map.mesh, map.map, threads);
}

int run_verify(const VerifyArguments& arguments) {
  const Stopwatch stopwatch;
  require_report_place({arguments.file, arguments.sphere}, arguments.json);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  console.progress("certificate", 0);
  const VerifiedMap map = verify_map(
      arguments.file,
      {.sphere = arguments.sphere, .read = input_limits(), .threads = arguments.threads});
  if (!map.is_round()) console.warning(roundness_warning(map));
  VerificationRecord report = {.file = arguments.file, .map = map, .chart_wanted = arguments.chart};
  if (arguments.chart) report.chart = chart_of(map, arguments.threads);
  report.seconds = stopwatch.seconds();
  console.clear_progress();
  if (!arguments.json.empty()) write_file(arguments.json, to_json(report));
  const std::string text = to_text(report);
  if (!is_stream(arguments.json) && !arguments.loudness.quiet) write_file("-", text);
  const bool chart_holds =
      !arguments.chart || (report.chart && report.chart->certificate.one_to_one());
  if (map.certificate.bijective() && chart_holds) return Ok;
  if (arguments.loudness.quiet) print_error(text.substr(0, text.size() - 1));
  return NotCertified;
}

}  // namespace

Command declare_verify(CLI::App& program) {
  const auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command = program.add_subcommand("verify", summary);
  command->add_option("FILE", arguments->file, "A written map, a sphere or a mesh; - for stdin")
      ->type_name(" ")
      ->required();
  command->add_option("SPHERE", arguments->sphere, "The sphere of mesh FILE, same connectivity")
      ->type_name(" ");
  command->add_flag("--chart", arguments->chart,
                    "Make the (u, v) chart for textures too, and prove it");
  add_json(*command, arguments->json);
  add_threads(*command, arguments->threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_verify(*arguments); }};
}

}  // namespace sphparam::cli
