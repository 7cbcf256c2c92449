#include "bake/image_level.h"

#include <algorithm>
#include <cmath>

namespace sphparam {

ImageLevel::ImageLevel(int fine_width, int fine_height, int channels, FieldKind kind)
    : fine_width_(fine_width),
      channels_(static_cast<size_t>(channels)),
      kind_(kind),
      columns_(box_shares(fine_width, std::max(1, fine_width / 2))),
      rows_(box_shares(fine_height, std::max(1, fine_height / 2))),
      values_(columns_.size() * rows_.size() * channels_, 0.0F) {}

void ImageLevel::add_rows(const float* values, int rows) {
  for (int i = 0; i < rows; ++i, ++next_row_) {
    const float* fine =
        values + static_cast<size_t>(i) * static_cast<size_t>(fine_width_) * channels_;
    // At most two boxes hold the row; the first begins at most three rows before it.
    const auto after = std::ranges::upper_bound(rows_, next_row_, {}, &BoxShares::first);
    for (auto box = after - std::min<std::ptrdiff_t>(2, after - rows_.begin()); box < after;
         ++box) {
      const int offset = next_row_ - box->first;
      if (offset >= 4) continue;
      const float weight = box->weights[static_cast<size_t>(offset)];
      const bool takes = !has_means(kind_) ? offset == 0 : weight > 0;
      if (takes) add_row(fine, static_cast<size_t>(box - rows_.begin()), weight);
    }
  }
}

void ImageLevel::add_row(const float* fine, size_t row, float weight) {
  float* out = &values_[row * columns_.size() * channels_];
  for (const BoxShares& box : columns_) {
    const float* in = fine + static_cast<size_t>(box.first) * channels_;
    if (!has_means(kind_)) {
      std::copy_n(in, channels_, out);
    } else {
      for (size_t k = 0; k < 4 && box.weights[k] > 0; ++k, in += channels_) {
        for (size_t c = 0; c < channels_; ++c) out[c] += weight * box.weights[k] * in[c];
      }
    }
    out += channels_;
  }
}

void ImageLevel::finish() {
  if (kind_ == FieldKind::Direction) make_unit(values_, static_cast<int>(channels_));
}

void make_unit(std::vector<float>& values, int channels) {
  for (size_t i = 0; i + 2 < values.size(); i += static_cast<size_t>(channels)) {
    float* n = &values[i];
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length > 0) std::for_each(n, n + 3, [length](float& x) { x /= length; });
  }
}

}  // namespace sphparam
