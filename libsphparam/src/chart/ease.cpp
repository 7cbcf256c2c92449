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
  const SheetPoint start = sheet_.place(v);
  double lowest = HUGE_VAL;
  for (double step = longest_slide; step > least; step /= 2)
    try_place(v, {start.x + step * direction.x, start.y + step * direction.y}, lowest);
}

double Easing::cost(Face f) const {
  const double height = sheet_.height(f);
  if (height >= wanted) return 0;
  if (height < least) return folded_cost * (1 - height);
  const double lack = wanted / height - 1;
  return lack * lack;
}

double Easing::cost_around(Vertex v) const {
  double sum = 0;
  sheet_.for_each_spoke(v, [&](Halfedge h) { sum += cost(Topology::face(h)); });
  return sum;
}

bool Easing::ease(Vertex v) {
  const double before = cost_around(v);
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

/// Leaves v there if that costs less.
bool Easing::try_place(Vertex v, const SheetPoint& p, double& lowest) {
  if (!sheet_.allows(v, p)) return false;
  const SheetPoint before = sheet_.place(v);
  sheet_.move(v, p);
  const double there = cost_around(v);
  if (there < lowest) {
    lowest = there;
    return true;
  }
  sheet_.move(v, before);
  return false;
}

}  // namespace sphparam
