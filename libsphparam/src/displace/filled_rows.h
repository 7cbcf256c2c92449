#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "displace/displacement.h"
#include "displace/normal_line.h"
#include "sphparam/parallel.h"

namespace sphparam {

/// What became of some texels.
struct Tally {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  std::int64_t hits[3] = {}, inexact = 0;

  void add(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  void add(const Tally& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
    for (int i = 0; i < 3; ++i) hits[i] += other.hits[i];
    inexact += other.inexact;
  }
  /// As an image holds them: `greatest` of the figures tells where that is not the height.
  void store(std::span<const NormalLines::Crossing> crossings, float* pixels) {
    constexpr double most = std::numeric_limits<float>::max();
    for (const NormalLines::Crossing& crossing : crossings) {
      ++hits[static_cast<int>(crossing.hit)];
      add(crossing.height);
      *pixels++ = static_cast<float>(std::clamp(crossing.height, -most, most));
    }
  }
  DisplacementFigures figures() const {
    return {least,
            greatest,
            hits[static_cast<int>(LineHit::Walk)],
            hits[static_cast<int>(LineHit::Ray)],
            hits[static_cast<int>(LineHit::Near)],
            inexact};
  }
};

/// Fills an image in runs of rows: fill(first, last, image) gives a tally of these rows.
template <class Fill>
Displacement filled_rows(int width, int height, const DisplacementOptions& options,
                         const Fill& fill) {
  // Of a thread. The first of them costs five times as much as the others; the fewer there are, the
  // more threads share a small image.
  constexpr std::int64_t rows_at_once = 32;
  constexpr std::int64_t rows_between = 512;  // looks whether to go on
  Displacement result;
  result.image = Image(width, height, 1);
  Tally all;
  for (std::int64_t first = 0; first < height; first += rows_between) {
    report(options.progress, "displacement", static_cast<double>(first) / height);
    const std::int64_t count = std::min<std::int64_t>(rows_between, height - first);
    std::vector<Tally> tallies(static_cast<size_t>((count + rows_at_once - 1) / rows_at_once));
    parallel_for(count, rows_at_once, options.threads, [&](std::int64_t from, std::int64_t to) {
      tallies[static_cast<size_t>(from / rows_at_once)] =
          fill(first + from, first + to, result.image);
    });
    for (const Tally& tally : tallies) all.add(tally);
  }
  result.figures = all.figures();
  return result;
}

}  // namespace sphparam
