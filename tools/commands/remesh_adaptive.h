#pragma once

#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"
#include "arguments/remesh_arguments.h"
#include "remesh/sample_density.h"

namespace sphparam::cli {

/// `remesh --adaptive`: relaxes the map of the source for a grid of so many vertices, and certifies
/// it. Says so where that is not possible. Throws: NotCertifiedError, Cancelled.
Adaptation adapt_source(MappedMesh& mapped, std::int64_t samples,
                        const RemeshArguments& arguments, Console& console);

}  // namespace sphparam::cli
