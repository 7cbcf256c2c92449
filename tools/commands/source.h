#pragma once

#include <string>

#include "arguments/input_limits.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam::cli {

/// A mesh within the limits of the command line.
inline MeshSource read_source(const std::string& path) {
  return sphparam::read_source(path, input_limits());
}

}  // namespace sphparam::cli
