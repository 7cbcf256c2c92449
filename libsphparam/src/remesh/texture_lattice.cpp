// A vertex at x cells of a tile lies at texel gutter + steps·x of it; in the equirectangular chart,
// which has no gutter, between texels: at steps·x − ½.

#include "remesh/texture_lattice.h"

#include <algorithm>
#include <stdexcept>

#include "remesh/grids/grid_family.h"
#include "remesh/subdivision/patch_net.h"

namespace sphparam {

namespace {

const GridFamily& charted(const GridSpec& spec) {
  const GridFamily& family = family_of(spec.kind);
  if (!family.chart) throw std::invalid_argument(name_of(spec) + " has no layout in an image");
  return family;
}

/// How far a place is out of its triangle.
double outside(const LimitPlace& place) {
  return std::max({-place.s, -place.t, place.s + place.t - 1});
}

}  // namespace

TextureLattice::TextureLattice(const GridSpec& spec, const SphereGrid& grid,
                               const TextureLayout& layout)
    : cells_(charted(spec).chart_cells(spec)),
      corners_(charted(spec).chart(spec, grid)),
      layout_(layout),
      starts_(grid.faces.starts) {
  const auto cells_of_tile = static_cast<size_t>(cells_.width) * static_cast<size_t>(cells_.height);
  faces_.assign(cells_of_tile * static_cast<size_t>(cells_.columns * cells_.rows), {-1, -1});
  for (std::int64_t f = 0; f < grid.faces.count(); ++f) {
    TexelPoint middle = TexelPoint::Zero();
    const int first = starts_[static_cast<size_t>(f)], degree = grid.faces.degree(f);
    for (int k = 0; k < degree; ++k) middle += cells(first + k) / degree;
    const auto tile = static_cast<size_t>(corners_[static_cast<size_t>(first)].tile);
    const auto cell = tile * cells_of_tile +
                      static_cast<size_t>(middle.y()) * static_cast<size_t>(cells_.width) +
                      static_cast<size_t>(middle.x());
    faces_[cell][faces_[cell][0] < 0 ? 0 : 1] = static_cast<int>(f);
  }
}

TexelPoint TextureLattice::cells(int index) const {
  const ChartCorner& corner = corners_[static_cast<size_t>(index)];
  return {corner.x, corner.y};
}

TexelPoint TextureLattice::corner(int index) const {
  const int tile = corners_[static_cast<size_t>(index)].tile;
  if (cells_.closed) return (layout_.steps * cells(index)).array() - 0.5;
  const TexelPoint top_left(tile % cells_.columns * (layout_.width / cells_.columns),
                            tile / cells_.columns * (layout_.height / cells_.rows));
  return (top_left + layout_.steps * cells(index)).array() + layout_.gutter;
}

Eigen::Vector2d TextureLattice::coordinates(const TexelPoint& point) const {
  return {(point.x() + 0.5) / layout_.width, 1 - (point.y() + 0.5) / layout_.height};
}

TexelPoint TextureLattice::point(const LimitPlace& on_face) const {
  const int first = starts_[static_cast<size_t>(on_face.patch)],
            last = starts_[static_cast<size_t>(on_face.patch) + 1] - 1;
  const TexelPoint origin = corner(first);
  return origin + on_face.s * (corner(first + 1) - origin) + on_face.t * (corner(last) - origin);
}

LimitPlace TextureLattice::on_face(int face, const TexelPoint& at) const {
  const int first = starts_[static_cast<size_t>(face)],
            last = starts_[static_cast<size_t>(face) + 1] - 1;
  const TexelPoint origin = cells(first), s = cells(first + 1) - origin, t = cells(last) - origin,
                   from = at - origin;
  const double area = s.x() * t.y() - s.y() * t.x();
  return {face, (from.x() * t.y() - from.y() * t.x()) / area,
          (s.x() * from.y() - s.y() * from.x()) / area};
}

TextureLattice::InTile TextureLattice::in_tile(int column, int row) const {
  if (cells_.closed) {
    const TexelPoint at((column + 0.5) / layout_.steps, (row + 0.5) / layout_.steps);
    return {0, at, at};
  }
  const int wide = layout_.width / cells_.columns, high = layout_.height / cells_.rows;
  const TexelPoint at(static_cast<double>(column % wide - layout_.gutter) / layout_.steps,
                      static_cast<double>(row % high - layout_.gutter) / layout_.steps);
  return {
      row / high * cells_.columns + column / wide,
      at,
      {std::clamp<double>(at.x(), 0, cells_.width), std::clamp<double>(at.y(), 0, cells_.height)}};
}

int TextureLattice::face_at(int tile, const TexelPoint& at) const {
  const int x = std::min(static_cast<int>(at.x()), cells_.width - 1),
            y = std::min(static_cast<int>(at.y()), cells_.height - 1);
  const auto [first, second] =
      faces_[static_cast<size_t>((tile * cells_.height + y) * cells_.width + x)];
  if (second < 0) return first;
  return outside(on_face(first, at)) <= outside(on_face(second, at)) ? first : second;
}

LimitPlace TextureLattice::place(int column, int row) const {
  const InTile found = in_tile(column, row);
  const int face = face_at(found.tile, found.inside);
  const bool at_a_corner = found.at.x() != found.inside.x() && found.at.y() != found.inside.y();
  const LimitPlace place = on_face(face, at_a_corner ? found.inside : found.at);
  const bool beside_a_pole =
      cells_.closed &&
      starts_[static_cast<size_t>(face) + 1] - starts_[static_cast<size_t>(face)] == 3;
  return beside_a_pole ? clamped(place, 3) : place;
}

}  // namespace sphparam
