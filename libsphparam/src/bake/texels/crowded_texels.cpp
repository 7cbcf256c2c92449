// Triangles that are small against a texel mark the texels they touch; then all triangles are
// clipped to those texels.

#include "bake/texels/crowded_texels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/chart_piece.h"
#include "bake/texels/calm_walls.h"
#include "mesh/triangle_geometry.h"

namespace sphparam {
namespace {

constexpr double small_area = 0.5;  // of a texel: such a triangle may own none, wherever it lies

constexpr double finest_grid = 8;  // points in a texel, to the east or to the south

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

/// A point of a texel.
struct Deposit {
  size_t texel;
  TexelRun place;
  SurfaceRun run;
  double weight;
};

/// What positions are multiplied by before areas are taken of them, a power of two, so that no bit
/// is lost: weights are relative, and squares must be numbers. By some of the positions: this is
/// asked for every band.
double to_unit_size(const Points& positions) {
  constexpr int greatest = 1023;  // 2¹⁰²⁴ is infinite, and subnormal coordinates ask for more
  constexpr Eigen::Index enough = 1000;
  double extent = 0;
  for (Eigen::Index i = 0; i < positions.rows(); i += 1 + positions.rows() / enough)
    extent = std::max(extent, positions.row(i).cwiseAbs().maxCoeff());
  return extent > 0 ? std::ldexp(1.0, std::min(greatest, -std::ilogb(extent))) : 1;
}

/// Of what the two steps span on the surface, at unit size.
double area_of_step(const TriangleMesh& mesh, double scale, const SurfaceRun& run) {
  Vector3 step = Vector3::Zero(), below = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector3 corner = scale * mesh.position(mesh.triangles(run.face, k));
    step += run.step[k] * corner;
    below += run.below[k] * corner;
  }
  return step.cross(below).norm();
}

class Collector {
 public:
  Collector(const BakeScene& scene, const TexelFinder& finder, int band)
      : target_(scene.target),
        finder_(finder),
        owners_(finder.owners()),
        band_(band),
        width_(finder.owners().width()),
        marked_(static_cast<size_t>(finder.owners().rows(band)) * static_cast<size_t>(width_), 0),
        row_marked_(static_cast<size_t>(finder.owners().rows(band)), 0) {}

  std::vector<Deposit> collect() {
    bool any = false;
    const double limit = small_area / (static_cast<double>(width_) * owners_.height());
    for (const Face f : owners_.faces(band_)) {
      const ChartPiece piece(target_.chart, f);
      if (piece.is_trapezoid() || piece.area() >= limit) continue;
      any = true;
      for_each_strip(piece, [&](int row, Clip&, int first, int last) {
        row_marked_[static_cast<size_t>(row)] = 1;
        std::fill(mark(row, first), mark(row, last) + 1, char{1});
      });
    }
    if (!any) return {};
    for (const Face f : owners_.faces(band_)) add(ChartPiece(target_.chart, f));
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
    const double height = owners_.height();
    const int first_row = owners_.first_row(band_);
    const int top = std::max(0, static_cast<int>(piece.low() * height) - first_row);
    const int bottom =
        std::min(owners_.rows(band_) - 1, static_cast<int>(piece.high() * height) - first_row);
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
    const double share = std::sqrt(area * width_ * owners_.height());
    TexelRun place{piece.face(),
                   owners_.first_row(band_) + row,
                   column,
                   1,
                   piece.weights(centre),
                   piece.gradient(1),
                   piece.gradient(0)};
    for (size_t k = 0; k < 2; ++k) {
      place.step[k] *= share / width_;
      place.below[k] *= share / owners_.height();
    }
    deposits_.push_back({.texel = static_cast<size_t>(mark(row, column) - marked_.begin()),
                         .place = place,
                         .run = finder_.run_in_source(place),
                         .weight = area * density});
  }

  double surface_area(Face f) const {
    const auto corner = [&](int k) -> Vector3 {
      return scale_ * target_.positions.row(target_.chart.triangles(f, k));
    };
    return triangle_area(corner(0), corner(1), corner(2));
  }

  const BakeTarget& target_;
  double scale_ = to_unit_size(target_.positions);
  const TexelFinder& finder_;
  const TexelOwners& owners_;
  int band_, width_;
  std::vector<char> marked_, row_marked_;
  std::vector<Deposit> deposits_;
};

/// How many points to the east and to the south for a texel that spans so many triangles there.
GridSize grid_size(const SurfaceRun& run) {
  const auto points = [](const Vector3& spanned) {
    const double triangles = spanned.cwiseAbs().maxCoeff();
    return triangles > 1 ? static_cast<int>(std::min(std::ceil(triangles + 0.5), finest_grid)) : 1;
  };
  return {points(run.step), points(run.below)};
}

/// The grid of each texel for itself. What a wall hides needs none.
std::vector<GridSize> own_grids(const CalmWalls* walls, const TexelPoints& centres) {
  std::vector<GridSize> sizes;
  sizes.reserve(centres.runs.size());
  for (const TexelRun& place : centres.places) {
    for (int i = 0; i < place.count; ++i) {
      const SurfaceRun& shown = centres.runs[sizes.size()];
      GridSize size = grid_size(shown);
      if (size.count() > 1 && walls && walls->hides(place.at(i), shown)) size = {};
      sizes.push_back(size);
    }
  }
  return sizes;
}

/// The grid of each texel: more than a point in texels that span more than a triangle, or have
/// neighbours that do.
std::vector<GridSize> grids_of(const CalmWalls* walls, const TexelOwners& owners, int band,
                               const TexelPoints& centres) {
  const int width = owners.width(), rows = owners.rows(band);
  const std::vector<GridSize> own = own_grids(walls, centres);
  std::vector<GridSize> grids(own.size());
  const auto texel = [&](int row, int column) {
    return static_cast<size_t>(row) * static_cast<size_t>(width) +
           static_cast<size_t>((column + width) % width);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < width; ++column) {
      const GridSize size = own[texel(row, column)];
      if (size.count() == 1) continue;
      for (int r = std::max(0, row - 1); r <= std::min(rows - 1, row + 1); ++r) {
        for (int c = column - 1; c <= column + 1; ++c) grids[texel(r, c)].include(size);
      }
    }
  }
  return grids;
}

/// Texels that have come together until there are enough to be worked on.
class Gatherer {
 public:
  explicit Gatherer(const std::function<void(const CrowdedTexels&)>& visit) : visit_(visit) {}

  /// A texel whose points are the last of `gathered.points.runs`, each with its area.
  void add(size_t texel, std::span<const double> areas) {
    std::vector<SurfaceRun>& runs = gathered.points.runs;
    double total = 0;
    for (const double area : areas) total += area;
    if (!(total > 0)) {  // nothing there has an area, and the centre's value stays
      runs.resize(runs.size() - areas.size());
      gathered.points.places.resize(places_);
      return;
    }
    const size_t first = gathered.weights.size();
    gathered.texels.push_back({texel, first, first + areas.size()});
    for (const double area : areas) gathered.weights.push_back(static_cast<float>(area / total));
    places_ = gathered.points.places.size();
    if (runs.size() >= points_together) hand_on();
  }

  void hand_on() {
    if (gathered.texels.empty()) return;
    visit_(gathered);
    gathered.before += std::ssize(gathered.points.runs);
    gathered.texels.clear();
    gathered.points.runs.clear();
    gathered.points.places.clear();
    gathered.weights.clear();
    places_ = 0;
  }

  CrowdedTexels gathered;

 private:
  static constexpr size_t points_together = 4096;  // some more: texels are whole

  const std::function<void(const CrowdedTexels&)>& visit_;
  size_t places_ = 0;  // of the texels that are kept
};

/// Of each texel that gets a grid.
void gather_grids(const BakeScene& scene, const TexelFinder& finder, int band,
                  const TexelPoints& centres, bool calm, Gatherer& gatherer) {
  const CalmWalls* walls = calm ? scene.walls.get() : nullptr;
  const std::vector<GridSize> grids = grids_of(walls, finder.owners(), band, centres);
  std::vector<SurfaceRun>& runs = gatherer.gathered.points.runs;
  const TriangleMesh& mesh = scene.source.mesh();
  const double scale = to_unit_size(mesh.positions);
  std::vector<double> areas;
  size_t i = 0;
  for (const TexelRun& run : centres.places) {
    for (int k = 0; k < run.count; ++k, ++i) {
      const GridSize size = grids[i];
      if (size.count() == 1) continue;
      TexelRun place = run;
      for (size_t c = 0; c < 2; ++c) place.weights[c] += k * run.step[c];
      place.first += k;
      const size_t first = runs.size();
      finder.grid(place, size, centres.runs[i].face, runs);
      areas.clear();
      for (size_t s = first; s < runs.size(); ++s)
        areas.push_back(area_of_step(mesh, scale, runs[s]));
      place.count = size.count();
      place.step = {0, 0};  // all of them show what the texel's middle is to be lit by
      gatherer.gathered.points.places.push_back(place);
      gatherer.add(i, areas);
    }
  }
}

/// Of the texels that have deposits. Requires: in the order of the texels.
void gather_crowds(const std::vector<Deposit>& deposits, Gatherer& gatherer) {
  std::vector<double> areas;
  for (auto first = deposits.begin(); first != deposits.end();) {
    const size_t texel = first->texel;
    areas.clear();
    for (; first != deposits.end() && first->texel == texel; ++first) {
      gatherer.gathered.points.places.push_back(first->place);
      gatherer.gathered.points.runs.push_back(first->run);
      areas.push_back(first->weight);
    }
    gatherer.add(texel, areas);
  }
}

}  // namespace

void for_crowded_texels(const BakeScene& scene, const TexelFinder& finder, int band,
                        const TexelPoints& centres, bool calm,
                        const std::function<void(const CrowdedTexels&)>& visit) {
  Gatherer gatherer(visit);
  if (finder.by_location())
    gather_grids(scene, finder, band, centres, calm, gatherer);
  else
    gather_crowds(Collector(scene, finder, band).collect(), gatherer);
  gatherer.hand_on();
}

}  // namespace sphparam
