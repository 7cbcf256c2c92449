#include "texture/texture_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "elementary.h"
#include "sphparam/parallel.h"
#include "srgb_curves.h"
#include "texture/box_shares.h"
#include "texture/wrapped.h"

// Texels are four lanes, so that a bilinear sample is four loads and a handful of vector
// operations. The singular values of the footprint's Jacobian are the sides of what a sample
// covers.

namespace sphparam {
namespace {

using Lanes = float __attribute__((vector_size(16)));
using IntLanes = std::int32_t __attribute__((vector_size(16)));
using Texel = std::uint16_t __attribute__((vector_size(8)));
using Level = TexturePyramid::Level;

constexpr float full = 65535;
constexpr int most_taps = 16;            // along the wide side of a sample
constexpr double reach_of_texels = 1.5;  // that a bilinear look-up touches, from its place
constexpr std::int64_t grain = 16;       // rows

std::uint16_t stored(float x) { return static_cast<std::uint16_t>(std::lround(x * full)); }

Level with_room(int width, int height) {
  Level level{width, height, {}};
  level.texels.resize(4 * static_cast<size_t>(width) * static_cast<size_t>(height));
  return level;
}

Level finest(const Image& image, bool linear, int threads) {
  Level level = with_room(image.width, image.height);
  const SrgbCurves& curves = SrgbCurves::get();
  const auto colour = [&](float x) {
    return stored(linear ? std::clamp(x, 0.0F, 1.0F) : curves.to_linear(x));
  };
  const bool grey = image.channels < 3, alpha = image.channels == 2 || image.channels >= 4;
  parallel_for(image.height, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t row = first; row < last; ++row) {
      for (int column = 0; column < image.width; ++column) {
        const float* pixel = image.pixel(column, static_cast<int>(row));
        std::uint16_t* texel = &level.texels[4 * static_cast<size_t>(row * image.width + column)];
        for (int c = 0; c < 3; ++c) texel[c] = colour(pixel[grey ? 0 : c]);
        texel[3] = alpha ? stored(std::clamp(pixel[grey ? 1 : 3], 0.0F, 1.0F)) : UINT16_MAX;
      }
    }
  });
  return level;
}

Lanes texel_at(const Level& level, size_t index) {
  Texel texel;
  std::memcpy(&texel, &level.texels[4 * index], sizeof texel);
  return __builtin_convertvector(__builtin_convertvector(texel, IntLanes), Lanes);
}

/// How much each texel of a level counts in means. The finest level's are those of `seen`.
class Weights {
 public:
  explicit Weights(const SeenTexels& seen) : seen_(&seen) {}
  explicit Weights(size_t texels) : values_(texels, 0) {}

  float operator[](size_t texel) const { return seen_ ? seen_->weight(texel) : values_[texel]; }
  float& of(size_t texel) { return values_[texel]; }

 private:
  const SeenTexels* seen_ = nullptr;
  std::vector<float> values_;
};

/// A mean over a box of texels.
struct BoxMean {
  Lanes seen{}, plain{};  // sums
  float weight = 0;       // of what is seen
  bool all_seen = true;

  void add(float share, float weight_of, const Lanes& texel) {
    seen += share * weight_of * texel;
    plain += share * texel;
    weight += share * weight_of;
    all_seen = all_seen && weight_of == 1;
  }
  /// Where all of a box is seen the sum is the mean: shares are 1 together.
  Lanes mean() const { return all_seen || weight == 0 ? plain : seen / weight; }
  float mean_weight() const { return all_seen ? 1 : weight; }
};

BoxMean box_mean(const Level& fine, const Weights& weights, const BoxShares& columns,
                 const BoxShares& rows) {
  BoxMean box;
  for (size_t j = 0; j < 4; ++j) {
    for (size_t i = 0; i < 4 && rows.weights[j] > 0; ++i) {
      const float share = rows.weights[j] * columns.weights[i];
      if (share == 0) continue;
      const size_t texel = (static_cast<size_t>(rows.first) + j) * static_cast<size_t>(fine.width) +
                           static_cast<size_t>(columns.first) + i;
      box.add(share, weights[texel], texel_at(fine, texel));
    }
  }
  return box;
}

struct WeightedLevel {
  Level level;
  Weights weights;
};

/// The share of a sphere that lies north of a parallel, by its place in an image's rows.
double from_pole(double place) { return (1 - elementary::cos(std::numbers::pi * place)) / 2; }

WeightedLevel halved(const Level& fine, const Weights& weights, ImageRows of, int threads) {
  Level coarse = with_room(std::max(1, fine.width / 2), std::max(1, fine.height / 2));
  Weights coarse_weights(coarse.texels.size() / 4);
  const std::vector<BoxShares> columns = box_shares(fine.width, coarse.width),
                               rows = box_shares(fine.height, coarse.height,
                                                 of == ImageRows::Parallels ? from_pole : nullptr);
  parallel_for(coarse.height, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto y = static_cast<size_t>(first); y < static_cast<size_t>(last); ++y) {
      for (size_t x = 0; x < columns.size(); ++x) {
        const BoxMean box = box_mean(fine, weights, columns[x], rows[y]);
        const size_t texel = y * columns.size() + x;
        coarse_weights.of(texel) = box.mean_weight();
        const Lanes mean = box.mean();
        for (size_t c = 0; c < 4; ++c) coarse.texels[4 * texel + c] = stored(mean[c] / full);
      }
    }
  });
  return {std::move(coarse), std::move(coarse_weights)};
}

/// What nobody sees takes the colour of the coarser texel that it lies in.
void fill_unseen(Level& fine, const Weights& weights, const Level& coarse, int threads) {
  const auto width = static_cast<size_t>(fine.width), height = static_cast<size_t>(fine.height);
  const auto coarse_width = static_cast<size_t>(coarse.width);
  parallel_for(fine.height, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto y = static_cast<size_t>(first); y < static_cast<size_t>(last); ++y) {
      const size_t row = y * static_cast<size_t>(coarse.height) / height;
      for (size_t x = 0; x < width; ++x) {
        if (weights[y * width + x] > 0) continue;
        const size_t column = x * coarse_width / width;
        std::copy_n(&coarse.texels[4 * (row * coarse_width + column)], 4,
                    &fine.texels[4 * (y * width + x)]);
      }
    }
  });
}

int floor_of(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (x < truncated);
}

/// What is no number, as coordinates of files may be, is 0.
double bounded(double x) { return std::isnan(x) ? 0 : std::clamp(x, -1e9, 1e9); }

/// What is whole numbers apart in the mesh's coordinates is one place of the image.
bool goes_on(const SourceTexture& texture) {
  const auto is_whole = [](double x) { return x == std::round(x); };
  const bool repeats =
      texture.wrap_s == TextureWrap::Repeat && texture.wrap_t == TextureWrap::Repeat;
  return repeats && std::ranges::all_of(texture.placement, [&](const auto& row) {
           return is_whole(row[0]) && is_whole(row[1]);
         });
}

/// Those of a face that are seams of this texture.
unsigned seams_on(const SourceTexture& texture, unsigned seams) {
  constexpr unsigned of_all = 7;
  return (goes_on(texture) ? seams : seams | seams >> 3) & of_all;
}

class Sampler {
 public:
  Sampler(const SourceTexture& texture, TextureFilter filter, const TextureLine& line)
      : texture_(texture), levels_(texture.image->levels()), line_(line), filter_(filter) {
    x_ = near_zero(line.first[0], texture.wrap_s);
    y_ = near_zero(line.first[1], texture.wrap_t);
    if (filter != TextureFilter::Nearest) measure_footprint();
    if (half_wide_ > 0) seams_ = seams_on(texture, line.face.seams);
    if (seams_ != 0) measure_face();
    const bool magnified = taps_ == 1 && coarse_share_ == 0 && level_ == 0;
    if (texture.nearest && magnified) filter_ = TextureFilter::Nearest;
  }

  /// Where samples are bilinear in the finest level and none needs a texel beyond its borders: the
  /// ends of a line say so for all of it.
  bool is_plain() const {
    if (filter_ != TextureFilter::Bilinear || taps_ > 1 || coarse_share_ > 0 || level_ > 0) {
      return false;
    }
    const Level& level = levels_[0];
    for (const int i : {0, line_.count - 1}) {
      const double x = place(x_, line_.step[0], i, level.width);
      const double y = place(y_, line_.step[1], i, level.height);
      if (!(x >= 0 && y >= 0 && x < level.width - 1 && y < level.height - 1)) return false;
    }
    return true;
  }

  /// Requires: is_plain().
  Lanes plain(int i) const {
    const Level& level = levels_[0];
    const double x = place(x_, line_.step[0], i, level.width);
    const double y = place(y_, line_.step[1], i, level.height);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    return mix(level, column, row, static_cast<float>(x - column), static_cast<float>(y - row));
  }

  Lanes operator()(int i) const {
    const double x = x_ + i * line_.step[0], y = y_ + i * line_.step[1];
    if (filter_ == TextureFilter::Nearest) return nearest(x, y);
    if (taps_ == 1 && coarse_share_ == 0 && level_ == 0) {
      return filter_ == TextureFilter::Bicubic ? bicubic(levels_[0], x, y)
                                               : bilinear(levels_[0], x, y);
    }
    if (const double room = room_within_seams(i); room < half_wide_) {
      const auto level = static_cast<size_t>(std::ilogb(std::max(1.0, room / reach_of_texels)));
      return bilinear(levels_[std::min(level, level_)], x, y);
    }
    Lanes sum{};
    for (int tap = 0; tap < taps_; ++tap) {
      const double along = (tap + 0.5) / taps_ - 0.5;
      sum += between_levels(x + along * wide_[0], y + along * wide_[1]);
    }
    return sum / static_cast<float>(taps_);
  }

 private:
  /// The singular values of the footprint in texels, and the direction of the larger.
  void measure_footprint() {
    const double w = levels_[0].width, h = levels_[0].height;
    const double a = line_.step[0] * w, b = line_.below[0] * w, c = line_.step[1] * h,
                 d = line_.below[1] * h;
    const double p = (a * a + b * b + c * c + d * d) / 2, det = a * d - b * c;
    const double q = std::sqrt(std::max(0.0, p * p - det * det));
    const double wide = std::sqrt(p + q), narrow = wide > 0 ? std::abs(det) / wide : 0;
    if (!(wide > 1)) return;  // texels are larger than samples
    if (!std::isfinite(wide)) {
      level_ = levels_.size() - 1;
      return;
    }
    half_wide_ = wide / 2;
    taps_ = static_cast<int>(
        std::clamp(std::ceil(wide / std::max(narrow, 1.0)), 1.0, double{most_taps}));
    const double level = elementary::log2(std::max({narrow, wide / taps_, 1.0}));
    const auto last = static_cast<double>(levels_.size() - 1);
    level_ = static_cast<size_t>(std::min(std::floor(level), last));
    coarse_share_ = level >= last ? 0 : static_cast<float>(level - std::floor(level));
    // The eigenvector of J Jᵀ to wide²; where J is a rotation any direction will do.
    const double xx = a * a + b * b, xy = a * c + b * d, yy = c * c + d * d;
    double x = xx > yy ? p + q - yy : xy, y = xx > yy ? xy : p + q - xx;
    if (x == 0 && y == 0) x = 1;
    const double length = elementary::hypot(x, y);
    wide_[0] = x / length * wide / w;
    wide_[1] = y / length * wide / h;
  }

  /// How many texels the corners are from the sides that face them.
  void measure_face() {
    const auto& c = line_.face.corners;
    const double w = levels_[0].width, h = levels_[0].height;
    const auto x = [&](int k) { return w * c[k % 3][0]; };
    const auto y = [&](int k) { return h * c[k % 3][1]; };
    const double twice_area =
        std::abs((x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0)));
    for (int k = 0; k < 3; ++k) {
      const double side = elementary::hypot(x(k + 2) - x(k + 1), y(k + 2) - y(k + 1));
      heights_[k] = side > 0 ? twice_area / side : 0;
    }
  }

  /// Texels of the finest level from a sample to the nearest seam of its face.
  double room_within_seams(int i) const {
    double room = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      if ((seams_ >> k & 1) == 0) continue;
      room = std::min(room, heights_[k] * (line_.face.first[k] + i * line_.face.step[k]));
    }
    return room;
  }

  Lanes between_levels(double x, double y) const {
    const Lanes fine = bilinear(levels_[level_], x, y);
    if (coarse_share_ == 0) return fine;
    return fine + coarse_share_ * (bilinear(levels_[level_ + 1], x, y) - fine);
  }

  Lanes at(const Level& level, int x, int y) const {
    const int column = wrapped(x, level.width, texture_.wrap_s);
    const int row = wrapped(y, level.height, texture_.wrap_t);
    return texel_at(level, static_cast<size_t>(row) * static_cast<size_t>(level.width) +
                               static_cast<size_t>(column));
  }

  static double place(double first, double step, int i, int size) {
    return (first + i * step) * size - 0.5;
  }

  /// Of four texels within the level.
  static Lanes mix(const Level& level, int column, int row, float u, float v) {
    const auto width = static_cast<size_t>(level.width);
    const size_t index = static_cast<size_t>(row) * width + static_cast<size_t>(column);
    const Lanes a = texel_at(level, index), b = texel_at(level, index + 1),
                c = texel_at(level, index + width), d = texel_at(level, index + width + 1);
    const Lanes top = a + u * (b - a), bottom = c + u * (d - c);
    return top + v * (bottom - top);
  }

  Lanes nearest(double x, double y) const {
    const Level& level = levels_[0];
    return at(level, floor_of(bounded(x * level.width)), floor_of(bounded(y * level.height)));
  }

  Lanes bilinear(const Level& level, double x, double y) const {
    const double px = bounded(x * level.width - 0.5), py = bounded(y * level.height - 0.5);
    const int column = floor_of(px), row = floor_of(py);
    const auto u = static_cast<float>(px - column), v = static_cast<float>(py - row);
    if (column >= 0 && row >= 0 && column + 1 < level.width && row + 1 < level.height) {
      return mix(level, column, row, u, v);
    }
    const Lanes a = at(level, column, row), b = at(level, column + 1, row);
    const Lanes c = at(level, column, row + 1), d = at(level, column + 1, row + 1);
    const Lanes top = a + u * (b - a), bottom = c + u * (d - c);
    return top + v * (bottom - top);
  }

  /// Catmull and Rom's spline through the texels; it overshoots, so values are clamped.
  Lanes bicubic(const Level& level, double x, double y) const {
    const double px = bounded(x * level.width - 0.5), py = bounded(y * level.height - 0.5);
    const int column = floor_of(px), row = floor_of(py);
    const std::array<float, 4> u = spline(static_cast<float>(px - column)),
                               v = spline(static_cast<float>(py - row));
    Lanes sum{};
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        sum += v[static_cast<size_t>(j)] * u[static_cast<size_t>(i)] *
               at(level, column - 1 + i, row - 1 + j);
      }
    }
    for (int c = 0; c < 4; ++c) sum[c] = std::clamp(sum[c], 0.0F, full);
    return sum;
  }

  static std::array<float, 4> spline(float t) {
    return {((-0.5F * t + 1) * t - 0.5F) * t, (1.5F * t - 2.5F) * t * t + 1,
            ((-1.5F * t + 2) * t + 0.5F) * t, (0.5F * t - 0.5F) * t * t};
  }

  const SourceTexture& texture_;
  const std::vector<Level>& levels_;
  const TextureLine& line_;
  TextureFilter filter_;
  double x_, y_;
  int taps_ = 1;
  size_t level_ = 0;
  float coarse_share_ = 0;
  double half_wide_ = 0;  // texels; 0: none is smaller than a sample
  double wide_[2] = {0, 0};
  unsigned seams_ = 0;  // bit k: the side of its face that faces corner k, where that matters
  double heights_[3] = {0, 0, 0};
};

}  // namespace

TexturePyramid::TexturePyramid(const Image& image, bool linear, int threads, const SeenTexels& seen,
                               ImageRows rows)
    : has_alpha_(image.channels == 2 || image.channels >= 4) {
  levels_.push_back(finest(image, linear, threads));
  std::vector<Weights> weights{Weights(seen)};
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    WeightedLevel next = halved(levels_.back(), weights.back(), rows, threads);
    levels_.push_back(std::move(next.level));
    weights.push_back(std::move(next.weights));
  }
  const bool any_seen = weights.back()[0] > 0;
  if (seen.all() || !any_seen) return;
  for (size_t l = levels_.size() - 1; l-- > 0;)
    fill_unseen(levels_[l], weights[l], levels_[l + 1], threads);
}

namespace {

/// Writes one colour after the other.
template <int channels>
void write_line(const Sampler& sampler, const Lanes& factor, int count, float* out) {
  const auto put = [&](const Lanes& colour) {
    for (int c = 0; c < channels; ++c) *out++ = colour[c];
  };
  if (sampler.is_plain()) {
    for (int i = 0; i < count; ++i) put(factor * sampler.plain(i));
  } else {
    for (int i = 0; i < count; ++i) put(factor * sampler(i));
  }
}

}  // namespace

void sample_texture(const SourceTexture& texture, TextureFilter filter, const TextureLine& line,
                    float* values, int channels) {
  Lanes factor;
  std::memcpy(&factor, texture.factor.data(), sizeof factor);
  if (!texture.image) {
    for (int i = 0; i < line.count; ++i) {
      values = std::copy_n(texture.factor.begin(), channels, values);
    }
    return;
  }
  const Sampler sampler(texture, filter, line);
  factor /= full;
  channels == 3 ? write_line<3>(sampler, factor, line.count, values)
                : write_line<4>(sampler, factor, line.count, values);
}

}  // namespace sphparam
