#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bake/surface_field.h"
#include "image/image_writer.h"
#include "sphparam/texture/convention.h"

namespace sphparam {

struct BakedFileOptions {
  int width, height;
  ImageFormat format = ImageFormat::Png;
  SampleType sample_type = SampleType::Uint8;
  Convention convention = Convention::Sphparam;
  bool tiles = false;    // EXR with all levels
  bool no_data = false;  // floats with coverage 0 become no numbers: geographic programs take alpha
                         // as a mask of integers alone
  std::vector<std::pair<std::string, std::string>> metadata = {};  // besides its own
};

class ImageLevel;

/// What the ends of a field's range are to a file: data as integers and the colours of heat maps
/// end there. Nothing where the values are as they are, or the field has no range.
std::optional<std::pair<double, double>> range_in_file(const SurfaceField& field, SampleType type);

/// What the channels of a field that is far from the origin are counted from, with blanks between.
std::string origin_text(const SurfaceField& field);

/// Makes values of a field those that they stand for, in float32: sums with its origin.
void add_origin(const SurfaceField& field, std::vector<float>& values);

/// Writes the baked values of a field as an image file, as rows come.
///
/// Colours become sRGB in integer files and stay linear in others; directions become ½ + ½·n, data
/// the part of their range from 0 to 1 in integers (what is no number becomes 0), and stay as they
/// are in others. Rows are in
/// θ on entry and in the convention's u in the file. Metadata: sphparam:map, :about, :convention,
/// :u0 (u = turns·θ/2π + u0), :min and :max (what 0 and 1 stand for), :offset (what is to be added
/// to them, a channel, in integers of several channels far from the origin), oiio:ColorSpace.
///
/// Levels of tiled files are means of boxes of texels, of unit length again for directions, the
/// first texel for labels. A box never reaches beyond the seam or a pole, so levels wrap as the
/// image does. Memory: some rows; with tiles, a third of the image besides.
class BakedFile {
 public:
  /// Requires: a range for data in integers; where the convention shifts by a quarter, a width that
  /// is a multiple of 4. Throws: ImageError for what the format cannot hold.
  BakedFile(const SurfaceField& field, const BakedFileOptions& options, ImagePlace file);
  ~BakedFile();

  void write_rows(int rows, const float* values);
  /// The share of the texels so far whose values end at those of the range: 0 but for data in
  /// integers.
  double share_beyond() const;
  /// Reads the file back, as `ImageWriter::close` does. Throws: ImageError.
  void close();

 private:
  void write_level_rows(const float* values, int rows);
  void encode(const float* values, int rows);
  void encode_floats(const float* values, size_t count, int rows);
  void count_beyond(const float* values, int rows);

  SurfaceField field_;  // without its functions
  BakedFileOptions options_;
  ImageWriter writer_;
  std::vector<float> pending_;              // rows of a tiled file that fill no tile yet
  std::unique_ptr<ImageLevel> next_level_;  // of a tiled file
  std::int64_t texels_ = 0, beyond_ = 0;
};

}  // namespace sphparam
