#pragma once

#include "remesh/limit_surface.h"
#include "remesh/sphere_grid.h"

namespace sphparam::tests {

/// A grid of the sphere as control mesh of a limit surface.
struct LimitSubject {
  const char* name;
  tools::Scheme scheme;

  tools::SphereGrid grid() const { return tools::make_grid(tools::parse_grid(name)); }
};

}  // namespace sphparam::tests
