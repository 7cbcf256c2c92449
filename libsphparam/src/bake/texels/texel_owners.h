#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

class ChartPiece;

/// Neighbouring texels of a row that one face owns. Texel `first` + i has the weights
/// `weights` + i·step of the face's corners 0 and 1 (corner 2 has the rest), within [0, 1].
struct TexelRun {
  Face face;  // of the chart
  int row, first, count;
  std::array<double, 2> weights, step;
  std::array<double, 2> below;  // what the weights change by from a row to the next

  SurfacePoint at(int i) const {
    const double a = weights[0] + i * step[0], b = weights[1] + i * step[1];
    return {face, {a, b, 1 - a - b}};
  }
};

/// Who owns which texel of some rows of an image.
struct OwnerBand {
  int width = 0, first_row = 0, rows = 0;
  std::vector<Face> faces;  // rows·width, row by row: chart faces, never −1
  // Of the face's corners 0 and 1; corner 2 has the rest.
  std::vector<std::array<double, 2>> weights;

  size_t index(int row, int column) const {
    return static_cast<size_t>(row - first_row) * static_cast<size_t>(width) +
           static_cast<size_t>(column);
  }
  Vector3 barycentric(size_t texel) const {
    const auto& [a, b] = weights[texel];
    return {a, b, 1 - a - b};
  }
};

/// Gives every texel of a width×height image of a chart to exactly one of its faces.
///
/// The point asked for is u = (column + x)/width, v = (row + y)/height, rounded to doubles,
/// 0 < x, y < 1; (x, y) = (½, ½) is the texel's centre. On an edge or at a vertex the owner is the
/// face that a point a little to the east, and much less to the north, belongs to. A face with a
/// corner at ±z owns the whole trapezoid between its link edge and v = 0 or 1; beyond its triangle
/// the weights are those of the nearest point of the triangle at the same v, so that neighbours
/// agree where their trapezoids meet. Signs are exact: no gap, no double. Our own: the chart covers
/// the rectangle once, and the rule picks one side of every edge.
class TexelOwners {
 public:
  /// Requires: width, height ≥ 1; chart.certificate.one_to_one(); the chart outlives the owners.
  /// Throws: std::invalid_argument if not. Cost: 4 bytes for each band that a face
  /// reaches.
  TexelOwners(const SphericalChart& chart, int width, int height);

  /// Rows are handled in bands, to be worked on in parallel.
  static constexpr int rows_a_band = 32;
  int band_count() const { return static_cast<int>(offsets_.size()) - 1; }

  /// The owners of a band's texels, row by row from the west.
  /// Ensures: every texel is in one run. Throws: std::logic_error if one has no owner or two: the
  /// chart was none that its certificate calls one-to-one. Cost: some ten signs for each row a
  /// face reaches, and a sort of the runs.
  std::vector<TexelRun> runs(int band, double x = 0.5, double y = 0.5) const;

  /// The same texel by texel. Cost: one visit a texel more.
  OwnerBand band(int band, double x = 0.5, double y = 0.5) const;

  int first_row(int band) const { return band * rows_a_band; }
  int rows(int band) const { return std::min(rows_a_band, height_ - first_row(band)); }
  /// The faces that reach into a band, ascending; a few more at its rim.
  std::span<const Face> faces(int band) const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void draw(const ChartPiece& piece, int band, double x, double y,
            std::vector<TexelRun>& runs) const;
  void add_runs(const ChartPiece& piece, int row, int first, int last, double x, double v,
                std::vector<TexelRun>& runs) const;

  const SphericalChart* chart_;
  int width_, height_;
  std::vector<std::int64_t> offsets_;  // per band, into faces_
  std::vector<Face> faces_;            // that reach a band, ascending
};

}  // namespace sphparam
