// Larger and larger distances on a coarse lattice, until points are left that the outside does not
// reach. Each point's own distance from the soup is taken once for all of them.

#include <cmath>

#include "mesh/box.h"
#include "sphparam/wrap/wrap.h"
#include "wrap/distance_field.h"
#include "wrap/solid.h"

namespace sphparam {

namespace {

constexpr double fineness = 96;      // voxels along the longest side of the soup's box
constexpr double widest = 0.25;      // distance, of that side
constexpr double step = 1.15;        // from one distance to the next
constexpr double least_share = 0.1;  // of what is solid, that is farther from the soup

Lattice lattice_with_room(const Box& box, double voxel, double room) {
  const double margin = std::ceil(room / voxel) + 2;
  Lattice lattice = {box.lower - Vector3::Constant(margin * voxel), voxel, {}};
  const Vector3 inside = (box.upper - box.lower) / voxel;
  for (int axis = 0; axis < 3; ++axis)
    lattice.points[axis] = static_cast<int>(std::ceil(inside[axis]) + 2 * margin + 1);
  return lattice;
}

double hollow_share_at(const Lattice& lattice, std::vector<float> field, double distance) {
  for (float& value : field) value -= static_cast<float>(distance / lattice.voxel);
  std::vector<std::int64_t> hollows;
  const Solid solid = surrounded(lattice, field, hollows);
  return hollow_share(field, solid);
}

/// Two digits, not below the number. Requires: it is above 0 and finite.
double rounded_up(double value) {
  double units = 1;
  while (value * units < 10) units *= 10;
  while (value * units >= 100) units /= 10;
  return std::ceil(value * units) / units;
}

}  // namespace

double closing_distance(const TriangleMesh& soup, double distance, int threads) {
  const Box box = surface_box(soup);
  const double voxel = box.longest_side() / fineness, most = widest * box.longest_side();
  const Lattice lattice = lattice_with_room(box, voxel, most);
  const std::vector<float> field = distance_field(soup, lattice, 0, threads, {});
  for (double wider = step * distance; wider <= most; wider *= step)
    if (hollow_share_at(lattice, field, wider) > least_share) return rounded_up(wider + voxel);
  return 0;
}

}  // namespace sphparam
