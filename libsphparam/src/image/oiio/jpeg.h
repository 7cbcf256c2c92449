#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace sphparam {

/// The JPEG that bytes hold.
class Jpeg {
 public:
  explicit Jpeg(std::string_view bytes) : bytes_(bytes) {}

  /// Whether no end follows the first scan. (In a scan, 0xff is never before 0xd9; what is behind
  /// the end, as films of telephones are, does not matter.)
  bool lacks_end() const { return bytes_.find(end, segment("\xda")) == bytes_.npos; }

  /// Whether no scan is missing: of every component all coefficients are there to the last bit,
  /// which those of a progressive JPEG get scan by scan. Whether the data of a scan are complete
  /// the decoder notices, where no end follows it.
  bool has_all_scans() const;

  std::string with_end() const { return std::string(bytes_) + end; }

 private:
  static constexpr char end[] = "\xff\xd9";
  static constexpr size_t coefficients = 64;

  /// Whether a marker begins a segment; 0, 1, 0xff and those of restarts, start and end do not.
  static bool has_length(unsigned kind) {
    return kind > 1 && kind < 0xff && !(kind >= 0xd0 && kind <= 0xd9);
  }

  using Coefficients = std::bitset<coefficients>;
  /// Notes what the scan at `at` has to the last bit.
  void note_scan(size_t at, bool is_progressive, std::map<unsigned, Coefficients>& sent) const;

  unsigned byte(size_t i) const { return i < bytes_.size() ? static_cast<uint8_t>(bytes_[i]) : 0; }

  /// Where the first segment of one of these kinds begins, of the head or behind it. (One of the
  /// head may hold a thumbnail, with scan and end.)
  size_t segment(std::string_view kinds) const;

  std::string_view bytes_;
};

}  // namespace sphparam
