#pragma once

#include "arguments/map_arguments.h"
#include "commands/map_outcome.h"
#include "console/console.h"
#include "sphparam/stopwatch.h"

namespace sphparam::cli {

/// What is odd but harmless, and what the stages did; the paper's method is for those who want to
/// see what each stage does, so it tells without being asked.
void tell_stages(const MapArguments& arguments, const MapOutcome& outcome, Console& console);

/// What holding the given vertices cost; with -v also what automatic poles cost.
void tell_frame(const MapArguments& arguments, const MapOutcome& outcome, Console& console);

/// The verdict in a line, what is wrong with it, and where it was written.
void tell_result(const MapArguments& arguments, const MapOutcome& outcome, bool written,
                 const Stopwatch& stopwatch, Console& console);

}  // namespace sphparam::cli
