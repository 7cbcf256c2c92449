#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Unit vectors that differ by more than roundings do: those of θ and of θ + 2π are one direction.
/// They are numbered from 0, as they come.
class DistinctDirections {
 public:
  /// The number of the one that is there already; nothing: there was none, and x is the next.
  std::optional<int> add(const Vector3& x) {
    const Cell cell = {cell_of(x[0]), cell_of(x[1]), cell_of(x[2])};
    for (int i = 0; i < 27; ++i) {
      const auto found =
          taken_.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (found != taken_.end()) return found->second;
    }
    taken_.emplace(cell, static_cast<int>(taken_.size()));
    return std::nullopt;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr double width = 0x1p-49;  // 8 roundings of a coordinate near 1
  static std::int64_t cell_of(double coordinate) {
    return static_cast<std::int64_t>(std::floor(coordinate / width));
  }

  std::map<Cell, int> taken_;
};

}  // namespace sphparam
