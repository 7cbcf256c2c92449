#pragma once

#include <functional>
#include <string_view>

#include "sphparam/errors.h"

namespace sphparam {

/// Told the stage and how much of it is done (0 to 1); returns false to cancel. May be empty.
/// Called by any thread that works for the caller, one call at a time; never after the call ends.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Throws: Cancelled, if the callback says so.
inline void report(const Progress& progress, std::string_view stage, double fraction) {
  if (progress && !progress(stage, fraction)) throw Cancelled();
}

}  // namespace sphparam
