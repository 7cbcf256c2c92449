// One thread, whatever the machine has: the bytes are the same everywhere.

#include "image/oiio/webp_encoder.h"

#include <webp/encode.h>

#include <memory>
#include <string_view>

namespace {

constexpr int lossless_level = 6;  // of libwebp, 0 to 9: slower and smaller
constexpr int lossy_method = 5;    // of libwebp, 0 to 6, likewise

struct Sink {
  SphparamBytesSink bytes;
  void* context;

  static int take(const std::uint8_t* data, size_t size, const WebPPicture* picture) {
    const auto& sink = *static_cast<const Sink*>(picture->custom_ptr);
    sink.bytes(sink.context, reinterpret_cast<const char*>(data), size);
    return 1;
  }
};

bool configure(const SphparamWebp& image, WebPConfig& config) {
  if (!WebPConfigInit(&config)) return false;
  if (image.lossless) {
    config.exact = 1;
    return WebPConfigLosslessPreset(&config, lossless_level) != 0;
  }
  config.quality = static_cast<float>(image.quality);
  config.method = lossy_method;
  config.alpha_quality = 100;
  config.exact = 1;          // colours beneath what is transparent bleed where texels are mixed
  config.use_sharp_yuv = 1;  // colours are halved in resolution, and their edges kept
  return true;
}

}  // namespace

int encode_webp(const SphparamWebp* image, SphparamBytesSink bytes, void* context,
                SphparamBytesSink error, void* error_context) {
  const auto fail = [&](std::string_view why) {
    error(error_context, why.data(), why.size());
    return 1;
  };
  WebPConfig config;
  WebPPicture picture;
  if (!configure(*image, config) || !WebPValidateConfig(&config) || !WebPPictureInit(&picture))
    return fail("libwebp does not take these settings");
  const std::unique_ptr<WebPPicture, void (*)(WebPPicture*)> freed(&picture, WebPPictureFree);
  Sink sink{bytes, context};
  picture.use_argb = 1;
  picture.width = image->width;
  picture.height = image->height;
  picture.writer = Sink::take;
  picture.custom_ptr = &sink;
  const int stride = image->channels * image->width;
  const bool imported = (image->channels == 4
                             ? WebPPictureImportRGBA(&picture, image->samples, stride)
                             : WebPPictureImportRGB(&picture, image->samples, stride)) != 0;
  if (!imported || !WebPEncode(&config, &picture))
    return fail("libwebp gave up: error " + std::to_string(picture.error_code));
  return 0;
}
