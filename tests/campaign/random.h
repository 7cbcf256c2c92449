#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::campaign {

/// Numbers that are the same on every machine: the distributions of <random> are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// 0 … count − 1.
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  int between(int least, int most) { return least + below(most - least + 1); }
  bool chance(double share) { return unit() < share; }
  /// In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double least, double most) { return least + (most - least) * unit(); }
  /// Evenly spread in its logarithm.
  double logarithmic(double least, double most) { return least * std::pow(most / least, unit()); }
  Vector3 in_cube() {
    const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
    return {x, y, z};
  }
  Vector3 direction() {
    for (;;) {
      const Vector3 v = in_cube();
      if (v.squaredNorm() > 0.01 && v.squaredNorm() < 1) return v.normalized();
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace sphparam::campaign
