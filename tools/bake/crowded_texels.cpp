// Triangles that are small against a texel mark the texels they touch; then all triangles are
// clipped to those texels.

#include "bake/crowded_texels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/chart_piece.h"

namespace sphparam::tools {
namespace {

constexpr double small_area = 0.5;  // of a texel: such a triangle may own none, wherever it lies

/// A convex polygon under clipping: each of four cuts adds a corner at most.
struct Clip {
  std::array<UvPoint, 8> points;
  size_t size = 0;

  explicit Clip(std::span<const UvPoint> outline) : points{}, size(outline.size()) {
    std::ranges::copy(outline, points.begin());
  }

  /// Keeps what has sign·(coordinate − limit) ≥ 0.
  void cut(double UvPoint::*coordinate, double limit, int sign) {
    std::array<UvPoint, 8> kept{};
    size_t count = 0;
    for (size_t k = 0; k < size; ++k) {
      const UvPoint &a = points[k], &b = points[(k + 1) % size];
      const double in_a = sign * (a.*coordinate - limit), in_b = sign * (b.*coordinate - limit);
      if (in_a >= 0 && count < kept.size()) kept[count++] = a;
      if ((in_a < 0) != (in_b < 0) && count < kept.size()) {
        const double t = in_a / (in_a - in_b);
        kept[count] = {a.v + t * (b.v - a.v), a.u + t * (b.u - a.u)};
        kept[count++].*coordinate = limit;
      }
    }
    points = kept;
    size = count;
  }

  /// Area and centroid.
  std::pair<double, UvPoint> measure() const {
    double twice = 0, v = 0, u = 0;
    for (size_t k = 1; k + 1 < size; ++k) {
      const UvPoint &a = points[0], &b = points[k], &c = points[k + 1];
      const double part = (b.v - a.v) * (c.u - a.u) - (b.u - a.u) * (c.v - a.v);
      twice += part;
      v += part * (a.v + b.v + c.v) / 3;
      u += part * (a.u + b.u + c.u) / 3;
    }
    return {twice / 2, {v / twice, u / twice}};
  }
};

struct Deposit {
  size_t texel;
  RasterRun place;
  double weight;
};

class Collector {
 public:
  Collector(const BakeScene& scene, const UvRaster& raster, int band)
      : target_(scene.target),
        raster_(raster),
        band_(band),
        width_(raster.width()),
        marked_(static_cast<size_t>(raster.rows(band)) * static_cast<size_t>(width_), 0),
        row_marked_(static_cast<size_t>(raster.rows(band)), 0) {}

  std::vector<Deposit> collect() {
    bool any = false;
    const double limit = small_area / (static_cast<double>(width_) * raster_.height());
    for (const Face f : raster_.faces(band_)) {
      const ChartPiece piece(target_.chart, f);
      if (piece.is_trapezoid() || piece.area() >= limit) continue;
      any = true;
      for_each_strip(piece, [&](int row, Clip&, int first, int last) {
        row_marked_[static_cast<size_t>(row)] = 1;
        std::fill(mark(row, first), mark(row, last) + 1, char{1});
      });
    }
    if (!any) return {};
    for (const Face f : raster_.faces(band_)) add(ChartPiece(target_.chart, f));
    std::ranges::stable_sort(deposits_, {}, &Deposit::texel);
    return std::move(deposits_);
  }

 private:
  std::vector<char>::iterator mark(int row, int column) {
    return marked_.begin() + static_cast<std::ptrdiff_t>(row) * width_ + column;
  }

  /// visit(row of the band, what lies in it, first and last column it may touch).
  template <class Visit>
  void for_each_strip(const ChartPiece& piece, Visit&& visit) {
    const double height = raster_.height();
    const int first_row = raster_.first_row(band_);
    const int top = std::max(0, static_cast<int>(piece.low() * height) - first_row);
    const int bottom =
        std::min(raster_.rows(band_) - 1, static_cast<int>(piece.high() * height) - first_row);
    for (int row = top; row <= bottom; ++row) {
      Clip strip(piece.outline());
      strip.cut(&UvPoint::v, (first_row + row) / height, 1);
      strip.cut(&UvPoint::v, (first_row + row + 1) / height, -1);
      if (strip.size < 3) continue;
      double least = 1, greatest = 0;
      for (size_t k = 0; k < strip.size; ++k) {
        least = std::min(least, strip.points[k].u);
        greatest = std::max(greatest, strip.points[k].u);
      }
      visit(row, strip, std::clamp(static_cast<int>(least * width_), 0, width_ - 1),
            std::clamp(static_cast<int>(greatest * width_), 0, width_ - 1));
    }
  }

  void add(const ChartPiece& piece) {
    const double outline = piece.area();
    if (!(outline > 0)) return;
    const double density = surface_area(piece.face()) / outline;
    for_each_strip(piece, [&](int row, const Clip& strip, int first, int last) {
      if (!row_marked_[static_cast<size_t>(row)]) return;
      for (int column = first; column <= last; ++column) {
        if (!*mark(row, column)) continue;
        Clip part = strip;
        part.cut(&UvPoint::u, static_cast<double>(column) / width_, 1);
        part.cut(&UvPoint::u, static_cast<double>(column + 1) / width_, -1);
        const auto [area, centre] = part.measure();
        if (area > 0) deposit(piece, row, column, area, density, centre);
      }
    });
  }

  /// A point stands for as much of the texel as it has of its area, also for texture filters.
  void deposit(const ChartPiece& piece, int row, int column, double area, double density,
               const UvPoint& centre) {
    const double share = std::sqrt(area * width_ * raster_.height());
    RasterRun place{piece.face(),
                    raster_.first_row(band_) + row,
                    column,
                    1,
                    piece.weights(centre),
                    piece.gradient(1),
                    piece.gradient(0)};
    for (size_t k = 0; k < 2; ++k) {
      place.step[k] *= share / width_;
      place.below[k] *= share / raster_.height();
    }
    deposits_.push_back(
        {static_cast<size_t>(mark(row, column) - marked_.begin()), place, area * density});
  }

  double surface_area(Face f) const {
    const auto corner = [&](int k) -> Vector3 {
      return target_.positions.row(target_.chart.triangles(f, k));
    };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
  }

  const BakeTarget& target_;
  const UvRaster& raster_;
  int band_, width_;
  std::vector<char> marked_, row_marked_;
  std::vector<Deposit> deposits_;
};

}  // namespace

CrowdedTexels::CrowdedTexels(const BakeScene& scene, const TexelFinder& finder, int band) {
  const std::vector<Deposit> deposits = Collector(scene, finder.raster(), band).collect();
  for (size_t i = 0; i < deposits.size();) {
    size_t end = i;
    double total = 0;
    while (end < deposits.size() && deposits[end].texel == deposits[i].texel) {
      total += deposits[end++].weight;
    }
    if (total > 0) {  // else nothing there has an area, and the centre's value stays
      texels.push_back({deposits[i].texel, weights.size(), weights.size() + end - i});
      for (; i < end; ++i) {
        weights.push_back(static_cast<float>(deposits[i].weight / total));
        points.places.push_back(deposits[i].place);
        points.runs.push_back(finder.run_in_source(deposits[i].place));
      }
    }
    i = end;
  }
}

}  // namespace sphparam::tools
