#pragma once

#include "arguments/map_arguments.h"
#include "console/session.h"
#include "reports/map_outcome.h"

namespace sphparam::cli {

/// Writes the map (if `with_map`), the sphere, plots and report that are asked for, all of them
/// or, where one fails, none. The map and the sphere are read back and must have the verdict of the
/// map in memory. Throws: NotCertifiedError if not; WriteError; Cancelled.
void write_outputs(const MapArguments& arguments, MapOutcome& outcome, bool with_map,
                   Session& session);

/// The same without writing: the files wait in the session. Returns the report, if one is wanted.
std::string add_outputs(const MapArguments& arguments, MapOutcome& outcome, bool with_map,
                        Session& session);

}  // namespace sphparam::cli
