#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "displace/directed_base.h"

namespace sphparam {

/// Both of a base's surfaces on one patch.
struct DirectedPatch {
  DirectedPatch(LimitPatch surface, LimitPatch direction)
      : surface(std::move(surface)), direction(std::move(direction)) {}
  LimitPatch surface, direction;
};

/// Finds the places of directions, fast where one is near the one before. One for each thread.
class PlaceFinder {
 public:
  /// `most_kept`: patches that are kept, of 1 kB; when there are more, it begins anew.
  explicit PlaceFinder(const DirectedBase& base, size_t most_kept = 1 << 14)
      : base_(base), most_kept_(most_kept) {}

  struct Found {
    LimitPlace place;  // within its patch
    bool exact;  // else the grid's own place, where the directions' surface folds or Newton fails
  };
  /// Requires: unit direction. Ensures: where `exact`, the place's direction is the one asked for,
  /// to 1e-7 of a face where faces beside one another are of like sizes. `start_anew` forgets the
  /// search before, so that what is found does not depend on it, not even by rounding.
  Found find(const Vector3& direction);
  void start_anew() { last_.reset(); }
  /// The same from a place that should be near.
  Found find(const Vector3& direction, const LimitPlace& near);

  /// Until the next call.
  const DirectedPatch& patch(int index) {
    const DirectedPatch* recent = recent_[slot(index)];
    return recent && recent->surface.index() == index ? *recent : make_patch(index);
  }
  const DirectedBase& base() const { return base_; }

  static constexpr double longest_step = 0.75;   // in parameters: beyond, a patch says nothing
  static constexpr double edge_rounding = 1e-9;  // beyond the edge of a patch, and still in it
  /// Of a polynomial the next step would be some 1e-8; derivatives of other patches are not quite
  /// those of their points.
  static constexpr double last_step(bool of_polynomial) { return of_polynomial ? 1e-4 : 5e-6; }

 private:
  static constexpr size_t recent_count = 1 << 10;
  static size_t slot(int index) { return static_cast<size_t>(index) % recent_count; }
  const DirectedPatch& make_patch(int index);
  std::optional<LimitPlace> newton(const Vector3& direction, LimitPlace place);
  std::optional<LimitPlace> newton_anew(const Vector3& direction) {
    return newton(direction, base_.guess(direction));
  }
  Found found(const Vector3& direction, const std::optional<LimitPlace>& place) const;

  const DirectedBase& base_;
  size_t most_kept_;
  std::unordered_map<int, DirectedPatch> kept_;
  std::array<const DirectedPatch*, recent_count> recent_{};  // each where its number says
  std::optional<LimitPlace> last_, before_last_;
};

/// Finders of a base, with the patches that they made: lent to whoever works on some rows.
class FinderPool {
 public:
  explicit FinderPool(const DirectedBase& base) : base_(base) {}

  /// A finder, until this ends.
  class Lent {
   public:
    Lent(const FinderPool& pool, std::unique_ptr<PlaceFinder> finder)
        : pool_(pool), finder_(std::move(finder)) {}
    ~Lent();
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;
    PlaceFinder& operator*() const { return *finder_; }

   private:
    const FinderPool& pool_;
    std::unique_ptr<PlaceFinder> finder_;
  };
  /// One that nobody has; what it was asked before leaves no trace in what it finds. May be called
  /// from many threads.
  Lent lend() const;

 private:
  const DirectedBase& base_;
  mutable std::mutex mutex_;
  mutable size_t made_ = 0;
  mutable std::vector<std::unique_ptr<PlaceFinder>> idle_;
};

}  // namespace sphparam
