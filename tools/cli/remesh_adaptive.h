#pragma once

#include "cli/console.h"
#include "cli/mapped_source.h"
#include "cli/remesh_arguments.h"
#include "remesh/sample_density.h"

namespace sphparam::tools {

/// `remesh --adaptive`: relaxes the map of the source for a grid of so many vertices, and certifies
/// it. Says so where that is not possible. Throws: NotCertifiedError, Cancelled.
Adaptation adapt_source(MappedSource& mapped, std::int64_t samples,
                        const RemeshArguments& arguments, Console& console);

}  // namespace sphparam::tools
