// The plan's name is written into both: a task that waits runs what was planned when it was
// submitted, whatever is planned in the meantime.

#include "batch/engines.h"

#include <algorithm>
#include <filesystem>

namespace sphparam {

namespace {

namespace fs = std::filesystem;

/// "/usr/bin/sphparam" where nobody says otherwise.
std::string program_line(const std::string& program) {
  return "sphparam=${SPHPARAM:-" + shell_quoted(program) + "}";
}

/// Inside a string of Python between single quotes.
std::string python_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

/// Between double quotes of a line of #SBATCH, where % begins what Slurm fills in.
std::string sbatch_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c == '%' ? "%%" : std::string(1, c);
  }
  return escaped;
}

/// Is there no record of it, neither of success nor of failure?
bool is_open(const fs::path& folder, const BatchItem& item) {
  std::error_code hidden;
  return !fs::exists(folder / "results" / item.id / "record.json", hidden) &&
         !fs::exists(folder / "failed" / (item.id + ".json"), hidden);
}

}  // namespace

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string slurm_script(const std::string& folder, const BatchPlan& plan,
                         const std::string& program) {
  const std::string tasks = std::to_string(plan.tasks());
  return "#!/bin/sh\n"
         "# " +
         std::to_string(plan.items.size()) + " items, " + std::to_string(plan.chunk) +
         " a task, made by `sphparam batch plan`. Options on the command line of sbatch come\n"
         "# first: sbatch --time=2:00:00 --cpus-per-task=4 --mem-per-cpu=2G array.sbatch\n"
         "#SBATCH --job-name=sphparam-" +
         plan.name.substr(0, 8) +
         "\n"
         "#SBATCH --array=1-" +
         tasks +
         "\n"
         "#SBATCH --cpus-per-task=1\n"
         "#SBATCH --open-mode=append\n"
         "#SBATCH --output=\"" +
         sbatch_escaped(folder) + "/logs/%A_%a.log\"\n" + program_line(program) +
         "\n"
         "exec \"$sphparam\" batch run " +
         shell_quoted(folder) + " --plan " + plan.name +
         " --task \"$SLURM_ARRAY_TASK_ID\" --threads \"${SLURM_CPUS_PER_TASK:-1}\"\n";
}

std::string snakefile(const BatchPlan& plan, const std::string& program) {
  const std::string tasks = std::to_string(plan.tasks());
  return "# " + std::to_string(plan.items.size()) + " items, " + std::to_string(plan.chunk) +
         " a task, made by `sphparam batch plan`.\n"
         "#   snakemake -s Snakefile --cores 16 --keep-going\n"
         "import os\n"
         "\n"
         "workdir: workflow.basedir\n"
         "sphparam = os.environ.get('SPHPARAM', " +
         python_quoted(program) +
         ")\n"
         "\n"
         "rule all:\n"
         "    input: expand('tasks/" +
         plan.name + "/{task}.done', task=range(1, " + tasks +
         " + 1))\n"
         "\n"
         "rule chunk:\n"
         "    output: touch('tasks/" +
         plan.name +
         "/{task}.done')\n"
         "    threads: int(config.get('threads', 1))\n"
         "    shell: '{sphparam:q} batch run . --plan " +
         plan.name + " --task {wildcards.task} --threads {threads}'\n";
}

std::string task_mark(const std::string& folder, const BatchPlan& plan, int task) {
  return (fs::path(folder) / "tasks" / plan.name / (std::to_string(task) + ".done")).string();
}

std::vector<int> tasks_marked_open(const std::string& folder, const BatchPlan& plan) {
  std::vector<int> tasks;
  for (int task = 1; task <= plan.tasks(); ++task) {
    std::error_code hidden;
    if (!fs::exists(task_mark(folder, plan, task), hidden)) continue;
    const auto first = plan.items.begin() + std::ptrdiff_t{task - 1} * plan.chunk;
    const auto last = first + std::min<std::ptrdiff_t>(plan.chunk, plan.items.end() - first);
    if (std::any_of(first, last, [&](const BatchItem& item) { return is_open(folder, item); }))
      tasks.push_back(task);
  }
  return tasks;
}

}  // namespace sphparam
