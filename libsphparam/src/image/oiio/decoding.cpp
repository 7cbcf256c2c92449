#include "image/oiio/decoding.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/oiio/colour_profile.h"
#include "image/oiio/jpeg.h"
#include "image/oiio/webp_codec.h"

// Files are decoded from memory by the decoder that the caller named after looking at the first
// bytes: Debian's build of OpenImageIO has 29 of them, some of which have known holes, and would
// choose by content itself.

namespace sphparam {
namespace {

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

/// A compressed image cannot grow without bound: deflate, the best of these codecs at it, reaches
/// 1032:1. Small images are let pass whatever they claim.
bool grows_too_much(int64_t decoded, size_t file) {
  constexpr int64_t harmless = int64_t{16} << 20, most_per_byte = 1100;
  return decoded > harmless && decoded / most_per_byte > static_cast<int64_t>(file);
}

/// Where an image may be of any size, however few its bytes are.
constexpr size_t any_size = std::numeric_limits<int64_t>::max();

void require_within(SphparamImageLimits limits, const OIIO::ImageSpec& spec, size_t file_size) {
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0)
    fail("not a flat image with at least one pixel");
  if (spec.deep) fail("deep images are not supported");
  if (spec.nchannels > limits.channels) {
    fail(std::to_string(spec.nchannels) + " channels, more than the limit of " +
         std::to_string(limits.channels));
  }
  const auto decoded = static_cast<int64_t>(spec.width) * spec.height * spec.nchannels *
                       static_cast<int64_t>(spec.format.size());
  if (decoded > (limits.megabytes << 20)) {
    fail(std::to_string(spec.width) + " x " + std::to_string(spec.height) +
         " pixels are more than the limit of " + std::to_string(limits.megabytes) + " MB");
  }
  if (grows_too_much(decoded, file_size)) fail("claims to be far larger than its bytes can hold");
}

/// WebP needs next to no bytes for one colour, however large: it may grow as much as it likes.
void require_within(SphparamImageLimits limits, const WebpHead& head) {
  const OIIO::ImageSpec spec(head.width, head.height, head.channels, OIIO::TypeDesc::UINT8);
  require_within(limits, spec, any_size);
}

/// Whether an EXR has pixels for another part of the plane than the one that is to be seen.
bool has_other_window(const OIIO::ImageSpec& spec, std::string_view format) {
  return format == "openexr" && (spec.x != spec.full_x || spec.y != spec.full_y ||
                                 spec.width != spec.full_width || spec.height != spec.full_height);
}

/// What is to be seen of it: of any size, however few bytes the pixels are that it has.
OIIO::ImageSpec seen_spec(const OIIO::ImageSpec& spec) {
  OIIO::ImageSpec seen = spec;
  seen.width = spec.full_width;
  seen.height = spec.full_height;
  return seen;
}

/// Puts the pixels where they are to be seen; black, without alpha, where there are none.
void place(const std::vector<float>& pixels, const OIIO::ImageSpec& spec, float* seen) {
  const auto channels = static_cast<int64_t>(spec.nchannels);
  std::fill_n(seen, int64_t{spec.full_width} * spec.full_height * channels, 0.0F);
  const int64_t right = int64_t{spec.x} - spec.full_x, down = int64_t{spec.y} - spec.full_y;
  const int64_t first = std::max<int64_t>(0, right),
                last = std::min<int64_t>(spec.full_width, right + spec.width);
  if (first >= last) return;
  for (int64_t row = 0; row < spec.height; ++row) {
    if (row + down < 0 || row + down >= spec.full_height) continue;
    std::copy_n(&pixels[static_cast<size_t>((row * spec.width + first - right) * channels)],
                (last - first) * channels,
                seen + ((row + down) * spec.full_width + first) * channels);
  }
}

/// What libjpeg only warns of, painting grey: data of a JPEG that end early or are damaged. Empty:
/// nothing. Of several warnings it tells the first: where that was of the head, it says nothing of
/// the data.
std::string damage_of(OIIO::ImageInput& input, const Jpeg& jpeg, bool head_was_told) {
  const std::string told = input.has_error() ? input.geterror() : "";
  const bool is_whole = told.empty() && !head_was_told && jpeg.has_all_scans();
  if (jpeg.lacks_end() && !is_whole)
    return "is cut off, the end of the JPEG is not there: copy or save it again";
  for (const char* const harmless : {"Adobe color transform", "SOS parameters"})
    if (told.find(harmless) != std::string::npos) return "";
  return told.empty() ? "" : "damaged, or ends early: " + told;
}

/// Whether a PNG ends within its pixels. libpng would print that to standard error by itself.
/// ISO/IEC 15948, 5.3: behind the signature come chunks of length, name, data and checksum.
bool is_cut_png(std::string_view bytes) {
  constexpr size_t signature = 8, head = 8, checksum = 4;
  for (size_t at = signature; at + head <= bytes.size();) {
    size_t length = 0;
    for (size_t k = 0; k < 4; ++k)
      length = 256 * length + static_cast<unsigned char>(bytes[at + k]);
    if (length > bytes.size() - at - head) return bytes.substr(at + 4, 4) == "IDAT";
    at += head + length + checksum;
  }
  return false;
}

/// A file in memory with the head read. The decoder goes before the bytes it reads from.
class FileInMemory {
 public:
  FileInMemory(const char* format, std::string_view bytes)
      : is_jpeg_(std::string_view(format) == "jpeg"),
        jpeg_(bytes),
        ended_(is_jpeg_ && jpeg_.lacks_end() ? jpeg_.with_end() : ""),
        all_(ended_.empty() ? bytes : ended_),
        // From memory only, whatever the decoder would like to open.
        memory_(const_cast<char*>(all_.data()), all_.size()),
        input_(OIIO::ImageInput::create(format, false)) {
    if (!input_) fail(OIIO::geterror());
    if (std::string_view(format) == "png" && is_cut_png(bytes))
      fail("is cut off, the PNG ends within its pixels: copy or save it again");
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input_->set_ioproxy(&memory_)) fail("this decoder cannot read from memory");
    if (!input_->open(std::string("memory.") + format, spec_, config)) fail(input_->geterror());
    // Of the head, where stray bytes do no harm.
    head_was_told_ = is_jpeg_ && !input_->geterror().empty();
  }

  const OIIO::ImageSpec& spec() const { return spec_; }
  /// Of a JPEG: its end was put there.
  bool lacked_end() const { return !ended_.empty(); }

  void read(float* pixels) {
    if (!input_->read_image(0, 0, 0, spec_.nchannels, OIIO::TypeDesc::FLOAT, pixels))
      fail(input_->geterror());
    const std::string damage = is_jpeg_ ? damage_of(*input_, jpeg_, head_was_told_) : "";
    if (!damage.empty()) fail(damage);
  }

 private:
  bool is_jpeg_;
  Jpeg jpeg_;
  std::string ended_;
  std::string_view all_;
  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
  bool head_was_told_ = false;
};

void tell(SphparamTextSink text, const char* name, const std::string& value) {
  text.take(text.context, name, value.c_str());
}

}  // namespace

void tell_texts(const OIIO::ImageSpec& spec, SphparamTextSink text) {
  for (const OIIO::ParamValue& value : spec.extra_attribs)
    if (value.type() == OIIO::TypeDesc::STRING)
      tell(text, value.name().c_str(), value.get_string());
}

void decode_in_memory(const char* format, std::string_view bytes, SphparamImageLimits limits,
                      SphparamPixelRoom room, SphparamTextSink text) {
  if (const std::optional<WebpHead> head = webp_head(bytes)) {
    require_within(limits, *head);
    return decode_webp(*head, bytes, room);
  }
  FileInMemory file(format, bytes);
  const OIIO::ImageSpec& spec = file.spec();
  require_within(limits, spec, bytes.size());
  const bool is_placed = has_other_window(spec, format);
  const OIIO::ImageSpec seen = is_placed ? seen_spec(spec) : spec;
  require_within(limits, seen, any_size);
  if (text.take) {
    tell(text, sphparam_samples,
         spec.format.c_str());  // the first of this name, whatever a file says
    tell_texts(spec, text);
    const std::string profile = other_profile(spec);
    if (!profile.empty()) tell(text, sphparam_other_profile, profile);
  }
  float* const pixels = room.make(room.context, seen.width, seen.height, seen.nchannels);
  if (!pixels) fail(sphparam_image_no_memory);
  std::vector<float> apart;
  if (is_placed) apart.resize(spec.image_pixels() * static_cast<size_t>(spec.nchannels));
  file.read(is_placed ? apart.data() : pixels);
  if (is_placed) place(apart, spec, pixels);
  if (text.take && file.lacked_end()) tell(text, sphparam_lacks_end, "1");
}

}  // namespace sphparam
