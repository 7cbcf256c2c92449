#include "bake/uv_raster.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "sphparam/sphere/orientation.h"

// A piece of the chart is convex, so the texels it owns in a row are neighbours: their two ends are
// estimated from where the row crosses the piece's edges and then moved until exact signs agree.
// Points are (v, u): there, faces are counter-clockwise. A sign of 0 is decided as if the point
// were moved by (−ε², ε): the sign of det(b − a, δ) then is + iff (v, u) of b is lexicographically
// greater than that of a, and the same edge seen from its other face says −.

namespace sphparam::tools {
namespace {

struct UvPoint {
  double v, u;
  auto operator<=>(const UvPoint&) const = default;
};

/// Is p to the left of the edge from a to b, ties decided by the moved point?
bool is_left(const UvPoint& a, const UvPoint& b, const UvPoint& p) {
  const double det = (b.v - a.v) * (p.u - a.u) - (b.u - a.u) * (p.v - a.v);
  const double size = std::abs((b.v - a.v) * (p.u - a.u)) + std::abs((b.u - a.u) * (p.v - a.v));
  // Four roundings of at most 2⁻⁵³ each; products that may have underflowed are left to
  // `orientation`.
  if (size > 1e-280 && std::abs(det) > 0x1p-50 * size) return det > 0;
  const int sign = orientation(Vector3(a.v, a.u, 1), Vector3(b.v, b.u, 1), Vector3(p.v, p.u, 1));
  return sign != 0 ? sign > 0 : a < b;
}

/// The range of u of a convex polygon at a height v, up to rounding.
std::array<double, 2> range_at(std::span<const UvPoint> polygon, double v) {
  double least = 2, greatest = -1;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const UvPoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if (v < std::min(a.v, b.v) || v > std::max(a.v, b.v)) continue;
    const double t = a.v == b.v ? 0 : (v - a.v) / (b.v - a.v), u = a.u + t * (b.u - a.u);
    least = std::min({least, u, a.v == b.v ? b.u : u});
    greatest = std::max({greatest, u, a.v == b.v ? b.u : u});
  }
  return {least, greatest};
}

}  // namespace

/// What a face owns: a convex polygon, counter-clockwise in (v, u).
struct UvRaster::Piece {
  Face face;
  size_t size;  // 3, or 4 at a pole
  std::array<UvPoint, 4> corners;
  std::array<UvPoint, 3> triangle;  // the face's own corners, for the weights
  double low, high;                 // range of v

  Piece(const SphericalChart& chart, Face f) : face(f), size(3) {
    for (int k = 0; k < 3; ++k) {
      const auto uv = chart.uv.row(chart.wedges(f, k));
      triangle[static_cast<size_t>(k)] = {uv[1], uv[0]};
    }
    std::copy(triangle.begin(), triangle.end(), corners.begin());
    if (const int pole = chart.pole_corner(f); pole >= 0) {
      const auto apex = static_cast<size_t>(pole);
      const UvPoint a = triangle[(apex + 1) % 3], b = triangle[(apex + 2) % 3];
      const double rim = triangle[apex].v;
      corners = {a, b, UvPoint{rim, b.u}, UvPoint{rim, a.u}};
      size = 4;
    }
    low = high = corners[0].v;
    for (const UvPoint& corner : outline()) {
      low = std::min(low, corner.v);
      high = std::max(high, corner.v);
    }
  }

  bool holds(const UvPoint& p) const {
    for (size_t k = 0; k < size; ++k) {
      if (!is_left(corners[k], corners[(k + 1) % size], p)) return false;
    }
    return true;
  }

  std::span<const UvPoint> outline() const { return {corners.data(), size}; }

  /// λ₀ = det(p − p₂, p₁ − p₂) / det(p₀ − p₂, p₁ − p₂), λ₁ likewise, of the nearest point of the
  /// triangle at the same v.
  std::array<double, 2> weights(UvPoint p) const {
    if (size == 4) {
      const auto [least, greatest] = range_at(triangle, p.v);
      p.u = std::clamp(p.u, least, greatest);
    }
    const auto& [p0, p1, p2] = triangle;
    const double det = (p0.v - p2.v) * (p1.u - p2.u) - (p0.u - p2.u) * (p1.v - p2.v);
    const double a = ((p.v - p2.v) * (p1.u - p2.u) - (p.u - p2.u) * (p1.v - p2.v)) / det;
    const double b = ((p0.v - p2.v) * (p.u - p2.u) - (p0.u - p2.u) * (p.v - p2.v)) / det;
    const double first = std::clamp(a, 0.0, 1.0);
    return {first, std::clamp(b, 0.0, 1 - first)};
  }
};

UvRaster::UvRaster(const SphericalChart& chart, int width, int height)
    : chart_(&chart), width_(width), height_(height) {
  if (width < 1 || height < 1) {
    throw std::invalid_argument("an image of " + std::to_string(width) + " × " +
                                std::to_string(height) + " texels");
  }
  if (!chart.certificate.one_to_one()) {
    throw std::invalid_argument("a chart that is not one-to-one has texels with two owners");
  }
  const int bands = (height + rows_a_band - 1) / rows_a_band;
  const auto band_of = [&](double v) {
    return std::clamp(static_cast<int>(v * height) / rows_a_band, 0, bands - 1);
  };
  offsets_.assign(static_cast<size_t>(bands) + 1, 0);
  const auto face_count = static_cast<Face>(chart.triangles.rows());
  for (Face f = 0; f < face_count; ++f) {
    const Piece piece(chart, f);
    for (int b = band_of(piece.low); b <= band_of(piece.high); ++b) {
      ++offsets_[static_cast<size_t>(b) + 1];
    }
  }
  for (size_t b = 1; b < offsets_.size(); ++b) offsets_[b] += offsets_[b - 1];
  faces_.resize(static_cast<size_t>(offsets_.back()));
  std::vector<std::int64_t> next(offsets_.begin(), offsets_.end() - 1);
  for (Face f = 0; f < face_count; ++f) {
    const Piece piece(chart, f);
    for (int b = band_of(piece.low); b <= band_of(piece.high); ++b) {
      faces_[static_cast<size_t>(next[static_cast<size_t>(b)]++)] = f;
    }
  }
}

/// Draws the rows of the band that a piece reaches.
void UvRaster::draw(const Piece& piece, double x, double y, RasterBand& band) const {
  const int last_row = band.first_row + band.rows - 1;
  const int top = std::max(band.first_row, static_cast<int>(piece.low * height_ - y) - 1);
  const int bottom = std::min(last_row, static_cast<int>(piece.high * height_ - y) + 1);
  for (int row = top; row <= bottom; ++row) {
    const double v = (row + y) / height_;
    if (v < piece.low || v > piece.high) continue;
    const auto [least, greatest] = range_at(piece.outline(), v);
    const auto inside = [&](int column) { return piece.holds({v, (column + x) / width_}); };
    int first = std::max(0, static_cast<int>(std::floor(least * width_ - x)) - 1);
    int last = std::min(width_ - 1, static_cast<int>(std::ceil(greatest * width_ - x)) + 1);
    while (first <= last && !inside(first)) ++first;
    while (last > first && !inside(last)) --last;
    for (int column = first; column <= last; ++column) {
      const size_t texel = band.index(row, column);
      if (band.faces[texel] >= 0) throw std::logic_error("a texel has two owners");
      band.faces[texel] = piece.face;
      band.weights[texel] = piece.weights({v, (column + x) / width_});
    }
  }
}

RasterBand UvRaster::band(int index, double x, double y) const {
  RasterBand band;
  band.width = width_;
  band.first_row = index * rows_a_band;
  band.rows = std::min(rows_a_band, height_ - band.first_row);
  const size_t texels = static_cast<size_t>(band.rows) * static_cast<size_t>(width_);
  band.faces.assign(texels, -1);
  band.weights.resize(texels);
  const auto at = static_cast<size_t>(index);
  for (auto i = static_cast<size_t>(offsets_[at]); i < static_cast<size_t>(offsets_[at + 1]); ++i) {
    draw(Piece(*chart_, faces_[i]), x, y, band);
  }
  if (std::ranges::find(band.faces, -1) != band.faces.end()) {
    throw std::logic_error("a texel has no owner");
  }
  return band;
}

}  // namespace sphparam::tools
