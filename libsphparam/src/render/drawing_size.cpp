#include "render/drawing_size.h"

#include <algorithm>
#include <cmath>

// Halves are taken before differences: that of two large numbers may be none.

namespace sphparam {
namespace {

constexpr double largest_drawn = 0x1p60, smallest_drawn = 0x1p-60;
constexpr int greatest_exponent = 1023;  // extents below the normal numbers ask for more

}  // namespace

TriangleMesh at_drawing_size(TriangleMesh mesh) {
  if (mesh.vertex_count() == 0) return mesh;
  const Vector3 low = mesh.positions.colwise().minCoeff() / 2,
                high = mesh.positions.colwise().maxCoeff() / 2;
  const double half = (high - low).maxCoeff();
  const double largest = mesh.positions.cwiseAbs().maxCoeff();
  if (largest <= largest_drawn && (half >= smallest_drawn || half == 0)) return mesh;
  const Vector3 middle = low + high;
  const double scale =
      half > 0 ? std::ldexp(1.0, std::min(greatest_exponent, -std::ilogb(half))) : 1;
  mesh.positions = (mesh.positions.rowwise() - middle.transpose()) * scale;
  return mesh;
}

}  // namespace sphparam
