#include "embedding/ring_packs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sphparam/parallel.h"

// The energy of one triangle, seen from its corner x. With source edges a, b from x (capital: the
// image edges A = p − x, B = q − x), t = a·b/|a|², area ½|a × b| = F:
//   the squared Frobenius norm of the linear map is |A|²/|a|² + |B − tA|² |a|²/4F²,
//   so   F² d = α|A|² + β|B − tA|²   with α = F²/2|a|², β = |a|²/8,
// a sum of squares that no rounding makes negative, and S = F s = ½ det(x, A, B). Four numbers a
// corner, no division when it is evaluated.

namespace sphparam {
namespace {

constexpr std::int64_t pack_grain = 32;

size_t at(int i) { return static_cast<size_t>(i); }

/// The smallest colour that no neighbour has; neighbours are looked at in blocks of 64 colours.
int free_colour(const HierarchyLevel& level, Vertex v, const std::vector<int>& colour) {
  const Vertex* ring = level.ring_begin(v);
  const int k = level.valence(v);
  for (int base = 0;; base += 64) {
    std::uint64_t taken = base == 0 ? 1 : 0;  // colour 0 is for the removed vertices
    for (int i = 0; i < k; ++i) {
      const int c = colour[at(ring[i])] - base;
      if (c >= 0 && c < 64) taken |= std::uint64_t{1} << c;
    }
    if (taken != ~std::uint64_t{0}) return base + std::countr_one(taken);
  }
}

constexpr int no_colour = std::numeric_limits<int>::min() / 2;  // of pinned vertices

std::vector<int> colour_vertices(const HierarchyLevel& level, const std::vector<Vertex>& pinned) {
  std::vector<int> colour(at(level.vertex_count()), -1);
  for (const Vertex v : level.removed) colour[at(v)] = 0;
  for (const Vertex v : pinned) colour[at(v)] = no_colour;
  for (Vertex v = 0; v < level.vertex_count(); ++v) {
    if (colour[at(v)] == -1) colour[at(v)] = free_colour(level, v, colour);
  }
  return colour;
}

/// Vertices sorted by colour, then by valence (up to 63: longer ones are rare), then by name.
struct Order {
  std::vector<Vertex> vertices;
  std::vector<int> colour_start;
};

Order sort_vertices(const HierarchyLevel& level, const std::vector<int>& colour) {
  const int colours = 1 + *std::max_element(colour.begin(), colour.end());
  std::vector<int> place(at(colours) * 64 + 1, 0);
  const auto key = [&](Vertex v) {
    return at(colour[at(v)]) * 64 + at(std::min(level.valence(v), 63));
  };
  const auto each_vertex = [&](const auto& visit) {
    for (Vertex v = 0; v < level.vertex_count(); ++v) {
      if (colour[at(v)] != no_colour) visit(v);
    }
  };
  each_vertex([&](Vertex v) { ++place[key(v) + 1]; });
  for (size_t i = 1; i < place.size(); ++i) place[i] += place[i - 1];
  Order order;
  for (int c = 0; c <= colours; ++c) order.colour_start.push_back(place[at(c) * 64]);
  order.vertices.resize(at(order.colour_start.back()));
  each_vertex([&](Vertex v) { order.vertices[at(place[key(v)]++)] = v; });
  // Valences from 64 up share a bucket: sort them, so that packs are not padded far.
  for (int c = 0; c < colours; ++c) {
    const auto end = order.vertices.begin() + order.colour_start[at(c) + 1];
    const auto long_rings = std::find_if(order.vertices.begin() + order.colour_start[at(c)], end,
                                         [&](Vertex v) { return level.valence(v) >= 63; });
    std::stable_sort(long_rings, end,
                     [&](Vertex a, Vertex b) { return level.valence(a) < level.valence(b); });
  }
  return order;
}

Order removed_only(const HierarchyLevel& level) {
  Order order{level.removed, {0, static_cast<int>(level.removed.size())}};
  std::stable_sort(order.vertices.begin(), order.vertices.end(),
                   [&](Vertex a, Vertex b) { return level.valence(a) < level.valence(b); });
  return order;
}

/// What a slot keeps of a source triangle.
struct Corner {
  double area, squared_base, shear;
};

/// The source part of one corner's triangle (v, p, q).
Corner measure_corner(const HierarchyLevel& level, Vertex v, Vertex p, Vertex q,
                      double area_floor) {
  const Vector3 x = level.positions.row(v);
  const Vector3 a = level.positions.row(p).transpose() - x;
  const Vector3 b = level.positions.row(q).transpose() - x;
  const double area = a.cross(b).norm() / 2, base = a.squaredNorm();
  if (area >= area_floor) return {area, base, a.dot(b) / base};
  // the equilateral triangle of that area
  return {area_floor, 4 / std::sqrt(3.0) * area_floor, 0.5};
}

/// Lanes without a vertex, or with fewer neighbours than the pack's longest, repeat a valid
/// neighbour with zero weights: they compute something harmless.
template <class MeasureCorner>
void fill_pack(const HierarchyLevel& level, const MeasureCorner& measure, const RingPack& pack,
               RingSlot* slots) {
  for (int lane = 0; lane < pack_width; ++lane) {
    const bool empty = pack.vertex[lane] < 0;
    const Vertex v = empty ? pack.vertex[0] : pack.vertex[lane];
    const Vertex* ring = level.ring_begin(v);
    const int k = level.valence(v);
    for (int i = 0; i < pack.valence; ++i) {
      RingSlot& slot = slots[i];
      slot.neighbour[lane] = ring[0];
      slot.alpha[lane] = slot.beta[lane] = slot.shear[lane] = 0;
      if (empty || i >= k) continue;
      const Corner c = measure(v, i);
      slot.neighbour[lane] = ring[i];
      slot.alpha[lane] = static_cast<float>(c.area * c.area / (2 * c.squared_base));
      slot.beta[lane] = static_cast<float>(c.squared_base / 8);
      slot.shear[lane] = static_cast<float>(c.shear);
    }
  }
}

template <class MeasureCorner>
RingPacks pack(const HierarchyLevel& level, const Order& order, const MeasureCorner& measure,
               int threads) {
  RingPacks result;
  result.colour_start.push_back(0);
  size_t slots = 0;
  for (size_t c = 0; c + 1 < order.colour_start.size(); ++c) {
    for (int first = order.colour_start[c]; first < order.colour_start[c + 1];
         first += pack_width) {
      RingPack pack{};
      for (int lane = 0; lane < pack_width; ++lane) {
        const bool filled = first + lane < order.colour_start[c + 1];
        pack.vertex[lane] = filled ? order.vertices[at(first + lane)] : -1;
        if (filled) pack.valence = std::max(pack.valence, level.valence(pack.vertex[lane]));
      }
      pack.first_slot = slots;
      slots += at(pack.valence);
      result.largest_valence = std::max(result.largest_valence, pack.valence);
      result.packs.push_back(pack);
    }
    result.colour_start.push_back(static_cast<int>(result.packs.size()));
  }
  result.slots.resize(slots);
  parallel_for(static_cast<std::int64_t>(result.packs.size()), pack_grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (std::int64_t p = first; p < last; ++p) {
                   const RingPack& pack = result.packs[static_cast<size_t>(p)];
                   fill_pack(level, measure, pack, &result.slots[pack.first_slot]);
                 }
               });
  return result;
}

}  // namespace

RingPacks pack_rings(const HierarchyLevel& level, double area_floor, bool only_removed, int threads,
                     const std::vector<Vertex>& pinned) {
  const Order order =
      only_removed ? removed_only(level) : sort_vertices(level, colour_vertices(level, pinned));
  const auto measure = [&](Vertex v, int i) {
    const Vertex* ring = level.ring_begin(v);
    return measure_corner(level, v, ring[i], ring[i + 1 < level.valence(v) ? i + 1 : 0],
                          area_floor);
  };
  return pack(level, order, measure, threads);
}

RingPacks pack_rings(const std::vector<int>& start, const std::vector<Vertex>& ring,
                     const std::function<SourceTriangle(Vertex v, int i)>& corner, int threads,
                     const std::vector<Vertex>& pinned) {
  HierarchyLevel level;
  level.start = start;
  level.ring = ring;
  const auto measure = [&](Vertex v, int i) {
    const SourceTriangle s = corner(v, i);
    return Corner{s.area, 1 / (s.inverse_base * s.inverse_base), s.foot};
  };
  return pack(level, sort_vertices(level, colour_vertices(level, pinned)), measure, threads);
}

}  // namespace sphparam
