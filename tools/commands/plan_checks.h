#pragma once

#include <string>
#include <vector>

#include "sphparam/batch/inputs.h"
#include "sphparam/batch/plan.h"

namespace sphparam::cli {

// Of steps that are complete, and shapes of which there is one at least. All throw UsageMistake.

/// One file of two shapes would be written by all of them, over and over.
void require_outputs_apart(const std::vector<BatchStep>& steps, const BatchInputs& inputs);

/// Of two steps that write one file the second would take away what the first one left.
void require_results_apart(const std::vector<BatchStep>& steps, const BatchInputs& inputs);

/// Words that only the run of a subcommand looks at, which it does before it reads a mesh: each
/// step is run for a shape that is nowhere.
void require_sense(const std::vector<BatchStep>& steps, const BatchInputs& inputs);

/// Files in the batch's folder that are named like its scripts are people's own.
void require_own_scripts(const std::string& folder);

}  // namespace sphparam::cli
