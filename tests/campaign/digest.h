#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>

namespace sphparam::campaign {

/// 64 bits of numbers, by FNV-1a a number: whether two runs made the same. The product moves bits
/// up alone, and so a sign nowhere: it is brought down.
class Digest {
 public:
  template <class Table>
  void add(const Table& table) {
    for (Eigen::Index i = 0; i < table.size(); ++i) add_bits(bits_of(table.data()[i]));
  }
  std::uint64_t bits() const { return bits_; }

 private:
  static std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }
  static std::uint64_t bits_of(int x) { return static_cast<std::uint64_t>(x); }
  void add_bits(std::uint64_t bits) {
    bits_ = (bits_ ^ bits) * 0x100000001b3;
    bits_ ^= bits_ >> 32;
  }

  std::uint64_t bits_ = 0xcbf29ce484222325;
};

}  // namespace sphparam::campaign
