#include "sphparam/measure/coordinates_apart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/box.h"

namespace sphparam {

namespace {

/// Sides of the box about the triangles, ascending.
Vector3 sides_of(const TriangleMesh& mesh) {
  const Box box = surface_box(mesh);
  Vector3 sides = box.upper - box.lower;
  std::ranges::sort(sides);
  return sides;
}

/// Two units of which one is so many of the other.
struct UnitRatio {
  double ratio;
  const char* words;
};
constexpr std::array unit_ratios = {UnitRatio{10, "mm and cm"}, UnitRatio{25.4, "mm and inches"},
                                    UnitRatio{100, "cm and m"}, UnitRatio{1000, "mm and m"}};

}  // namespace

std::optional<UnitsApart> units_apart(const TriangleMesh& first, const TriangleMesh& second) {
  constexpr double alike = 0.15, about = 1.25;
  const Vector3 one = sides_of(first), other = sides_of(second);
  if (!(one[2] > 0 && other[2] > 0)) return std::nullopt;
  if ((one / one[2] - other / other[2]).cwiseAbs().maxCoeff() > alike) return std::nullopt;
  const double ratio = std::max(one[2] / other[2], other[2] / one[2]);
  for (const UnitRatio& unit : unit_ratios)
    if (!(ratio < unit.ratio / about || ratio > unit.ratio * about))
      return UnitsApart{one[2] < other[2] ? Side::First : Side::Second, ratio, unit.words};
  return std::nullopt;
}

double far_apart(const TriangleMesh& first, const TriangleMesh& second) {
  const Box one = surface_box(first), other = surface_box(second);
  const Vector3 apart =
      (one.lower - other.upper).cwiseMax(other.lower - one.upper).cwiseMax(Vector3::Zero());
  const double larger =
      std::max((one.upper - one.lower).norm(), (other.upper - other.lower).norm());
  return larger > 0 && apart.norm() > larger ? apart.norm() : 0;
}

}  // namespace sphparam
