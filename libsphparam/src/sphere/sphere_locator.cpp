#include "sphparam/sphere/sphere_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// The filter. For rays of length at most M, a component of n = a × b is computed with an error of
// at most 2u M² (u = 2⁻⁵³: two products whose sizes add up to M², their difference), and Σ qᵢ nᵢ
// with 3u M² |q|₁ more. 8u M² |q|₁ covers both, with room for what is of order u². Beyond it the
// sign of the computed dot product is that of det(a, b, q).
//
// The table. A direction has a place on the cube: side, s and t of 28 bits each. Faces are sorted
// by the Morton key of their centroids, so that a square of the cube holds a range of them; a
// square with more than a few is divided by 4 × 4. An entry is the face that holds its square's
// centre.

namespace sphparam {
namespace {

constexpr int bits_an_axis = 28;
constexpr size_t crowd = 8;  // faces with centroids in a square, above which it is divided
constexpr std::int64_t grain = 4096;
constexpr int straight_steps = 64;         // before the walk chooses its edges by chance
constexpr int most_steps = 1 << 16;        // before all faces are asked
constexpr double steps_worth_walking = 8;  // triangles between two directions; else the table
constexpr double least_rounding = 1e-290;  // of tiny rays: their products may underflow
constexpr double coarse_triangle = 1e-5;   // det of rays, above which dot products are weights

/// A place on the cube around the origin.
struct CubePlace {
  int side;            // 2·axis, +1 where negative
  std::uint32_t s, t;  // bits_an_axis bits each
};

std::uint32_t fixed(double ratio) {
  constexpr double size = 1u << bits_an_axis;
  return static_cast<std::uint32_t>(std::clamp((ratio + 1) / 2 * size, 0.0, size - 1));
}

CubePlace cube_place(const Vector3& q) {
  int axis = 0;
  const double length = q.cwiseAbs().maxCoeff(&axis);
  const int a = axis == 2 ? 0 : axis + 1, b = axis == 0 ? 2 : axis - 1;
  return {2 * axis + (q[axis] < 0), fixed(q[a] / length), fixed(q[b] / length)};
}

/// The bits of s at even places.
std::uint64_t spread(std::uint64_t s) {
  s = (s | s << 16) & 0x0000ffff0000ffff;
  s = (s | s << 8) & 0x00ff00ff00ff00ff;
  s = (s | s << 4) & 0x0f0f0f0f0f0f0f0f;
  s = (s | s << 2) & 0x3333333333333333;
  return (s | s << 1) & 0x5555555555555555;
}

std::uint32_t gather(std::uint64_t s) {
  s &= 0x5555555555555555;
  s = (s | s >> 1) & 0x3333333333333333;
  s = (s | s >> 2) & 0x0f0f0f0f0f0f0f0f;
  s = (s | s >> 4) & 0x00ff00ff00ff00ff;
  s = (s | s >> 8) & 0x0000ffff0000ffff;
  return static_cast<std::uint32_t>(s | s >> 16);
}

std::uint64_t morton_key(const CubePlace& place) {
  return static_cast<std::uint64_t>(place.side) << 2 * bits_an_axis | spread(place.t) << 1 |
         spread(place.s);
}

/// The direction of the centre of the square of keys [key, key + 2^bits).
Vector3 square_centre(std::uint64_t key, int bits) {
  const auto side = static_cast<int>(key >> 2 * bits_an_axis);
  const double half = std::ldexp(0.5, bits / 2), size = 1u << bits_an_axis;
  const int axis = side / 2, a = axis == 2 ? 0 : axis + 1, b = axis == 0 ? 2 : axis - 1;
  const std::uint64_t place = key & ((std::uint64_t{1} << 2 * bits_an_axis) - 1);
  Vector3 q;
  q[axis] = side % 2 ? -1 : 1;
  q[a] = 2 * (gather(place) + half) / size - 1;
  q[b] = 2 * (gather(place >> 1) + half) / size - 1;
  return q.normalized();
}

/// The direction at a length at which nothing over- or underflows: scaled by a power of two.
Vector3 usable(const Vector3& q) {
  const double length = q.cwiseAbs().maxCoeff();
  if (!q.allFinite() || length == 0) {
    throw std::invalid_argument("SphereLocator: a direction is zero or not finite");
  }
  if (length >= 0.25 && length <= 4) return q;
  return q.unaryExpr([&](double x) { return std::ldexp(x, -std::ilogb(length)); });
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
  rounding_ = std::max(0x1p-50 * map.points.rowwise().squaredNorm().maxCoeff(), least_rounding);
  reach2_ =
      steps_worth_walking * steps_worth_walking * 4 * std::numbers::pi / topology.face_count();
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
        cell.normals[edge] =
            map_->point(topology_->origin(h)).cross(map_->point(topology_->target(h)));
        cell.across[edge] = 3 * cell_of[static_cast<size_t>(Topology::face(twin))] +
                            (Topology::corner(twin) + 2) % 3;
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
  int near = 0;  // a cell to start from: in the square, or in the one before
  for (std::uint64_t square = 0; square < squares(level_); ++square) {
    const std::uint64_t key = square << bits, end = (square + 1) << bits;
    size_t last = first;
    while (last < order.size() && order[last].key < end) ++last;
    if (last > first) near = static_cast<int>(first);
    const std::uint64_t place = square & ((std::uint64_t{1} << 2 * level_) - 1);
    const auto side = static_cast<size_t>(square >> 2 * level_);
    const size_t row = (side << level_) + gather(place >> 1);
    table_[(row << level_) + gather(place)] = make_entry(order, key, bits, first, last, near);
    first = last;
  }
}

/// The entry for the square of keys [key, key + 2^bits), whose faces are order[first … last).
std::int32_t SphereLocator::make_entry(const std::vector<Keyed>& order, std::uint64_t key, int bits,
                                       size_t first, size_t last, int& near) {
  const int centre = near = walk(square_centre(key, bits), near).cell;
  if (last - first <= crowd || bits < 4) return centre;
  const size_t block = table_.size();
  table_.resize(block + 16);
  for (std::uint64_t child = 0; child < 16; ++child) {
    const std::uint64_t child_key = key + (child << (bits - 4)),
                        end = child_key + (std::uint64_t{1} << (bits - 4));
    size_t child_last = first;
    while (child_last < last && order[child_last].key < end) ++child_last;
    if (child_last > first) near = static_cast<int>(first);
    const std::int32_t entry = make_entry(order, child_key, bits - 4, first, child_last, near);
    table_[block + 4 * gather(child >> 1) + gather(child)] = entry;
    first = child_last;
  }
  return ~static_cast<std::int32_t>(block);
}

int SphereLocator::start(const Vector3& q) const {
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

inline int SphereLocator::sign(const Cell& cell, int edge, const Vector3& q, double bound) const {
  const double det = cell.normals[static_cast<size_t>(edge)].dot(q);
  if (det > bound) return 1;
  if (-det > bound) return -1;
  const Halfedge h = 3 * cell.face + (edge + 1) % 3;
  return orientation(map_->point(topology_->origin(h)), map_->point(topology_->target(h)), q);
}

SphereLocator::Found SphereLocator::walk(const Vector3& q, int at) const {
  const double bound = rounding_ * q.lpNorm<1>();
  int entered = -1;  // the edge that was crossed, seen from here: q is on this side of it
  std::uint32_t chance = 1;
  for (int step = 0; step < most_steps; ++step) {
    const Cell& cell = cells_[static_cast<size_t>(at)];
    if (step >= straight_steps) chance = 1664525 * chance + 1013904223;
    const int offset =
        step < straight_steps ? std::max(entered, 0) : static_cast<int>(chance >> 16) % 3;
    Found found{at, {1, 1, 1}};
    int crossed = -1;
    for (int i = 0; i < 3 && crossed < 0; ++i) {
      const int edge = (i + offset) % 3;
      if (edge == entered) continue;
      const int s = sign(cell, edge, q, bound);
      found.signs[static_cast<size_t>(edge)] = s;
      if (s < 0) crossed = edge;
    }
    if (crossed < 0) return found;
    const std::int32_t across = cell.across[static_cast<size_t>(crossed)];
    at = across / 3;
    entered = across % 3;
  }
  return search(q);
}

/// Asks all faces: for walks that go round and round, which chance all but excludes.
SphereLocator::Found SphereLocator::search(const Vector3& q) const {
  const double bound = rounding_ * q.lpNorm<1>();
  for (size_t i = 0; i < cells_.size(); ++i) {
    Found found{static_cast<int>(i), {}};
    for (int k = 0; k < 3; ++k) found.signs[static_cast<size_t>(k)] = sign(cells_[i], k, q, bound);
    if (*std::min_element(found.signs.begin(), found.signs.end()) >= 0) return found;
  }
  throw std::logic_error("SphereLocator: no face holds a direction; the map is not one-to-one");
}

/// Weights λₖ ∝ det(xᵢ, xⱼ, q). Where the triangle is small they are taken from differences to a
/// multiple of q, which lose nothing: det(xᵢ, xⱼ, q) = det(xᵢ − sq, xⱼ − sq, q).
SurfacePoint SphereLocator::point(const Vector3& direction, const Found& found) const {
  const Vector3 q = direction.normalized();
  const Cell& cell = cells_[static_cast<size_t>(found.cell)];
  SurfacePoint point{cell.face, {}};
  for (int k = 0; k < 3; ++k) {
    point.barycentric[k] = cell.normals[static_cast<size_t>(k)].dot(q);
  }
  if (point.barycentric.sum() < coarse_triangle) {
    const Vector3 near = map_->point(topology_->vertex(cell.face, 0)).dot(q) * q;
    Vector3 offsets[3];
    for (int k = 0; k < 3; ++k) offsets[k] = map_->point(topology_->vertex(cell.face, k)) - near;
    for (int k = 0; k < 3; ++k) {
      point.barycentric[k] = offsets[(k + 1) % 3].cross(offsets[(k + 2) % 3]).dot(q);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const bool inside = found.signs[static_cast<size_t>(k)] > 0;
    point.barycentric[k] =
        inside ? std::max(point.barycentric[k], std::numeric_limits<double>::min()) : 0;
  }
  point.barycentric /= point.barycentric.sum();
  return point;
}

/// The same point on the face of lowest index that it lies on.
SurfacePoint SphereLocator::on_lowest_face(const SurfacePoint& point, const Found& found) const {
  Face lowest = point.face;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, previous = (k + 2) % 3;
    const Halfedge h = 3 * point.face + next;  // the edge opposite to corner k
    if (found.signs[static_cast<size_t>(k)] == 0) {
      lowest = std::min(lowest, Topology::face(topology_->twin(h)));
    }
    if (found.signs[static_cast<size_t>(next)] == 0 &&
        found.signs[static_cast<size_t>(previous)] == 0) {
      topology_->for_each_outgoing(topology_->vertex(point.face, k), [&](Halfedge out) {
        lowest = std::min(lowest, Topology::face(out));
      });
    }
  }
  if (lowest == point.face) return point;
  SurfacePoint moved{lowest, Vector3::Zero()};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (topology_->vertex(point.face, i) == topology_->vertex(lowest, k)) {
        moved.barycentric[k] = point.barycentric[i];
      }
    }
  }
  return moved;
}

SurfacePoint SphereLocator::finish(const Vector3& q, const Found& found) const {
  const SurfacePoint here = point(q, found);
  const auto& [a, b, c] = found.signs;
  return a > 0 && b > 0 && c > 0 ? here : on_lowest_face(here, found);
}

SurfacePoint SphereLocator::locate(const Vector3& direction) const {
  const Vector3 q = usable(direction);
  return finish(q, walk(q, start(q)));
}

std::vector<SurfacePoint> SphereLocator::locate_all(const Points& directions, int threads) const {
  std::vector<SurfacePoint> points(static_cast<size_t>(directions.rows()));
  parallel_for(directions.rows(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    Vector3 before = Vector3::Zero();
    int cell = 0;
    for (std::int64_t i = first; i < last; ++i) {
      const Vector3 q = usable(directions.row(i));
      if ((q - before).squaredNorm() > reach2_) cell = start(q);
      const Found found = walk(q, cell);
      points[static_cast<size_t>(i)] = finish(q, found);
      before = q;
      cell = found.cell;
    }
  });
  return points;
}

}  // namespace sphparam
