#include "image/oiio/jpeg.h"

#include <algorithm>

// ISO/IEC 10918-1, Annex B: segments begin with 0xff, a kind and, but for a few, their length;
// behind that of a scan (0xda) come its data, in which 0xff stands before 0 or a restart only.

namespace sphparam {

bool Jpeg::has_all_scans() const {
  std::map<unsigned, Coefficients> sent;
  bool is_progressive = false;
  for (size_t at = 2; at < bytes_.size();) {
    const unsigned kind = byte(at) == 0xff ? byte(at + 1) : 0;
    if (!has_length(kind)) {  // data of a scan
      ++at;
      continue;
    }
    if (kind >= 0xc0 && kind <= 0xc2) {
      is_progressive = kind == 0xc2;
      for (unsigned i = 0; i < byte(at + 9); ++i) sent[byte(at + 10 + 3 * i)];
    }
    if (kind == 0xda) note_scan(at, is_progressive, sent);
    at += 2 + 256 * byte(at + 2) + byte(at + 3);
  }
  const auto is_whole = [](const auto& component) { return component.second.all(); };
  return !sent.empty() && std::all_of(sent.begin(), sent.end(), is_whole);
}

void Jpeg::note_scan(size_t at, bool is_progressive, std::map<unsigned, Coefficients>& sent) const {
  const unsigned count = byte(at + 4);
  const size_t spectrum = at + 5 + 2 * size_t{count};
  const unsigned first = is_progressive ? byte(spectrum) : 0,
                 last = is_progressive ? byte(spectrum + 1) : coefficients - 1,
                 bits_left = is_progressive ? byte(spectrum + 2) & 15 : 0;
  if (bits_left > 0) return;
  for (unsigned i = 0; i < count; ++i)
    for (unsigned k = first; k <= last && k < coefficients; ++k) sent[byte(at + 5 + 2 * i)].set(k);
}

size_t Jpeg::segment(std::string_view kinds) const {
  size_t at = 2;
  while ((at = bytes_.find('\xff', at)) != bytes_.npos &&
         kinds.find(static_cast<char>(byte(at + 1))) == kinds.npos)
    at += byte(at + 1) == 0xff ? 1 : 2 + 256 * byte(at + 2) + byte(at + 3);
  return at;
}

}  // namespace sphparam
