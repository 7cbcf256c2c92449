#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sphparam/image/image.h"
#include "sphparam/image/image_format.h"

namespace sphparam {

/// What is refused before any pixel is allocated.
struct ImageLimits {
  std::int64_t file_bytes = std::int64_t{2} << 30;
  std::int64_t decoded_megabytes = 512;  // in the file's own sample type
  int channels = 8;
};

/// Names and values.
using ImageTexts = std::vector<std::pair<std::string, std::string>>;

/// Beside the texts of a file: the name of the ICC profile that its colours are in.
constexpr char other_profile_text[] = "sphparam:other-profile";
/// Beside them, of a JPEG that ends without its mark though all its pixels are there: "1".
constexpr char lacks_end_text[] = "sphparam:lacks-end";

struct ImageWriteOptions {
  SampleType sample_type = SampleType::Uint8;  // PNG: Uint8 or Uint16; EXR: Half or Float
  std::vector<std::pair<std::string, std::string>> metadata = {};  // text, name and value
};

/// Pixels as they are in the file, integers scaled to [0, 1], alpha not multiplied in, no colour
/// conversion. The format is told by the first bytes, never by the name.
///
/// The decoders are OpenImageIO's, in a module opened on first use: a program that touches no
/// image never loads them. Those of BMP and TGA, which are not written, are our own.
/// `texts`, where given, gets the texts of the file's metadata, and the name of its colour profile
/// as `other_profile_text` where that is not sRGB's; `lacks_end_text` where that is so.
/// Throws: std::bad_alloc; ImageError with the file's name, for what is no PNG, JPEG, WebP, TIFF,
/// EXR, BMP or TGA file, for broken ones and for what is beyond the limits.
Image read_image(const std::string& path, const ImageLimits& limits = {},
                 ImageTexts* texts = nullptr);

/// The same from memory; `name` is for error messages.
Image decode_image(const std::vector<char>& bytes, std::string_view name,
                   const ImageLimits& limits = {}, ImageTexts* texts = nullptr);

/// Whether bytes begin as those of an image that is read.
bool is_image(const std::vector<char>& bytes);
/// Whether they begin as those of an EXR, whose colours are linear; all others hold sRGB.
bool is_exr(std::string_view bytes);
inline bool is_exr(const std::vector<char>& bytes) {
  return is_exr(std::string_view(bytes.data(), bytes.size()));
}

/// The bytes of an image file, read back as `ImageWriter` does; in integers clamped to [0, 1].
/// Ensures: same bytes for the same input (EXR carries the time SOURCE_DATE_EPOCH, or 1970).
/// Requires: PNG or EXR. Throws: ImageError; also for a sample type the format does not have.
std::vector<char> encode_image(const Image& image, ImageFormat format,
                               const ImageWriteOptions& options = {});

/// Writes a .png or .exr file, as the name says in whatever case. Throws: ImageError.
void write_image(const std::string& path, const Image& image,
                 const ImageWriteOptions& options = {});

}  // namespace sphparam
