#include "image/image_codec.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>

#include "image/bmp.h"
#include "image/image_writer.h"
#include "image/integer_sample.h"
#include "image/open_module.h"
#include "image/sinks.h"
#include "image/targa.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"

// Whole images in memory, decoded and encoded by the module; BMP and TGA without it.

namespace sphparam {
namespace {

float* make_room(void* context, int width, int height, int channels) {
  auto& image = *static_cast<Image*>(context);
  try {
    image = Image(width, height, channels);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return image.pixels.data();
}

/// OpenImageIO's name of the format, told by the first bytes; null for what is not allowed.
const char* format_of(const std::vector<char>& bytes) {
  using namespace std::string_view_literals;
  const std::string_view head(bytes.data(), std::min<size_t>(bytes.size(), 12));
  if (head.starts_with("\x89PNG\r\n\x1a\n"sv)) return "png";
  if (head.starts_with("\xff\xd8\xff"sv)) return "jpeg";
  if (head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv)) return "tiff";
  if (head.starts_with("II+\0"sv) || head.starts_with("MM\0+"sv)) return "tiff";  // BigTIFF
  if (is_exr(head)) return "openexr";
  if (head.starts_with("RIFF"sv) && head.ends_with("WEBP"sv)) return "webp";
  return nullptr;
}

using Decoder = Image (*)(std::string_view, const std::string&, const ImageLimits&);

/// Our own for what the module does not decode; null for what is none of these formats.
Decoder decoder_of(std::string_view bytes) {
  if (looks_like_bmp(bytes)) return decode_bmp;
  return looks_like_targa(bytes) ? decode_targa : nullptr;
}

template <class Sample>
std::vector<Sample> integers(const float* values, size_t count) {
  std::vector<Sample> samples(count);
  std::transform(values, values + count, samples.begin(), integer_sample<Sample>);
  return samples;
}

Image decode_ourselves(std::string_view bytes, const std::string& name,
                       const ImageLimits& limits) try {
  if (const Decoder decode = decoder_of(bytes)) return decode(bytes, name, limits);
  throw ImageError(name + ": not a PNG, JPEG, WebP, TIFF, EXR, BMP or TGA image");
} catch (const ReadError& error) {
  throw ImageError(error.what());
}

std::vector<char> read_bytes(const std::string& path, const ImageLimits& limits) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw ImageError(path + ": " + error.message());
  if (size > static_cast<std::uintmax_t>(limits.file_bytes)) {
    throw ImageError(path + ": " + std::to_string(size) + " bytes, more than the limit of " +
                     std::to_string(limits.file_bytes));
  }
  std::vector<char> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw ImageError(path + ": cannot be read");
  }
  return bytes;
}

}  // namespace

bool is_image(const std::vector<char>& bytes) {
  return format_of(bytes) || decoder_of({bytes.data(), bytes.size()});
}

bool is_exr(std::string_view bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

Image decode_image(const std::vector<char>& bytes, std::string_view name, const ImageLimits& limits,
                   ImageTexts* texts) {
  const std::string prefix = std::string(name) + ": ";
  const char* format = format_of(bytes);
  if (!format) return decode_ourselves({bytes.data(), bytes.size()}, std::string(name), limits);
  Image image;
  std::string error;
  const SphparamTextSink told = texts ? into(*texts) : SphparamTextSink{};
  if (image_codecs().decode(format, bytes.data(), bytes.size(),
                            {limits.decoded_megabytes, limits.channels}, {make_room, &image}, told,
                            into(error)) != 0) {
    throw_told(prefix, error.empty() ? "broken image" : error);
  }
  return image;
}

Image read_image(const std::string& path, const ImageLimits& limits, ImageTexts* texts) {
  return decode_image(read_bytes(path, limits), path, limits, texts);
}

std::vector<char> encode_image(const Image& image, ImageFormat format,
                               const ImageWriteOptions& options) {
  std::vector<char> bytes;
  ImageWriter writer({.width = image.width,
                      .height = image.height,
                      .channels = image.channels,
                      .format = format,
                      .sample_type = options.sample_type,
                      .metadata = options.metadata},
                     in_memory(bytes));
  constexpr int rows_at_once = 64;
  for (int row = 0; row < image.height; row += rows_at_once) {
    const int rows = std::min(rows_at_once, image.height - row);
    const float* const pixels = image.pixel(0, row);
    const size_t count = static_cast<size_t>(rows) * static_cast<size_t>(image.width) *
                         static_cast<size_t>(image.channels);
    if (options.sample_type == SampleType::Uint8) {
      writer.write_rows(integers<std::uint8_t>(pixels, count).data(), rows);
    } else if (options.sample_type == SampleType::Uint16) {
      writer.write_rows(integers<std::uint16_t>(pixels, count).data(), rows);
    } else {
      writer.write_rows(pixels, rows);
    }
  }
  writer.close();
  return bytes;
}

void write_image(const std::string& path, const Image& image, const ImageWriteOptions& options) {
  const std::string extension = extension_of(path);
  if (extension != ".png" && extension != ".exr") {
    throw ImageError(path + ": images are written as .png or .exr");
  }
  const ImageFormat format = extension == ".png" ? ImageFormat::Png : ImageFormat::Exr;
  const std::vector<char> bytes = encode_image(image, format, options);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw ImageError(path + ": cannot be written");
}

}  // namespace sphparam
