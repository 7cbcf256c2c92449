#include "console/mending_advice.h"

#include <algorithm>
#include <filesystem>

#include "io/shell_word.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/names.h"

namespace sphparam::cli {

namespace {

/// How many words an option takes that says how to repair, with its value; 0: it is none.
int words_of_repair(const std::string& word) {
  static const Words flags = {"--repair", "--keep-holes"};
  static const Words with_value = {"--component", "--min-kept",   "--max-hole",
                                   "--weld",      "--max-handle", "--handles"};
  const std::string name = word.substr(0, word.find('='));
  if (std::ranges::find(flags, name) != flags.end()) return 1;
  if (std::ranges::find(with_value, name) == with_value.end()) return 0;
  return name == word ? 2 : 1;
}

Words without_repairs(const Words& words) {
  Words rest;
  for (size_t at = 0; at < words.size();) {
    const int repairs = words_of_repair(words[at]);
    if (repairs == 0) rest.push_back(words[at]);
    at += static_cast<size_t>(std::max(repairs, 1));
  }
  return rest;
}

/// With the options before a `--`, behind which all are names of files.
std::string typed(const Words& words, const std::string& repairs) {
  const auto end_of_options = std::ranges::find(words, "--");
  std::string line = "sphparam", files;
  for (auto word = words.begin(); word != end_of_options; ++word) line += " " + shell_word(*word);
  for (auto word = end_of_options; word != words.end(); ++word) files += " " + shell_word(*word);
  return line + " " + repairs + files;
}

/// Of one component among several: what is counted and chosen is of the file.
std::string advice_for_component(const Words& words, const Words& rest,
                                 const MeshRefusal& refusal) {
  if (rest.size() == words.size())
    return "  --repair mends each component first, as in `" + typed(rest, "--repair") + "`\n";
  const bool helps =
      refusal.trial() && refusal.trial()->can_mend() && refusal.trial()->options.component == 0;
  if (!helps) {
    std::string lines = "  --component N maps one of the components\n  Done already:\n";
    for (const RepairAction& done : refusal.done()) lines += "    " + done.message + "\n";
    return lines;
  }
  return repair_advice(refusal, typed(rest, options_line(refusal.trial()->options)));
}

bool takes_repair(const std::string& subcommand) {
  static const Words all = {"map",   "bake",    "export", "remesh", "report",
                            "paint", "compare", "spharm", "match",  "group"};
  return std::ranges::find(all, subcommand) != all.end();
}

bool has(const Words& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

/// Behind an option or its "="; empty: it is not there.
std::string value_of(const Words& words, const std::string& option) {
  for (size_t at = 0; at < words.size(); ++at) {
    if (words[at].starts_with(option + "=")) return words[at].substr(option.size() + 1);
    if (words[at] == option && at + 1 < words.size()) return words[at + 1];
  }
  return "";
}

/// Whether the map in a file is of a mesh whose holes were kept.
bool keeps_holes(const std::string& map) try {
  return !map.empty() && !is_stream(map) && !fillers_of(read_mesh(map)).empty();
} catch (const std::exception&) {
  return false;
}

}  // namespace

std::string advice_for(const Words& words, const MeshRefusal& refusal) {
  if (words.empty() || !takes_repair(words.front())) return repair_advice(refusal);
  // What other subcommands take of --all-components are maps.
  if (words.front() != "map" && has(words, "--all-components")) return repair_advice(refusal);
  const Words rest = without_repairs(words);
  if (has(rest, "--all-components")) return advice_for_component(words, rest, refusal);
  if (!refusal.trial()) return repair_advice(refusal);
  if (rest.size() == words.size() && keeps_holes(value_of(rest, "--sphere")))
    return "  --sphere has a map of this mesh with its holes kept: `" +
           typed(rest, "--repair --keep-holes") + "`\n";
  return repair_advice(refusal, typed(rest, options_line(refusal.trial()->options)));
}

namespace {

/// What takes all files of a folder, where one was to be read.
std::string advice_for_folder(const Words& words, const std::string& folder) {
  if (words.front() == "group")
    return ": a group takes files, as in `sphparam group " +
           shell_word((std::filesystem::path(folder) / "*.ply").string()) + " -o OUT`";
  return ": `sphparam survey " + shell_file(folder) +
         " -o survey.html` looks at every mesh in it, `sphparam batch plan " + shell_file(folder) +
         " -o WORK -- map` plans the maps of all";
}

}  // namespace

std::string told_refusal(const Words& words, const std::string& refusal) {
  const std::string map = "`sphparam map ";
  const size_t at = refusal.find(map + "--repair");
  const auto is_refused = [&](const std::string& word) {
    return refusal.starts_with(word + ":") || refusal.starts_with(display_name(word) + ":");
  };
  const auto file = std::ranges::find_if(words, is_refused);
  if (refusal.ends_with(": is a directory") && file != words.end())
    return refusal + advice_for_folder(words, *file);
  if (at == std::string::npos || file == words.end()) return refusal;
  std::string told = refusal;
  told.insert(told.find('`', at + 1), " -o mended.sph.ply");
  return told.insert(at + map.size(), shell_file(*file) + " ");
}

}  // namespace sphparam::cli
