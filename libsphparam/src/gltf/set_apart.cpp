// Cells are sorted, with the places in them; the first place of a cell stays, and every other one
// goes to the nearest cell about it that is free. First are those that make the bounds, then the
// floats decide.

#include "gltf/set_apart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "gltf/format/packing.h"

namespace sphparam {

namespace {

using Place = std::array<float, 3>;
using Cell = std::array<int, 3>;

constexpr int last_cell = 65'535, farthest = 4;  // cells that a place moves at most

std::uint64_t number_of(const Cell& cell) {
  std::uint64_t number = 0;
  for (const int k : cell) number = number << 16U | static_cast<std::uint64_t>(k);
  return number;
}

/// A vertex, its place and the cell of that; along how many axes it may move.
struct Row {
  std::uint64_t cell;
  long free_axes;  // those that make the bounds come first, and stay
  Place place;
  Eigen::Index vertex;

  auto operator<=>(const Row&) const = default;
};

class Lattice {
 public:
  explicit Lattice(FloatRows& positions)
      : positions_(positions),
        least_(positions.colwise().minCoeff()),
        greatest_(positions.colwise().maxCoeff()),
        steps_(quantisation_of(positions)) {}

  long set_apart() {
    const std::vector<Row> rows = sorted_rows();
    if (!any_shared(rows)) return 0;
    for (const Row& row : rows) taken_.insert(row.cell);
    long left = 0;
    for (auto at = rows.begin(); at != rows.end();) {
      const auto end =
          std::find_if(at, rows.end(), [&](const Row& row) { return row.place != at->place; });
      const bool shared = at != rows.begin() && (at - 1)->cell == at->cell;
      if (shared && !move({at, end})) ++left;
      at = end;
    }
    return left;
  }

 private:
  /// As `pack_quantised` has it.
  int cell_along(int k, float number) const {
    const double steps = (static_cast<double>(number) - steps_.offset[k]) / steps_.scale;
    return static_cast<int>(std::clamp(std::round(steps), 0.0, static_cast<double>(last_cell)));
  }

  Cell cell_of(const Place& place) const {
    return {cell_along(0, place[0]), cell_along(1, place[1]), cell_along(2, place[2])};
  }

  std::vector<Row> sorted_rows() const {
    std::vector<Row> rows;
    rows.reserve(static_cast<std::size_t>(positions_.rows()));
    for (Eigen::Index v = 0; v < positions_.rows(); ++v) {
      // −0 and 0 are one place.
      const Place place = {positions_(v, 0) + 0.0F, positions_(v, 1) + 0.0F,
                           positions_(v, 2) + 0.0F};
      rows.push_back({number_of(cell_of(place)), free_axes(place), place, v});
    }
    std::ranges::sort(rows);
    return rows;
  }

  static bool any_shared(const std::vector<Row>& rows) {
    return std::ranges::adjacent_find(rows, [](const Row& a, const Row& b) {
             return a.cell == b.cell && a.place != b.place;
           }) != rows.end();
  }

  /// The place in another cell; what stays along an axis stays exactly, as what makes the bounds.
  Place moved(const Place& place, const Cell& from, const Cell& to) const {
    Place result = place;
    for (std::size_t k = 0; k < 3; ++k) {
      if (to[k] == from[k]) continue;
      const auto axis = static_cast<Eigen::Index>(k);
      const auto centre = static_cast<float>(steps_.offset[axis] + steps_.scale * to[k]);
      result[k] = std::clamp(centre, least_[axis], greatest_[axis]);
    }
    return result;
  }

  bool makes_bounds(const Place& place, std::size_t k) const {
    const auto axis = static_cast<Eigen::Index>(k);
    return place[k] == least_[axis] || place[k] == greatest_[axis];
  }

  long free_axes(const Place& place) const {
    long count = 0;
    for (std::size_t k = 0; k < 3; ++k) count += !makes_bounds(place, k);
    return count;
  }

  /// Whether a place may go there: free, within the lattice, and hit by the numbers of a float.
  bool is_open(const Place& place, const Cell& from, const Cell& to) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (to[k] < 0 || to[k] > last_cell) return false;
      if (to[k] != from[k] && makes_bounds(place, k)) return false;
    }
    return !taken_.contains(number_of(to)) && cell_of(moved(place, from, to)) == to;
  }

  double distance(const Place& place, const Cell& cell) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double steps =
          (place[k] - steps_.offset[static_cast<Eigen::Index>(k)]) / steps_.scale - cell[k];
      sum += steps * steps;
    }
    return sum;
  }

  /// The nearest open cell among those `far` cells off along some axis; nothing: there is none.
  std::optional<Cell> nearest_open(const Place& place, const Cell& from, int far) const {
    std::optional<Cell> best;
    double least = std::numeric_limits<double>::infinity();
    for (int x = -far; x <= far; ++x)
      for (int y = -far; y <= far; ++y)
        for (int z = -far; z <= far; ++z) {
          const Cell to = {from[0] + x, from[1] + y, from[2] + z};
          const double off = distance(place, to);
          const bool is_of_shell = std::max({std::abs(x), std::abs(y), std::abs(z)}) == far;
          if (!is_of_shell || off >= least || !is_open(place, from, to)) continue;
          least = off;
          best = to;
        }
    return best;
  }

  /// The copies of a place, to an open cell near it. False: there is none.
  bool move(std::span<const Row> copies) {
    const Place& place = copies.front().place;
    const Cell from = cell_of(place);
    std::optional<Cell> to;
    for (int far = 1; far <= farthest && !to; ++far) to = nearest_open(place, from, far);
    if (!to) return false;
    taken_.insert(number_of(*to));
    const Place now = moved(place, from, *to);
    for (const Row& row : copies) positions_.row(row.vertex) << now[0], now[1], now[2];
    return true;
  }

  FloatRows& positions_;
  Eigen::RowVector3f least_, greatest_;
  Quantisation steps_;
  std::unordered_set<std::uint64_t> taken_;
};

}  // namespace

long set_apart(FloatRows& positions) {
  return positions.rows() == 0 ? 0 : Lattice(positions).set_apart();
}

}  // namespace sphparam
