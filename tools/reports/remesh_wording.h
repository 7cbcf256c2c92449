#pragma once

#include "console/console.h"
#include "sphparam/records/remesh_record.h"

namespace sphparam::cli {

/// What was made, what may be wrong with it, and with -v how long its parts took.
void tell(const RemeshRecord& record, Console& console);

}  // namespace sphparam::cli
