#include "console/mistakes.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "bake/field_registry.h"
#include "sphparam/io/mesh_reader.h"

namespace sphparam::cli {

namespace {

Words option_names(const CLI::App& app) {
  Words names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// What to type now, for options that have changed their name.
std::string present_spelling(const std::string& command, const std::string& option) {
  static const std::map<std::pair<std::string, std::string>, std::string> renamed = {
      {{"map", "--sphere"},
       "--sphere names a sphere that is read, in other subcommands; --write-sphere FILE writes it"},
      {{"map", "--charts"},
       "a chart is what textures lie on, as in verify --chart; --plots FOLDER writes the "
       "distortion"},
      {{"remesh", "--normals"},
       "--normals names an image that is read, in unimage; --normal-image FILE writes it"},
      {{"export", "--texture"},
       "--texture is for the mesh's own coordinates, in other subcommands; --image IMAGE is an "
       "equirectangular image, as in paint"},
      {{"export", "--textures"}, "--images FOLDER is a folder of `bake`"},
      {{"export", "--normal"}, "--normal-map IMAGE is a normal map"},
      {{"export", "--occlusion"},
       "--occlusion darkens a picture, in render; --occlusion-map IMAGE is ambient occlusion"}};
  const auto now = renamed.find({command, option});
  return now == renamed.end() ? "" : command + ": " + now->second;
}

/// Once a flag in `info` and `verify`: where its file is missing, or it took the place of another.
std::string hint_of_json(const CLI::App& command, const CLI::ParseError& error) {
  const CLI::Option* json = command.get_option_no_throw("--json");
  if (!json) return "";
  const bool missing = std::string_view(error.what()).starts_with("--json:") &&
                       error.get_name() == "ArgumentMismatch";
  const bool swallowed = json->count() > 0 && error.get_name() == "RequiredError";
  return missing || swallowed ? "; --json takes a file, `--json -` is standard output" : "";
}

/// Where an option complains whose name stood for another one once.
std::string hint_of_rename(const CLI::App& command, const CLI::ParseError& error) {
  const std::string message = error.what();
  const std::string now =
      present_spelling(command.get_name(), message.substr(0, message.find(':')));
  return now.empty() ? "" : "; " + now;
}

/// Where a word that nothing takes names an image of `bake`.
std::string hint_of_image(const CLI::App& command, const std::string& word) {
  const Words kinds = names_of(field_makers(), [](const FieldMaker& maker) { return maker.name; });
  const bool is_kind = std::ranges::count(kinds, word.substr(0, word.find(':'))) > 0;
  return command.get_name() == "bake" && is_kind ? "; --map " + word + " bakes it" : "";
}

/// Where an option is of what a batch is to run, and stands before its --.
std::string hint_of_plan(const CLI::App& command, const std::string& option) {
  return command.get_name() == "plan"
             ? "; the subcommand that is to run and its options come last, behind --: `-- map " +
                   option + "`"
             : "";
}

/// Where `map` is given several meshes, as a shell makes them of a pattern.
std::string hint_of_many(const CLI::App& command, const std::string& word) {
  return command.get_name() == "map" && is_mesh_name(word)
             ? "; one mesh is mapped: `sphparam batch plan FILES -o WORK -- map` plans the maps of "
               "many"
             : "";
}

/// The subcommand that was asked for, of a subcommand where that has some; else the program.
const CLI::App& chosen_command(const CLI::App& program) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  return chosen.empty() ? program : chosen_command(*chosen.front());
}

}  // namespace

Words command_names(const CLI::App& program) {
  return names_of(program.get_subcommands({}), &CLI::App::get_name);
}

std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& app = chosen_command(program);
  const bool wants_subcommand = !app.get_subcommands({}).empty();
  // An option that took the word before a stray one says more.
  const auto kind = static_cast<CLI::ExitCodes>(error.get_exit_code());
  const bool nothing_else =
      kind == CLI::ExitCodes::ExtrasError || kind == CLI::ExitCodes::RequiredError;
  bool are_files = false;  // what stands behind --
  for (const std::string& word : app.remaining()) {
    if (!are_files && word == "--") {
      are_files = true;
      continue;
    }
    const bool is_option = !are_files && word.size() > 1 && word.front() == '-';
    if (is_option) {
      const std::string name = word.substr(0, word.find('='));
      const std::string now = present_spelling(app.get_name(), name);
      if (!now.empty()) return now;
      const std::string meant = did_you_mean(name, option_names(app));
      return "unknown option " + name + (meant.empty() ? hint_of_plan(app, name) : meant);
    }
    if (wants_subcommand)
      return "unknown subcommand " + word + did_you_mean(word, command_names(app));
    if (nothing_else)
      return "unexpected argument " + word + hint_of_image(app, word) + hint_of_many(app, word);
  }
  return error.what() + hint_of_json(app, error) + hint_of_rename(app, error);
}

}  // namespace sphparam::cli
