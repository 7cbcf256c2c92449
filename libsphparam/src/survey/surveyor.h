#pragma once

#include <string>

#include "sphparam/survey/survey.h"

namespace sphparam {

/// What becomes of one file below a folder. Throws: Cancelled.
SurveyedMesh survey_mesh(const std::string& folder, const std::string& name,
                         const SurveyOptions& options);

}  // namespace sphparam
