#pragma once

#include <vector>

#include "bake/surface_field.h"
#include "texture/box_shares.h"

namespace sphparam {

/// The level below another of an image: half as wide and high, rounded down, at least 1. Made as
/// rows of the finer level come: means of boxes, the first texel for labels.
class ImageLevel {
 public:
  ImageLevel(int fine_width, int fine_height, int channels, FieldKind kind);

  /// Rows of the finer level, from its top.
  void add_rows(const float* values, int rows);
  /// After the last: makes directions unit again.
  void finish();

  int width() const { return static_cast<int>(columns_.size()); }
  int height() const { return static_cast<int>(rows_.size()); }
  const std::vector<float>& values() const { return values_; }

 private:
  void add_row(const float* fine, size_t row, float weight);

  int fine_width_, next_row_ = 0;
  size_t channels_;
  FieldKind kind_;
  std::vector<BoxShares> columns_, rows_;
  std::vector<float> values_;
};

/// Divides the first three of so many channels by their length, where it is not zero.
void make_unit(std::vector<float>& values, int channels);

}  // namespace sphparam
