#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sphparam {

/// An image that cannot be read or written, or the image module that cannot be found.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a channel of a texel is in a file. Integers stand for 0 to 1.
enum class SampleType { Uint8, Uint16, Half, Float };

enum class ImageFormat { Png, Exr, Jpeg, Tiff };

/// The format of a file name: .png .jpg .jpeg .tif .tiff .exr, in whatever case; nothing for
/// others.
std::optional<ImageFormat> image_format_of(const std::string& path);

/// The sample types a format has, the usual one first.
const std::vector<SampleType>& sample_types_of(ImageFormat format);
int most_channels(ImageFormat format);
/// Texels a row, and rows: 65,500 of JPEG; others have room for what memory has.
int most_texels_a_side(ImageFormat format);

/// Whether values are rounded to whole numbers: Uint8 and Uint16.
bool is_integer(SampleType type);

/// "uint8", "uint16", "half", "float".
const char* name_of(SampleType type);
/// "png", "exr", "jpeg", "tiff".
const char* name_of(ImageFormat format);

}  // namespace sphparam
