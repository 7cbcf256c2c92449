#pragma once

#include <string>
#include <vector>

#include "sphparam/batch/plan.h"

namespace sphparam {

/// The script for `sbatch`: an array of the plan's tasks. `folder`: the batch's, absolute.
std::string slurm_script(const std::string& folder, const BatchPlan& plan,
                         const std::string& program);

/// The Snakefile: a job a task, which leaves tasks/PLAN/TASK.done.
std::string snakefile(const BatchPlan& plan, const std::string& program);

/// What Snakemake leaves of a task that ended well.
std::string task_mark(const std::string& folder, const BatchPlan& plan, int task);

/// Tasks with such a mark of which an item has no record: it was removed, by hand.
std::vector<int> tasks_marked_open(const std::string& folder, const BatchPlan& plan);

/// A word as shells take it.
std::string shell_quoted(const std::string& text);

}  // namespace sphparam
