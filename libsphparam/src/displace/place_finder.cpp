// Along a row of texels the two places before tell where the next one is, and one step is enough. A
// step goes over into the next patch where it leaves its own.

#include "displace/place_finder.h"

#include <cmath>

#include "displace/direction_step.h"

namespace sphparam {

namespace {

constexpr int most_steps = 24;  // of Newton, patches crossed included

}  // namespace

const DirectedPatch& PlaceFinder::make_patch(int index) {
  auto kept = kept_.find(index);
  if (kept == kept_.end()) {
    if (kept_.size() >= most_kept_) {
      recent_.fill(nullptr);
      kept_.clear();
    }
    LimitPatch surface = base_.surface().patch(index);
    LimitPatch direction(surface, base_.directions().control());
    kept = kept_.try_emplace(index, std::move(surface), std::move(direction)).first;
  }
  return *(recent_[slot(index)] = &kept->second);
}

std::optional<LimitPlace> PlaceFinder::newton(const Vector3& q, LimitPlace place) {
  const PatchNet& net = base_.net();
  for (int i = 0; i < most_steps; ++i) {
    if (net.beyond(place) > edge_rounding) {
      place = net.cross(place);
      if (net.beyond(place) > 0) place = clamped(place, net.degree());
    }
    const LimitPlace inside = clamped(place, net.degree());
    const LimitPatch& direction = patch(inside.patch).direction;
    const LimitPoint d = direction.evaluate(inside.s, inside.t);
    DirectionStep<double> step = direction_step(d.position, d.by_s, d.by_t, q);
    const double length = std::abs(step.s) + std::abs(step.t);
    if (!(step.det > 0) || !(step.ahead > 0) || !(length < 1e6)) return std::nullopt;
    if (length > longest_step) {
      step.s *= longest_step / length;
      step.t *= longest_step / length;
    }
    place = {inside.patch, inside.s + step.s, inside.t + step.t};
    if (length < last_step(direction.is_polynomial()) && net.beyond(place) <= edge_rounding)
      return clamped(place, net.degree());
  }
  return std::nullopt;
}

PlaceFinder::Found PlaceFinder::find(const Vector3& direction) {
  std::optional<LimitPlace> place;
  if (last_) {
    LimitPlace start = *last_;
    if (before_last_ && before_last_->patch == start.patch) {
      start.s += start.s - before_last_->s;
      start.t += start.t - before_last_->t;
    }
    place = newton(direction, start);
  }
  if (!place) place = newton_anew(direction);
  before_last_ = last_;
  last_ = place;
  return found(direction, place);
}

PlaceFinder::Found PlaceFinder::find(const Vector3& direction, const LimitPlace& near) {
  std::optional<LimitPlace> place = newton(direction, near);
  return found(direction, place ? place : newton_anew(direction));
}

PlaceFinder::Found PlaceFinder::found(const Vector3& direction,
                                      const std::optional<LimitPlace>& place) const {
  if (place) return {*place, true};
  return {clamped(base_.guess(direction), base_.net().degree()), false};
}

FinderPool::Lent FinderPool::lend() const {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<PlaceFinder> finder;
  if (idle_.empty()) {
    idle_.reserve(++made_);  // so that they come back whatever memory there is
    finder = std::make_unique<PlaceFinder>(base_);
  } else {
    finder = std::move(idle_.back());
    idle_.pop_back();
  }
  return {*this, std::move(finder)};
}

FinderPool::Lent::~Lent() {
  const std::lock_guard lock(pool_.mutex_);
  pool_.idle_.push_back(std::move(finder_));
}

}  // namespace sphparam
