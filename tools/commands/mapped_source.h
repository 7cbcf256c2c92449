#pragma once

#include <string>

#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"

namespace sphparam::cli {

/// `load_mapped` within the limits of the command line; what the file loses is told, and so is a
/// map that had to be made, with the λ given.
MappedMesh read_mapped_source(const std::string& path, const std::string& sphere, int threads,
                              Console& console, double lambda = 1);

}  // namespace sphparam::cli
