#pragma once

#include <string>

#include "sphparam/survey/survey.h"

namespace sphparam {

/// `survey_mesh` in a process of its own, which ends with this one. `done`: how much of the survey
/// is, for `progress`. Requires: no other thread. Throws: Cancelled; BatchMachineError where there
/// can be no process.
SurveyedMesh isolated_trial(const std::string& folder, const std::string& name,
                            const SurveyOptions& options, double done);

}  // namespace sphparam
