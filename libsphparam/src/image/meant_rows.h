#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "image/image_codec.h"

namespace sphparam {

/// The nearest number that has 16 bits, as a float; even ones where two are as near.
float rounded_to_half(float x);

/// What the rows of an image are to be, in some bytes a row instead of the rows: whether rows that
/// are read back are these can be told without keeping the image.
///
/// A row that is not the same is told for certain where one sample differs, else but for one case
/// in 2^64. JPEG does not keep samples: there it is the mean of each channel over 16 rows that
/// must come back, within a quarter of the range: four texels share a colour there and are cut to
/// the range afterwards, which moves a mean by 56.5 of 255 at worst (black and yellow in turn), and
/// rounding adds a little.
class MeantRows {
 public:
  MeantRows(int width, int channels, SampleType type, bool keeps_samples);

  /// The next rows, as an `ImageWriter` takes them.
  void add(const void* samples, int rows);
  int count() const { return static_cast<int>(marks_.size() / marks_per_row_); }

  /// As many rows as are compared at once; the last may be fewer.
  static constexpr int rows_at_once = 64;
  /// Says where rows read back differ; empty where they are as meant. Requires: `first_row` a
  /// multiple of `rows_at_once`, `rows` that many, or those to the end.
  std::string difference(const void* samples, int first_row, int rows) const;

 private:
  using Marks = std::vector<std::uint64_t>;
  void add_marks(const void* samples, int rows, Marks& marks) const;
  bool are_close(Marks::const_iterator found, Marks::const_iterator meant, int rows) const;

  std::size_t samples_per_row_, channels_;
  SampleType type_;
  bool keeps_samples_;
  std::size_t marks_per_row_;  // a digest, or the sum of each channel
  Marks marks_;                // row after row
};

}  // namespace sphparam
