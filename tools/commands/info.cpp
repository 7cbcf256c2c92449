// `sphparam info`: what a file holds, and everything that is wrong with it.

#include "commands/command.h"
#include "commands/sources.h"
#include "console/places.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/records/inspection_record.h"

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

struct InfoArguments : CommonArguments {
  std::string input;
};

int run_info(InfoArguments& arguments) {
  Session session(arguments);
  require_report_place(arguments.json);
  session.console.progress("inspection", 0);
  const MeshSource source = read_source(arguments.input);
  InspectionRecord record = {.source = source};
  if (!source.inspection.is_sphere()) record.repair = try_repair(source);
  record.seconds = session.stopwatch.seconds();
  session.console.clear_progress();
  session.add_report([&] { return to_json(record); });
  if (!is_stream(arguments.json) && !arguments.quiet) session.files.add("-", to_text(record));
  session.publish();
  if (source.inspection.is_sphere()) return Ok;
  if (arguments.quiet)
    print_error(display_name(arguments.input) + ": this is not a closed genus-0 mesh");
  return MeshUnusable;
}

void declare_options(Declaration& command, InfoArguments& arguments) {
  command.input("MESH", arguments.input, readable_formats("or") + "; - for standard input")
      .json(arguments)
      .console(arguments);
}

}  // namespace

Command declare_info(CLI::App& program) {
  return make_command(program, "info", summary, declare_options, run_info);
}

}  // namespace sphparam::cli
