// `sphparam batch status`, `retry`, `table` and `report`: what became of a batch, from its files.

#include <algorithm>
#include <filesystem>

#include "arguments/mesh_names.h"
#include "arguments/numbers.h"
#include "commands/batch.h"
#include "console/places.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "sphparam/batch/results.h"
#include "sphparam/batch/status.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace {

constexpr char status_summary[] =
    "Say how far a batch is, and why items failed.\n"
    "\n"
    "Examples:\n"
    "  sphparam batch status work/\n"
    "  sphparam batch status work/ --json - -q\n"
    "\n"
    "It reads the files of the batch alone, and may be asked while it runs.\n";

constexpr char retry_summary[] =
    "Have failed items tried again by the next run.\n"
    "\n"
    "Examples:\n"
    "  sphparam batch retry work/               all that failed\n"
    "  sphparam batch retry work/ --code 1,137          those out of memory, or killed\n"
    "  sphparam batch retry work/ --id sub-17\n";

constexpr char table_summary[] =
    "Write one table of all shapes, a row each.\n"
    "\n"
    "Examples:\n"
    "  sphparam batch table work/ -o all.csv\n"
    "\n"
    "Columns are the figures that the steps tell with --json, as map.distortion.mean_abs_ln_area;\n"
    "what runs took comes last.\n";

constexpr char report_summary[] =
    "Write one page of all shapes: pictures, verdicts, distortion, outliers first.\n"
    "\n"
    "Examples:\n"
    "  sphparam batch report work/ -o work/all.html\n"
    "\n"
    "Pictures stay in the folder of the batch: the page is to be moved with it.\n";

struct ResultArguments : CommonArguments {
  std::string folder, plan, output, title;
  std::vector<int> codes;
  Words ids;
};

/// Runs, and pages to come, go by these: what replaced one would be the end of the batch.
void require_not_of_batch(const std::string& option, const std::string& folder,
                          const std::string& output) {
  static const Words folders = {"results", "failed", "staging", "logs", "pictures"},
                     files = {"plan", "array.sbatch", "Snakefile"};
  namespace fs = std::filesystem;
  if (output.empty() || is_stream(output)) return;
  std::error_code hidden;
  const fs::path place = fs::weakly_canonical(fs::absolute(output, hidden), hidden)
                             .lexically_relative(fs::canonical(folder, hidden));
  const std::string first = place.empty() ? "" : place.begin()->string();
  const bool is_inside = std::ranges::count(folders, first) > 0 && place != first;
  const bool is_own = std::ranges::count(files, first) > 0 ||
                      (first.starts_with("plan-") && first.ends_with(".tsv"));
  if (is_inside || (is_own && place == first))
    throw UsageMistake(
        option + ": " + output + " is a file of the batch itself; another name, as " +
        (fs::path(folder) / ("all" + fs::path(output).extension().string())).string() +
        ", leaves it whole");
}

/// "1,137"
bool add_codes(const std::string& text, std::vector<int>& codes) {
  for (const std::string& word : split(text)) {
    const Range<int> range{1, 255};
    if (!complaint_of_number(word, range).empty()) return false;
    codes.push_back(std::stoi(word));
  }
  return true;
}

int run_status(ResultArguments& arguments) {
  Session session(arguments);
  require_not_of_batch("--json", arguments.folder, arguments.json);
  require_report_place(arguments.json);
  const BatchPlan plan = load_plan(arguments.folder, arguments.plan);
  const BatchStatus status = batch_status(arguments.folder, plan, arguments.threads);
  session.add_report([&] { return to_json(status); });
  if (!is_stream(arguments.json) && !arguments.quiet) session.files.add("-", to_text(status));
  session.publish();
  return Ok;
}

int run_retry(ResultArguments& arguments) try {
  Session session(arguments);
  const BatchPlan plan = load_plan(arguments.folder, arguments.plan);
  const BatchRetry retry =
      retry_batch(arguments.folder, plan, {.codes = arguments.codes, .ids = arguments.ids});
  session.console.say(counted(static_cast<long>(retry.items), "item") + " in " +
                      counted(std::ssize(retry.tasks), "task") + " will be tried again" +
                      (retry.tasks.empty() ? "" : ":"));
  if (retry.tasks.empty()) return Ok;
  const std::filesystem::path work(arguments.folder);
  session.console.say("  sbatch --array=" + ranges_of(retry.tasks) + " " +
                      shell_word((work / "array.sbatch").string()));
  session.console.say("  snakemake -s " + shell_word((work / "Snakefile").string()) +
                      " --cores all --keep-going");
  session.console.say("  sphparam batch run " + shell_word(arguments.folder));
  return Ok;
} catch (const BatchInputError& error) {
  throw UsageMistake(error.what());
}

int run_table(ResultArguments& arguments) {
  const char separator = table_separator("-o", arguments.output);
  Session session(arguments);
  require_not_of_batch("-o", arguments.folder, arguments.output);
  check_places({{"-o", arguments.output}});
  const BatchPlan plan = load_plan(arguments.folder, arguments.plan);
  session.files.add(arguments.output,
                    batch_table(arguments.folder, plan, arguments.threads, separator));
  session.publish();
  session.console.say(counted(static_cast<long>(plan.items.size()), "row") + " → " +
                      output_name(arguments.output));
  return Ok;
}

int run_report(ResultArguments& arguments) {
  Session session(arguments);
  require_not_of_batch("-o", arguments.folder, arguments.output);
  check_places({{"-o", arguments.output}});
  const BatchPlan plan = load_plan(arguments.folder, arguments.plan);
  const std::string page_folder =
      is_stream(arguments.output)
          ? "."
          : std::filesystem::absolute(arguments.output).parent_path().string();
  session.files.add(arguments.output, batch_page(arguments.folder, plan,
                                                 {.page_folder = page_folder,
                                                  .title = arguments.title,
                                                  .threads = arguments.threads}));
  session.publish();
  session.console.say(counted(static_cast<long>(plan.items.size()), "shape") + " → " +
                      output_name(arguments.output));
  return Ok;
}

Declaration& declare_batch_of(Declaration& command, ResultArguments& arguments) {
  return command.input("FOLDER", arguments.folder, "The batch")
      .text("--plan", arguments.plan, "NAME", "Another plan than the latest");
}

void declare_status_options(Declaration& command, ResultArguments& arguments) {
  declare_batch_of(command, arguments).json(arguments).threads(arguments).console(arguments);
}

void declare_retry_options(Declaration& command, ResultArguments& arguments) {
  declare_batch_of(command, arguments)
      .parsed(
          "--code", "N", [&](const std::string& text) { return add_codes(text, arguments.codes); },
          "expected exit codes as in 1 or 1,137, not ",
          "Those that ended with this exit code; 128 + N: killed by signal N")
      .texts("--id", arguments.ids, "ID", "This item")
      .console(arguments);
}

void declare_table_options(Declaration& command, ResultArguments& arguments) {
  declare_batch_of(command, arguments)
      .output(arguments.output, "FILE.csv", "The table, or .tsv; - for standard output")
      .threads(arguments)
      .console(arguments);
}

void declare_report_options(Declaration& command, ResultArguments& arguments) {
  declare_batch_of(command, arguments)
      .output(arguments.output, "PAGE.html", "The page; - for standard output")
      .text("--title", arguments.title, "TEXT", "Its title")
      .threads(arguments)
      .console(arguments);
}

}  // namespace

Command declare_batch_status(CLI::App& program) {
  return make_command(program, "status", status_summary, declare_status_options, run_status);
}
Command declare_batch_retry(CLI::App& program) {
  return make_command(program, "retry", retry_summary, declare_retry_options, run_retry);
}
Command declare_batch_table(CLI::App& program) {
  return make_command(program, "table", table_summary, declare_table_options, run_table);
}
Command declare_batch_report(CLI::App& program) {
  return make_command(program, "report", report_summary, declare_report_options, run_report);
}

}  // namespace sphparam::cli
