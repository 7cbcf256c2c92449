#include <algorithm>
#include <catch2/catch.hpp>

#include "displace/directed_base.h"

using namespace sphparam;

TEST_CASE("directed base: triangles among quads are divided, and the surface stays as it is") {
  const SphereGrid grid = make_grid(parse_grid("uv:9x6"));
  const DirectedBase base(grid, grid.directions, Scheme::CatmullClark);
  for (std::int64_t f = 0; f < base.faces().count(); ++f) CHECK(base.faces().degree(f) == 4);
  const LimitSurface whole(grid.faces, grid.directions, Scheme::CatmullClark);
  // A pole is a corner of the first faces before and after.
  const Vector3 pole = whole.evaluate({0, 0, 0}).position;
  double nearest = 1;
  for (int p = 0; p < base.net().patch_count(); ++p)
    nearest = std::min(nearest, (base.surface().evaluate({p, 0, 0}).position - pole).norm());
  CHECK(nearest < 1e-12);
}
