#include "mesh/flat_face.h"

#include <algorithm>
#include <cmath>

namespace sphparam {

bool has_no_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  constexpr double harmless = 1e50;  // and its reciprocal: squares of areas are numbers
  Vector3 one = b / 2 - a / 2, other = c / 2 - a / 2;
  const double size = std::max(one.cwiseAbs().maxCoeff(), other.cwiseAbs().maxCoeff());
  if (!(size > 0)) return true;
  if (size < 1 / harmless || size > harmless) {
    const int exponent = std::ilogb(size);
    for (Vector3* const side : {&one, &other}) {
      for (double& x : *side) x = std::ldexp(x, -exponent);
    }
  }
  return is_flat(Vector3::Zero(), one, other);
}

// The first triangle ends it usually.
bool has_area(const TriangleMesh& mesh) {
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    const auto corner = [&](int k) { return mesh.position(mesh.triangles(f, k)); };
    if (!has_no_area(corner(0), corner(1), corner(2))) return true;
  }
  return false;
}

}  // namespace sphparam
