#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/image_codec.h"

namespace sphparam {

/// Writes bytes at a place of a file, which may lie before its end.
using WriteAt = std::function<void(std::int64_t offset, std::string_view bytes)>;
/// Reads up to `size` bytes from a place of it; returns how many there are.
using ReadAt = std::function<std::size_t(std::int64_t offset, char* bytes, std::size_t size)>;

/// Where an image goes, and whence it is read back.
struct ImagePlace {
  WriteAt write;
  ReadAt read;
};

/// The place is a buffer of the caller's, which outlives it.
ImagePlace in_memory(std::vector<char>& bytes);

struct ImageFileOptions {
  int width, height, channels;
  ImageFormat format = ImageFormat::Png;
  SampleType sample_type = SampleType::Uint8;
  bool tiles = false;  // EXR only: tiled, with all levels down to one texel
  std::vector<std::pair<std::string, std::string>> metadata = {};  // text, name and value
};

/// An image file that is written row by row from the top, so that no more than some rows are ever
/// in memory, and read back so at the end. Same bytes for the same rows; dates are
/// SOURCE_DATE_EPOCH, or 1970.
class ImageWriter {
 public:
  /// Throws: ImageError, for what the format cannot hold.
  ImageWriter(const ImageFileOptions& options, ImagePlace file);
  ~ImageWriter();
  ImageWriter(const ImageWriter&) = delete;
  ImageWriter& operator=(const ImageWriter&) = delete;

  static constexpr int tile_size = 64;

  /// The next rows, interleaved: std::uint8_t or std::uint16_t, else float. Of files with tiles, a
  /// multiple of `tile_size` of them, but at the end.
  void write_rows(const void* samples, int rows);
  /// The next level of a file with tiles, each half as wide and high, rounded down.
  void begin_level(int width, int height);
  /// Ends the file, and reads it back: all levels, their sizes and sample type, every row (of JPEG,
  /// as `MeantRows` says, and the bytes), and the texts of its metadata must be what was meant. A
  /// file that is not closed is none. Throws: ImageError, which says what is not as it was meant.
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sphparam
