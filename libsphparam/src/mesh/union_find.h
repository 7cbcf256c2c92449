#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace sphparam {

/// Classes of the numbers 0 … count − 1; each is named after its smallest member.
class UnionFind {
 public:
  explicit UnionFind(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int x) {
    while (parent_[index(x)] != x) {
      parent_[index(x)] = parent_[index(parent_[index(x)])];
      x = parent_[index(x)];
    }
    return x;
  }
  /// Whether they were apart before.
  bool unite(int a, int b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    parent_[index(std::max(a, b))] = std::min(a, b);
    return true;
  }

 private:
  static size_t index(int x) { return static_cast<size_t>(x); }
  std::vector<int> parent_;
};

}  // namespace sphparam
