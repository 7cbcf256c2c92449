#include "image/oiio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

// The only code that knows OpenImageIO. Files are decoded from memory by the decoder that the
// caller named after looking at the first bytes: Debian's build has 29 of them, some of which have
// known holes, and would choose by content itself.

namespace {

void tell(SphparamBytesSink sink, void* context, const std::string& text) {
  sink(context, text.data(), text.size());
}

/// A compressed image cannot grow without bound: deflate, the best of these codecs at it, reaches
/// 1032:1. Small images are let pass whatever they claim.
bool grows_too_much(int64_t decoded, size_t file) {
  constexpr int64_t harmless = int64_t{16} << 20, most_per_byte = 1100;
  return decoded > harmless && decoded / most_per_byte > static_cast<int64_t>(file);
}

/// Empty, or why the image is refused.
std::string refusal(const OIIO::ImageSpec& spec, size_t file_size, int64_t max_megabytes,
                    int max_channels) {
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0) {
    return "not a flat image with at least one pixel";
  }
  if (spec.deep) return "deep images are not supported";
  if (spec.nchannels > max_channels) {
    return std::to_string(spec.nchannels) + " channels, more than the limit of " +
           std::to_string(max_channels);
  }
  const auto decoded = static_cast<int64_t>(spec.width) * spec.height * spec.nchannels *
                       static_cast<int64_t>(spec.format.size());
  if (decoded > (max_megabytes << 20)) {
    return std::to_string(spec.width) + " x " + std::to_string(spec.height) +
           " pixels are more than the limit of " + std::to_string(max_megabytes) + " MB";
  }
  if (grows_too_much(decoded, file_size)) return "claims to be far larger than its bytes can hold";
  return "";
}

int decode(const char* format, const char* bytes, size_t size, int64_t max_megabytes,
           int max_channels, SphparamPixelRoom room, void* room_context, SphparamBytesSink error,
           void* error_context) try {
  OIIO::attribute("limits:imagesize_MB", static_cast<int>(max_megabytes));
  OIIO::attribute("limits:channels", max_channels);
  const auto fail = [&](const std::string& why) {
    tell(error, error_context, why);
    return 1;
  };
  // From memory only, whatever the decoder would like to open.
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes), size);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format, false);
  if (!input) return fail(OIIO::geterror());
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->set_ioproxy(&memory)) return fail("this decoder cannot read from memory");
  if (!input->open(std::string("memory.") + format, spec, config)) return fail(input->geterror());
  const std::string refused = refusal(spec, size, max_megabytes, max_channels);
  if (!refused.empty()) return fail(refused);
  float* pixels = room(room_context, spec.width, spec.height, spec.nchannels);
  if (!pixels) return fail("not enough memory");
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels)) {
    return fail(input->geterror());
  }
  return 0;
} catch (const std::exception& e) {
  tell(error, error_context, e.what());
  return 1;
}

/// "YYYY:MM:DD hh:mm:ss" of SOURCE_DATE_EPOCH, so that files do not depend on the clock.
std::string reproducible_date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t time = epoch ? std::atoll(epoch) : 0;
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc);
  return text;
}

int encode(const char* format, const char* sample_type, const float* pixels, int width, int height,
           int channels, const char* const* metadata, size_t metadata_count, SphparamBytesSink out,
           void* out_context, SphparamBytesSink error, void* error_context) try {
  const auto fail = [&](const std::string& why) {
    tell(error, error_context, why);
    return 1;
  };
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc(sample_type));
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (std::string(format) == "exr") {
    spec.attribute("DateTime", reproducible_date());
    spec.attribute("compression", "zip");
  } else {
    spec.attribute("png:compressionLevel", 6);
  }
  for (size_t i = 0; i < metadata_count; ++i) spec.attribute(metadata[2 * i], metadata[2 * i + 1]);
  std::vector<unsigned char> buffer;
  OIIO::Filesystem::IOVecOutput memory(buffer);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) return fail(OIIO::geterror());
  if (!output->set_ioproxy(&memory)) return fail("this encoder cannot write to memory");
  if (!output->open(std::string("memory.") + format, spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, pixels) || !output->close()) {
    return fail(output->geterror());
  }
  out(out_context, reinterpret_cast<const char*>(buffer.data()), buffer.size());
  return 0;
} catch (const std::exception& e) {
  tell(error, error_context, e.what());
  return 1;
}

constexpr SphparamImageTable kTable{kSphparamImageTableVersion, decode, encode};

}  // namespace

extern "C" __attribute__((visibility("default"))) const SphparamImageTable* sphparam_image_table() {
  return &kTable;
}
