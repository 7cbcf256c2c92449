// `sphparam batch plan`: shapes and steps → a manifest, and scripts for who runs it.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include "arguments/leading_options.h"
#include "arguments/numbers.h"
#include "batch/record.h"
#include "batch/steps.h"
#include "commands/batch.h"
#include "commands/plan_checks.h"
#include "console/program.h"
#include "io/files/program_path.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "parsed_number.h"
#include "sphparam/batch/plan.h"
#include "sphparam/batch/run.h"
#include "sphparam/batch/status.h"

namespace sphparam::cli {

namespace {

namespace fs = std::filesystem;

constexpr char plan_help[] =
    "Plan a batch: which shapes, which steps, how many of them a task.\n"
    "\n"
    "Examples:\n"
    "  sphparam batch plan meshes/ -o work/ -- map --repair\n"
    "  sphparam batch plan 'scans/*.stl' -o work/ --chunk 50 -- map --quality draft\n"
    "  sphparam batch plan subjects.csv -o work/ -- map --pin {pins}\n"
    "  sphparam batch plan $SUBJECTS_DIR -o work/ --surface pial -- map -- spharm --degree 15\n"
    "  sphparam batch plan meshes/ -o work/ -- map -- remesh --grid ico:5 -- export\n"
    "\n"
    "INPUT is a mesh, a pattern, a list of paths (a line each), a table (.csv, .tsv with a column\n"
    "path; an id, and options of a row where they have a column), or a folder: of meshes, of\n"
    "FreeSurfer subjects, or a BIDS data set. After `--` come the steps as on the command line of\n"
    "sphparam, with `--` between them: {input}, {id} and {COLUMN} stand for what differs. A step\n"
    "that names no file to take takes the mesh of the step before, and writes {id} with its "
    "ending.\n"
    "What is written goes to work/results/ID/; names in steps are relative to that.\n";

struct PlanArguments : CommonArguments {
  Words inputs;
  std::string folder;
  std::string chunk = "auto";
  std::string surface = "white";
};

/// What is found out before anything is planned for thousands.
constexpr std::size_t dry_items = 3;
constexpr double task_seconds = 600;      // long enough to be worth a job, short enough to be lost
constexpr std::size_t most_tasks = 1000;  // Slurm's MaxArraySize is 1001 where nobody changed it
constexpr std::size_t least_tasks = 16;   // or few cores would have all the work
constexpr double least_seconds = 60;      // of a task, or starting tasks would be most of the work

std::vector<BatchStep> given_steps() {
  std::vector<BatchStep> steps;
  for (const std::string& word : taken_steps()) {
    if (word == "--") {
      steps.emplace_back();
    } else {
      steps.back().push_back(word);
    }
  }
  if (steps.empty()) throw UsageMistake("no step: after the inputs `-- map` is wanted, or more");
  return steps;
}

/// The word with the file named from the root, where it names it: alone, behind a sign that joins
/// it to a name, or between commas.
std::string with_whole_path(const std::string& word, const std::string& file) {
  constexpr std::string_view before = "=:,";
  for (std::size_t at = word.find(file); at != std::string::npos; at = word.find(file, at + 1)) {
    const std::size_t end = at + file.size();
    const bool begins = at == 0 || before.find(word[at - 1]) != std::string_view::npos;
    if (begins && (end == word.size() || word[end] == ','))
      return word.substr(0, at) + fs::absolute(file).string() + word.substr(end);
  }
  return word;
}

/// Steps run elsewhere: the files that they read are named from the root, but for what a step of
/// theirs leaves. Their words are those of the first shape; what differs between shapes is a
/// column's business.
std::vector<BatchStep> with_whole_paths(std::vector<BatchStep> steps, const BatchInputs& inputs) {
  const BatchPlan sample{.steps = steps, .columns = inputs.columns};
  const BatchInput& shape = inputs.shapes.front();
  const BatchItem item{.id = shape.id, .path = shape.path, .values = shape.values};
  const std::vector<BatchStep> words = steps_of(sample, item);
  const std::vector<std::string> left = files_left_by(words);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    for (const std::string& file : files_read_by(words[k])) {
      if (std::ranges::count(left, file) > 0) continue;
      for (std::string& word : steps[k]) word = with_whole_path(word, file);
    }
  }
  return steps;
}

/// Values of columns that name files beside the table or here, from the root too.
void complete_values(BatchInputs& inputs) {
  std::error_code hidden;  // a text that is too long for a name is none
  for (BatchInput& shape : inputs.shapes)
    for (std::string& value : shape.values)
      if (!value.empty() && fs::is_regular_file(value, hidden))
        value = fs::absolute(value).string();
}

std::string first_reason(const std::string& folder, const BatchPlan& plan) {
  const BatchStatus status = batch_status(folder, plan);
  return status.failures.empty() ? "" : status.failures.front().reason;
}

/// Some of them as they will run: of small, middle and large ones; what is done is done for good.
/// Is anything left to do? Throws: UsageMistake where the words of the steps make no sense.
bool dry_run(const std::string& folder, const BatchPlan& plan, Session& session) {
  std::vector<std::size_t> order(plan.items.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return plan.items[i].size; });
  BatchRunOptions options;
  for (std::size_t k = 0; k < std::min(dry_items, order.size()); ++k)
    options.only.push_back(order[(2 * k + 1) * order.size() / (2 * dry_items)]);
  std::ranges::sort(options.only);
  options.only.erase(std::unique(options.only.begin(), options.only.end()), options.only.end());
  options.workers = 1;
  options.run_step = [](const BatchStep& words, const BatchStepSetting& step) {
    return run_batch_step(words, step.report, step.threads);
  };
  options.progress = [&](std::size_t ended, std::size_t all) {
    return session.console.progress("dry run",
                                    static_cast<double>(ended) / static_cast<double>(all));
  };
  const BatchRunSummary summary = run_batch(folder, plan, options);
  if (summary.interrupted) throw Cancelled();
  if (summary.first_failure == UsageError)
    throw UsageMistake("the steps make no sense: " + first_reason(folder, plan));
  if (summary.failed > 0)
    session.console.warning("of " + counted(static_cast<long>(summary.items), "item") + " tried, " +
                            std::to_string(summary.failed) +
                            " failed: " + first_reason(folder, plan));
  const BatchStatus status = batch_status(folder, plan);
  const bool all_tried = summary.items == plan.items.size();
  return !all_tried && (status.open() + status.to_retry > 0 || summary.other_program > 0);
}

/// Seconds an item, by what was ever run of it: nothing, where all was done before, is no reason
/// for tasks of one item.
std::optional<double> seconds_of_item(const std::string& folder, const BatchPlan& plan) {
  const BatchStatus status = batch_status(folder, plan);
  if (status.done + status.failed == status.to_retry) return std::nullopt;
  return std::max(1e-3, status.cpu_seconds_an_item);
}

int chunk_for(std::size_t items, double seconds_an_item) {
  const double by_time = std::max(1.0, std::floor(task_seconds / seconds_an_item));
  const double most = std::max(std::floor(static_cast<double>(items) / least_tasks),
                               std::max(1.0, std::floor(least_seconds / seconds_an_item)));
  const double least = std::ceil(static_cast<double>(items) / most_tasks);
  return static_cast<int>(
      std::min(static_cast<double>(items), std::max(least, std::min(by_time, most))));
}

int chunk_of(const std::string& text) {
  const int chunk = parsed<int>(text).value_or(0);
  if (chunk < 1) throw UsageMistake("--chunk: expected auto or a number from 1, not " + text);
  return chunk;
}

/// Has the shape been worked on under that name?
bool has_record(const fs::path& folder, const std::string& id) {
  std::error_code hidden;
  return fs::exists(folder / "results" / id, hidden) ||
         fs::exists(folder / "failed" / (id + ".json"), hidden);
}

/// "a is in_a now": shapes that the plan before called otherwise, and what became of them.
Words renamed_shapes(const std::string& folder, const BatchPlan& plan) try {
  std::map<std::string, std::string> ids;
  for (const BatchItem& item : plan.items) ids.emplace(item.path, item.id);
  Words renamed;
  for (const BatchItem& item : load_plan(folder).items) {
    const auto now = ids.find(item.path);
    if (now != ids.end() && now->second != item.id && has_record(folder, item.id))
      renamed.push_back(item.id + " is " + now->second + " now");
  }
  return renamed;
} catch (const ReadError&) {  // the first plan of its folder
  return {};
}

void tell_renamed(const std::string& folder, const BatchPlan& plan, Console& console) {
  constexpr std::size_t most_told = 5;
  Words renamed = renamed_shapes(folder, plan);
  if (renamed.empty()) return;
  const auto count = static_cast<long>(renamed.size());
  renamed.resize(std::min(renamed.size(), most_told));
  console.warning(counted(count, "shape has", "shapes have") +
                  " another id than in the plan before (" + joined(renamed) +
                  (count > static_cast<long>(most_told) ? ", …" : "") +
                  "), as where others have the same name: what was made under the old one stays, "
                  "and counts no more; a table with the column id keeps ids");
}

/// Of a folder whose name Slurm does not take.
void tell_lost_logs(const std::string& folder, Console& console) {
  if (fs::absolute(folder).string().find('\\') != std::string::npos)
    console.warning(
        "the folder has a backslash in its name, which Slurm takes out of names of "
        "logs: tasks of array.sbatch cannot write theirs");
}

void tell(const BatchPlan& plan, const std::string& folder, std::optional<double> item_seconds,
          bool anything_left, Console& console) {
  console.say(counted(static_cast<long>(plan.items.size()), "item") + " in " +
              counted(plan.tasks(), "task") + " of up to " + std::to_string(plan.chunk) + " → " +
              (fs::path(folder) / ("plan-" + plan.name + ".tsv")).string());
  if (item_seconds) {
    const double all = *item_seconds * static_cast<double>(plan.items.size());
    console.say("  an item takes about " + short_number(*item_seconds) + " s of one core, a task " +
                short_number(*item_seconds * plan.chunk) + " s, all " + short_number(all / 3600) +
                " h");
  }
  if (plan.tasks() > static_cast<int>(most_tasks))
    console.warning(std::to_string(plan.tasks()) +
                    " tasks are more than the 1000 that Slurm takes unless its MaxArraySize is "
                    "raised; --chunk " +
                    std::to_string((plan.items.size() + most_tasks - 1) / most_tasks) +
                    " makes fewer");
  const fs::path work(folder);
  if (!anything_left) {
    console.say("  nothing left to do: all were tried; `sphparam batch status " +
                shell_word(folder) + "` says how they ended");
    return;
  }
  console.say("  sbatch " + shell_word((work / "array.sbatch").string()));
  console.say("  snakemake -s " + shell_word((work / "Snakefile").string()) +
              " --cores all --keep-going");
  console.say("  sphparam batch run " + shell_word(folder));
}

int run_plan(PlanArguments& arguments) try {
  const std::vector<BatchStep> steps = complete_steps(given_steps());
  Session session(arguments);
  BatchInputs inputs = find_batch_inputs(arguments.inputs, {.surface = arguments.surface});
  for (const std::string& note : inputs.notes) session.console.warning(note);
  complete_values(inputs);
  require_outputs_apart(steps, inputs);
  require_results_apart(steps, inputs);
  require_own_scripts(arguments.folder);
  const bool automatic = arguments.chunk == "auto";
  session.hold_signals();
  const std::vector<BatchStep> whole_steps = with_whole_paths(steps, inputs);
  require_sense(whole_steps, inputs);
  BatchPlan plan = make_plan(inputs, {.steps = whole_steps,
                                      .chunk = automatic ? 1 : chunk_of(arguments.chunk),
                                      .threads = arguments.threads,
                                      .progress = session.progress()});
  tell_renamed(arguments.folder, plan, session.console);
  tell_lost_logs(arguments.folder, session.console);
  std::optional<double> item_seconds;
  bool anything_left = true;
  if (automatic) {
    anything_left = dry_run(arguments.folder, plan, session);
    item_seconds = seconds_of_item(arguments.folder, plan);
    plan = with_chunk(std::move(plan), chunk_for(plan.items.size(), item_seconds.value_or(60)));
  }
  save_plan(arguments.folder, plan, program_path().string());
  session.console.clear_progress();
  tell(plan, arguments.folder, item_seconds, anything_left, session.console);
  return Ok;
} catch (const BatchInputError& error) {
  throw UsageMistake(error.what());
} catch (const BatchMachineError& error) {
  print_error(error.what());
  return FileError;
}

void declare_options(Declaration& command, PlanArguments& arguments) {
  command.texts("INPUT", arguments.inputs, " ", "Shapes; then -- and the steps")
      .required()
      .output(arguments.folder, "FOLDER", "Of the batch; made where it is not there")
      .text("--chunk", arguments.chunk, "auto|N",
            "Items a task; auto: ten minutes of work, by a dry run of three items")
      .text("--surface", arguments.surface, "NAME", "Which surface of FreeSurfer and BIDS subjects")
      .threads(arguments)
      .console(arguments);
}

/// Results may lie in folders of their own: who names one wants it made.
void make_folders_for(const std::vector<std::string>& words) {
  for (const std::string& path : files_written_by(words)) {
    if (path.starts_with('/') || path.starts_with("../")) continue;
    std::error_code hidden;  // the step says that it cannot write there
    if (const fs::path folder = fs::path(path).parent_path(); !folder.empty())
      fs::create_directories(folder, hidden);
  }
}

}  // namespace

int run_batch_step(const std::vector<std::string>& words, const std::string& report, int threads) {
  make_folders_for(words);
  return run_command_line(words, {{"--json", report}, {"--threads", std::to_string(threads)}},
                          step_has_no_room);
}

Command declare_batch_plan(CLI::App& program) {
  return make_command(program, "plan", plan_help, declare_options, run_plan);
}

}  // namespace sphparam::cli
