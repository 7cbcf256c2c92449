#include "embedding/sweeps/ring_packs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "embedding/energy/gathered_lanes.h"
#include "embedding/sweeps/least_colour.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

constexpr std::int64_t pack_grain = 64;
constexpr int region_size = 2048;  // vertices
constexpr size_t valences = 64;    // told apart in the order of vertices

size_t at(int i) { return static_cast<size_t>(i); }

/// The rings of a level, or of any mesh.
struct Rings {
  std::span<const int> start;
  std::span<const Vertex> ring;
  std::span<const Vertex> removed;

  int vertex_count() const { return static_cast<int>(start.size()) - 1; }
  int valence(Vertex v) const { return start[at(v + 1)] - start[at(v)]; }
  const Vertex* ring_begin(Vertex v) const { return &ring[at(start[at(v)])]; }
};

/// The least colour that no neighbour has; colour 0 is for the removed vertices.
int free_colour(const Rings& rings, Vertex v, const std::vector<int>& colour) {
  const Vertex* ring = rings.ring_begin(v);
  const int k = rings.valence(v);
  return least_free_colour(1, [&](const auto& take) {
    for (int i = 0; i < k; ++i) take(colour[at(ring[i])]);
  });
}

constexpr int no_colour = std::numeric_limits<int>::min() / 2;  // of pinned vertices

std::vector<int> colour_vertices(const Rings& rings, const std::vector<Vertex>& pinned) {
  std::vector<int> colour(at(rings.vertex_count()), -1);
  for (const Vertex v : rings.removed) colour[at(v)] = 0;
  for (const Vertex v : pinned) colour[at(v)] = no_colour;
  for (Vertex v = 0; v < rings.vertex_count(); ++v) {
    if (colour[at(v)] == -1) colour[at(v)] = free_colour(rings, v, colour);
  }
  return colour;
}

/// Vertices sorted by colour, then by region (names that are near each other are mostly near on the
/// mesh too, so that threads with ranges of packs seldom write where another one reads), then by
/// valence (up to 63: longer ones are rare), then by name.
struct Order {
  std::vector<Vertex> vertices;
  std::vector<int> colour_start;
};

/// The longest rings share a place in the order by valence. They are sorted, run by run, so that
/// packs are not padded far.
void sort_long_rings(const Rings& rings, Order& order) {
  const auto is_long = [&](Vertex v) { return at(rings.valence(v)) >= valences - 1; };
  for (size_t c = 0; c + 1 < order.colour_start.size(); ++c) {
    const auto end = order.vertices.begin() + order.colour_start[c + 1];
    for (auto last = order.vertices.begin() + order.colour_start[c]; last != end;) {
      const auto first = std::find_if(last, end, is_long);
      last = std::find_if_not(first, end, is_long);
      std::stable_sort(first, last,
                       [&](Vertex a, Vertex b) { return rings.valence(a) < rings.valence(b); });
    }
  }
}

Order sort_vertices(const Rings& rings, const std::vector<int>& colour) {
  const int last = *std::max_element(colour.begin(), colour.end());
  const int colours = last == no_colour ? 0 : last + 1;  // none where all are pinned
  const int regions = (rings.vertex_count() + region_size - 1) / region_size;
  std::vector<int> place(at(colours) * at(regions) * valences + 1, 0);
  const auto key = [&](Vertex v) {
    return (at(colour[at(v)]) * at(regions) + at(v / region_size)) * valences +
           std::min(at(rings.valence(v)), valences - 1);
  };
  const auto each_vertex = [&](const auto& visit) {
    for (Vertex v = 0; v < rings.vertex_count(); ++v) {
      if (colour[at(v)] != no_colour) visit(v);
    }
  };
  each_vertex([&](Vertex v) { ++place[key(v) + 1]; });
  for (size_t i = 1; i < place.size(); ++i) place[i] += place[i - 1];
  Order order;
  for (int c = 0; c <= colours; ++c)
    order.colour_start.push_back(place[at(c) * at(regions) * valences]);
  order.vertices.resize(at(order.colour_start.back()));
  each_vertex([&](Vertex v) { order.vertices[at(place[key(v)]++)] = v; });
  sort_long_rings(rings, order);
  return order;
}

/// Fills in the neighbours of a pack's vertices. Lanes without a vertex, or with fewer neighbours
/// than the pack's longest, repeat a valid one: they compute something harmless.
void fill_neighbours(const Rings& rings, const RingPack& pack, RingSlot* slots) {
  for (int lane = 0; lane < pack_width; ++lane) {
    const bool empty = pack.vertex[lane] < 0;
    const Vertex v = empty ? pack.vertex[0] : pack.vertex[lane];
    const Vertex* ring = rings.ring_begin(v);
    const int k = empty ? 0 : rings.valence(v);
    for (int i = 0; i < pack.valence; ++i) slots[i].neighbour[lane] = ring[i < k ? i : 0];
  }
}

/// Rest triangles with edges a and b from a corner: F², |a|² and a·b / |a|².
template <int W>
struct RestLanes {
  Lanes<W> area2, base2, shear;
};

/// As `fattened` of one (rest_floors.cpp). `side2`: |b|².
template <int W>
SPHPARAM_INLINE RestLanes<W> fattened(const RestLanes<W>& rest, Lanes<W> side2,
                                      const Fatness& fatness) {
  const Lanes<W> ab = rest.shear * rest.base2, half_sum = rest.base2 + side2 - ab;
  const Lanes<W> c = fatness.added(half_sum), base2 = rest.base2 + c;
  return {rest.area2 + 0.25 * (c * (half_sum + 0.75 * c)), base2, (ab + 0.5 * c) / base2};
}

/// Measures the rest triangles of a pack's vertices, W lanes at a time.
template <int W>
SPHPARAM_INLINE void measure_part(const HierarchyLevel& level, const RestFloors& floors,
                                  const RingPack& pack, int first, RingSlot* slots) {
  Vertex own[W];
  Lanes<W> valence = 0.0;
  for (int i = 0; i < W; ++i) {
    const Vertex v = pack.vertex[first + i];
    own[i] = v < 0 ? pack.vertex[0] : v;
    valence.v[i] = v < 0 ? 0 : level.valence(v);
  }
  const Lanes<W> zero = 0.0, least = floors.area * floors.area;
  const LaneVectors<W> x = gather<W>(level.positions, own);
  const auto edge = [&](int i) SPHPARAM_INLINED {
    return gather<W>(level.positions, slots[i].neighbour + first) - x;
  };
  LaneVectors<W> a = edge(0);
  const LaneVectors<W> start = a;
  for (int i = 0; i < pack.valence; ++i) {
    const LaneVectors<W> b = i + 1 < pack.valence ? edge(i + 1) : start, normal = cross(a, b);
    const Lanes<W> area2 = 0.25 * dot(normal, normal), base = dot(a, a);
    // Too small or not a number: the equilateral triangle of the least area.
    const LaneMask<W> fine = area2 > least, live = valence > static_cast<double>(i);
    const Lanes<W> base_used = select(fine, base, 4 / std::sqrt(3.0) * floors.area);
    RestLanes<W> rest{select(fine, area2, least), base_used,
                      select(fine, dot(a, b) / base, Lanes<W>(0.5))};
    if (!floors.fatness.is_none())
      rest = fattened(rest, select(fine, dot(b, b), base_used), floors.fatness);
    store(select(live, rest.area2 / (rest.base2 + rest.base2), zero), slots[i].alpha + first);
    store(select(live, 0.125 * rest.base2, zero), slots[i].beta + first);
    store(select(live, rest.shear, zero), slots[i].shear + first);
    a = b;
  }
}

/// The packs of an order of vertices, their slots not filled in.
RingPacks make_packs(const Rings& rings, const Order& order, RingPacks result) {
  result.packs.clear();
  result.colour_start.clear();
  result.largest_valence = 0;
  result.packs.reserve(order.vertices.size() / pack_width + order.colour_start.size());
  result.colour_start.push_back(0);
  size_t slots = 0;
  for (size_t c = 0; c + 1 < order.colour_start.size(); ++c) {
    for (int first = order.colour_start[c]; first < order.colour_start[c + 1];
         first += pack_width) {
      RingPack pack{};
      for (int lane = 0; lane < pack_width; ++lane) {
        const bool filled = first + lane < order.colour_start[c + 1];
        pack.vertex[lane] = filled ? order.vertices[at(first + lane)] : -1;
        if (filled) pack.valence = std::max(pack.valence, rings.valence(pack.vertex[lane]));
      }
      pack.first_slot = slots;
      slots += at(pack.valence);
      result.largest_valence = std::max(result.largest_valence, pack.valence);
      result.packs.push_back(pack);
    }
    result.colour_start.push_back(static_cast<int>(result.packs.size()));
  }
  if (!result.slots) result.room = 0;  // it was moved from
  if (slots > result.room) {
    result.slots = nullptr;  // both at once would be too much
    result.slots = std::make_unique_for_overwrite<RingSlot[]>(slots);
    result.room = slots;
  }
  return result;
}

/// Calls fill(first, last) on ranges of packs.
template <class Fill>
void fill_packs(const RingPacks& packs, int threads, const Fill& fill) {
  parallel_for(static_cast<std::int64_t>(packs.packs.size()), pack_grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 fill(&packs.packs[static_cast<size_t>(first)], last - first);
               });
}

}  // namespace

RingPacks room_for_rings(std::int64_t halfedges) {
  // Packs of mixed valences have slots that some lanes do not need: a few in a hundred.
  const auto slots = static_cast<size_t>(halfedges + halfedges / 16) / pack_width;
  RingPacks packs;
  packs.slots = std::make_unique_for_overwrite<RingSlot[]>(slots);
  packs.room = slots;
  return packs;
}

RingPacks pack_rings(const HierarchyLevel& level, const RestFloors& floors, int threads,
                     const std::vector<Vertex>& pinned, RingPacks used) {
  const Rings rings{level.start, level.ring, level.removed};
  RingPacks packs =
      make_packs(rings, sort_vertices(rings, colour_vertices(rings, pinned)), std::move(used));
  fill_packs(packs, threads, [&](const RingPack* pack, std::int64_t count) {
    for (std::int64_t p = 0; p < count; ++p) {
      fill_neighbours(rings, pack[p], &packs.slots[pack[p].first_slot]);
    }
    run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
      for (std::int64_t p = 0; p < count; ++p) {
        for (int lane = 0; lane < pack_width; lane += W) {
          measure_part<W>(level, floors, pack[p], lane, &packs.slots[pack[p].first_slot]);
        }
      }
    });
  });
  return packs;
}

RingPacks pack_rings(const std::vector<int>& start, const std::vector<Vertex>& ring,
                     const std::function<void(Vertex v, int lane, RingSlot* slots)>& measure,
                     int threads, const std::vector<Vertex>& pinned) {
  const Rings rings{start, ring, {}};
  RingPacks packs = make_packs(rings, sort_vertices(rings, colour_vertices(rings, pinned)), {});
  fill_packs(packs, threads, [&](const RingPack* pack, std::int64_t count) {
    for (; count-- > 0; ++pack) {
      RingSlot* slots = &packs.slots[pack->first_slot];
      fill_neighbours(rings, *pack, slots);
      for (int lane = 0; lane < pack_width; ++lane) {
        const Vertex v = pack->vertex[lane];
        if (v >= 0) measure(v, lane, slots);
        for (int i = v < 0 ? 0 : rings.valence(v); i < pack->valence; ++i) {
          slots[i].alpha[lane] = slots[i].beta[lane] = slots[i].shear[lane] = 0;
        }
      }
    }
  });
  return packs;
}

}  // namespace sphparam
