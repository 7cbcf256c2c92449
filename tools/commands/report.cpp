// `sphparam report`: maps of a mesh → one page that needs nothing else. Maps that fold are results
// here, not failures: to see them is what the page is for.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "arguments/up_option.h"
#include "commands/command.h"
#include "commands/shown_textures.h"
#include "commands/source.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "image/image_codec.h"
#include "records/comparison_record.h"
#include "reports/told_losses.h"
#include "showcase/report_page.h"
#include "sphparam/errors.h"
#include "sphparam/io/connectivity.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/names.h"
#include "sphparam/stopwatch.h"
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
constexpr std::array<std::string_view, 17> other_kinds = {
    ".ply", ".obj",  ".off", ".stl",  ".gii", ".glb", ".gltf", ".png", ".exr",
    ".jpg", ".jpeg", ".tif", ".tiff", ".svg", ".csv", ".json", ".pdf"};

struct ReportArguments {
  std::vector<std::string> inputs;
  std::string sphere, texture, output, json;
  bool no_viewer = false;
  std::optional<Up> up;
  int size = ReportOptions{}.image_width;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

/// "statue" of "folder/statue.sph.ply"; "standard input" of "-".
std::string name_of_map(const std::string& path) {
  return is_stream(path) ? display_name(path) : stem_of(path);
}

/// Names of maps, told apart where files have the same.
std::string new_name(const std::string& path, const std::vector<PageEntry>& entries) {
  const std::string stem = name_of_map(path);
  std::string name = stem;
  const auto taken = [&] {
    return std::any_of(entries.begin(), entries.end(),
                       [&](const PageEntry& other) { return other.entry.name == name; });
  };
  for (int i = 2; taken(); ++i) name = stem + " (" + std::to_string(i) + ")";
  return name;
}

void require_sense(const ReportArguments& arguments) {
  std::vector<std::string> inputs = arguments.inputs;
  for (const std::string& more : {arguments.sphere, arguments.texture}) {
    if (!more.empty()) inputs.push_back(more);
  }
  if (std::count_if(inputs.begin(), inputs.end(), is_stream) > 1) {
    throw UsageMistake("only one file can come from standard input");
  }
  const std::string kind = extension_of(arguments.output);
  if (std::find(other_kinds.begin(), other_kinds.end(), kind) != other_kinds.end()) {
    throw UsageMistake("-o: the page is written as .html, not as " + kind);
  }
  check_places(inputs, {{"--output", arguments.output}, {"--json", arguments.json}});
}

/// A map that a file holds for the mesh: sx sy sz, or else the file is a sphere of it.
PageEntry read_page_entry(const std::string& path, const std::string& name, const MeshFile& mesh,
                          const MeshFile& file, int threads) {
  const SphereMap map = read_sphere(file).value_or(SphereMap{file.mesh.positions});
  return make_page_entry(entry_of_map(name, display_name(path), mesh.mesh, map, threads),
                         read_provenance(file), mesh, threads);
}

/// Throws: ReadError when its connectivity is another.
PageEntry other_page_entry(const std::string& path, const std::string& name, const MeshFile& mesh,
                           const std::string& mesh_path, int threads) {
  const MeshSource source = read_source(path);
  const std::string difference = connectivity_difference(mesh, source.file);
  if (!difference.empty()) {
    throw ReadError(display_name(path),
                    "not a map of " + display_name(mesh_path) + ": " + difference);
  }
  return read_page_entry(path, name, mesh, source.file, threads);
}

PageEntry new_page_entry(const std::string& name, const MeshFile& file, int threads,
                         Console& console) {
  ParameterizeOptions options{.threads = threads};
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  Entry entry = entry_of_method(options.method, file.mesh, options);
  console.clear_progress();
  console.say(name + ": carries no map; mapped now (" + entry.name + ")");
  Provenance lines = {{"version", version},
                      {"method", entry.name},
                      {"options", options_line(options)},
                      {"verdict", verdict(entry.certificate)}};
  entry.name = name;
  return make_page_entry(std::move(entry), std::move(lines), file, threads);
}

PageEntry first_page_entry(const ReportArguments& arguments, const MeshFile& file,
                           Console& console) {
  const std::string& path = arguments.inputs.front();
  const std::string name = new_name(path, {});
  if (!arguments.sphere.empty()) {
    return other_page_entry(arguments.sphere, name, file, path, arguments.threads);
  }
  if (!read_sphere(file)) return new_page_entry(name, file, arguments.threads, console);
  return read_page_entry(path, name, file, file, arguments.threads);
}

std::vector<PageEntry> all_page_entries(const ReportArguments& arguments, const MeshFile& file,
                                        Console& console) {
  std::vector<PageEntry> entries;
  entries.push_back(first_page_entry(arguments, file, console));
  for (size_t i = 1; i < arguments.inputs.size(); ++i) {
    const std::string& path = arguments.inputs[i];
    entries.push_back(other_page_entry(path, new_name(path, entries), file,
                                       arguments.inputs.front(), arguments.threads));
  }
  return entries;
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
  add(" --texture", arguments.texture);
  add(" -o", arguments.output);
  if (arguments.up == Up::Y) line += " --up y";
  if (arguments.up == Up::Z) line += " --up z";
  if (arguments.size != ReportOptions{}.image_width) {
    line += " --size " + std::to_string(arguments.size);
  }
  if (arguments.no_viewer) line += " --no-viewer";
  return line;
}

std::string input_line(const ReportArguments& arguments, const MeshSource& source) {
  const TriangleMesh& mesh = source.file.mesh;
  return display_name(arguments.inputs.front()) + " (" + source.file.format + "), " +
         std::to_string(mesh.vertex_count()) + " vertices, " + std::to_string(mesh.face_count()) +
         " triangles";
}

ReportOptions page_options(const ReportArguments& arguments, const MeshSource& source,
                           Console& console) {
  ReportOptions options;
  if (!arguments.no_viewer) {
    options.viewer = installed_viewer();
    options.viewer_is_missing = !options.viewer;
    if (!options.viewer) {
      console.warning("this build has no 3D viewer (" + viewer_folder() +
                      "): the page has pictures instead; CMake's " + viewer_option + " brings it");
    }
  }
  const int size = options.look.size;
  options.look = seen_with_up(direction_of(arguments.up.value_or(up_axis(source.file))));
  options.look.size = std::min(size, arguments.size);
  options.image_width = arguments.size;
  options.textures = shown_textures(source.file, arguments.inputs.front(), arguments.texture,
                                    arguments.threads, console);
  options.threads = arguments.threads;
  options.facts = {{"mesh", input_line(arguments, source)},
                   {"command", command_line(arguments)},
                   {"program", std::string("sphparam ") + version}};
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  return options;
}

std::string page_of(const ReportArguments& arguments, const MeshSource& source,
                    const std::vector<PageEntry>& entries, Console& console) {
  return report_page(name_of_map(arguments.inputs.front()), source.file, entries,
                     page_options(arguments, source, console));
}

void tell(const PageEntry& page_entry, Console& console) {
  const Entry& entry = page_entry.entry;
  std::string line = entry.name + ": " + short_verdict(entry);
  if (entry.figures) line += ", " + distortion_line(*entry.figures);
  console.say(line);
}

int run_report(const ReportArguments& arguments) {
  const Stopwatch stopwatch;
  require_sense(arguments);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const MeshSource source = read_source(arguments.inputs.front());
  tell_losses(source, arguments.inputs.front(), console);
  require_mappable(source);
  const OrderlyInterruption orderly;
  const std::vector<PageEntry> entries = all_page_entries(arguments, source.file, console);
  for (const PageEntry& page_entry : entries) tell(page_entry, console);
  std::string html = page_of(arguments, source, entries, console);
  console.clear_progress();
  PendingFiles files;
  files.add(arguments.output, std::move(html));
  if (!arguments.json.empty()) {
    std::vector<Entry> compared;
    for (const PageEntry& shown : entries) compared.push_back(shown.entry);
    files.add(arguments.json, to_json(ComparisonRecord{source, compared, stopwatch.seconds()}));
  }
  if (interrupted()) throw Cancelled();
  files.publish();
  console.say("→ " + output_name(arguments.output));
  return Ok;
}

}  // namespace

Command declare_report(CLI::App& program) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = program.add_subcommand("report", summary);
  command->add_option("FILE", arguments->inputs, "A mesh or .sph.ply, and other maps of it")
      ->type_name(" ")
      ->required();
  command->add_option("-o,--output", arguments->output, "The page; - for standard output")
      ->type_name("PAGE.html")
      ->required();
  command->add_option("--sphere", arguments->sphere, "The first file's map, in a file of its own")
      ->type_name("FILE");
  command->add_option("--texture", arguments->texture, "The texture of the mesh")
      ->type_name("IMAGE");
  add_up(*command, arguments->up);
  command
      ->add_option("--size", arguments->size,
                   "Pixels, the width of textures and heat maps, and the most of pictures")
      ->check(between(64, 8192, "64 to 8192"))
      ->type_name("N")
      ->capture_default_str();
  command->add_flag("--no-viewer", arguments->no_viewer,
                    "Pictures instead of 3D models: a smaller page without scripts");
  add_json(*command, arguments->json, "All figures");
  add_threads(*command, arguments->threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_report(*arguments); }};
}

}  // namespace sphparam::cli
