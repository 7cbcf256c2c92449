#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace sphparam {

/// Numbers the distinct rows of a table in the order of their first use: a hash table with open
/// addressing. Rows are equal when all their bits are.
/// Cost: O(1) a row, expected.
template <class Scalar, int Width>
class DistinctRows {
 public:
  using Row = std::array<Scalar, Width>;

  explicit DistinctRows(std::size_t expected_rows = 0) {
    slots_.assign(std::bit_ceil(2 * expected_rows + 16), empty);
    rows_.reserve(expected_rows);
  }

  /// The id of the row, a new one if it was not there.
  int insert(const Row& row) {
    if (2 * rows_.size() >= slots_.size()) grow();
    int& slot = slots_[find_slot(row)];
    if (slot == empty) {
      slot = static_cast<int>(rows_.size());
      rows_.push_back(row);
    }
    return slot;
  }

  bool contains(const Row& row) const { return slots_[find_slot(row)] != empty; }

  const std::vector<Row>& rows() const { return rows_; }

 private:
  static constexpr int empty = -1;
  using Bits = std::conditional_t<sizeof(Scalar) == 8, std::uint64_t, std::uint32_t>;

  static bool same_bits(const Row& a, const Row& b) {
    for (int i = 0; i < Width; ++i)
      if (std::bit_cast<Bits>(a[i]) != std::bit_cast<Bits>(b[i])) return false;
    return true;
  }

  // The finaliser of splitmix64 (Steele, Lea & Flood 2014), once per entry.
  static std::uint64_t hash(const Row& row) {
    std::uint64_t h = 0;
    for (const Scalar entry : row) {
      h += std::bit_cast<Bits>(entry) + 0x9e3779b97f4a7c15u;
      h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
      h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
      h ^= h >> 31;
    }
    return h;
  }

  std::size_t find_slot(const Row& row) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash(row) & mask;
    while (slots_[at] != empty && !same_bits(rows_[static_cast<std::size_t>(slots_[at])], row))
      at = (at + 1) & mask;
    return at;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), empty);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      slots_[find_slot(rows_[i])] = static_cast<int>(i);
  }

  std::vector<int> slots_;
  std::vector<Row> rows_;
};

}  // namespace sphparam
