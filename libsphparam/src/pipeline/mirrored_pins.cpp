#include "pipeline/mirrored_pins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary.h"
#include "embedding/frame/pinned_points.h"
#include "number_text.h"

// A map without pins is the mesh on the sphere up to a rotation R. True pins p lie near R x,
// mirrored ones near a reflection Q x; both are fitted by least squares. If deviations are normal,
// of one unknown size, n pins have 2n coordinates and each fit takes 3 of them, so the reflection
// is
//   (E_R / E_Q)^((2n − 3) / 2)
// times as likely, E being sums of squares. It is told where that is a thousand. Deviations of
// neighbouring pins go the same way, so that many pins say less than they are: E_R must be twice
// E_Q in any case.

namespace sphparam {
namespace {

constexpr double least_odds = 1000;
constexpr double least_ratio = 2;
constexpr double rounding = 1e-6;  // of typed coordinates: pins so near the map are not mirrored

double sum_of_squares(const Points& from, const Points& to, const Eigen::Matrix3d& turn) {
  return (from * turn.transpose() - to).squaredNorm();
}

/// Root of the mean square, in degrees.
std::string degrees(double sum, size_t pins) {
  const double chord = std::sqrt(sum / static_cast<double>(pins));
  const double sine = std::min(1.0, chord / 2);  // of half the angle
  const double angle = 2 * elementary::atan2(sine, std::sqrt(1 - sine * sine));
  return short_number(angle * 180 / std::numbers::pi, 2);
}

}  // namespace

std::optional<std::string> suspicion_of_mirror(const SphereMap& map, const std::vector<Pin>& pins) {
  if (pins.size() < 3) return std::nullopt;
  const auto [from, to] = pinned_points(map, pins);
  // −R is a reflection: the best one comes from the best rotation to the opposite points.
  const double rotated = sum_of_squares(from, to, best_rotation(from, to));
  const double mirrored = sum_of_squares(from, to, -best_rotation(from, Points(-to)));
  const double exponent = static_cast<double>(2 * pins.size() - 3) / 2;
  const double least = std::max(least_ratio, elementary::pow(least_odds, 1 / exponent));
  const double rounded = rounding * rounding * static_cast<double>(pins.size());
  if (!(rotated > least * mirrored) || rotated < rounded) return std::nullopt;
  return "the pins look mirrored: they are " + degrees(mirrored, pins.size()) +
         "° (RMS) from the mirror image of the map without pins, and " +
         degrees(rotated, pins.size()) +
         "° from the map; theta runs counter-clockwise seen from outside, above the north pole";
}

}  // namespace sphparam
