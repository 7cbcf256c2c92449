#pragma once

#include <array>
#include <vector>

#include "embedding/energy/triangle_packs.h"
#include "sphere/solid_angle.h"

namespace sphparam {

/// Triangles in packs as they come; lanes left over in the last pack repeat the last triangle.
/// Their corners are numbers of points of the caller's.
class PackedTriangles {
 public:
  void add(const RestTriangle& rest, const std::array<Vertex, 3>& corners) {
    const int lane = count_ % pack_width;
    if (lane == 0) packs_.emplace_back();
    for (int l = lane; l < pack_width; ++l) fill_lane(rest, corners, l, packs_.back());
    ++count_;
  }

  int count() const { return count_; }
  Vertex corner(int triangle, int k) const {
    return packs_[static_cast<size_t>(triangle / pack_width)].corner[k][triangle % pack_width];
  }
  const std::vector<TrianglePack>& packs() const { return packs_; }

  /// As `guarded_energy` of all.
  double energy(const std::vector<ImagePoint>& points, const DistortionEnergy& energy) const {
    return guarded_energy(packs_.data(), count_, points.data(), energy);
  }

  /// Of all together.
  double solid_angle(const std::vector<ImagePoint>& points) const {
    double sum = 0;
    for (int t = 0; t < count_; ++t) {
      const auto at_corner = [&](int k) {
        return points[static_cast<size_t>(corner(t, k))].vector();
      };
      sum += sphparam::solid_angle(at_corner(0), at_corner(1), at_corner(2));
    }
    return sum;
  }

 private:
  std::vector<TrianglePack> packs_;
  int count_ = 0;
};

}  // namespace sphparam
