// `sphparam repair`: a mesh mended as far as it can be, for this program or for others.

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <optional>

#include "arguments/limits.h"
#include "arguments/mesh_names.h"
#include "arguments/repair_arguments.h"
#include "commands/command.h"
#include "commands/data_files.h"
#include "console/places.h"
#include "io/inspected_source.h"
#include "io/polygons/welding.h"
#include "io/shell_word.h"
#include "reports/told_losses.h"
#include "reports/told_repairs.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/loop_file.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/names.h"
#include "sphparam/records/repair_record.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Mend a mesh and write it, also where it cannot be mapped even then.\n"
    "\n"
    "Examples:\n"
    "  sphparam repair scan.ply -o mended.ply\n"
    "  sphparam repair scan.stl -o mended.obj --repair=duplicates,orientation,unused\n"
    "  sphparam repair brain.vtk -o brain.surf.gii --max-handle 10% --loops loops.obj\n"
    "  sphparam repair parts.obj -o body.ply --component 2 --json repair.json\n"
    "\n"
    "The exit status is 0 when the mesh as written can be mapped, 4 when it cannot: it is written\n"
    "all the same. What was whole is written as it was, but that faces of more corners are cut\n"
    "into triangles. Formats without a place for the mark of fillers get the surface alone.\n";

struct RepairCommandArguments : CommonArguments {
  std::string input, output;
  Words data;
  RepairArguments repair;
};

void require_sensible(const RepairCommandArguments& arguments) {
  require_mesh_name("-o", "the mesh", arguments.output);
  check_places(
      {{"-o", arguments.output}, {"--loops", arguments.repair.loops}, {"--json", arguments.json}});
}

MeshSource read_given(const RepairCommandArguments& arguments, const RepairOptions& wanted,
                      Session& session) {
  ReadOptions options = input_limits();
  options.repeated_corners = true;
  options.non_finite = wanted.non_finite;
  MeshSource source = read_source(arguments.input, options);
  const bool is_beside = has_data_beside(arguments.output);
  attach_data_files(source.file, source.path, arguments.data,
                    is_beside ? MissingValues::Kept : MissingValues::LeftOut, session);
  return source;
}

MeshSource mended_as(const MeshSource& given, const RepairOptions& wanted) try {
  return mended(given, wanted);
} catch (const NoSuchComponent& error) {
  throw UsageMistake(std::string("--component: ") + error.what());
}

/// What would mend it, beyond what was wanted: what is typed begins with the mesh as it was given,
/// whose components are those that are numbered, and of which a weld has the edges.
void tell_what_else(const RepairCommandArguments& arguments, const RepairOptions& wanted,
                    const MeshSource& given) {
  const RepairTrial trial = try_repair_beyond(given, wanted);
  const std::string command = "sphparam repair " + shell_file(arguments.input) + " " +
                              options_line(trial.options) + " -o " + shell_file(arguments.output);
  std::optional<PartsTrial> parts;
  if (trial.parts.refused) parts = try_parts(given);
  std::fputs(repair_advice(trial, arguments.input, command, parts).c_str(), stderr);
}

int run_repair(RepairCommandArguments& arguments) {
  require_sensible(arguments);
  const RepairOptions wanted = all_or_wanted_repairs(arguments.repair);
  Session session(arguments);
  session.console.progress("repair", 0);
  const MeshSource given = read_given(arguments, wanted, session);
  const MeshSource source = mended_as(given, wanted);
  session.hold_signals();
  session.console.clear_progress();
  tell_losses(source, session.console);
  for (const std::string& note : renumberings_among(given.notes)) session.console.say("  " + note);
  tell_repairs(source, session.console);
  std::vector<std::string> losses;
  const MeshFile file = written_as_mended(source, losses);
  std::ranges::copy(add_mesh(session.files, arguments.output, file, {.origin = arguments.input}),
                    std::back_inserter(losses));
  tell_losses(arguments.output, losses, session.console);
  for (std::string& loss : losses) loss = output_name(arguments.output) + ": " + loss;
  RepairRecord record = {source, wanted, losses, {{"mesh", arguments.output}}};
  if (const std::string& loops = arguments.repair.loops; !loops.empty()) {
    session.files.add(loops, serialise_loops(loops, source.handles));
    record.outputs.emplace_back("loops", loops);
  }
  record.seconds = session.stopwatch.seconds();
  session.add_report([&] { return to_json(record); });
  session.publish();
  const std::string line = display_name(arguments.input) + ": " + outcome_line(source.inspection);
  session.console.say(line + " → " + output_name(arguments.output));
  if (is_mappable(source)) return Ok;
  if (!arguments.quiet && !source.inspection.is_sphere()) tell_what_else(arguments, wanted, given);
  if (arguments.quiet) print_error(line);
  return MeshUnusable;
}

void declare_options(Declaration& command, RepairCommandArguments& arguments) {
  command.input("MESH", arguments.input, readable_formats("or") + "; - for standard input")
      .output(arguments.output, "FILE",
              "The mended mesh, in the format of its name; - for standard output")
      .data(arguments.data)
      .json(arguments);
  declare_repair_and_loops(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace

Command declare_repair(CLI::App& program) {
  return make_command(program, "repair", summary, declare_options, run_repair);
}

}  // namespace sphparam::cli
