#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sphparam/survey/survey.h"

namespace sphparam {

/// What became of a file as JSON, with its pictures.
std::string record_of(const SurveyedMesh& mesh);

/// The same again; nothing where the text is no such record.
std::optional<SurveyedMesh> surveyed_of(std::string_view record);

}  // namespace sphparam
