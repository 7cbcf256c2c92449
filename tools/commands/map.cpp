// `sphparam map`: file → mesh → map → proof → file.

#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "arguments/map_arguments.h"
#include "commands/command.h"
#include "commands/map_outcome.h"
#include "commands/map_outputs.h"
#include "commands/source.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "reports/map_wording.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/pin_file.h"
#include "sphparam/stopwatch.h"

namespace sphparam::cli {

namespace {

/// Poles, meridian and pins as vertices of the mesh.
void settle_vertices(const MapArguments& arguments, const MeshFile& file,
                     ParameterizeOptions& options) {
  if (!options.poles && !options.meridian && arguments.pins.empty()) return;
  const FileNumbers numbers(file);
  const auto vertex = [&](const char* option, Vertex number) {
    const Vertex found = numbers.vertex(number);
    if (found < 0) throw UsageMistake(std::string(option) + ": " + numbers.absence(number));
    return found;
  };
  if (options.poles) {
    options.poles =
        Poles{vertex("--poles", options.poles->north), vertex("--poles", options.poles->south)};
    if (options.poles->north == options.poles->south) {
      throw UsageMistake("--poles: the two are one vertex, welded where positions agree");
    }
  }
  if (options.meridian) options.meridian = vertex("--meridian", *options.meridian);
  if (arguments.pins.empty()) return;
  options.pins = read_pins(arguments.pins, numbers);
  for (const Landmark& pin : options.pins) {
    if (options.poles &&
        (pin.vertex == options.poles->north || pin.vertex == options.poles->south)) {
      throw UsageMistake("--pin: vertex " + std::to_string(numbers.number(pin.vertex)) +
                         " is one of the --poles");
    }
  }
}

MapOutcome compute(MeshSource source, const MapArguments& arguments, Console& console) {
  MapOutcome outcome = {.source = std::move(source)};
  require_mappable(outcome.source);
  const TriangleMesh& mesh = outcome.source.file.mesh;
  ParameterizeOptions options = arguments.options;
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  settle_vertices(arguments, outcome.source.file, options);
  outcome.pins = options.pins;
  outcome.poles = options.poles;
  outcome.meridian = options.meridian;
  MethodRun run = run_method(arguments.method, mesh, outcome.topology(), options);
  outcome.result = std::move(run.result);
  outcome.account = std::move(run.account);
  outcome.certificate = outcome.result.certificate;
  if (outcome.has_map()) {
    outcome.distortion = measure_distortion(mesh, outcome.result.map, options.threads);
    outcome.figures = summarise(*outcome.distortion, options.threads);
  }
  return outcome;
}

/// The mesh, after the repairs that are wanted.
MeshSource read_mended(const MapArguments& arguments) {
  const std::optional<RepairOptions> repairs = wanted_repairs(arguments.repair);
  ReadOptions options = input_limits();
  options.repeated_corners = repairs && repairs->duplicates;
  MeshSource source = sphparam::read_source(arguments.input, options);
  if (!repairs) return source;
  try {
    return repaired(std::move(source), *repairs);
  } catch (const NoSuchComponent& error) {
    throw UsageMistake(std::string("--component: ") + error.what());
  }
}

int run_map(const MapArguments& arguments) {
  const Stopwatch stopwatch;
  Console console(arguments.loudness.verbosity(), arguments.progress);
  MeshSource source = read_mended(arguments);
  const OrderlyInterruption orderly;  // from here on there may be files to clean up
  MapOutcome outcome = compute(std::move(source), arguments, console);
  tell_stages(arguments, outcome, console);
  tell_frame(arguments, outcome, console);
  const bool writes = outcome.has_map() && outcome.frame_holds() &&
                      (outcome.certificate.bijective() || arguments.keep_folded);
  write_outputs(arguments, outcome, writes, stopwatch, console);
  try {
    tell_result(arguments, outcome, writes, stopwatch, console);
  } catch (const std::bad_alloc&) {  // what is on disk is there all the same
  }
  return outcome.succeeded() ? Ok : NotCertified;
}

}  // namespace

Command declare_map(CLI::App& program) {
  const auto arguments = std::make_shared<MapArguments>();
  const MapDeclaration declared = declare_map_arguments(program, *arguments);
  return {declared.options, [arguments, settle = declared.settle] {
            settle();
            return run_map(*arguments);
          }};
}

}  // namespace sphparam::cli
