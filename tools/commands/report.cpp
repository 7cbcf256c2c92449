// `sphparam report`: maps of a mesh → one page that needs nothing else. Maps that fold are results
// here, not failures: to see them is what the page is for.

#include <algorithm>
#include <array>
#include <filesystem>

#include "arguments/limits.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "console/places.h"
#include "io/inspected_source.h"
#include "number_text.h"
#include "records/comparison_record.h"
#include "reports/told_losses.h"
#include "showcase/report_page.h"
#include "sphparam/image/image_format.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/names.h"
#include "sphparam/version.h"
#include "sphparam/words.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "One page that shows maps: models, charts, figures; it works without network.\n"
    "\n"
    "Examples:\n"
    "  sphparam report statue.sph.ply -o statue.html\n"
    "  sphparam report statue.obj -o statue.html          maps it first\n"
    "  sphparam report one.sph.ply two.sph.ply -o both.html\n"
    "  sphparam report statue.sph.ply sphere.obj -o both.html\n"
    "\n"
    "The mesh is that of the first file; a first file without a map is mapped now. The others are\n"
    "maps of the same mesh: sx sy sz, or a sphere with its triangles, in its order. They stand "
    "side\n"
    "by side, charts on the same scale. The exit status is 0 also where maps fold.\n";

/// What a page is not; any other ending, as that of page.v2, may be part of its name.
bool is_of_other_kind(const std::string& path) {
  constexpr std::array<std::string_view, 4> documents = {".svg", ".csv", ".json", ".pdf"};
  return is_mesh_name(path) || image_format_of(path) ||
         std::ranges::find(documents, extension_of(path)) != documents.end();
}

struct ReportArguments : CommonArguments {
  Words inputs, data;
  std::string sphere, texture, output;
  double crease = -1;  // degrees; below 0: none
  PageOptions options;
  RepairArguments repair;
};

void require_sense(const ReportArguments& arguments) {
  Words inputs = arguments.inputs;
  inputs.insert(inputs.end(), {arguments.sphere, arguments.texture});
  if (std::ranges::count_if(inputs, is_stream) > 1)
    throw UsageMistake("only one file can come from standard input");
  if (is_of_other_kind(arguments.output))
    throw UsageMistake("-o: the page is written as .html, not as " +
                       extension_of(arguments.output));
  check_places({{"--output", arguments.output}, {"--json", arguments.json}});
}

/// The command as it may be shown to others: files without their folders.
std::string command_line(const ReportArguments& arguments) {
  std::string line = "sphparam report";
  const auto add = [&](const std::string& option, const std::string& path) {
    if (path.empty()) return;
    const std::string name = std::filesystem::path(path).filename().string();
    line += option + " " + (name.find(' ') == std::string::npos ? name : "'" + name + "'");
  };
  for (const std::string& input : arguments.inputs) add("", input);
  add(" --sphere", arguments.sphere);
  for (const std::string& file : split_all(arguments.data)) add(" --data", file);
  add(" --texture", arguments.texture);
  if (arguments.crease >= 0) line += " --crease " + shortest(arguments.crease);
  add(" -o", arguments.output);
  const auto& [up, front] = arguments.options.up;
  if (up) line += " --up " + name_of_direction(*up);
  if (front) line += " --front " + name_of_direction(*front);
  if (arguments.options.size != PageOptions{}.size) {
    line += " --size " + std::to_string(arguments.options.size);
  }
  if (!arguments.options.viewer) line += " --no-viewer";
  return line;
}

std::string input_line(const ReportArguments& arguments, const MeshSource& source) {
  const TriangleMesh& mesh = source.file.mesh;
  return display_name(arguments.inputs.front()) + " (" + source.file.format + "), " +
         std::to_string(mesh.vertex_count()) + " vertices, " + std::to_string(mesh.face_count()) +
         " triangles";
}

std::string page_of(const ReportArguments& arguments, const MeshSource& source,
                    const std::vector<PageEntry>& entries, Session& session) {
  PageOptions page = arguments.options;
  page.facts = {{"mesh", input_line(arguments, source)},
                {"command", command_line(arguments)},
                {"program", std::string("sphparam ") + version}};
  page.threads = session.threads();
  page.progress = session.progress();
  page.textures =
      read_shown_textures(source.file, arguments.inputs.front(), arguments.texture, session);
  const ReportOptions options = report_options(source.file, page);
  if (options.viewer_is_missing) {
    session.console.warning("this build has no 3D viewer (" + viewer_folder() +
                            "): the page has pictures instead; CMake's " + viewer_option +
                            " brings it");
  }
  return report_page(entries.front().entry.name, source.file, entries, options);
}

void tell(const PageEntry& page_entry, Console& console) {
  const Entry& entry = page_entry.entry;
  if (!page_entry.warning.empty()) console.warning(entry.name + ": " + page_entry.warning);
  std::string line = entry.name + ": " + short_verdict(entry);
  if (entry.figures) line += ", " + distortion_line(*entry.figures);
  console.say(line);
}

std::vector<PageEntry> load_entries(const ReportArguments& arguments, const MeshSource& source,
                                    Session& session) {
  const auto tell_mapped = [&](const PageEntry& made) {
    session.console.say(made.entry.name + ": carries no map; mapped now (" +
                        name_of(ParameterizeOptions{}.method) + ")");
  };
  return load_page_entries(source,
                           {.others = {arguments.inputs.begin() + 1, arguments.inputs.end()},
                            .sphere = arguments.sphere,
                            .read = input_limits()},
                           {.threads = session.threads(), .progress = session.progress()},
                           tell_mapped);
}

int run_report(ReportArguments& arguments) {
  Session session(arguments);
  require_sense(arguments);
  require_there(arguments.inputs);
  require_there({arguments.sphere, arguments.texture});
  MeshSource source =
      read_mended(arguments.inputs.front(), arguments.repair, session, arguments.data);
  crease(source.file, arguments.inputs.front(), arguments.crease, session);
  require_mappable(source);
  require_area(source);
  session.hold_signals();
  const std::vector<PageEntry> entries = load_entries(arguments, source, session);
  for (const PageEntry& page_entry : entries) tell(page_entry, session.console);
  session.files.add(arguments.output, page_of(arguments, source, entries, session));
  session.add_report([&] {
    std::vector<Entry> compared;
    for (const PageEntry& shown : entries) compared.push_back(shown.entry);
    return to_json(ComparisonRecord{"report", source, compared, session.stopwatch.seconds()});
  });
  session.publish();
  session.console.say("→ " + output_name(arguments.output));
  return Ok;
}

void declare_options(Declaration& command, ReportArguments& arguments) {
  command.texts("FILE", arguments.inputs, " ", "A mesh or .sph.ply, and other maps of it")
      .required()
      .output(arguments.output, "PAGE.html", "The page; - for standard output")
      .sphere(arguments.sphere)
      .crease(arguments.crease)
      .data(arguments.data)
      .text("--texture", arguments.texture, "IMAGE", "The texture of the mesh")
      .up(arguments.options.up)
      .number("--size", arguments.options.size, "N", {64, 8192},
              "Pixels, the width of textures and heat maps, and the most of pictures")
      .flag_off("--no-viewer", arguments.options.viewer,
                "Pictures instead of 3D models: a smaller page without scripts")
      .json(arguments, "All figures");
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace

Command declare_report(CLI::App& program) {
  return make_command(program, "report", summary, declare_options, run_report);
}

}  // namespace sphparam::cli
