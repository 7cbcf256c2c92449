// A row's places by Newton, as many side by side as are expected on one patch: from a good start
// one step is enough. Where steps lead out of the patch, or fail, each place is searched alone. The
// points and normals there come with the places, from the same numbers.

#include "displace/place_rows.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "displace/base_normals.h"
#include "displace/direction_step.h"
#include "displace/unit_normals.h"
#include "remesh/subdivision/limit_polynomial.h"

namespace sphparam {

namespace {

using Numbers = LimitPoints::Numbers;

constexpr int most_steps = 3;  // side by side, before each goes its own way
constexpr double last_step = PlaceFinder::last_step(true);
constexpr double too_long = PlaceFinder::longest_step + 0x1p-53;  // the next number
static_assert(too_long > PlaceFinder::longest_step && PlaceFinder::longest_step < 1);

/// As PatchNet::beyond.
template <Scheme scheme, int W>
SPHPARAM_INLINE Lanes<W> beyond(const Lanes<W>& s, const Lanes<W>& t) {
  const Lanes<W> before = larger(-s, -t);
  return larger(before, scheme == Scheme::Loop ? s + t - 1.0 : larger(s, t) - 1.0);
}

/// A step of Newton's, and how long it was in parameters; infinite where there is none.
template <Scheme scheme, int W>
SPHPARAM_INLINE Lanes<W> take_step(const LimitPatch::Coefficients& direction,
                                   const LaneVectors<W>& q, Lanes<W>& s, Lanes<W>& t) {
  const Lanes<W> none = std::numeric_limits<double>::infinity();
  const LimitLanes<W> d = evaluate_polynomials<scheme>(direction, s, t);
  const auto step = direction_step(d.position, d.by_s, d.by_t, q);
  // Choices of one comparison each: GCC 12 takes masks apart where they meet one another.
  const Lanes<W> fine = 0.0;
  Lanes<W> length = magnitude(step.s) + magnitude(step.t);
  length = larger(select(step.det > 0.0, fine, none), length);  // what is no number stays none
  length = larger(select(step.ahead > 0.0, fine, none), length);
  length = select(length < too_long, length, none);
  s = select(length < too_long, s + step.s, s);
  t = select(length < none, t + step.t, t);
  return length;
}

/// The greatest of those below the count, of which there are some.
SPHPARAM_INLINE double greatest(const double* numbers, size_t count) {
  double greatest = numbers[0];
  for (size_t i = 1; i < count; ++i) greatest = std::max(greatest, numbers[i]);
  return greatest;
}

/// Newton's steps of a run at once, which end where no step is long any more, and the surface
/// there.
template <Scheme scheme>
struct Settled {
  const DirectedPatch& patch;
  size_t first, count;
  const DirectionTable& directions;

  /// Whether all are within the patch. `length`: of the last step of each.
  bool newton(const PlaceTable& expected, PlaceTable& places, Numbers& length,
              LineTable& lines) const {
    bool all_within = true;
    run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
      constexpr size_t most_parts = LimitPoints::count / W;
      const size_t parts = most_parts == 1 ? 1 : (count + W - 1) / W;
      Lanes<W> s[most_parts], t[most_parts];
      for (size_t p = 0; p < parts; ++p) {
        s[p] = load<W>(&expected.s[first + p * W]);
        t[p] = load<W>(&expected.t[first + p * W]);
      }
      double longest = std::numeric_limits<double>::infinity();
      for (int taken = 0; taken < most_steps && longest >= last_step; ++taken) {
        for (size_t p = 0; p < parts; ++p) {
          store(take_step<scheme>(patch.direction.coefficients(),
                                  load<W>(directions.x, first + p * W), s[p], t[p]),
                &length[p * W]);
        }
        longest = greatest(length.data(), count);
      }
      Numbers beyond_end;
      for (size_t p = 0; p < parts; ++p) {
        const size_t at = first + p * W;
        store(beyond<scheme>(s[p], t[p]), &beyond_end[p * W]);
        store(s[p], &places.s[at]);
        store(t[p], &places.t[at]);
        const LimitLanes<W> point =
            evaluate_polynomials<scheme>(patch.surface.coefficients(), s[p], t[p]);
        store(point.position, lines.origins, at);
        store(unit_normals(point), lines.normals, at);
      }
      all_within = longest < last_step && greatest(beyond_end.data(), count) <= 0;
    });
    return all_within;
  }
};

}  // namespace

void PlaceTable::resize(size_t count) {
  patch.resize(count);
  s.resize(count + padding);
  t.resize(count + padding);
}

void PlaceRows::put(size_t column, const PlaceFinder::Found& found, LineTable& lines) {
  places_.patch[column] = found.place.patch;
  places_.s[column] = found.place.s;
  places_.t[column] = found.place.t;
  exact_[column] = found.exact;
  find_normals({&found.place, 1}, finder_, lines, column);
}

void PlaceRows::find_next(const DirectionTable& directions, LineTable& lines) {
  std::swap(expected_, above_);
  std::swap(above_, places_);
  places_.resize(directions.count);
  exact_.assign(directions.count, true);
  if (above_.patch.empty()) return begin(directions, lines);
  if (expected_.patch.empty()) expected_ = above_;
  expect();
  Run run{0, 0, 0};
  for (; run.first < directions.count; run.first += run.count) {
    run = run_from(run.first);
    settle(run, directions, lines);
  }
}

void PlaceRows::begin(const DirectionTable& directions, LineTable& lines) {
  finder_.start_anew();
  for (size_t c = 0; c < directions.count; ++c) put(c, finder_.find(directions[c]), lines);
}

/// As if rows went on in straight lines, on the patch where that is.
void PlaceRows::expect() {
  for (size_t c = 0; c < above_.patch.size(); ++c) {
    const bool same = expected_.patch[c] == above_.patch[c];
    const double s = above_.s[c], t = above_.t[c];
    const double further_s = s + (s - expected_.s[c]), further_t = t + (t - expected_.t[c]);
    expected_.patch[c] = above_.patch[c];
    expected_.s[c] = same ? further_s : s;
    expected_.t[c] = same ? further_t : t;
  }
  for (size_t c = 0; c < above_.patch.size(); ++c) {
    if (finder_.base().net().beyond(expected_[c]) > PlaceFinder::edge_rounding) cross_over(c);
  }
}

void PlaceRows::cross_over(size_t column) {
  const LimitPlace place = finder_.base().net().cross(expected_[column]);
  expected_.patch[column] = place.patch;
  expected_.s[column] = place.s;
  expected_.t[column] = place.t;
}

PlaceRows::Run PlaceRows::run_from(size_t first) const {
  const std::vector<int>& patch = expected_.patch;
  const size_t most = std::min(first + LimitPoints::count, patch.size());
  size_t last = first + 1;
  while (last < most && patch[last] == patch[first]) ++last;
  return {patch[first], first, last - first};
}

void PlaceRows::settle(const Run& run, const DirectionTable& directions, LineTable& lines) {
  const DirectedPatch& patch = finder_.patch(run.patch);
  if (!patch.direction.is_polynomial()) {
    for (size_t c = run.first; c < run.first + run.count; ++c)
      settle_alone(c, expected_[c], directions, lines);
    return;
  }
  std::fill_n(&places_.patch[run.first], run.count, run.patch);
  Numbers length;
  const auto newton = [&]<Scheme scheme>(std::integral_constant<Scheme, scheme>) {
    return Settled<scheme>{patch, run.first, run.count, directions}.newton(expected_, places_,
                                                                           length, lines);
  };
  const PatchNet& net = finder_.base().net();
  const bool of_triangle = net.degree() == 3;
  if (of_triangle ? newton(std::integral_constant<Scheme, Scheme::Loop>{})
                  : newton(std::integral_constant<Scheme, Scheme::CatmullClark>{}))
    return;
  for (size_t i = 0; i < run.count; ++i) {
    const size_t column = run.first + i;
    const LimitPlace place = places_[column];
    const double beyond = net.beyond(place);
    if (!(length[i] < last_step && beyond <= PlaceFinder::edge_rounding))
      settle_alone(column, place, directions, lines);
    else if (beyond > 0)
      put(column, {clamped(place, net.degree()), true}, lines);
  }
}

void PlaceRows::settle_alone(size_t column, const LimitPlace& near,
                             const DirectionTable& directions, LineTable& lines) {
  put(column, finder_.find(directions[column], near), lines);
}

}  // namespace sphparam
