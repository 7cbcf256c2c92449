// One thread, whatever the machine has: the bytes are the same everywhere.

#include "image/oiio/webp_codec.h"

#include <OpenImageIO/imageio.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

namespace {

constexpr int lossless_level = 6;  // of libwebp, 0 to 9: slower and smaller
constexpr int lossy_method = 5;    // of libwebp, 0 to 6, likewise

int complain(SphparamBytesSink error, const std::string& why) {
  error.take(error.context, why.data(), why.size());
  return 1;
}

/// Colours beneath what is transparent are kept too: they bleed where texels are mixed.
bool configure(const SphparamWebp& image, WebPConfig& config) {
  if (!WebPConfigInit(&config)) return false;
  config.exact = 1;
  if (image.lossless) return WebPConfigLosslessPreset(&config, lossless_level) != 0;
  config.quality = static_cast<float>(image.quality);
  config.method = lossy_method;
  config.alpha_quality = 100;
  config.use_sharp_yuv = 1;  // colours are halved in resolution, and their edges kept
  return true;
}

/// What is freed on every way out.
struct Encoding {
  WebPPicture picture;
  WebPMemoryWriter file;

  Encoding() {
    if (!WebPPictureInit(&picture)) throw std::runtime_error("libwebp is of another version");
    WebPMemoryWriterInit(&file);
    picture.use_argb = 1;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &file;
  }
  ~Encoding() {
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&file);
  }
  Encoding(const Encoding&) = delete;
  Encoding& operator=(const Encoding&) = delete;
};

bool take_samples(WebPPicture& picture, const SphparamWebp& image) {
  picture.width = image.width;
  picture.height = image.height;
  const int stride = image.channels * image.width;
  return (image.channels == 4 ? WebPPictureImportRGBA(&picture, image.samples, stride)
                              : WebPPictureImportRGB(&picture, image.samples, stride)) != 0;
}

}  // namespace

std::optional<WebpHead> webp_head(std::string_view bytes) {
  WebPBitstreamFeatures features;
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK || features.has_animation)
    return std::nullopt;
  return WebpHead{features.width, features.height, features.has_alpha ? 4 : 3};
}

void decode_webp(const WebpHead& head, std::string_view bytes, SphparamPixelRoom room) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const auto decode = head.channels == 4 ? WebPDecodeRGBA : WebPDecodeRGB;
  int width = 0, height = 0;
  const std::unique_ptr<std::uint8_t, void (*)(void*)> samples(
      decode(data, bytes.size(), &width, &height), WebPFree);
  if (!samples || width != head.width || height != head.height)
    throw std::runtime_error("a WebP image that is broken or cut short");
  float* const pixels = room.make(room.context, head.width, head.height, head.channels);
  if (!pixels) throw std::runtime_error(sphparam_image_no_memory);
  const int row = head.width * head.channels;
  for (std::ptrdiff_t y = 0; y < head.height; ++y) {
    OIIO::convert_pixel_values(OIIO::TypeDesc::UINT8, samples.get() + y * row,
                               OIIO::TypeDesc::FLOAT, pixels + y * row, row);
  }
}

int encode_webp(const SphparamWebp* image, SphparamBytesSink bytes, SphparamBytesSink error) try {
  WebPConfig config;
  if (!configure(*image, config) || !WebPValidateConfig(&config))
    return complain(error, "libwebp does not take these settings");
  Encoding encoding;
  if (!take_samples(encoding.picture, *image) || !WebPEncode(&config, &encoding.picture))
    return complain(error, "libwebp gave up: error " + std::to_string(encoding.picture.error_code));
  bytes.take(bytes.context, reinterpret_cast<const char*>(encoding.file.mem), encoding.file.size);
  return 0;
} catch (const std::bad_alloc&) {
  return complain(error, sphparam_image_no_memory);
} catch (const std::exception& e) {
  return complain(error, e.what());
}
