// The words of steps: what is added to those that say little, and what placeholders stand for.

#include "batch/steps.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "number_text.h"
#include "sphparam/batch/plan.h"

namespace sphparam {

namespace {

/// What a subcommand writes where nobody says so.
struct Subcommand {
  std::string_view name;
  std::string_view option;   // that says where; empty: it needs none
  std::string_view ending;   // empty: it has to be said
  bool leaves_mesh = false;  // that the next step may take
};

constexpr std::array<Subcommand, 16> subcommands = {{{"map", "-o", ".sph.ply", true},
                                                     {"repair", "-o", "_repaired.ply", true},
                                                     {"remesh", "-o", "_remesh.sph.ply", true},
                                                     {"wrap", "-o", "", true},
                                                     {"match", "-o", "", true},
                                                     {"unimage", "-o", "", true},
                                                     {"paint", "-o", "_painted.ply", true},
                                                     {"bake", "-o", "_{map}.png"},
                                                     {"export", "-o", ".glb"},
                                                     {"render", "-o", ".png"},
                                                     {"report", "-o", ".html"},
                                                     {"compare", "-o", "_compare"},
                                                     {"spharm", "--csv", "_spharm.csv"},
                                                     {"info", "", ""},
                                                     {"verify", "", ""},
                                                     {"measure", "", ""}}};

constexpr std::array<std::string_view, 3> not_in_batches = {"batch", "manual", "completion"};

const Subcommand* known(const std::string& name) {
  const auto found = std::ranges::find(subcommands, name, &Subcommand::name);
  return found == subcommands.end() ? nullptr : &*found;
}

bool has_placeholder(const std::string& word, std::string_view name) {
  return std::ranges::count(placeholders_in(word), name, &Placeholder::name) > 0;
}

/// "-o" where the table says "-o": also as --output, with the value behind an equals sign, and with
/// the value glued to it.
bool is_option(const std::string& word, std::string_view option) {
  const auto is = [&](std::string_view name) {
    return word == name || word.starts_with(std::string(name) + "=");
  };
  return is(option) || (option == "-o" && (is("--output") || word.starts_with("-o")));
}

bool has_option(const BatchStep& step, std::string_view option) {
  return std::ranges::any_of(step,
                             [&](const std::string& word) { return is_option(word, option); });
}

/// The value of the option that says where the result goes, which has it now.
std::string written_to(const BatchStep& step, std::string_view option) {
  for (std::size_t i = 0; i < step.size(); ++i) {
    if (!is_option(step[i], option)) continue;
    const bool is_glued = step[i].starts_with("-o") && step[i].size() > 2;  // as in -oNAME
    if (is_glued) return step[i].substr(2);
    const std::size_t equals = step[i].find('=');
    if (equals != std::string::npos) return step[i].substr(equals + 1);
    return i + 1 < step.size() ? step[i + 1] : "";
  }
  return "";
}

/// Does it say what it takes: {input} anywhere, {id} in a word that is no option's value, or the
/// mesh that the steps before left?
bool takes_input(const BatchStep& step, const std::string& mesh) {
  if (step.size() > 1 && !mesh.empty() && step[1] == mesh) return true;
  for (std::size_t i = 1; i < step.size(); ++i) {
    const bool is_value = i > 1 && step[i - 1].starts_with('-');
    if (has_placeholder(step[i], "input")) return true;
    if (!is_value && !step[i].starts_with('-') && has_placeholder(step[i], "id")) return true;
  }
  return false;
}

/// What a step that leaves no mesh of one name has instead, and how the next one may take it: as in
/// "files of its components: {id}_0001.sph.ply is the first". Empty: it leaves one, or none.
std::string several_left_by(const BatchStep& step) {
  if (step.front() == "asset") return "a folder of files: FOLDER/NAME.sph.ply of `-o FOLDER`";
  if (step.front() == "map" && has_option(step, "--all-components"))
    return "a map of each component: {id}_0001.sph.ply of `-o {id}.sph.ply`";
  return "";
}

bool leaves_mesh(const Subcommand& subcommand, const BatchStep& step) {
  const bool is_image = step.front() == "paint" && has_option(step, "--atlas");
  return subcommand.leaves_mesh && !is_image;
}

/// Steps are not joined by pipes: what goes to standard output would be lost in their log.
void require_no_stream(const BatchStep& step) {
  for (const std::string& word : step) {
    const bool is_value = word.starts_with("--") && word.ends_with("=-");
    if (word != "-" && word != "-o-" && !is_value) continue;
    throw BatchInputError(joined(step, " ") + ": " + word +
                          " stands for a stream, which steps of a batch have none of; a name, as "
                          "in `-o {id}.sph.ply` or `--json {id}.json`, is a file of its results");
  }
}

}  // namespace

std::vector<Placeholder> placeholders_in(const std::string& word) {
  std::vector<Placeholder> found;
  for (std::size_t at = word.find('{'); at != std::string::npos; at = word.find('{', at + 1)) {
    const std::size_t end = word.find('}', at);
    if (end == std::string::npos) break;
    found.push_back({at, end + 1 - at, word.substr(at + 1, end - at - 1)});
  }
  return found;
}

bool is_foreign(const std::string& name) { return name == "map" || name == "n"; }

std::vector<BatchStep> complete_steps(std::vector<BatchStep> steps) {
  if (steps.empty()) throw BatchInputError("no step: what is to be done with each shape?");
  std::string mesh = "{input}", several;
  for (BatchStep& step : steps) {
    if (step.empty()) throw BatchInputError("a step without a subcommand: -- twice");
    if (std::ranges::count(not_in_batches, step.front()) > 0)
      throw BatchInputError(step.front() + " cannot be a step of a batch");
    require_no_stream(step);
    const bool takes = takes_input(step, mesh);
    if (!takes && mesh.empty())
      throw BatchInputError(step.front() + ": the step before it leaves " + several +
                            "; its name right behind `" + step.front() +
                            "` says what is taken, and {input} is the shape as it came");
    if (!takes) step.insert(step.begin() + 1, mesh);
    const std::string left = several_left_by(step);
    if (!left.empty()) {
      several = left;
      mesh.clear();
    }
    const Subcommand* const subcommand = known(step.front());
    if (!subcommand) continue;
    const bool says_where = subcommand->option.empty() || has_option(step, subcommand->option);
    if (!says_where && !subcommand->ending.empty()) {
      step.emplace_back(subcommand->option);
      step.push_back("{id}" + std::string(subcommand->ending));
    }
    if (left.empty() && leaves_mesh(*subcommand, step)) mesh = written_to(step, subcommand->option);
  }
  return steps;
}

std::vector<std::string> files_left_by(const std::vector<BatchStep>& steps) {
  std::vector<std::string> files;
  for (const BatchStep& step : steps)
    if (const Subcommand* const subcommand = known(step.front()))
      files.push_back(written_to(step, subcommand->option));
  return files;
}

std::string substituted(const std::string& word, const BatchPlan& plan, const BatchItem& item,
                        bool with_input) {
  std::string result;
  std::size_t from = 0;
  for (const auto& [at, length, name] : placeholders_in(word)) {
    if (at < from) continue;
    const auto column = std::ranges::find(plan.columns, name);
    const bool stays = is_foreign(name) || (name == "input" && !with_input);
    result += word.substr(from, at - from);
    if (stays) {
      result += word.substr(at, length);
    } else if (name == "input" || name == "id") {
      result += name == "id" ? item.id : item.path;
    } else if (column != plan.columns.end()) {
      result += item.values[column - plan.columns.begin()];
    } else {
      std::vector<std::string> names = {"{input}", "{id}"};
      for (const std::string& known_column : plan.columns)
        names.push_back("{" + known_column + "}");
      throw BatchInputError("no {" + name + "} among " + joined(names));
    }
    from = at + length;
  }
  return result + word.substr(from);
}

std::vector<BatchStep> steps_of(const BatchPlan& plan, const BatchItem& item) {
  std::vector<BatchStep> steps = plan.steps;
  for (BatchStep& step : steps) {
    BatchStep words;
    for (const std::string& word : step) words.push_back(substituted(word, plan, item, true));
    step = std::move(words);
  }
  add_options_of_row(steps, plan, item);
  return steps;
}

void add_options_of_row(std::vector<BatchStep>& steps, const BatchPlan& plan,
                        const BatchItem& item) {
  const auto column = std::ranges::find(plan.columns, "options");
  if (column == plan.columns.end()) return;
  for (std::string& word : words_of(item.values[column - plan.columns.begin()]))
    steps.front().push_back(std::move(word));
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  char quote = 0;
  bool inside = false;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\t';
    if (quote == 0 && blank) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else {
      words.back() += c;
    }
  }
  if (quote != 0) throw BatchInputError("options: a quote that does not end in " + text);
  return words;
}

}  // namespace sphparam
