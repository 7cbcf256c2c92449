// A digest takes eight bytes at a time: h ← (h ⊕ word)·odd, then its high bits into its low ones.
// Each step is one-to-one in h and in the word, so one changed word always changes the digest.

#include "image/meant_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "image/image_writer.h"

namespace sphparam {
namespace {

constexpr int rows_of_means = 16;  // a JPEG block of colours covers as many
constexpr double close_means = 255.0 / 4;

std::uint64_t digest_of(const void* bytes, std::size_t size) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
  std::uint64_t digest = size;
  const auto* at = static_cast<const char*>(bytes);
  for (std::size_t left = size; left > 0;) {
    std::uint64_t word = 0;
    const std::size_t count = std::min(left, sizeof word);
    std::memcpy(&word, at, count);
    digest = (digest ^ word) * odd;
    digest ^= digest >> 32;
    at += count;
    left -= count;
  }
  return digest;
}

std::size_t size_of(SampleType type) {
  return type == SampleType::Uint8 ? 1 : type == SampleType::Uint16 ? 2 : 4;
}

}  // namespace

float rounded_to_half(float x) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x), sign = bits & 0x80000000U;
  const float size = std::abs(x);
  constexpr float least_normal = 0x1p-14F, beyond = 65520;  // which rounds to 2^16
  std::uint32_t rounded = 0;
  if (std::isnan(x)) {
    rounded = 0x7fc00000U;
  } else if (size >= beyond) {
    rounded = 0x7f800000U;
  } else if (size < least_normal) {  // multiples of 2^-24, as numbers from ½ to 1 are
    rounded = std::bit_cast<std::uint32_t>((size + 0.5F) - 0.5F);
  } else {
    const std::uint32_t digits = bits & 0x7fffffffU;
    rounded = (digits + 0xfffU + ((digits >> 13) & 1U)) & ~0x1fffU;
  }
  return std::bit_cast<float>(rounded | sign);
}

MeantRows::MeantRows(int width, int channels, SampleType type, bool keeps_samples)
    : samples_per_row_(static_cast<std::size_t>(width) * static_cast<std::size_t>(channels)),
      channels_(static_cast<std::size_t>(channels)),
      type_(type),
      keeps_samples_(keeps_samples),
      marks_per_row_(keeps_samples ? 1 : channels_) {}

void MeantRows::add(const void* samples, int rows) { add_marks(samples, rows, marks_); }

void MeantRows::add_marks(const void* samples, int rows, Marks& marks) const {
  const std::size_t row_size = samples_per_row_ * size_of(type_);
  std::vector<float> halves(type_ == SampleType::Half ? samples_per_row_ : 0);
  for (int row = 0; row < rows; ++row) {
    const auto* at = static_cast<const char*>(samples) + static_cast<std::size_t>(row) * row_size;
    if (!keeps_samples_) {
      const std::size_t first = marks.size();
      marks.resize(first + channels_);
      for (std::size_t i = 0; i < samples_per_row_; ++i)
        marks[first + i % channels_] += static_cast<unsigned char>(at[i]);
    } else if (type_ == SampleType::Half) {
      const auto* values = reinterpret_cast<const float*>(at);
      std::transform(values, values + samples_per_row_, halves.begin(), rounded_to_half);
      marks.push_back(digest_of(halves.data(), row_size));
    } else {
      marks.push_back(digest_of(at, row_size));
    }
  }
}

/// Whether the means of each channel over some rows are.
bool MeantRows::are_close(Marks::const_iterator found, Marks::const_iterator meant,
                          int rows) const {
  const auto channels = static_cast<std::ptrdiff_t>(channels_);
  const double texels = static_cast<double>(rows) * static_cast<double>(samples_per_row_) /
                        static_cast<double>(channels_);
  for (std::ptrdiff_t c = 0; c < channels; ++c) {
    double off = 0;
    for (std::ptrdiff_t at = c; at < rows * channels; at += channels)
      off += static_cast<double>(found[at]) - static_cast<double>(meant[at]);
    if (std::abs(off) > close_means * texels) return false;
  }
  return true;
}

std::string MeantRows::difference(const void* samples, int first_row, int rows) const {
  Marks found;
  add_marks(samples, rows, found);
  const auto per_row = static_cast<std::ptrdiff_t>(marks_per_row_);
  const int step = keeps_samples_ ? 1 : rows_of_means;
  for (int row = 0; row < rows; row += step) {
    const auto here = found.cbegin() + row * per_row;
    const auto meant = marks_.cbegin() + (first_row + row) * per_row;
    const bool same =
        keeps_samples_ ? *here == *meant : are_close(here, meant, std::min(step, rows - row));
    if (!same) return "row " + std::to_string(first_row + row) + " is not what was meant";
  }
  return "";
}

}  // namespace sphparam
