// Segments are passed by their lengths, so that a thumbnail in one of them is not taken for the
// image. In what follows the frame's head, FF D9 is nothing but the end: there FF is followed by 0.

#include "gltf/images/jpeg_head.h"

#include <cstddef>

namespace sphparam {
namespace {

constexpr int first_frame = 0xC0, last_frame = 0xCF, tables = 0xC4, reserved = 0xC8,
              conditioning = 0xCC;

/// SOF0 to SOF15, among which are three markers of other kinds.
bool begins_frame(int marker) {
  return marker >= first_frame && marker <= last_frame && marker != tables && marker != reserved &&
         marker != conditioning;
}

}  // namespace

JpegHead jpeg_head(std::string_view bytes) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  // Of a segment: FF, the marker, two bytes of length, and of a frame bits, height, width,
  // channels.
  constexpr std::size_t marker_bytes = 2, frame_bytes = 10, bits_at = 4, channels_at = 9;
  for (std::size_t i = marker_bytes; i + frame_bytes <= bytes.size() && at(i) == 0xFF;) {
    const int marker = at(i + 1);
    if (marker == 0xFF) {  // filling
      ++i;
    } else if (begins_frame(marker)) {
      return {.process = marker - first_frame,
              .bits = at(i + bits_at),
              .channels = at(i + channels_at),
              .found = true,
              .is_whole = bytes.find("\xFF\xD9", i) != std::string_view::npos};
    } else {
      i += marker_bytes + at(i + 2) * std::size_t{256} + at(i + 3);
    }
  }
  const std::size_t scan = bytes.rfind("\xFF\xDA");  // of a thumbnail no other one follows
  return {.is_whole = scan != std::string_view::npos &&
                      bytes.find("\xFF\xD9", scan) != std::string_view::npos};
}

}  // namespace sphparam
