#include "sphparam/image/image_format.h"

#include <limits>

#include "sphparam/io/paths.h"

namespace sphparam {

std::optional<ImageFormat> image_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".png") return ImageFormat::Png;
  if (extension == ".exr") return ImageFormat::Exr;
  if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::Jpeg;
  if (extension == ".tif" || extension == ".tiff") return ImageFormat::Tiff;
  return std::nullopt;
}

const std::vector<SampleType>& sample_types_of(ImageFormat format) {
  using enum SampleType;
  static const std::vector<SampleType> png = {Uint8, Uint16}, exr = {Half, Float}, jpeg = {Uint8},
                                       tiff = {Uint8, Uint16, Float};
  switch (format) {
    case ImageFormat::Png:
      return png;
    case ImageFormat::Exr:
      return exr;
    case ImageFormat::Jpeg:
      return jpeg;
    case ImageFormat::Tiff:
      break;
  }
  return tiff;
}

int most_channels(ImageFormat format) {
  return format == ImageFormat::Jpeg ? 3 : format == ImageFormat::Exr ? 1024 : 4;
}

int most_texels_a_side(ImageFormat format) {
  constexpr int of_libjpeg = 65500;
  return format == ImageFormat::Jpeg ? of_libjpeg : std::numeric_limits<int>::max();
}

const char* name_of(SampleType type) {
  switch (type) {
    case SampleType::Uint8:
      return "uint8";
    case SampleType::Uint16:
      return "uint16";
    case SampleType::Half:
      return "half";
    case SampleType::Float:
      return "float";
  }
  return "";
}

bool is_integer(SampleType type) { return type == SampleType::Uint8 || type == SampleType::Uint16; }

const char* name_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::Png:
      return "png";
    case ImageFormat::Exr:
      return "exr";
    case ImageFormat::Jpeg:
      return "jpeg";
    case ImageFormat::Tiff:
      return "tiff";
  }
  return "";
}

}  // namespace sphparam
