// Any bytes are an image that our own decoders read, or a ReadError. What was read is as large as
// it says, within the limits, of numbers from 0 to 1.

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "expect.h"
#include "image/bmp.h"
#include "image/targa.h"
#include "sphparam/io/read_options.h"

namespace {

using namespace sphparam;
using sphparam::tests::expect;

constexpr ImageLimits limits{.decoded_megabytes = 16};

void expect_promises(const Image& image) {
  expect(image.width > 0 && image.height > 0, "an image has a pixel");
  expect(image.channels >= 1 && image.channels <= 4, "grey or colours, with alpha or without");
  const std::size_t samples = static_cast<std::size_t>(image.width) * image.height * image.channels;
  expect(image.pixels.size() == samples, "an image is as large as it says");
  expect(samples <= static_cast<std::size_t>(limits.decoded_megabytes) << 20,
         "an image is within the limits");
  expect(std::ranges::all_of(image.pixels, [](float x) { return x >= 0 && x <= 1; }),
         "samples are from 0 to 1");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    if (looks_like_bmp(bytes)) expect_promises(decode_bmp(bytes, "fuzzed.bmp", limits));
    if (looks_like_targa(bytes)) expect_promises(decode_targa(bytes, "fuzzed.tga", limits));
  } catch (const ReadError&) {
  }
  return 0;
}
