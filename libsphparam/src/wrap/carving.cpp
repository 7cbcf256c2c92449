// Points wait in buckets by their values, 1/64 of a voxel each; the last bucket that has any
// is worked off as a whole, first come, first served, so that fronts advance evenly and meet
// half-way. A point that is not simple leaves, and comes back with the next of its neighbours that
// goes.

#include "wrap/carving.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <memory>

namespace sphparam {

namespace {

constexpr int neighbours = Lattice::neighbours;
constexpr unsigned all_neighbours = (1u << neighbours) - 1;

/// Coordinates −1, 0, 1 of a neighbour.
std::array<int, 3> offset(int k) {
  const int direction = k % 7 + 1, sign = k < 7 ? 1 : -1;
  return {sign * (direction & 1), sign * (direction >> 1 & 1), sign * (direction >> 2 & 1)};
}

bool are_joined(int k, int l) {
  const std::array<int, 3> a = offset(k), b = offset(l);
  int least = 0, greatest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    least = std::min(least, b[axis] - a[axis]);
    greatest = std::max(greatest, b[axis] - a[axis]);
  }
  return greatest - least == 1;
}

std::array<unsigned, neighbours> link_of_a_point() {
  std::array<unsigned, neighbours> joined{};
  for (int k = 0; k < neighbours; ++k) {
    for (int l = 0; l < neighbours; ++l) joined[k] |= are_joined(k, l) ? 1u << l : 0u;
  }
  return joined;
}

/// Whether these points of the link are one piece of it; none are not.
bool is_connected(unsigned points) {
  static const std::array<unsigned, neighbours> joined = link_of_a_point();
  unsigned reached = points & -points, before = 0;
  while (reached != before) {
    before = reached;
    for (int k = 0; k < neighbours; ++k) {
      if (before >> k & 1) reached |= joined[k] & points;
    }
  }
  return points != 0 && reached == points;
}

using SimpleTable = std::bitset<1u << neighbours>;

const SimpleTable& simple_table() {
  static const std::unique_ptr<const SimpleTable> table = [] {
    auto made = std::make_unique<SimpleTable>();
    for (unsigned m = 0; m <= all_neighbours; ++m)
      (*made)[m] = is_connected(m) && is_connected(all_neighbours & ~m);
    return made;
  }();
  return *table;
}

enum : std::uint8_t { Air = 0, Full = 1, Kept = 2, Waiting = 4 };

class Carver {
 public:
  Carver(const Lattice& lattice, const std::vector<float>& field, const Solid& kept)
      : lattice_(lattice), strides_(lattice.strides()), field_(field), marks_(field.size(), Air) {
    for_each_inner([&](std::int64_t i) {
      marks_[static_cast<size_t>(i)] = kept[static_cast<size_t>(i)] ? Full | Kept : Full;
    });
    for_each_inner([&](std::int64_t i) { wait(i); });
  }

  void run(const Progress& progress) {
    const auto total = static_cast<double>(marks_.size());
    for (std::int64_t done = 0; last_ >= 0;) {
      std::vector<std::int64_t> batch;
      batch.swap(buckets_[static_cast<size_t>(last_)]);
      for (const std::int64_t i : batch) done += try_to_remove(i);
      while (last_ >= 0 && buckets_[static_cast<size_t>(last_)].empty()) --last_;
      report(progress, "carving", std::min(1.0, static_cast<double>(done) / total));
    }
  }

  Solid solid() {
    for (std::uint8_t& mark : marks_) mark &= Full;
    return std::move(marks_);
  }

 private:
  template <class Visit>
  void for_each_inner(const Visit& visit) const {
    for (int z = 1; z + 1 < lattice_.points[2]; ++z) {
      for (int y = 1; y + 1 < lattice_.points[1]; ++y) {
        for (int x = 1; x + 1 < lattice_.points[0]; ++x) visit(lattice_.index(x, y, z));
      }
    }
  }

  unsigned solid_neighbours(std::int64_t i) const {
    unsigned bits = 0;
    for (int k = 0; k < neighbours; ++k)
      bits |= static_cast<unsigned>(marks_[static_cast<size_t>(i + strides_[k])] & Full) << k;
    return bits;
  }

  /// Unless it is kept, waits already, or no air is beside it.
  void wait(std::int64_t i) {
    std::uint8_t& mark = marks_[static_cast<size_t>(i)];
    if (mark != Full || solid_neighbours(i) == all_neighbours) return;
    mark |= Waiting;
    const auto bucket = static_cast<std::ptrdiff_t>(
        std::max(0.0f, std::floor(64 * field_[static_cast<size_t>(i)])));
    if (bucket >= static_cast<std::ptrdiff_t>(buckets_.size()))
      buckets_.resize(static_cast<size_t>(bucket) + 1);
    buckets_[static_cast<size_t>(bucket)].push_back(i);
    last_ = std::max(last_, bucket);
  }

  bool try_to_remove(std::int64_t i) {
    std::uint8_t& mark = marks_[static_cast<size_t>(i)];
    mark = Full;
    if (!is_simple(solid_neighbours(i))) return false;
    mark = Air;
    for (const std::int64_t stride : strides_) wait(i + stride);
    return true;
  }

  const Lattice& lattice_;
  const std::array<std::int64_t, neighbours> strides_;
  const std::vector<float>& field_;
  Solid marks_;
  std::vector<std::vector<std::int64_t>> buckets_;
  std::ptrdiff_t last_ = -1;  // bucket that is not empty
};

}  // namespace

bool is_simple(unsigned solid_neighbours) { return simple_table()[solid_neighbours]; }

Solid carve_ball(const Lattice& lattice, const std::vector<float>& field, const Solid& kept,
                 const Progress& progress) {
  Carver carver(lattice, field, kept);
  carver.run(progress);
  return carver.solid();
}

}  // namespace sphparam
