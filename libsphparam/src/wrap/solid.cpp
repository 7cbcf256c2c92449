#include "wrap/solid.h"

#include <algorithm>
#include <array>

namespace sphparam {

namespace {

/// Gives what hangs together with a point by points of its mark another mark, run by run along x:
/// what waits are runs, of which there are far fewer than points.
class Flood {
 public:
  Flood(const Lattice& lattice, Solid& marks, std::uint8_t from, std::uint8_t to)
      : marks_(marks), from_(from), to_(to) {
    for (size_t k = 0; k < rows_.size(); ++k)
      rows_[k] = lattice.stride(2 * static_cast<int>(k) + 2);
  }

  /// Requires: no point of the mark on the lattice's faces. Returns how many there were.
  std::int64_t run(std::int64_t start) {
    take(start);
    while (!waiting_.empty()) {
      const Run run = waiting_.back();
      waiting_.pop_back();
      for (const std::int64_t row : rows_) {  // x of neighbours there: by 0 or 1 more, or less
        look(run.first + row, run.last + row + 1);
        look(run.first - row - 1, run.last - row);
      }
    }
    return count_;
  }

 private:
  struct Run {
    std::int64_t first, last;  // both of it
  };

  bool is_open(std::int64_t p) const { return marks_[static_cast<size_t>(p)] == from_; }

  void look(std::int64_t first, std::int64_t last) {
    for (std::int64_t p = first; p <= last; ++p)
      if (is_open(p)) p = take(p);
  }

  /// The whole run that a point is in; returns its last.
  std::int64_t take(std::int64_t p) {
    Run run{p, p};
    while (is_open(run.first - 1)) --run.first;
    while (is_open(run.last + 1)) ++run.last;
    std::fill(marks_.begin() + run.first, marks_.begin() + run.last + 1, to_);
    waiting_.push_back(run);
    count_ += run.last - run.first + 1;
    return run.last;
  }

  Solid& marks_;
  const std::uint8_t from_, to_;
  std::array<std::int64_t, 3> rows_{};  // to the next rows along y, z, and both
  std::vector<Run> waiting_;
  std::int64_t count_ = 0;
};

std::int64_t flood(const Lattice& lattice, Solid& marks, std::int64_t start, std::uint8_t to) {
  return Flood(lattice, marks, marks[static_cast<size_t>(start)], to).run(start);
}

template <class Visit>
void for_each_point(const Lattice& lattice, const Visit& visit) {
  std::int64_t i = 0;
  for (int z = 0; z < lattice.points[2]; ++z) {
    for (int y = 0; y < lattice.points[1]; ++y) {
      for (int x = 0; x < lattice.points[0]; ++x, ++i) visit(x, y, z, i);
    }
  }
}

/// How deep a point lies below the lattice's faces.
int depth(const Lattice& lattice, int x, int y, int z) {
  const auto& n = lattice.points;
  return std::min({x, y, z, n[0] - 1 - x, n[1] - 1 - y, n[2] - 1 - z});
}

/// What the corner of a cube adds, with the simplices that it is the least corner of. Bits of the
/// mask: corners of the cube by direction, the least one first.
std::array<std::int8_t, 256> euler_table() {
  std::array<std::int8_t, 256> table{};
  for (int mask = 1; mask < 256; mask += 2) {
    const auto inside = [mask](int corner) { return mask >> corner & 1; };
    int sum = 1;
    for (int a = 1; a < 8; ++a) {
      if (!inside(a)) continue;
      --sum;
      for (int b = a + 1; b < 8; ++b) {
        if ((a & b) != a || !inside(b)) continue;
        ++sum;
        for (int c = b + 1; c < 8; ++c) sum -= (b & c) == b && inside(c);
      }
    }
    table[mask] = static_cast<std::int8_t>(sum);
  }
  return table;
}

}  // namespace

Solid surrounded(const Lattice& lattice, const std::vector<float>& field,
                 std::vector<std::int64_t>& hollows) {
  enum : std::uint8_t { Near = 1, Far = 2, Reached = 0, Margin = 3 };
  Solid marks(field.size());
  for_each_point(lattice, [&](int x, int y, int z, std::int64_t i) {
    marks[static_cast<size_t>(i)] = depth(lattice, x, y, z) == 0        ? Margin
                                    : field[static_cast<size_t>(i)] > 0 ? Far
                                                                        : Near;
  });
  for_each_point(lattice, [&](int x, int y, int z, std::int64_t i) {
    if (depth(lattice, x, y, z) == 1 && marks[static_cast<size_t>(i)] == Far)
      flood(lattice, marks, i, Reached);
  });
  hollows.clear();
  for (size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == Far) {
      hollows.push_back(static_cast<std::int64_t>(i));
      flood(lattice, marks, hollows.back(), Near);
    }
  }
  for (std::uint8_t& mark : marks) mark = mark == Near;
  return marks;
}

double hollow_share(const std::vector<float>& field, const Solid& solid) {
  std::int64_t hollow = 0, all = 0;
  for (size_t i = 0; i < solid.size(); ++i) {
    all += solid[i];
    hollow += solid[i] && field[i] > 0;
  }
  return all == 0 ? 0 : static_cast<double>(hollow) / static_cast<double>(all);
}

std::vector<std::int64_t> parts_of(const Lattice& lattice, const Solid& solid) {
  Solid marks = solid;
  std::vector<std::int64_t> sizes;
  for (size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == 1) sizes.push_back(flood(lattice, marks, static_cast<std::int64_t>(i), 2));
  }
  return sizes;
}

void keep_largest(const Lattice& lattice, Solid& solid) {
  const std::vector<std::int64_t> sizes = parts_of(lattice, solid);
  const auto largest = std::ranges::max_element(sizes) - sizes.begin();
  std::ptrdiff_t part = 0;
  for (size_t i = 0; i < solid.size(); ++i) {
    if (solid[i] != 1) continue;
    flood(lattice, solid, static_cast<std::int64_t>(i), part == largest ? 2 : 0);
    ++part;
  }
  for (std::uint8_t& mark : solid) mark = mark == 2;
}

std::int64_t euler_characteristic(const Lattice& lattice, const Solid& solid) {
  const std::array<std::int8_t, 256> table = euler_table();
  std::array<std::int64_t, 8> corner{};
  for (int c = 1; c < 8; ++c) corner[c] = lattice.stride(c);
  std::int64_t sum = 0;
  for (size_t i = 0; i < solid.size(); ++i) {
    if (!solid[i]) continue;
    int mask = 0;
    for (int c = 0; c < 8; ++c) mask |= solid[i + static_cast<size_t>(corner[c])] << c;
    sum += table[mask];
  }
  return sum;
}

}  // namespace sphparam
