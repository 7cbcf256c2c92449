// `sphparam info`: what a file holds, and everything that is wrong with it.

#include <optional>

#include "arguments/limits.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "console/places.h"
#include "io/inspected_source.h"
#include "sphparam/io/coarse_coordinates.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/records/data_record.h"
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
    "  sphparam info lh.aparc.annot\n"
    "\n"
    "Of a file of numbers a vertex it says what it holds.\n"
    "The exit status is 0 when the mesh can be mapped to a sphere, 4 when it cannot.\n";

struct InfoArguments : CommonArguments {
  std::string input;
  bool crossings = true;
};

/// A file of numbers a vertex; nothing where it is none.
std::optional<VertexData> read_data(const std::string& path) try {
  if (is_stream(path)) return std::nullopt;
  return read_vertex_data(path, any_vertices, input_limits());
} catch (const ReadError&) {
  return std::nullopt;
}

template <class Record>
void publish(const Record& record, const InfoArguments& arguments, Session& session) {
  session.console.clear_progress();
  session.add_report([&] { return to_json(record); });
  if (!is_stream(arguments.json) && !arguments.quiet) session.files.add("-", to_text(record));
  session.publish();
}

/// It is told what it is, and that it is no mesh.
int tell_data(const VertexData& data, const InfoArguments& arguments, Session& session) {
  publish(DataRecord{data, arguments.input, session.stopwatch.seconds()}, arguments, session);
  if (arguments.quiet) print_error(display_name(arguments.input) + ": this is no mesh");
  return MeshUnusable;
}

std::optional<SelfCrossings> looked_for_crossings(const MeshSource& source,
                                                  const InfoArguments& arguments,
                                                  Session& session) {
  if (!arguments.crossings) return std::nullopt;
  return crossings_of(source.file, session.threads(), session.progress());
}

int tell_mesh(const MeshSource& source, const InfoArguments& arguments, Session& session) {
  for (const std::string& coarse : coarse_coordinates_among(source.notes))
    session.console.warning(display_name(source.path) + ": " + coarse);
  InspectionRecord record = {.source = source};
  if (!source.inspection.is_sphere()) record.repair = try_repair(source);
  if (record.repair && record.repair->parts.refused) record.parts = try_parts(source);
  record.crossings = looked_for_crossings(source, arguments, session);
  record.seconds = session.stopwatch.seconds();
  publish(record, arguments, session);
  if (is_mappable(source)) return Ok;
  if (arguments.quiet)
    print_error(display_name(arguments.input) + (source.inspection.is_sphere()
                                                     ? ": this mesh has no area"
                                                     : ": this is not a closed genus-0 mesh"));
  return MeshUnusable;
}

int run_info(InfoArguments& arguments) {
  Session session(arguments);
  require_report_place(arguments.json);
  session.console.progress("inspection", 0);
  std::optional<MeshSource> source;
  try {
    source = read_source(arguments.input);
  } catch (const ReadError&) {
    const std::optional<VertexData> data = read_data(arguments.input);
    if (!data) throw;
    return tell_data(*data, arguments, session);
  }
  return tell_mesh(*source, arguments, session);
}

void declare_options(Declaration& command, InfoArguments& arguments) {
  command.input("MESH", arguments.input, readable_formats("or") + "; - for standard input")
      .flag_off("--no-crossings", arguments.crossings,
                "Triangles that cross in space are not looked for: much quicker")
      .json(arguments)
      .threads(arguments)
      .console(arguments);
}

}  // namespace

Command declare_info(CLI::App& program) {
  return make_command(program, "info", summary, declare_options, run_info);
}

}  // namespace sphparam::cli
