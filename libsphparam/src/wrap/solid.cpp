#include "wrap/solid.h"

#include <algorithm>
#include <array>

namespace sphparam {

namespace {

/// Visits what hangs together with a point by points of this mark, and gives them another.
/// Requires: no point of the mark on the lattice's faces, but where it is the start. Returns how
/// many.
std::int64_t flood(const Lattice& lattice, Solid& marks, std::int64_t start, std::uint8_t to) {
  const std::uint8_t from = marks[static_cast<size_t>(start)];
  const auto strides = lattice.strides();
  std::vector<std::int64_t> waiting = {start};
  marks[static_cast<size_t>(start)] = to;
  std::int64_t count = 0;
  while (!waiting.empty()) {
    const std::int64_t p = waiting.back();
    waiting.pop_back();
    ++count;
    for (const std::int64_t stride : strides) {
      const std::int64_t q = p + stride;
      if (marks[static_cast<size_t>(q)] != from) continue;
      marks[static_cast<size_t>(q)] = to;
      waiting.push_back(q);
    }
  }
  return count;
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

Solid surrounded(const Lattice& lattice, const std::vector<float>& field, long& cavities) {
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
  cavities = 0;
  for (size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == Far) {
      flood(lattice, marks, static_cast<std::int64_t>(i), Near);
      ++cavities;
    }
  }
  for (std::uint8_t& mark : marks) mark = mark == Near;
  return marks;
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
