// One thread, whatever the machine has: the bytes are the same everywhere.

#include "image/oiio/webp_codec.h"

#include <OpenImageIO/imageio.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include <exception>
#include <memory>
#include <new>
#include <string>

namespace {

constexpr int lossless_level = 6;  // of libwebp, 0 to 9: slower and smaller
constexpr int lossy_method = 5;    // of libwebp, 0 to 6, likewise

/// Where what went wrong is told.
struct Complaint {
  SphparamBytesSink sink;
  void* context;

  int operator()(const std::string& why) const {
    sink(context, why.data(), why.size());
    return 1;
  }
};

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

std::optional<WebpHead> webp_head(const char* bytes, size_t size) {
  WebPBitstreamFeatures features;
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes);
  if (WebPGetFeatures(data, size, &features) != VP8_STATUS_OK || features.has_animation)
    return std::nullopt;
  return WebpHead{features.width, features.height, features.has_alpha ? 4 : 3};
}

int decode_webp(const WebpHead& head, const char* bytes, size_t size, SphparamPixelRoom room,
                void* room_context, SphparamBytesSink error, void* error_context) {
  const Complaint complain{error, error_context};
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes);
  const auto decode = head.channels == 4 ? WebPDecodeRGBA : WebPDecodeRGB;
  int width = 0, height = 0;
  const std::unique_ptr<std::uint8_t, void (*)(void*)> samples(decode(data, size, &width, &height),
                                                               WebPFree);
  if (!samples || width != head.width || height != head.height)
    return complain("a WebP image that is broken or cut short");
  float* const pixels = room(room_context, head.width, head.height, head.channels);
  if (!pixels) return complain(sphparam_image_no_memory);
  const int row = head.width * head.channels;
  for (std::ptrdiff_t y = 0; y < head.height; ++y) {
    OIIO::convert_pixel_values(OIIO::TypeDesc::UINT8, samples.get() + y * row,
                               OIIO::TypeDesc::FLOAT, pixels + y * row, row);
  }
  return 0;
}

int encode_webp(const SphparamWebp* image, SphparamBytesSink bytes, void* context,
                SphparamBytesSink error, void* error_context) try {
  const Complaint complain{error, error_context};
  WebPConfig config;
  if (!configure(*image, config) || !WebPValidateConfig(&config))
    return complain("libwebp does not take these settings");
  Encoding encoding;
  if (!take_samples(encoding.picture, *image) || !WebPEncode(&config, &encoding.picture))
    return complain("libwebp gave up: error " + std::to_string(encoding.picture.error_code));
  bytes(context, reinterpret_cast<const char*>(encoding.file.mem), encoding.file.size);
  return 0;
} catch (const std::bad_alloc&) {
  return Complaint{error, error_context}(sphparam_image_no_memory);
} catch (const std::exception& e) {
  return Complaint{error, error_context}(e.what());
}
