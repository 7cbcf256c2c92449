// `sphparam compare`: one mesh, many methods, one page. Maps that fold are results here, not
// failures: to see them is what the command is for.

#include <algorithm>
#include <filesystem>
#include <set>

#include "arguments/limits.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "compare/comparison.h"
#include "console/new_folder.h"
#include "console/places.h"
#include "io/inspected_source.h"
#include "number_text.h"
#include "records/comparison_record.h"
#include "sphparam/records/verification_record.h"
#include "sphparam/words.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Map a mesh by several methods and put the maps side by side, on a page.\n"
    "\n"
    "Examples:\n"
    "  sphparam compare statue.obj -o statue/\n"
    "  sphparam compare statue.obj -o statue/ --methods progressive,tangential,hemispheres\n"
    "  sphparam compare statue.obj -o statue/ --methods paper --add freesurfer=lh.sphere.gii\n"
    "\n"
    "Writes index.html with the table, the spheres and the polar charts of the first method "
    "against\n"
    "each other one, and compare.json. A sphere that is added must have the vertices and "
    "triangles\n"
    "of the mesh, in its order; it comes after the methods.\n"
    "Methods of others run as their authors published them, and no map is repaired. The exit\n"
    "status is 0 also where they fold.\n";

struct CompareArguments : CommonArguments {
  std::string input;
  std::string folder;
  std::string methods = "all";
  Words added;
  CompareOptions options;
  RepairArguments repair;
};

Words words_for_methods() {
  Words words = method_names();
  words.insert(words.begin(), "all");
  return words;
}

Words parse_methods(const std::string& text) {
  if (text == "all") return method_names();
  const Words methods = split(text);
  for (const std::string& name : methods) {
    place_among(words_for_methods(), name, "--methods");
    if (std::ranges::count(methods, name) > 1)
      throw UsageMistake("--methods: " + name + " is there twice");
  }
  return methods;
}

/// Names and files of --add.
std::vector<std::pair<std::string, std::string>> parse_added(const CompareArguments& arguments) {
  const Words methods = method_names();
  std::set<std::string> names(methods.begin(), methods.end());
  std::vector<std::pair<std::string, std::string>> added;
  for (const std::string& text : arguments.added) {
    const auto one = name_and_file(text);
    if (!one || !can_name_files(one->first)) {
      throw UsageMistake(
          "--add: expected NAME=FILE, the name of letters, digits, dots, - and _, not " + text);
    }
    if (!names.insert(one->first).second)
      throw UsageMistake("--add: the name " + one->first + " is taken");
    require_one_stream({arguments.input, one->second}, "the mesh and --add");
    added.push_back(*one);
  }
  return added;
}

void tell(const Entry& entry, Console& console) {
  std::string line = entry.name + ": " + short_verdict(entry);
  if (entry.figures) line += ", " + distortion_line(*entry.figures);
  if (entry.seconds) line += ", " + short_number(*entry.seconds) + " s";
  console.say(line);
  if (!entry.statement.empty()) console.detail("  " + entry.statement);
}

void write_files(const std::string& folder, FolderFiles files, Session& session) {
  for (auto& [name, bytes] : files)
    session.files.add((std::filesystem::path(folder) / name).string(), std::move(bytes));
  session.publish();
}

/// Spheres that are none are told before minutes go by.
std::vector<NamedMap> load_added(const std::vector<std::pair<std::string, std::string>>& added,
                                 const MeshSource& source, Session& session) {
  std::vector<NamedMap> maps;
  for (const auto& [name, path] : added) {
    maps.push_back(load_named_map(name, path, source, input_limits(), "sphere"));
    const std::string warning = roundness_warning(maps.back().map);
    if (!warning.empty()) session.console.warning(name + ": " + warning);
  }
  return maps;
}

int run_compare(CompareArguments& arguments) {
  NewFolder folder(arguments.folder);
  Session session(arguments);
  const Words methods = parse_methods(arguments.methods);
  const auto added = parse_added(arguments);
  const MeshSource source = read_mended(arguments.input, arguments.repair, session);
  require_mappable(source);
  require_area(source);
  session.hold_signals();
  CompareOptions options = arguments.options;
  options.threads = session.threads();
  options.progress = session.progress();
  const std::vector<NamedMap> others = load_added(added, source, session);
  const std::vector<Entry> entries =
      make_entries(source.file, methods, others, options,
                   [&](const Entry& entry) { tell(entry, session.console); });
  if (options.pictures)
    options.textures = read_shown_textures(source.file, arguments.input, "", session);
  FolderFiles files = comparison_files(stem_or(arguments.input, "standard input"), source.file,
                                       entries, comparison_options(source.file, options));
  files.emplace_back("compare.json", to_json(ComparisonRecord{"compare", source, entries,
                                                              session.stopwatch.seconds()}));
  folder.make();
  write_files(arguments.folder, std::move(files), session);
  session.console.say("→ " + (std::filesystem::path(arguments.folder) / "index.html").string());
  return Ok;
}

void declare_options(Declaration& command, CompareArguments& arguments) {
  command.input("MESH", arguments.input, "A mesh; - for standard input")
      .output(arguments.folder, "FOLDER", "Where the page goes")
      .text("--methods", arguments.methods, joined(words_for_methods(), "|"),
            "Those to compare, with commas between; the first is blue in all charts")
      .texts("--add", arguments.added, "NAME=FILE",
             "A map made elsewhere, as --add NAME=FILE; may be given again")
      .flag_off("--no-pictures", arguments.options.pictures, "Without the spheres: much quicker")
      .up(arguments.options.up)
      .number("--size", arguments.options.size, "N", {16, 4096},
              "Pixels, of each side of a picture");
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace

Command declare_compare(CLI::App& program) {
  return make_command(program, "compare", summary, declare_options, run_compare);
}

}  // namespace sphparam::cli
