// A head, a palette or masks, then rows from the bottom, each a multiple of four bytes. Indices are
// unpacked, a byte each, before their colours are looked up.

#include "image/bmp.h"

#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <vector>

#include "image/decoding.h"

namespace sphparam {
namespace {

enum Compression : std::uint32_t { None = 0, Runs8 = 1, Runs4 = 2, Masks = 3, MasksWithAlpha = 6 };

constexpr std::size_t file_head = 14, core_head = 12, head_with_alpha = 56;

constexpr int red = 0, green = 1, blue = 2, alpha = 3;

class BmpReader {
 public:
  BmpReader(std::string_view bytes, const std::string& name, const ImageLimits& limits)
      : bytes_(bytes), file_(bytes, name, std::endian::little), limits_(limits) {}

  Image read() {
    read_head();
    const bool with_palette = bits_ <= 8;
    require_size(file_, width_, height_, with_palette || masks_[alpha] == 0 ? 3 : 4, limits_);
    if (with_palette) read_palette();
    go_to_rows();
    Image image = with_palette ? coloured(indices()) : unmasked();
    drop_empty_alpha(image);
    return image;
  }

 private:
  void read_head() {
    file_.take(10, "its head");
    rows_at_ = file_.number<std::uint32_t>("its head");
    head_size_ = file_.number<std::uint32_t>("its head");
    if (head_size_ == core_head) {
      width_ = file_.number<std::uint16_t>("its head");
      height_ = file_.number<std::uint16_t>("its head");
    } else {
      width_ = file_.number<std::int32_t>("its head");
      height_ = file_.number<std::int32_t>("its head");
    }
    from_top_ = height_ < 0;
    height_ = from_top_ ? -height_ : height_;
    file_.take(2, "its head");
    bits_ = file_.number<std::uint16_t>("its head");
    if (bits_ == 16) masks_ = {0x7c00, 0x03e0, 0x001f, 0};
    if (bits_ == 24) masks_[alpha] = 0;
    if (head_size_ != core_head) read_rest_of_head();
    require_known();
  }

  void read_rest_of_head() {
    compression_ = file_.number<std::uint32_t>("its head");
    file_.take(12, "its head");
    colours_ = file_.number<std::uint32_t>("its head");
    file_.take(4, "its head");
    if (is_masked()) read_masks();
    if (head_size_ > file_.offset() - file_head)
      file_.take(head_size_ + file_head - file_.offset(), "its head");
  }

  /// In the head where it is long enough, else behind it.
  void read_masks() {
    const bool with_alpha = compression_ == MasksWithAlpha || head_size_ >= head_with_alpha;
    masks_[alpha] = 0;
    for (const int channel : {red, green, blue, alpha})
      if (channel != alpha || with_alpha)
        masks_[static_cast<std::size_t>(channel)] = file_.number<std::uint32_t>("its masks");
  }

  void require_known() const {
    static const std::set<int> known = {1, 2, 4, 8, 16, 24, 32};
    if (!known.contains(bits_)) file_.fail(std::to_string(bits_) + " bits a pixel are not read");
    const bool fits = compression_ == None || (compression_ == Runs8 && bits_ == 8) ||
                      (compression_ == Runs4 && bits_ == 4) ||
                      (is_masked() && (bits_ == 16 || bits_ == 32));
    if (!fits)
      file_.fail("BMP of compression " + std::to_string(compression_) + " and " +
                 std::to_string(bits_) + " bits a pixel is not read");
    if (is_in_runs() && from_top_) file_.fail("runs that begin at the top are not allowed");
  }

  bool is_masked() const { return compression_ == Masks || compression_ == MasksWithAlpha; }
  bool is_in_runs() const { return compression_ == Runs8 || compression_ == Runs4; }

  /// As many colours as there are, and are told.
  void read_palette() {
    const std::size_t entry = head_size_ == core_head ? 3 : 4, here = file_.offset();
    const std::size_t room = rows_at_ > here ? (rows_at_ - here) / entry : 0;
    const std::size_t all = std::size_t{1} << bits_;
    const std::size_t told = colours_ > 0 ? std::min<std::size_t>(colours_, all) : all;
    for (std::size_t i = 0; i < std::min(told, room); ++i) {
      const std::string_view bgr = file_.take(entry, "its palette");
      palette_.push_back({byte(bgr[2]), byte(bgr[1]), byte(bgr[0])});
    }
  }

  void go_to_rows() {
    if (rows_at_ < file_.offset() || rows_at_ > bytes_.size())
      file_.fail("its rows are said to begin at byte " + std::to_string(rows_at_));
    file_.take(rows_at_ - file_.offset(), "its head");
  }

  std::uint64_t bytes_of_row() const {
    const auto in_bits = static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(bits_);
    return (in_bits + 31) / 32 * 4;
  }

  /// Before anything is made for them.
  void require_rows() const {
    file_.require(bytes_of_row() * static_cast<std::uint64_t>(height_), "its rows");
  }

  /// In the file's order.
  std::vector<std::uint8_t> indices() {
    if (is_in_runs()) return indices_of_runs();
    require_rows();
    std::vector<std::uint8_t> indices;
    indices.reserve(static_cast<std::size_t>(width_ * height_));
    for (std::int64_t y = 0; y < height_; ++y) {
      const std::string_view row = file_.take(bytes_of_row(), "its rows");
      for (std::int64_t x = 0; x < width_; ++x) indices.push_back(packed(row, x));
    }
    return indices;
  }

  /// The first pixel is in the highest bits.
  std::uint8_t packed(std::string_view row, std::int64_t x) const {
    const std::int64_t per_byte = 8 / bits_;
    const auto last = static_cast<int>(per_byte - 1 - x % per_byte);
    const int shifted = byte(row[static_cast<std::size_t>(x / per_byte)]) >> (last * bits_);
    return static_cast<std::uint8_t>(shifted & ((1 << bits_) - 1));
  }

  /// (n, index): n pixels; (0, 0): end of the row; (0, 1): of the image; (0, 2): a step; (0, n): n
  /// pixels as they come, in whole 16 bits. What is stepped over has the first colour.
  std::vector<std::uint8_t> indices_of_runs() {
    constexpr std::uint64_t most_per_byte = 255;
    if (static_cast<std::uint64_t>(width_ * height_) / most_per_byte > file_.remaining())
      file_.fail("claims to be far larger than its bytes can hold");
    runs_.assign(static_cast<std::size_t>(width_ * height_), 0);
    for (x_ = y_ = 0;;) {
      const int count = next_byte(), index = next_byte();
      for (int i = 0; i < count; ++i) put(half(index, i));
      if (count > 0) continue;
      if (index == 1) return std::move(runs_);
      if (index == 0) {
        x_ = 0;
        ++y_;
      } else if (index == 2) {
        x_ += next_byte();
        y_ += next_byte();
      } else {
        put_as_they_come(index);
      }
    }
  }

  void put_as_they_come(int count) {
    const int bytes = compression_ == Runs8 ? count : (count + 1) / 2;
    const std::string_view run = file_.take(static_cast<std::size_t>(bytes + bytes % 2), "a run");
    for (int i = 0; i < count; ++i)
      put(half(byte(run[static_cast<std::size_t>(compression_ == Runs8 ? i : i / 2)]), i));
  }

  /// Two indices share a byte in runs of 4 bits, and take turns.
  int half(int index, int i) const {
    if (compression_ == Runs8) return index;
    return i % 2 == 0 ? index >> 4 : index & 15;
  }

  void put(int index) {
    if (x_ >= width_ || y_ >= height_) file_.fail("a run goes beyond the image");
    runs_[static_cast<std::size_t>(y_ * width_ + x_++)] = static_cast<std::uint8_t>(index);
  }

  int next_byte() { return file_.number<std::uint8_t>("its runs"); }

  Image coloured(const std::vector<std::uint8_t>& indices) const {
    Image image(static_cast<int>(width_), static_cast<int>(height_), 3);
    auto index = indices.begin();
    for (std::int64_t y = 0; y < height_; ++y) {
      float* pixel = image.pixel(0, row_of(y));
      for (std::int64_t x = 0; x < width_; ++x, ++index) {
        if (*index >= palette_.size()) file_.fail("a pixel has a colour beyond the palette");
        for (const std::uint8_t sample : palette_[*index])
          *pixel++ = static_cast<float>(sample) / 255.0F;
      }
    }
    return image;
  }

  Image unmasked() {
    require_rows();
    Image image(static_cast<int>(width_), static_cast<int>(height_), masks_[alpha] ? 4 : 3);
    const auto bytes = static_cast<std::size_t>(bits_ / 8);
    for (std::int64_t y = 0; y < height_; ++y) {
      const std::string_view row = file_.take(bytes_of_row(), "its rows");
      float* sample = image.pixel(0, row_of(y));
      for (std::size_t x = 0; x < static_cast<std::size_t>(width_); ++x) {
        std::uint32_t packed = 0;
        for (std::size_t k = 0; k < bytes; ++k)
          packed |= static_cast<std::uint32_t>(byte(row[x * bytes + k])) << (8 * k);
        for (int c = 0; c < image.channels; ++c)
          *sample++ = under(masks_[static_cast<std::size_t>(c)], packed);
      }
    }
    return image;
  }

  /// The bits that the mask has, in [0, 1].
  static float under(std::uint32_t mask, std::uint32_t packed) {
    if (mask == 0) return 0;
    const int shift = std::countr_zero(mask);
    return static_cast<float>(static_cast<double>((packed & mask) >> shift) /
                              static_cast<double>(mask >> shift));
  }

  int row_of(std::int64_t y) const { return static_cast<int>(from_top_ ? y : height_ - 1 - y); }
  static std::uint8_t byte(char c) { return static_cast<std::uint8_t>(c); }

  std::string_view bytes_;
  ByteReader file_;
  const ImageLimits& limits_;
  std::size_t rows_at_ = 0, head_size_ = 0;
  std::int64_t width_ = 0, height_ = 0;
  bool from_top_ = false;
  int bits_ = 0;
  std::uint32_t compression_ = None, colours_ = 0;
  std::array<std::uint32_t, 4> masks_ = {0xff0000, 0x00ff00, 0x0000ff, 0xff000000};
  std::vector<std::array<std::uint8_t, 3>> palette_;
  std::vector<std::uint8_t> runs_;
  std::int64_t x_ = 0, y_ = 0;  // where the next pixel of a run goes
};

}  // namespace

bool looks_like_bmp(std::string_view bytes) {
  static const std::set<int> heads = {12, 40, 52, 56, 64, 108, 124};
  if (!bytes.starts_with("BM") || bytes.size() < file_head + 4) return false;
  return bytes.substr(file_head + 1, 3) == std::string_view("\0\0", 3) &&
         heads.contains(static_cast<unsigned char>(bytes[file_head]));
}

Image decode_bmp(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  return BmpReader(bytes, name, limits).read();
}

}  // namespace sphparam
