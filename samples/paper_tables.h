#pragma once

#include <vector>

#include "paper_trial.h"
#include "report/page.h"

/// What the evaluation says in numbers.
namespace sphparam::samples {

/// Times, the paper's and those of this machine.
void add_timings(sphparam::Page& page, const std::vector<Trial>& trials);

/// Folds by stage, area distortion by iteration, smoothing before and after; each with what the
/// paper claims and on how many meshes it holds here.
void add_findings(sphparam::Page& page, const std::vector<Trial>& trials);

/// All methods × all meshes, and the order that the paper claims for two of them.
void add_all_methods(sphparam::Page& page, const std::vector<Trial>& trials);

}  // namespace sphparam::samples
