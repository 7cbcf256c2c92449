#include "sphparam/sphere/sphere_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "sphere/cube_places.h"
#include "sphere/usable_direction.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// The filter. For rays of length at most M, a component of n = a × b is computed with an error of
// at most 2u M² (u = 2⁻⁵³: two products whose sizes add up to M², their difference), and Σ qᵢ nᵢ
// with 3u M² |q|₁ more. 8u M² |q|₁ covers both, with room for what is of order u²; |q|₁ ≤ 4 for
// every usable q, so one bound serves all. Beyond it the sign of the computed dot product is that
// of det(a, b, q).
//
// The walk crosses the edge whose det is least. At the end the three dets are the weights.
//
// Many directions are walked to side by side, in steps without branches: where nothing is left to
// cross, a step stays. So there is work to do where memory would make the processor wait, and no
// branch to mispredict. The few that are not there after some steps begin anew from the table.
//
// The table. A direction has a place on the cube (cube_places.h). Faces are sorted by the Morton
// key of their centroids, so that a square of the cube holds a range of them; a square with more
// than a few is divided by 4 × 4. An entry is the face that holds its square's centre.

namespace sphparam {
namespace {

// Of the table.
constexpr size_t crowd = 8;  // faces with centroids in a square, above which it is divided

// Of walks.
constexpr int straight_steps = 64;   // before the walk chooses its edges by chance
constexpr int most_steps = 1 << 16;  // before all faces are asked

// Of rounding.
constexpr double least_rounding = 1e-290;  // of tiny rays: their products may underflow

// Of many directions.
constexpr std::int64_t grain = 4096;   // faces, or directions
constexpr int lanes = 4;               // directions that are walked to side by side
constexpr int side_steps = 3;          // of each, before a look whether it is there
constexpr std::int64_t few = 1 << 10;  // directions that are not worth sorting
constexpr double near_triangles = 2;   // between most directions that are not worth sorting
constexpr std::int64_t least_sorted = 1 << 17, most_sorted = 1 << 20;  // together
constexpr std::int64_t ahead = 12;  // directions between asking for memory and using it
constexpr std::int32_t cells_ahead = 24;

/// Rows first … last along the curve of the cube's squares, relative to the first: two rounds of
/// counting, by the lower and the upper half of a short key.
std::vector<std::uint32_t> curve_order(SphereLocator::PointsView directions, std::int64_t first,
                                       std::int64_t last) {
  constexpr int kept = 10, half_bits = 12;  // bits an axis; 6·4¹⁰ < 2²⁴
  struct Item {
    std::uint32_t key, row;
  };
  const auto count = static_cast<size_t>(last - first);
  std::vector<Item> items(count), sorted(count);
  std::array<std::array<std::uint32_t, (1 << half_bits) + 1>, 2> starts{};
  constexpr std::uint32_t mask = (1 << half_bits) - 1;
  for (size_t i = 0; i < count; ++i) {
    const Vector3 q = usable(directions.row(first + static_cast<std::int64_t>(i)));
    const std::uint64_t key = morton_key(cube_place(q));
    items[i] = {static_cast<std::uint32_t>(key >> 2 * (bits_an_axis - kept)),
                static_cast<std::uint32_t>(i)};
    ++starts[0][(items[i].key & mask) + 1];
    ++starts[1][(items[i].key >> half_bits) + 1];
  }
  for (auto& table : starts) std::partial_sum(table.begin(), table.end(), table.begin());
  for (const Item& item : items) sorted[starts[0][item.key & mask]++] = item;
  std::vector<std::uint32_t> order(count);
  for (const Item& item : sorted) order[starts[1][item.key >> half_bits]++] = item.row;
  return order;
}

/// Which is least, without branches: nobody can predict it.
inline size_t least(const std::array<double, 3>& d) {
  const size_t second = d[1] < d[0], third = d[2] < std::min(d[0], d[1]);
  return 2 * third | (second & ~third);
}

}  // namespace

struct SphereLocator::Keyed {
  std::uint64_t key;
  Face face;
  bool operator<(const Keyed& other) const {
    return key != other.key ? key < other.key : face < other.face;
  }
};

SphereLocator::SphereLocator(const Topology& topology, const SphereMap& map, int threads)
    : topology_(&topology), map_(&map) {
  if (map.points.rows() != topology.vertex_count()) {
    throw std::invalid_argument("SphereLocator: " + std::to_string(map.points.rows()) +
                                " rays for " + std::to_string(topology.vertex_count()) +
                                " vertices");
  }
  bound_ = most_length *
           std::max(0x1p-50 * map.points.rowwise().squaredNorm().maxCoeff(), least_rounding);
  std::vector<Keyed> order(static_cast<size_t>(topology.face_count()));
  parallel_for(topology.face_count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      const Vector3 centroid = map.point(topology.vertex(f, 0)) + map.point(topology.vertex(f, 1)) +
                               map.point(topology.vertex(f, 2));
      order[static_cast<size_t>(f)] = {morton_key(cube_place(centroid)), f};
    }
  });
  std::sort(order.begin(), order.end());
  make_cells(order, threads);
  make_table(order);
}

void SphereLocator::make_cells(const std::vector<Keyed>& order, int threads) {
  std::vector<std::int32_t> cell_of(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    cell_of[static_cast<size_t>(order[i].face)] = static_cast<std::int32_t>(i);
  }
  cells_.resize(order.size());
  parallel_for(std::ssize(order), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i) {
      Cell& cell = cells_[i];
      cell.face = order[i].face;
      for (int k = 0; k < 3; ++k) {
        const Halfedge h = 3 * cell.face + (k + 1) % 3, twin = topology_->twin(h);
        const auto edge = static_cast<size_t>(k);
        const Vector3 normal =
            map_->point(topology_->origin(h)).cross(map_->point(topology_->target(h)));
        cell.x[edge] = normal.x();
        cell.y[edge] = normal.y();
        cell.z[edge] = normal.z();
        cell.across[edge] = cell_of[static_cast<size_t>(Topology::face(twin))];
      }
    }
  });
}

void SphereLocator::make_table(const std::vector<Keyed>& order) {
  const auto squares = [&](int level) { return size_t{6} << 2 * level; };
  while (squares(level_) < order.size() / 2 && level_ < bits_an_axis / 2) ++level_;
  table_.resize(squares(level_));
  const int bits = 2 * (bits_an_axis - level_);
  size_t first = 0;
  std::int32_t near = 0;  // a cell to start from: in the square, or in the one before
  for (std::uint64_t square = 0; square < squares(level_); ++square) {
    const std::uint64_t key = square << bits, end = (square + 1) << bits;
    size_t last = first;
    while (last < order.size() && order[last].key < end) ++last;
    if (last > first) near = static_cast<std::int32_t>(first);
    const std::uint64_t place = square & ((std::uint64_t{1} << 2 * level_) - 1);
    const auto side = static_cast<size_t>(square >> 2 * level_);
    const size_t row = (side << level_) + gather_bits(place >> 1);
    table_[(row << level_) + gather_bits(place)] = make_entry(order, key, bits, first, last, near);
    first = last;
  }
}

/// The entry for the square of keys [key, key + 2^bits), whose faces are order[first … last).
std::int32_t SphereLocator::make_entry(const std::vector<Keyed>& order, std::uint64_t key, int bits,
                                       size_t first, size_t last, std::int32_t& near) {
  const std::int32_t centre = near = walk(square_centre(key, bits), near).cell;
  if (last - first <= crowd || bits < 4) return centre;
  const size_t children = table_.size();
  table_.resize(children + 16);
  for (std::uint64_t child = 0; child < 16; ++child) {
    const std::uint64_t child_key = key + (child << (bits - 4)),
                        end = child_key + (std::uint64_t{1} << (bits - 4));
    size_t child_last = first;
    while (child_last < last && order[child_last].key < end) ++child_last;
    if (child_last > first) near = static_cast<std::int32_t>(first);
    const std::int32_t entry = make_entry(order, child_key, bits - 4, first, child_last, near);
    table_[children + 4 * gather_bits(child >> 1) + gather_bits(child)] = entry;
    first = child_last;
  }
  return ~static_cast<std::int32_t>(children);
}

std::int32_t SphereLocator::start(const Vector3& q) const {
  const CubePlace place = cube_place(q);
  int shift = bits_an_axis - level_;
  const size_t row = (static_cast<size_t>(place.side) << level_) + (place.t >> shift);
  std::int32_t entry = table_[(row << level_) + (place.s >> shift)];
  while (entry < 0) {
    shift -= 2;
    const std::uint32_t slot = 4 * (place.t >> shift & 3) + (place.s >> shift & 3);
    entry = table_[static_cast<size_t>(~entry) + slot];
  }
  return entry;
}

inline std::array<double, 3> SphereLocator::dets(const Cell& cell, const Vector3& q) {
  std::array<double, 3> result;
  for (size_t k = 0; k < 3; ++k) {
    result[k] = cell.x[k] * q.x() + cell.y[k] * q.y() + cell.z[k] * q.z();
  }
  return result;
}

int SphereLocator::sign(const Cell& cell, int edge, double det, const Vector3& q) const {
  if (det > bound_) return 1;
  if (-det > bound_) return -1;
  const Halfedge h = 3 * cell.face + (edge + 1) % 3;
  return orientation(map_->point(topology_->origin(h)), map_->point(topology_->target(h)), q);
}

SphereLocator::Found SphereLocator::walk(const Vector3& q, std::int32_t at) const {
  for (int step = 0; step < straight_steps; ++step) {
    const Cell& cell = cells_[static_cast<size_t>(at)];
    const std::array<double, 3> d = dets(cell, q);
    const size_t edge = least(d);
    if (d[edge] > bound_) return {at, false, d};
    if (!(d[edge] < -bound_)) break;  // too near to an edge to be told apart
    at = cell.across[edge];
  }
  return wander(q, at);
}

/// The cell one step from another towards q, or itself if q is there. Masks, for a compiler makes
/// branches of choices.
inline std::int32_t SphereLocator::step(const Vector3& q, std::int32_t at) const {
  const Cell& cell = cells_[static_cast<size_t>(at)];
  const std::array<double, 3> d = dets(cell, q);
  const std::int32_t change = at ^ cell.across[least(d)];
  return at ^ (change & -std::int32_t{std::min({d[0], d[1], d[2]}) < 0});
}

/// The first edge from `offset` on that q lies beyond, by exact signs; −1 if none.
int SphereLocator::edge_to_cross(const Cell& cell, const Found& found, const Vector3& q,
                                 int offset) const {
  for (int i = 0; i < 3; ++i) {
    const int edge = (i + offset) % 3;
    if (sign(cell, edge, found.dets[static_cast<size_t>(edge)], q) < 0) return edge;
  }
  return -1;
}

SphereLocator::Found SphereLocator::met(std::int32_t cell,
                                        const std::array<double, 3>& dets) const {
  return {cell, *std::min_element(dets.begin(), dets.end()) <= bound_, dets};
}

/// The walk with exact signs and by chance, and in the end a look at all faces: for those that go
/// round and round, which chance all but excludes.
SphereLocator::Found SphereLocator::wander(const Vector3& q, std::int32_t at) const {
  std::uint32_t chance = 1;
  for (int step = 0; step < most_steps; ++step) {
    chance = 1664525 * chance + 1013904223;
    const Cell& cell = cells_[static_cast<size_t>(at)];
    const Found found = met(at, dets(cell, q));
    const int crossed = edge_to_cross(cell, found, q, static_cast<int>(chance >> 16) % 3);
    if (crossed < 0) return found;
    at = cell.across[static_cast<size_t>(crossed)];
  }
  for (size_t i = 0; i < cells_.size(); ++i) {
    const Found found = met(static_cast<std::int32_t>(i), dets(cells_[i], q));
    if (edge_to_cross(cells_[i], found, q, 0) < 0) return found;
  }
  throw std::logic_error("SphereLocator: no face holds a direction; the map is not one-to-one");
}

/// Weights λₖ ∝ det(xᵢ, xⱼ, q) of a small triangle, from differences to a multiple of q, which lose
/// nothing: det(xᵢ, xⱼ, q) = det(xᵢ − sq, xⱼ − sq, q).
Vector3 SphereLocator::small_weights(const Vector3& q, Face face) const {
  const auto corner = [&](int k) { return map_->point(topology_->vertex(face, k)); };
  const Vector3 near = corner(0).dot(q) / q.squaredNorm() * q;
  const Vector3 offsets[3] = {corner(0) - near, corner(1) - near, corner(2) - near};
  Vector3 weights;
  for (int k = 0; k < 3; ++k) {
    weights[k] = offsets[(k + 1) % 3].cross(offsets[(k + 2) % 3]).dot(q);
  }
  return weights;
}

SurfacePoint SphereLocator::finish(const Vector3& q, const Found& found) const {
  if (found.touches) return finish_at_edge(q, found);
  SurfacePoint point{cells_[static_cast<size_t>(found.cell)].face,
                     {found.dets[0], found.dets[1], found.dets[2]}};
  double sum = found.dets[0] + found.dets[1] + found.dets[2];  // in the order of `settle`
  if (sum < coarse_triangle) {
    point.barycentric = small_weights(q, point.face).cwiseMax(std::numeric_limits<double>::min());
    sum = point.barycentric.sum();
  }
  point.barycentric *= 1 / sum;
  return point;
}

/// What `finish` says if q is in the cell and plainly so; false if not. Most of the work of many
/// directions: straight from registers to the point.
inline bool SphereLocator::settle(const Vector3& q, std::int32_t at, SurfacePoint& point) const {
  const Cell& cell = cells_[static_cast<size_t>(at)];
  const std::array<double, 3> d = dets(cell, q);
  const double sum = d[0] + d[1] + d[2];
  if (!(std::min({d[0], d[1], d[2]}) > bound_ && sum >= coarse_triangle)) return false;
  const double scale = 1 / sum;
  point.face = cell.face;
  point.barycentric = Vector3(d[0] * scale, d[1] * scale, d[2] * scale);
  return true;
}

/// Of a direction that exact signs were asked for: its weights at the corners of the face of lowest
/// index that it lies on, computed there, so that the walk's way leaves no trace.
SurfacePoint SphereLocator::finish_at_edge(const Vector3& q, const Found& found) const {
  const Cell& cell = cells_[static_cast<size_t>(found.cell)];
  std::array<bool, 3> beside{};  // is the weight of the corner zero?
  for (int k = 0; k < 3; ++k) {
    const auto edge = static_cast<size_t>(k);
    beside[edge] = sign(cell, k, found.dets[edge], q) == 0;
  }
  Face lowest = cell.face;
  for (int k = 0; k < 3; ++k) {
    const auto next = static_cast<size_t>((k + 1) % 3), previous = static_cast<size_t>((k + 2) % 3);
    if (beside[static_cast<size_t>(k)]) {
      const Halfedge h = 3 * cell.face + (k + 1) % 3;
      lowest = std::min(lowest, Topology::face(topology_->twin(h)));
    }
    if (beside[next] && beside[previous]) {
      topology_->for_each_outgoing(topology_->vertex(cell.face, k), [&](Halfedge out) {
        lowest = std::min(lowest, Topology::face(out));
      });
    }
  }
  SurfacePoint point{lowest, small_weights(q, lowest)};
  for (int i = 0; i < 3; ++i) {
    bool at_corner = false;  // of the found face, with a weight
    for (int k = 0; k < 3; ++k) {
      at_corner = at_corner || (topology_->vertex(lowest, i) == topology_->vertex(cell.face, k) &&
                                !beside[static_cast<size_t>(k)]);
    }
    point.barycentric[i] =
        at_corner ? std::max(point.barycentric[i], std::numeric_limits<double>::min()) : 0;
  }
  point.barycentric /= point.barycentric.sum();
  return point;
}

SurfacePoint SphereLocator::locate(const Vector3& direction) const {
  const Vector3 q = usable(direction);
  return finish(q, walk(q, start(q)));
}

/// Rows row_at(first) … row_at(last − 1), cut into a run for each lane: from each direction of a
/// run to the next.
template <class RowAt>
void SphereLocator::locate_in_order(PointsView directions, std::int64_t first, std::int64_t last,
                                    const RowAt& row_at, SurfacePoint* points) const {
  const std::int64_t length = (last - first) / lanes;
  const size_t last_cell = cells_.size() - 1;
  std::array<std::int64_t, lanes> rows;
  std::array<Vector3, lanes> q;
  std::array<std::int32_t, lanes> cells{};
  for (std::int64_t i = first; i < first + length; ++i) {
    for (size_t k = 0; k < lanes; ++k) {
      rows[k] = row_at(i + static_cast<std::int64_t>(k) * length);
      q[k] = usable(directions.row(rows[k]));
    }
    for (int taken = 0; taken < side_steps; ++taken) {
      for (size_t k = 0; k < lanes; ++k) cells[k] = step(q[k], cells[k]);
    }
    for (size_t k = 0; k < lanes; ++k) {
      if (!settle(q[k], cells[k], points[rows[k]])) {
        const Found found = walk(q[k], start(q[k]));
        points[rows[k]] = finish(q[k], found);
        cells[k] = found.cell;
      }
      // Cells and sorted directions lie along one curve: soon these will be met.
      const size_t soon = std::min(static_cast<size_t>(cells[k] + cells_ahead), last_cell - 1);
      __builtin_prefetch(&cells_[soon]);
      __builtin_prefetch(&cells_[soon + 1]);
    }
  }
  for (std::int64_t i = first + lanes * length; i < last; ++i) {
    const std::int64_t row = row_at(i);
    points[row] = locate(directions.row(row));
  }
}

/// Are most directions so near to the ones before them that sorting would not pay? Asked of some.
bool SphereLocator::is_coherent(PointsView directions) const {
  const double reach2 =
      near_triangles * near_triangles * 4 * std::numbers::pi / static_cast<double>(cells_.size());
  const std::int64_t stride = std::max<std::int64_t>(1, directions.rows() / few);
  std::int64_t asked = 0, near = 0;
  for (std::int64_t i = 1; i < directions.rows(); i += stride) {
    const double square = (directions.row(i) - directions.row(i - 1)).squaredNorm();
    near += square <= reach2 * directions.row(i).squaredNorm();
    ++asked;
  }
  return 4 * near >= 3 * asked;
}

std::vector<SurfacePoint> SphereLocator::locate_all(const Points& directions, int threads) const {
  std::vector<SurfacePoint> points(static_cast<size_t>(directions.rows()));
  locate_all(directions, points, threads);
  return points;
}

void SphereLocator::locate_all(PointsView directions, std::span<SurfacePoint> points,
                               int threads) const {
  const std::int64_t count = directions.rows();
  if (std::ssize(points) != count) {
    throw std::invalid_argument("SphereLocator: room for " + std::to_string(points.size()) +
                                " points of " + std::to_string(count) + " directions");
  }
  const bool sort = count >= few && !is_coherent(directions);
  // The more directions are sorted together, the nearer they are to one another.
  const std::int64_t share = count / resolve_threads(threads) + 1;
  const std::int64_t chunk = sort ? std::clamp(share, least_sorted, most_sorted) : grain;
  parallel_for(count, chunk, threads, [&](std::int64_t first, std::int64_t last) {
    if (!sort) {
      locate_in_order(
          directions, first, last, [](std::int64_t i) { return i; }, points.data());
      return;
    }
    const std::vector<std::uint32_t> order = curve_order(directions, first, last);
    const auto row_at = [&](std::int64_t i) {
      const std::int64_t later = std::min(i + ahead, std::ssize(order) - 1);
      const std::int64_t wanted = first + order[static_cast<size_t>(later)];
      __builtin_prefetch(directions.data() + 3 * wanted);
      __builtin_prefetch(points.data() + wanted, 1);
      return first + order[static_cast<size_t>(i)];
    };
    locate_in_order(directions, 0, last - first, row_at, points.data());
  });
}

}  // namespace sphparam
