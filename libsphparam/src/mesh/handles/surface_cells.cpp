#include "mesh/handles/surface_cells.h"

#include <algorithm>
#include <cstdint>
#include <limits>

// The unit box is cut into as many cells as there are faces, within limits; a face is in all cells
// that its box touches. Cells are larger where that would be too many, as of long faces that lie
// across the axes.

namespace sphparam {
namespace {

constexpr int most_cells = 96;             // a side
constexpr std::int64_t most_entries = 64;  // of a face in cells, on average

/// The cube root of a count.
int side_of(long count) {
  long side = 1;
  while (side < most_cells && (side + 1) * (side + 1) * (side + 1) <= count) ++side;
  return static_cast<int>(side);
}

bool touch(const TriangleCorners& s, const TriangleCorners& t) {
  return std::any_of(s.begin(), s.end(), [&](const Vector3& corner) {
    return std::find(t.begin(), t.end(), corner) != t.end();
  });
}

}  // namespace

SurfaceCells::SurfaceCells(const RepairState& state)
    : state_(state), cells_(side_of(state.face_count())) {
  const std::int64_t enough =
      std::min<std::int64_t>(most_entries * state.face_count(), std::numeric_limits<int>::max());
  while (cells_ > 1 && entries() > enough) cells_ = (cells_ + 1) / 2;
  const auto count =
      static_cast<size_t>(cells_) * static_cast<size_t>(cells_) * static_cast<size_t>(cells_);
  first_.assign(count + 1, 0);
  for (Face f = 0; f < state.face_count(); ++f) {
    for_each_cell(triangle(f), [&](size_t cell) { ++first_[cell + 1]; });
  }
  for (size_t c = 0; c < count; ++c) first_[c + 1] += first_[c];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  faces_.resize(static_cast<size_t>(first_.back()));
  for (Face f = 0; f < state.face_count(); ++f) {
    for_each_cell(triangle(f), [&](size_t cell) { faces_[static_cast<size_t>(next[cell]++)] = f; });
  }
}

TriangleCorners SurfaceCells::triangle(Face f) const {
  const auto& [a, b, c] = state_.faces[f];
  return {state_.shape[a], state_.shape[b], state_.shape[c]};
}

std::array<int, 3> SurfaceCells::cell_of(const Vector3& place) const {
  std::array<int, 3> cell;
  for (int k = 0; k < 3; ++k) {
    const double along = (place[k] + 1) / 2 * cells_;
    cell[static_cast<size_t>(k)] = std::clamp(static_cast<int>(along), 0, cells_ - 1);
  }
  return cell;
}

/// Of all faces in cells of this size.
std::int64_t SurfaceCells::entries() const {
  std::int64_t sum = 0;
  for (Face f = 0; f < state_.face_count(); ++f) {
    const TriangleCorners t = triangle(f);
    const auto first = cell_of(t[0].cwiseMin(t[1]).cwiseMin(t[2])),
               last = cell_of(t[0].cwiseMax(t[1]).cwiseMax(t[2]));
    std::int64_t cells = 1;
    for (size_t k = 0; k < 3; ++k) cells *= last[k] - first[k] + 1;
    sum += cells;
  }
  return sum;
}

template <class Visit>
void SurfaceCells::for_each_cell(const TriangleCorners& t, const Visit& visit) const {
  const auto [x0, y0, z0] = cell_of(t[0].cwiseMin(t[1]).cwiseMin(t[2]));
  const auto [x1, y1, z1] = cell_of(t[0].cwiseMax(t[1]).cwiseMax(t[2]));
  for (int x = x0; x <= x1; ++x) {
    for (int y = y0; y <= y1; ++y) {
      for (int z = z0; z <= z1; ++z) visit(static_cast<size_t>((x * cells_ + y) * cells_ + z));
    }
  }
}

long SurfaceCells::crossings(const TriangleCorners& t) const {
  std::vector<Face> crossed;
  for_each_cell(t, [&](size_t cell) {
    for (int i = first_[cell]; i < first_[cell + 1]; ++i) {
      const Face f = faces_[static_cast<size_t>(i)];
      const TriangleCorners other = triangle(f);
      if (!touch(t, other) && triangles_cross(t, other)) crossed.push_back(f);
    }
  });
  std::sort(crossed.begin(), crossed.end());
  return std::unique(crossed.begin(), crossed.end()) - crossed.begin();
}

}  // namespace sphparam
