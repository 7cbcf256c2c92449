// A head, a palette, then pixels, whose samples are in the order blue, green, red, alpha. Runs are
// unpacked before they are looked at.

#include "image/targa.h"

#include <array>
#include <bit>
#include <cstdint>

#include "image/decoding.h"

namespace sphparam {
namespace {

enum Kind { Palette = 1, Colours = 2, Grey = 3 };

constexpr std::size_t head_size = 18;
constexpr int in_runs = 8;

struct Head {
  int words, palette_type, type, first_colour, colours, colour_bits, width, height, bits, places;

  explicit Head(std::string_view bytes) {
    const auto byte = [&](std::size_t at) { return int{static_cast<unsigned char>(bytes[at])}; };
    const auto pair = [&](std::size_t at) { return byte(at) | byte(at + 1) << 8; };
    words = byte(0);
    palette_type = byte(1);
    type = byte(2);
    first_colour = pair(3);
    colours = pair(5);
    colour_bits = byte(7);
    width = pair(12);
    height = pair(14);
    bits = byte(16);
    places = byte(17);
  }

  int kind() const { return type & ~in_runs; }
  bool from_right() const { return (places & 0x10) != 0; }
  bool from_top() const { return (places & 0x20) != 0; }
  /// Of one colour, in the palette or not.
  int bits_of_colour() const { return kind() == Palette ? colour_bits : bits; }
  std::size_t bytes_of_pixel() const { return static_cast<std::size_t>((bits + 7) / 8); }
  std::size_t bytes_of_colour() const {
    return static_cast<std::size_t>((bits_of_colour() + 7) / 8);
  }
  int channels() const {
    if (kind() == Grey) return bits / 8;
    return bits_of_colour() == 32 ? 4 : 3;
  }

  bool makes_sense() const {
    const auto is_colour = [](int b) { return b == 15 || b == 16 || b == 24 || b == 32; };
    if (palette_type > 1 || width == 0 || height == 0 || places >= 0x40) return false;
    if (kind() == Grey) return bits == 8 || bits == 16;
    if (kind() == Colours) return is_colour(bits);
    return kind() == Palette && palette_type == 1 && (bits == 8 || bits == 16) &&
           is_colour(colour_bits);
  }
};

int byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// In the order of an image's channels.
std::array<float, 4> samples_of(std::string_view colour, const Head& head) {
  const auto sample = [&](std::size_t at) {
    return static_cast<float>(byte_at(colour, at)) / 255.0F;
  };
  if (head.kind() == Grey) return {sample(0), head.bits == 16 ? sample(1) : 0, 0, 0};
  if (colour.size() >= 3)
    return {sample(2), sample(1), sample(0), colour.size() == 4 ? sample(3) : 0};
  const int packed = byte_at(colour, 0) | byte_at(colour, 1) << 8;
  const auto five_bits = [&](int shift) {
    return static_cast<float>(packed >> shift & 31) / 31.0F;
  };
  return {five_bits(10), five_bits(5), five_bits(0), 0};
}

/// A byte says how many pixels follow, less one, or with 128 added how often one follows.
std::string unpacked(ByteReader& file, std::size_t pixels, std::size_t bytes_of_pixel) {
  constexpr std::size_t longest_run = 128;
  if (pixels / longest_run * (1 + bytes_of_pixel) > file.remaining())
    file.fail("claims to be far larger than its bytes can hold");
  const std::size_t size = pixels * bytes_of_pixel;
  std::string all;
  all.reserve(size);
  while (all.size() < size) {
    const int said = file.number<std::uint8_t>("its pixels");
    const auto count = static_cast<std::size_t>(said % 128 + 1);
    if (count * bytes_of_pixel > size - all.size()) file.fail("a run goes beyond the image");
    if (said < 128) {
      all += file.take(count * bytes_of_pixel, "its pixels");
    } else {
      const std::string_view one = file.take(bytes_of_pixel, "its pixels");
      for (std::size_t i = 0; i < count; ++i) all += one;
    }
  }
  return all;
}

class TargaReader {
 public:
  TargaReader(std::string_view bytes, const std::string& name)
      : file_(bytes, name, std::endian::little), head_(file_.take(head_size, "its head")) {}

  Image read(const ImageLimits& limits) {
    require_size(file_, head_.width, head_.height, head_.channels(), limits);
    file_.take(static_cast<std::size_t>(head_.words), "its head");
    read_palette();
    const auto pixels =
        static_cast<std::size_t>(head_.width) * static_cast<std::size_t>(head_.height);
    const bool packed = (head_.type & in_runs) != 0;
    if (packed) unpacked_ = unpacked(file_, pixels, head_.bytes_of_pixel());
    pixels_ = packed ? unpacked_ : file_.take(pixels * head_.bytes_of_pixel(), "its pixels");
    Image image = in_place();
    drop_empty_alpha(image);
    return image;
  }

 private:
  /// Also where none is wanted: then it is passed over.
  void read_palette() {
    if (head_.palette_type == 0) return;
    const auto bytes_of_colour = static_cast<std::size_t>((head_.colour_bits + 7) / 8);
    palette_ = file_.take(static_cast<std::size_t>(head_.colours) * bytes_of_colour, "its palette");
  }

  Image in_place() const {
    Image image(head_.width, head_.height, head_.channels());
    std::size_t at = 0;
    for (int y = 0; y < head_.height; ++y) {
      for (int x = 0; x < head_.width; ++x, at += head_.bytes_of_pixel()) {
        const std::array<float, 4> samples =
            samples_of(colour_of(pixels_.substr(at, head_.bytes_of_pixel())), head_);
        std::copy_n(samples.begin(), image.channels,
                    image.pixel(head_.from_right() ? head_.width - 1 - x : x,
                                head_.from_top() ? y : head_.height - 1 - y));
      }
    }
    return image;
  }

  std::string_view colour_of(std::string_view pixel) const {
    if (head_.kind() != Palette) return pixel;
    const int index =
        (pixel.size() == 1 ? byte_at(pixel, 0) : byte_at(pixel, 0) | byte_at(pixel, 1) << 8) -
        head_.first_colour;
    if (index < 0 || index >= head_.colours) file_.fail("a pixel has a colour beyond the palette");
    return palette_.substr(static_cast<std::size_t>(index) * head_.bytes_of_colour(),
                           head_.bytes_of_colour());
  }

  ByteReader file_;
  Head head_;
  std::string_view palette_, pixels_;
  std::string unpacked_;
};

}  // namespace

bool looks_like_targa(std::string_view bytes) {
  return bytes.size() >= head_size && Head(bytes).makes_sense();
}

Image decode_targa(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  return TargaReader(bytes, name).read(limits);
}

}  // namespace sphparam
