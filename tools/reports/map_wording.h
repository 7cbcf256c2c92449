#pragma once

#include <string>

#include "console/console.h"
#include "reports/map_outcome.h"

namespace sphparam::cli {

/// What is odd but harmless, and what the stages did; the paper's method is for those who want to
/// see what each stage does, so it tells without being asked.
void tell_stages(const MapOutcome& outcome, Console& console);

/// What holding the given vertices cost; with -v also what automatic poles cost.
void tell_frame(const MapOutcome& outcome, Console& console);

/// Where the map lies by directions: what --method radial had to move, what --align left.
void tell_directions(const MapOutcome& outcome, Console& console);

/// The verdict in a line, what is wrong with it, and where it was written; empty: nowhere. `when`
/// is said of a file that is not there yet.
void tell_result(const MapOutcome& outcome, const std::string& written, double seconds,
                 Console& console, const std::string& when = "");

}  // namespace sphparam::cli
