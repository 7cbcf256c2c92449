#pragma once

#include "cli/console.h"
#include "cli/map_arguments.h"
#include "cli/map_outcome.h"
#include "sphparam/stopwatch.h"

namespace sphparam::tools {

/// Writes the map (if `with_map`), the sphere, charts and report that are asked for, all of them
/// or, where one fails, none. The map and the sphere are read back and must have the verdict of the
/// map in memory. Throws: NotCertifiedError if not; WriteError; Cancelled.
void write_outputs(const MapArguments& arguments, MapOutcome& outcome, bool with_map,
                   const Stopwatch& stopwatch, Console& console);

}  // namespace sphparam::tools
