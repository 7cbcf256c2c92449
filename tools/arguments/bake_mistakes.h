#pragma once

#include "console/exit_codes.h"
#include "sphparam/bake/bake.h"

namespace sphparam::cli {

// The library's complaints about a bake, in the words of the command line.

/// With the option that sets it.
UsageMistake as_mistake(const BakeSettingError& error);

/// Before the mesh is read. Throws: UsageMistake.
void require_possible(const BakeRequest& image, const BakeSettings& settings);

/// Of the mesh that was read.
UsageMistake as_mistake(const FieldError& error, const BakeSettings& settings);
UsageMistake as_mistake(const OtherSphereError& error, const MappedMesh& source,
                        const BakeSettings& settings);

}  // namespace sphparam::cli
