// From direction to direction: those that lie plainly in the cell at hand are settled, eight at a
// time; from the first that does not the locator walks on to the next cell.

#include "sphere/row_locator.h"

#include <algorithm>
#include <numbers>

#include "lanes.h"
#include "sphere/usable_direction.h"

namespace sphparam {

namespace {

constexpr double fine = 0.3;        // directions are nearer than that, in triangles
constexpr size_t least_asked = 16;  // of a row, whether it is fine

std::array<PaddedNumbers, 3> padded(size_t count) {
  const PaddedNumbers numbers(count + padding);
  return {numbers, numbers, numbers};
}

}  // namespace

DirectionTable::DirectionTable(size_t count) : count(count), x(padded(count)) {}

PointTable::PointTable(size_t count) : count(count), faces(count), barycentric(padded(count)) {}

void PointTable::set(size_t i, const SurfacePoint& point) {
  faces[i] = point.face;
  for (size_t k = 0; k < 3; ++k) barycentric[k][i] = point.barycentric[static_cast<int>(k)];
}

/// Settles the directions from `first` on that are plainly in the cell, up to the first that is
/// not: how many these are. As SphereLocator::settle, to the bit.
size_t RowLocator::settle(std::int32_t at, const DirectionTable& directions, size_t first,
                          PointTable& points) const {
  const SphereLocator::Cell& cell = locator_.cells_[static_cast<size_t>(at)];
  const double bound = locator_.bound_;
  size_t next = first;
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    const LaneVectors<W> normals[3] = {{cell.x[0], cell.y[0], cell.z[0]},
                                       {cell.x[1], cell.y[1], cell.z[1]},
                                       {cell.x[2], cell.y[2], cell.z[2]}};
    std::array<double, W> doubtful;
    int settled;
    do {
      const LaneVectors<W> q = load<W>(directions.x, next),
                           d = {dot(normals[0], q), dot(normals[1], q), dot(normals[2], q)};
      const Lanes<W> least = smaller(smaller(d.x, d.y), d.z), sum = d.x + d.y + d.z,
                     square = dot(q, q);
      store((1.0 / sum) * d, points.barycentric, next);
      // Choices of one comparison each: GCC 12 takes masks apart where they meet one another.
      const Lanes<W> yes = 0.0, no = 1.0;
      Lanes<W> doubts = select(least > bound, yes, no);
      doubts = larger(doubts, select(sum > coarse_triangle, yes, no));
      doubts = larger(doubts, select(square > 0.25, yes, no));
      doubts = larger(doubts, select(square < 4.0, yes, no));
      store(doubts, doubtful.data());
      settled = 0;
      while (settled < W && doubtful[static_cast<size_t>(settled)] == 0) ++settled;
      next += static_cast<size_t>(settled);
    } while (settled == W && next < directions.count);
  });
  next = std::min(next, directions.count);
  std::fill(points.faces.begin() + static_cast<std::ptrdiff_t>(first),
            points.faces.begin() + static_cast<std::ptrdiff_t>(next), cell.face);
  return next - first;
}

void RowLocator::locate(const DirectionTable& directions, PointTable& points) const {
  if (directions.count == 0) return;
  if (!is_fine(directions)) return locate_each(directions, points);
  std::int32_t at = locator_.start(usable(directions[0]));
  for (size_t i = 0; i < directions.count;) {
    i += settle(at, directions, i, points);
    if (i == directions.count) return;
    const Vector3 q = usable(directions[i]);
    const SphereLocator::Found found = locator_.walk(q, at);
    // What is in this cell, and not plainly so, or on an edge of the next.
    if (found.cell == at || found.touches) points.set(i++, locator_.finish(q, found));
    at = found.cell;
  }
}

void RowLocator::locate_each(const DirectionTable& directions, PointTable& points) const {
  Points rows(static_cast<Eigen::Index>(directions.count), 3);
  for (size_t i = 0; i < directions.count; ++i)
    rows.row(static_cast<Eigen::Index>(i)) = directions[i];
  const std::vector<SurfacePoint> found = locator_.locate_all(rows, 1);
  for (size_t i = 0; i < directions.count; ++i) points.set(i, found[i]);
}

/// Are most directions nearer to the ones before them than triangles are large? Asked of some.
bool RowLocator::is_fine(const DirectionTable& directions) const {
  const double reach2 =
      fine * fine * 4 * std::numbers::pi / static_cast<double>(locator_.cells_.size());
  const size_t stride = std::max<size_t>(1, directions.count / least_asked);
  size_t asked = 0, near = 0;
  for (size_t i = 1; i < directions.count; i += stride) {
    near +=
        (directions[i] - directions[i - 1]).squaredNorm() <= reach2 * directions[i].squaredNorm();
    ++asked;
  }
  return 4 * near >= 3 * asked;
}

}  // namespace sphparam
