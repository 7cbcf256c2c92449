#pragma once

#include <string_view>

namespace sphparam {

/// What the head of a JPEG says of its pixels. Zero: there is no such head.
struct JpegHead {
  int process = 0;  // 0: baseline, 2: progressive, 9: arithmetic coding, …: n of the marker SOFn
  int bits = 0, channels = 0;
  bool found = false;     // the head is there; it is not where segments do not follow one another
  bool is_whole = false;  // its end is there

  /// What all decoders have, and glTF and the JFIF take: 8 bits, Huffman coding, grey or colours.
  bool is_common() const {
    return (process == 0 || process == 2) && bits == 8 && (channels == 1 || channels == 3);
  }
};

/// ITU-T T.81, Annex B. For any bytes.
JpegHead jpeg_head(std::string_view bytes);

}  // namespace sphparam
