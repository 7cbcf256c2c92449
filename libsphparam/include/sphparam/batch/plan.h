#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sphparam/batch/inputs.h"
#include "sphparam/progress.h"

namespace sphparam {

/// A step of a batch: a subcommand and its words, with {input}, {id} and {COLUMN} for what differs
/// from shape to shape. Steps run in a folder of their own: names without a folder are results.
using BatchStep = std::vector<std::string>;

/// A shape as it is planned.
struct BatchItem {
  std::string id;
  std::string path;          // absolute
  std::uint64_t size = 0;    // bytes
  std::string input = {};    // hash of the content, see content_hash
  std::string options = {};  // hash of all words that run for it and of the files that they name
  std::vector<std::string> values = {};
};

/// Everything that a task needs to know, and that no later plan changes: a file of its own, named
/// by the hash of its content.
struct BatchPlan {
  std::string name = {};  // sixteen hex digits
  std::vector<BatchStep> steps = {};
  std::vector<std::string> columns = {};
  std::vector<BatchItem> items = {};
  int chunk = 1;  // items a task

  int tasks() const { return static_cast<int>((items.size() + chunk - 1) / chunk); }
};

struct BatchPlanOptions {
  std::vector<BatchStep> steps;
  int chunk = 1;    // at least 1
  int threads = 0;  // that read inputs; 0: all cores
  Progress progress = {};
};

/// Completes steps: one without {input}, and without {id} but in values of options, takes the mesh
/// that the steps before left, the first the input; one that does not say where it writes gets {id}
/// with the ending that its subcommand has (.sph.ply of `map`, .glb of `export`). Throws:
/// BatchInputError for an empty step, or a subcommand that cannot be run in a batch.
std::vector<BatchStep> complete_steps(std::vector<BatchStep> steps);

/// The words that run for an item. Throws: BatchInputError for {NAME} that is neither input nor id
/// nor a column; names that subcommands have themselves, {map} and {n}, stay.
std::vector<BatchStep> steps_of(const BatchPlan& plan, const BatchItem& item);

/// Reads and hashes all inputs. Words that name files are read as they are: they should be
/// absolute. Throws: BatchInputError; ReadError; Cancelled; std::invalid_argument for a chunk below
/// 1, as does `with_chunk`. Cost: reads every input once.
BatchPlan make_plan(const BatchInputs& inputs, const BatchPlanOptions& options);

/// The same with other tasks, and so another name.
BatchPlan with_chunk(BatchPlan plan, int chunk);

/// Puts a plan into the folder of a batch, which is made where it is not there: plan-NAME.tsv,
/// `array.sbatch` for Slurm, `Snakefile` for Snakemake, which both name it, and `plan`, which says
/// that it is the latest. `program`: how `sphparam` is called there. Manifests of earlier plans
/// stay, for tasks that wait; marks of Snakemake go where results are gone. Throws: WriteError.
void save_plan(const std::string& folder, const BatchPlan& plan, const std::string& program);

/// The plan of that name, or where it is empty the latest. Throws: ReadError, also where its bytes
/// are not those that it is named by.
BatchPlan load_plan(const std::string& folder, const std::string& name = "");

}  // namespace sphparam
