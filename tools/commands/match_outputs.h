#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments/match_arguments.h"
#include "console/session.h"

namespace sphparam::cli {

/// The files that are asked for wait in the session. Returns what each holds, and its name; what
/// they lose is told. `rows`: of B's faces, `rows_in_file`. Throws: WriteError; as `make_morph`.
std::vector<std::pair<std::string, std::string>> add_outputs(
    const MatchArguments& arguments, const Match& match,
    const std::optional<std::vector<long>>& rows, Session& session);

/// Tells of values that are asked for and are not there.
void tell_absent_values(const MatchArguments& arguments, const MappedMesh& second,
                        Session& session);

}  // namespace sphparam::cli
