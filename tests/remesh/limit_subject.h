#pragma once

#include "sphparam/remesh/limit_surface.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam::tests {

/// A grid of the sphere as control mesh of a limit surface.
struct LimitSubject {
  const char* name;
  sphparam::Scheme scheme;

  sphparam::SphereGrid grid() const { return sphparam::make_grid(sphparam::parse_grid(name)); }
};

}  // namespace sphparam::tests
