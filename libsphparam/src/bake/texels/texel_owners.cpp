#include "bake/texels/texel_owners.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "bake/chart_piece.h"

// A piece of the chart is convex, so the texels it owns in a row are neighbours: their two ends are
// estimated from where the row crosses the piece's edges and then moved until exact signs agree.

namespace sphparam {

TexelOwners::TexelOwners(const SphericalChart& chart, int width, int height)
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
    const ChartPiece piece(chart, f);
    for (int b = band_of(piece.low()); b <= band_of(piece.high()); ++b) {
      ++offsets_[static_cast<size_t>(b) + 1];
    }
  }
  for (size_t b = 1; b < offsets_.size(); ++b) offsets_[b] += offsets_[b - 1];
  faces_.resize(static_cast<size_t>(offsets_.back()));
  std::vector<std::int64_t> next(offsets_.begin(), offsets_.end() - 1);
  for (Face f = 0; f < face_count; ++f) {
    const ChartPiece piece(chart, f);
    for (int b = band_of(piece.low()); b <= band_of(piece.high()); ++b) {
      faces_[static_cast<size_t>(next[static_cast<size_t>(b)]++)] = f;
    }
  }
}

/// The runs of one row: one, or, where the trapezoid of a pole goes beyond its triangle, a second
/// and a third of constant weights.
void TexelOwners::add_runs(const ChartPiece& piece, int row, int first, int last, double x,
                           double v, std::vector<TexelRun>& runs) const {
  const auto u = [&](int column) { return (column + x) / width_; };
  const auto add = [&](int from, int to, bool beside) {
    if (from > to) return;
    const std::array<double, 2> here = piece.weights({v, u(from)});
    TexelRun run{piece.face(), row, from, to - from + 1, here, {0, 0}, piece.gradient(0)};
    for (size_t k = 0; k < 2; ++k) {
      run.below[k] /= height_;
      if (!beside) run.step[k] = piece.gradient(1)[k] / width_;
    }
    if (run.count > 1 && !beside) {
      const std::array<double, 2> there = piece.weights({v, u(to)});
      for (size_t k = 0; k < 2; ++k) run.step[k] = (there[k] - here[k]) / (to - from);
    }
    runs.push_back(run);
  };
  if (!piece.is_trapezoid()) return add(first, last, false);
  const auto [least, greatest] = range_at(piece.triangle(), v);
  int inner = first, outer = last;
  while (inner <= last && u(inner) < least) ++inner;
  while (outer >= inner && u(outer) > greatest) --outer;
  add(first, inner - 1, true);
  add(inner, outer, false);
  add(outer + 1, last, true);
}

/// Draws the rows of the band that a piece reaches.
void TexelOwners::draw(const ChartPiece& piece, int band, double x, double y,
                       std::vector<TexelRun>& runs) const {
  const int last_row = first_row(band) + rows(band) - 1;
  const int top = std::max(first_row(band), static_cast<int>(piece.low() * height_ - y) - 1);
  const int bottom = std::min(last_row, static_cast<int>(piece.high() * height_ - y) + 1);
  for (int row = top; row <= bottom; ++row) {
    const double v = (row + y) / height_;
    if (v < piece.low() || v > piece.high()) continue;
    const auto [least, greatest] = range_at(piece.outline(), v);
    const auto inside = [&](int column) { return piece.holds({v, (column + x) / width_}); };
    int first = std::max(0, static_cast<int>(std::floor(least * width_ - x)) - 1);
    int last = std::min(width_ - 1, static_cast<int>(std::ceil(greatest * width_ - x)) + 1);
    while (first <= last && !inside(first)) ++first;
    while (last > first && !inside(last)) --last;
    if (first <= last) add_runs(piece, row, first, last, x, v, runs);
  }
}

std::span<const Face> TexelOwners::faces(int band) const {
  const auto first = static_cast<size_t>(offsets_[static_cast<size_t>(band)]);
  const auto last = static_cast<size_t>(offsets_[static_cast<size_t>(band) + 1]);
  return std::span(faces_).subspan(first, last - first);
}

std::vector<TexelRun> TexelOwners::runs(int band, double x, double y) const {
  std::vector<TexelRun> drawn;
  for (const Face f : faces(band)) draw(ChartPiece(*chart_, f), band, x, y, drawn);
  // Keys and indices in one number each, which is what sorts fastest.
  const auto place = [&](const TexelRun& run) {
    return static_cast<std::int64_t>(run.row) * width_ + run.first;
  };
  const std::int64_t start = static_cast<std::int64_t>(first_row(band)) * width_;
  std::vector<std::uint64_t> order(drawn.size());
  for (size_t i = 0; i < drawn.size(); ++i) {
    order[i] = static_cast<std::uint64_t>(place(drawn[i]) - start) << 32 | i;
  }
  std::ranges::sort(order);
  std::vector<TexelRun> runs;
  runs.reserve(drawn.size());
  std::int64_t next = start;
  for (const std::uint64_t key : order) {
    const TexelRun& run = drawn[key & 0xffffffff];
    const std::int64_t at = place(run);
    if (at != next)
      throw std::logic_error(at < next ? "a texel has two owners" : "a texel has no owner");
    runs.push_back(run);
    next += run.count;
  }
  if (next != static_cast<std::int64_t>(first_row(band) + rows(band)) * width_) {
    throw std::logic_error("a texel has no owner");
  }
  return runs;
}

OwnerBand TexelOwners::band(int index, double x, double y) const {
  OwnerBand band{width_, first_row(index), rows(index), {}, {}};
  const size_t texels = static_cast<size_t>(band.rows) * static_cast<size_t>(width_);
  band.faces.reserve(texels);
  band.weights.reserve(texels);
  for (const TexelRun& run : runs(index, x, y)) {
    for (int i = 0; i < run.count; ++i) {
      band.faces.push_back(run.face);
      band.weights.push_back({run.weights[0] + i * run.step[0], run.weights[1] + i * run.step[1]});
    }
  }
  return band;
}

}  // namespace sphparam
