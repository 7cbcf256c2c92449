// `sphparam compare`: one mesh, many methods, one page. Maps that fold are results here, not
// failures: to see them is what the command is for.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "arguments/suggestion.h"
#include "arguments/up_option.h"
#include "commands/command.h"
#include "commands/shown_textures.h"
#include "commands/source.h"
#include "compare/comparison.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "records/comparison_record.h"
#include "sphparam/errors.h"
#include "sphparam/io/connectivity.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/stopwatch.h"
#include "sphparam/words.h"
#include "number_text.h"

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
    "Methods of others run as their authors published them, and nothing is repaired. The exit\n"
    "status is 0 also where they fold.\n";

struct Added {
  std::string name;
  std::string path;
};

struct CompareArguments {
  std::string input;
  std::string folder;
  std::string methods = "all";
  std::vector<std::string> added;
  bool no_pictures = false;
  std::optional<Up> up;
  int size = PictureOptions{}.size;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

AnyMethod parse_method(const std::string& name) {
  if (const std::optional<AnyMethod> method = method_named(name)) return *method;
  std::vector<std::string> words;
  std::string all;
  for (const MethodInfo& info : all_methods()) {
    words.emplace_back(info.name);
    all += std::string(all.empty() ? "" : ", ") + info.name;
  }
  const std::string meant = nearest_word(name, words);
  throw UsageMistake("--methods: no " + name + " among all, " + all +
                     (meant.empty() ? "" : "; did you mean " + meant + "?"));
}

std::vector<AnyMethod> parse_methods(const std::string& text) {
  std::vector<AnyMethod> methods;
  if (text == "all") {
    for (const MethodInfo& info : all_methods()) methods.push_back(info.method);
    return methods;
  }
  for (const std::string& name : CLI::detail::split(text, ',')) {
    methods.push_back(parse_method(name));
    const auto same = std::count(methods.begin(), methods.end(), methods.back());
    if (same > 1) throw UsageMistake("--methods: " + name + " is there twice");
  }
  return methods;
}

/// A name that can be part of a file's name anywhere.
bool is_plain(const std::string& name) {
  return !name.empty() && name.front() != '.' && name.front() != '-' &&
         name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
             "0123456789._-") == std::string::npos;
}

std::vector<Added> parse_added(const CompareArguments& arguments) {
  std::set<std::string> names;
  for (const MethodInfo& info : all_methods()) names.insert(info.name);
  std::vector<Added> added;
  for (const std::string& text : arguments.added) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || !is_plain(text.substr(0, equals))) {
      throw UsageMistake(
          "--add: expected NAME=FILE, the name of letters, digits, dots, - and _, not " + text);
    }
    added.push_back({text.substr(0, equals), text.substr(equals + 1)});
    if (!names.insert(added.back().name).second) {
      throw UsageMistake("--add: the name " + added.back().name + " is taken");
    }
    if (is_stream(arguments.input) && is_stream(added.back().path)) {
      throw UsageMistake("the mesh and --add cannot both come from standard input");
    }
  }
  return added;
}

/// Throws: ReadError when its connectivity is another.
Entry read_entry(const Added& added, const MeshSource& source, const std::string& mesh_name,
                 int threads) {
  const MeshSource sphere = read_source(added.path);
  const std::string where = connectivity_difference(source.file, sphere.file);
  if (!where.empty()) {
    throw ReadError(display_name(added.path), "not a sphere of " + mesh_name + ": " + where);
  }
  const SphereMap map = read_sphere(sphere.file).value_or(SphereMap{sphere.file.mesh.positions});
  return entry_of_map(added.name, display_name(added.path), source.file.mesh, map, threads);
}

void tell(const Entry& entry, Console& console) {
  std::string line = entry.name + ": " + short_verdict(entry);
  if (entry.figures) line += ", " + distortion_line(*entry.figures);
  if (entry.seconds) line += ", " + short_number(*entry.seconds) + " s";
  console.say(line);
  if (!entry.statement.empty()) console.detail("  " + entry.statement);
}

std::vector<Entry> all_entries(const CompareArguments& arguments, const MeshSource& source,
                               const std::vector<AnyMethod>& methods,
                               const std::vector<Added>& added, Console& console) {
  std::vector<Entry> entries;
  // What is given is read first: a wrong file should not cost minutes.
  std::vector<Entry> given;
  for (const Added& one : added) {
    given.push_back(read_entry(one, source, display_name(arguments.input), arguments.threads));
  }
  ParameterizeOptions options{.threads = arguments.threads};
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  for (const AnyMethod method : methods) {
    entries.push_back(entry_of_method(method, source.file.mesh, options));
    tell(entries.back(), console);
  }
  for (Entry& one : given) {
    tell(one, console);
    entries.push_back(std::move(one));
  }
  return entries;
}

void write_folder(const std::string& folder, FolderFiles files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError(folder, error.message());
  PendingFiles pending;
  for (auto& [name, bytes] : files) {
    pending.add((std::filesystem::path(folder) / name).string(), std::move(bytes));
  }
  if (interrupted()) throw Cancelled();
  pending.publish();
}

int run_compare(const CompareArguments& arguments) {
  const Stopwatch stopwatch;
  const std::vector<AnyMethod> methods = parse_methods(arguments.methods);
  const std::vector<Added> added = parse_added(arguments);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const MeshSource source = read_source(arguments.input);
  require_mappable(source);
  const OrderlyInterruption orderly;
  const std::vector<Entry> entries = all_entries(arguments, source, methods, added, console);
  const std::string name = is_stream(arguments.input)
                               ? "standard input"
                               : std::filesystem::path(arguments.input).stem().string();
  PictureOptions look = seen_with_up(direction_of(arguments.up.value_or(up_axis(source.file))));
  look.size = arguments.size;
  look.threads = arguments.threads;
  ComparisonOptions options{.pictures = !arguments.no_pictures, .look = look};
  if (options.pictures) {
    options.textures = shown_textures(source.file, arguments.input, "", arguments.threads, console);
  }
  FolderFiles files = comparison_files(name, source.file, entries, options);
  files.emplace_back("compare.json",
                     to_json(ComparisonRecord{source, entries, stopwatch.seconds()}));
  write_folder(arguments.folder, std::move(files));
  console.say("→ " + (std::filesystem::path(arguments.folder) / "index.html").string());
  return Ok;
}

void add_look(CLI::App& command, CompareArguments& arguments) {
  command.add_flag("--no-pictures", arguments.no_pictures, "Without the spheres: much quicker");
  add_up(command, arguments.up);
  command.add_option("--size", arguments.size, "Pixels, of each side of a picture")
      ->check(between(16, 4096, "16 to 4096"))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

Command declare_compare(CLI::App& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = program.add_subcommand("compare", summary);
  command->add_option("MESH", arguments->input, "A mesh; - for standard input")
      ->type_name(" ")
      ->required();
  command->add_option("-o,--output", arguments->folder, "Where the page goes")
      ->type_name("FOLDER")
      ->required();
  std::string words = "all";
  for (const MethodInfo& info : all_methods()) words += std::string("|") + info.name;
  command
      ->add_option("--methods", arguments->methods,
                   "Those to compare, with commas between; the first is blue in all charts")
      ->type_name(words)
      ->capture_default_str();
  command
      ->add_option("--add", arguments->added,
                   "A map made elsewhere, as --add NAME=FILE; may be given again")
      ->type_name("NAME=FILE")
      ->expected(1)
      ->take_all();
  add_look(*command, *arguments);
  add_threads(*command, arguments->threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_compare(*arguments); }};
}

}  // namespace sphparam::cli
