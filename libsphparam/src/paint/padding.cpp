#include "paint/padding.h"

#include <algorithm>

namespace sphparam {
namespace {

struct Texel {
  int x, y;
};

template <class Visit>
void for_each_neighbour(const Image& image, const Texel& at, Visit&& visit) {
  for (int y = std::max(0, at.y - 1); y <= std::min(image.height - 1, at.y + 1); ++y) {
    for (int x = std::max(0, at.x - 1); x <= std::min(image.width - 1, at.x + 1); ++x) {
      if (x != at.x || y != at.y) visit(Texel{x, y});
    }
  }
}

class Painted {
 public:
  Painted(Image& image, std::vector<std::uint8_t>& rings) : image_(image), rings_(rings) {}

  std::uint8_t& ring(const Texel& t) {
    return rings_[static_cast<size_t>(t.y) * static_cast<size_t>(image_.width) +
                  static_cast<size_t>(t.x)];
  }

  /// The unpainted texels about these ones, which get their ring; each once.
  std::vector<Texel> claim_around(const std::vector<Texel>& texels, std::uint8_t number) {
    std::vector<Texel> claimed;
    for (const Texel& texel : texels) {
      for_each_neighbour(image_, texel, [&](const Texel& t) {
        if (ring(t)) return;
        ring(t) = number;
        claimed.push_back(t);
      });
    }
    return claimed;
  }

  /// Gives a texel the mean of its neighbours of lower rings.
  void fill(const Texel& texel) {
    const std::uint8_t own = ring(texel);
    float* out = image_.pixel(texel.x, texel.y);
    std::fill_n(out, image_.channels, 0.0F);
    int count = 0;
    for_each_neighbour(image_, texel, [&](const Texel& t) {
      if (ring(t) == 0 || ring(t) >= own) return;
      ++count;
      const float* in = image_.pixel(t.x, t.y);
      for (int c = 0; c < image_.channels; ++c) out[c] += in[c];
    });
    for (int c = 0; c < image_.channels; ++c) out[c] /= static_cast<float>(count);
  }

  /// The painted texels that others may be claimed around.
  std::vector<Texel> border() {
    std::vector<Texel> texels;
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        const Texel texel{x, y};
        bool is_border = false;
        if (ring(texel))
          for_each_neighbour(image_, texel, [&](const Texel& t) { is_border |= !ring(t); });
        if (is_border) texels.push_back(texel);
      }
    }
    return texels;
  }

 private:
  Image& image_;
  std::vector<std::uint8_t>& rings_;
};

void fill_rest_with_mean(Image& image, const std::vector<std::uint8_t>& rings) {
  const auto channels = static_cast<size_t>(image.channels);
  std::vector<double> sum(channels, 0);
  size_t count = 0;
  for (size_t i = 0; i < rings.size(); ++i) {
    if (rings[i] != 1) continue;
    ++count;
    for (size_t c = 0; c < channels; ++c) sum[c] += image.pixels[channels * i + c];
  }
  if (count == 0) return;
  for (size_t i = 0; i < rings.size(); ++i) {
    for (size_t c = 0; c < channels && rings[i] == 0; ++c) {
      image.pixels[channels * i + c] = static_cast<float>(sum[c] / static_cast<double>(count));
    }
  }
}

}  // namespace

void pad(Image& image, std::vector<std::uint8_t>& painted, int rings) {
  Painted texels(image, painted);
  std::vector<Texel> rim = texels.border();
  for (int ring = 1; ring <= rings && !rim.empty(); ++ring) {
    rim = texels.claim_around(rim, static_cast<std::uint8_t>(ring + 1));
    for (const Texel& texel : rim) texels.fill(texel);
  }
  fill_rest_with_mean(image, painted);
}

}  // namespace sphparam
