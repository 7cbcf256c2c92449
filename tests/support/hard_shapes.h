#pragma once

#include <functional>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

/// Shapes that are hard to map well: slivers, elongated features. Closed, genus 0, the same for the
/// same arguments on every machine.
namespace sphparam::tests {

/// Splits edges at `at` of their length, no two of one triangle: `share` of all, a third at most.
/// The triangles that this makes are 1/at times as long as wide. `inside(x)`: only edges with both
/// ends there.
TriangleMesh with_slivers(const TriangleMesh& mesh, double share, double at, unsigned seed,
                          const std::function<bool(const Vector3&)>& inside = {});

/// A ring of a body of revolution about the z axis.
struct ProfilePoint {
  double z, radius;
};

/// Rings of `around` vertices at the points of a profile, from the top down, and a vertex at each
/// end, a radius of the last ring beyond it.
TriangleMesh body_of_revolution(const std::vector<ProfilePoint>& profile, int around);

/// Two unit balls joined by a rod `aspect` times as long as wide: about aspect·around/3 rings of
/// triangles as long as wide.
TriangleMesh dumbbell(double aspect, double rod_radius, int around);

/// A ball with `count` bristles on it, prisms `aspect` times as long as wide, of `rings` rings.
TriangleMesh brush(int ball_level, int count, double aspect, int rings);

}  // namespace sphparam::tests
