#pragma once

#include "pipeline/map_in_progress.h"

namespace sphparam {

/// Makes the map one-to-one, if it is not: by the first rung that does. Where none does the map is
/// that of the last rung that made one, folds and all, and warnings say why.
void repair(MapInProgress& work);

}  // namespace sphparam
