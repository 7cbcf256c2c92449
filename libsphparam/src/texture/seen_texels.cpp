#include "texture/seen_texels.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "texture/wrapped.h"

// A bilinear look-up at a place touches the texels whose middles are nearer than a texel in both
// directions: of a triangle those near the part of it that lies within a texel of their row.

namespace sphparam {
namespace {

constexpr float touched_share = 1 / 1024.0F;

using Corners = SeenTexels::Corners;

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

/// How far the part of a triangle between two heights reaches; nothing: low > high.
Span span_between(const Corners& corners, double top, double bottom) {
  Span span;
  for (size_t k = 0; k < 3; ++k) {
    const auto &a = corners[k], &b = corners[(k + 1) % 3];
    if (a[1] >= top && a[1] <= bottom) span.add(a[0]);
    for (const double y : {top, bottom}) {
      if ((a[1] < y) == (b[1] < y)) continue;
      span.add(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    }
  }
  return span;
}

void mark(std::vector<char>& marks, size_t texel) {
  std::atomic_ref<char>(marks[texel]).store(1, std::memory_order_relaxed);
}

}  // namespace

SeenTexels::SeenTexels(int width, int height)
    : width_(width),
      height_(height),
      inside_(static_cast<size_t>(width) * static_cast<size_t>(height), 0),
      touched_(inside_.size(), 0) {}

void SeenTexels::add(const Corners& corners, TextureWrap wrap_s, TextureWrap wrap_t) {
  Span rows;
  for (const auto& corner : corners) rows.add(corner[1]);
  const auto add_row = [&](std::vector<char>& marks, int row, double low, double high) {
    if (!(low <= high)) return;
    const size_t start =
        static_cast<size_t>(wrapped(row, height_, wrap_t)) * static_cast<size_t>(width_);
    const auto last = static_cast<int>(std::floor(high - 0.5));
    for (auto c = static_cast<int>(std::ceil(low - 0.5)); c <= last; ++c)
      mark(marks, start + static_cast<size_t>(wrapped(c, width_, wrap_s)));
  };
  const auto last = static_cast<int>(std::floor(rows.high + 0.5));
  for (auto row = static_cast<int>(std::ceil(rows.low - 1.5)); row <= last; ++row) {
    const double middle = row + 0.5;
    const Span near = span_between(corners, middle - 1, middle + 1);
    add_row(touched_, row, near.low - 1, near.high + 1);
    const Span across = span_between(corners, middle, middle);
    add_row(inside_, row, across.low, across.high);
  }
}

float SeenTexels::weight(std::size_t texel) const {
  if (all() || inside_[texel]) return 1;
  return touched_[texel] ? touched_share : 0;
}

}  // namespace sphparam
