#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sphparam {

/// In groups of four characters, the last one filled up with '='.
std::string to_base64(std::string_view bytes);

/// Decodes base64 text as far as is wanted. Texts that follow one another, each with a filling of
/// its own, are read as one; blanks between groups are passed over.
class Base64Reader {
 public:
  /// Requires: `text` outlives the reader.
  explicit Base64Reader(std::string_view text) : text_(text) {}

  /// The next bytes are put at the end of `bytes`. False where there are fewer, or where the text
  /// is no base64.
  bool read(std::uint64_t count, std::string& bytes);

  /// Bytes that can still come, at most.
  std::uint64_t most_remaining() const { return ready_.size() + (text_.size() / 4 + 1) * 3; }

 private:
  bool decode_group();

  std::string_view text_;  // what is left of it
  std::string ready_;      // decoded and not asked for: less than a group
};

}  // namespace sphparam
