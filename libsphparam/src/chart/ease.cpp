#include "chart/ease.h"

#include <algorithm>
#include <array>
#include <cmath>

// The cost of a face grows as its height falls below what is wanted, and is huge where it folds. A
// vertex tries eight directions, with steps from long to short, and takes the best place of the
// first two lengths that help. Heights below `least` are rounding, and count as folded.

namespace sphparam {
namespace {

constexpr double least = 0x1p-26;  // cells
constexpr double folded_cost = 1e20;
constexpr double longest_step = 16, longest_slide = 64;  // cells
constexpr int lengths_that_help = 2;
constexpr double least_gain = 0.01;  // of the cost, that neighbours are told of
constexpr double diagonal = 0x1.6a09e667f3bcdp-1;
constexpr std::array<SheetPoint, 8> directions = {{{1, 0},
                                                   {-1, 0},
                                                   {0, 1},
                                                   {0, -1},
                                                   {diagonal, diagonal},
                                                   {-diagonal, -diagonal},
                                                   {diagonal, -diagonal},
                                                   {-diagonal, diagonal}}};

double cost_of(double height) {
  if (height >= Easing::wanted) return 0;
  if (height < least) return folded_cost * (1 - height);
  const double lack = Easing::wanted / height - 1;
  return lack * lack;
}

}  // namespace

void Easing::add(Vertex v) {
  char& is_waiting = is_waiting_[static_cast<size_t>(v)];
  if (is_waiting || sheet_.is_pole(v)) return;
  is_waiting = 1;
  waiting_.push_back(v);
}

void Easing::add_corners(Face f) {
  for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) add(sheet_.origin(h));
}

void Easing::run(std::int64_t most) {
  for (; !waiting_.empty(); --most) {
    const Vertex v = waiting_.front();
    waiting_.pop_front();
    is_waiting_[static_cast<size_t>(v)] = 0;
    if (most <= 0 || sheet_.is_hub(v) || !ease(v)) continue;
    sheet_.for_each_spoke(v, [&](Halfedge h) {
      if (sheet_.height(Topology::face(h)) < enough) add_corners(Topology::face(h));
    });
  }
}

void Easing::slide(Vertex v, const SheetPoint& direction) {
  take_ring(v);
  const SheetPoint start = sheet_.place(v);
  double lowest = HUGE_VAL;
  for (double step = longest_slide; step > least; step /= 2)
    try_place(v, {start.x + step * direction.x, start.y + step * direction.y}, lowest);
}

double Easing::RingFace::cost_with(const SheetPoint& p) {
  face.corners[corner] = {p.x, p.y + turn};
  return cost_of(face.height());
}

void Easing::take_ring(Vertex v) {
  ring_.clear();
  dear_ = 0;
  sheet_.for_each_spoke(v, [&](Halfedge h) {
    ring_.push_back({sheet_.face(Topology::face(h)), static_cast<size_t>(Topology::corner(h)),
                     sheet_.corner(h).y - sheet_.place(v).y});
  });
}

double Easing::cost_at(const SheetPoint& p, double most) {
  if (const double cost = ring_[dear_].cost_with(p); cost >= most) return cost;
  double sum = 0;
  for (size_t i = 0; i < ring_.size() && !(sum >= most); ++i) {
    const double cost = ring_[i].cost_with(p);
    if (cost >= most) dear_ = i;
    sum += cost;
  }
  return sum;
}

bool Easing::ease(Vertex v) {
  take_ring(v);
  const double before = cost_at(sheet_.place(v), HUGE_VAL);
  if (before == 0) return false;
  double lowest = before;
  int helped = 0;
  for (double step = std::clamp(longest_spoke(v), 1.0, longest_step);
       step > least && helped < lengths_that_help; step /= 2) {
    const SheetPoint start = sheet_.place(v);
    for (const SheetPoint& d : directions)
      try_place(v, {start.x + step * d.x, start.y + step * d.y}, lowest);
    helped += lowest < before;
  }
  return lowest < (1 - least_gain) * before;
}

double Easing::longest_spoke(Vertex v) const {
  double longest = 0;
  sheet_.for_each_spoke(v, [&](Halfedge h) {
    if (!sheet_.is_pole(sheet_.target(h))) longest = std::max(longest, square(sheet_.towards(h)));
  });
  return std::sqrt(longest);
}

/// Leaves v, whose ring is at hand, there if that costs less.
bool Easing::try_place(Vertex v, const SheetPoint& p, double& lowest) {
  if (!sheet_.allows(v, p)) return false;
  const double there = cost_at(p, lowest);
  if (!(there < lowest)) return false;
  lowest = there;
  sheet_.move(v, p);
  return true;
}

}  // namespace sphparam
