// Sums go from left to right and nothing is fused, as in the program whose roundings these are.

#include "remesh/float32_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "remesh/walk_to_nearest.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 4096;
constexpr float radius = 100;

using Vector = Eigen::Vector3f;

float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
float length(const Vector& a) { return std::sqrt(dot(a, a)); }

Vector unit(const Vector& a) {
  const float size = length(a);
  return size == 0 ? a : Vector(a[0] / size, a[1] / size, a[2] / size);
}

float twice_area(const Vector& a, const Vector& b) {
  return length({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
}

/// In the plane of a triangle.
struct Flat {
  float x = 0, y = 0;
  Flat operator-(const Flat& other) const { return {x - other.x, y - other.y}; }
};

float dot(const Flat& a, const Flat& b) { return a.x * b.x + a.y * b.y; }

struct Place {
  std::array<float, 3> weights{};
  float distance = 0;
};

class FlatTriangle {
 public:
  FlatTriangle(const std::array<Vector, 3>& corners) : corners_(corners) {
    along_ = unit(corners[1] - corners[0]);
    const Vector side = corners[2] - corners[0];
    across_ = unit(side - along_ * dot(along_, side));
    for (std::size_t k = 0; k < 3; ++k) flat_[k] = in_plane(corners[k]);
    has_area_ = twice_area(corners[1] - corners[0], side) > 0;
  }

  Place nearest(const Vector& p) const {
    if (!has_area_) return nearest_of_sides(p);
    const Flat at = in_plane(p);
    bool inside = true;
    Place best;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = k, j = (k + 2) % 3;
      if (!is_beyond(at, i, j)) continue;
      const Place other = on_side(p, at, i, j);
      if (inside || other.distance < best.distance) best = other;
      inside = false;
    }
    return inside ? within(p, at) : best;
  }

 private:
  /// Of a triangle that is a line or a point in such numbers: it has no plane, and no inside.
  Place nearest_of_sides(const Vector& p) const {
    Place best = at_corner(p, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const Vector whole = corners_[j] - corners_[i];
      const float size = length(whole);
      if (size == 0) continue;
      const float share = std::clamp(dot(p - corners_[i], unit(whole)) / size, 0.0F, 1.0F);
      Place place;
      place.distance = length(p - (corners_[i] + share * whole));
      place.weights[i] = 1 - share;
      place.weights[j] = share;
      if (place.distance < best.distance) best = place;
    }
    return best;
  }

  Flat in_plane(const Vector& p) const {
    const Vector from = p - corners_[0];
    return {dot(along_, from), dot(across_, from)};
  }

  Vector in_space(const Flat& at) const { return (at.x * along_ + at.y * across_) + corners_[0]; }

  /// Whether the side from i to j is between the point and the third corner.
  bool is_beyond(const Flat& at, std::size_t i, std::size_t j) const {
    Flat side = flat_[j] - flat_[i];
    const float size = std::sqrt(side.x * side.x + side.y * side.y);
    if (size == 0) return false;
    side = {side.x / size, side.y / size};
    Flat inwards = flat_[3 - i - j] - flat_[i];
    const float share = dot(inwards, side);
    inwards = {inwards.x - share * side.x, inwards.y - share * side.y};
    return dot(at - flat_[i], inwards) < 0;
  }

  Place on_side(const Vector& p, const Flat& at, std::size_t i, std::size_t j) const {
    Flat side = flat_[j] - flat_[i];
    const float size = std::sqrt(side.x * side.x + side.y * side.y);
    side = {side.x / size, side.y / size};
    const float share = dot(at - flat_[i], side);
    if (share <= 0) return at_corner(p, i);
    if (share >= size) return at_corner(p, j);
    const Vector found = in_space({flat_[i].x + share * side.x, flat_[i].y + share * side.y});
    const Vector whole = corners_[j] - corners_[i];
    Place place;
    place.distance = length(p - found);
    place.weights[j] = dot(unit(whole), found - corners_[i]) / length(whole);
    place.weights[i] = 1 - place.weights[j];
    for (float& weight : place.weights) weight = std::max(weight, 0.0F);
    return place;
  }

  Place at_corner(const Vector& p, std::size_t k) const {
    Place place;
    place.distance = length(p - corners_[k]);
    place.weights[k] = 1;
    return place;
  }

  Place within(const Vector& p, const Flat& at) const {
    const Vector found = in_space(at);
    const std::array<Vector, 3> to = {corners_[0] - found, corners_[1] - found,
                                      corners_[2] - found};
    Place place;
    place.distance = length(p - found);
    place.weights = {twice_area(to[1], to[2]), twice_area(to[0], to[2]), twice_area(to[0], to[1])};
    const float sum = place.weights[0] + place.weights[1] + place.weights[2];
    if (sum == 0) return nearest_of_sides(p);  // squares have vanished
    for (float& weight : place.weights) weight /= sum;
    return place;
  }

  std::array<Vector, 3> corners_;
  Vector along_, across_;
  std::array<Flat, 3> flat_;
  bool has_area_ = false;
};

class Facets32 {
 public:
  Facets32(const Topology& topology, const Float32Points& sphere)
      : topology_(topology), sphere_(sphere) {}

  SurfacePoint nearest(const Vector& p, Face start) const {
    const auto [face, place] = walk_to_nearest(
        topology_, start, [&](Face f) { return on_face(p, f); },
        [](const Place& other, Face other_face, const Place& best, Face best_face) {
          return other.distance < best.distance ||
                 (other.distance == best.distance && other_face < best_face);
        });
    const Eigen::Vector3f weights(place.weights.data());
    return {face, weights.cast<double>()};
  }

 private:
  Place on_face(const Vector& p, Face face) const {
    const auto corner = [&](int k) -> Vector { return sphere_.row(topology_.vertex(face, k)); };
    return FlatTriangle({corner(0), corner(1), corner(2)}).nearest(p);
  }

  const Topology& topology_;
  const Float32Points& sphere_;
};

/// The vector of 32-bit numbers whose direction this is, where there is one of about this length:
/// what a file had before its rays were made unit ones. One coordinate is the rounded one or a
/// neighbour of it, nearest first; that all others are 32-bit numbers to 2⁻⁴⁰ of themselves by
/// chance happens once in 10⁸ trials.
std::optional<Vector> as_in_file(const Vector3& unit, double length) {
  constexpr int most_steps = 8;
  constexpr double nothing = 0x1p-40;
  Eigen::Index axis = 0;
  unit.cwiseAbs().maxCoeff(&axis);
  const auto is_it = [&](float coordinate) -> std::optional<Vector> {
    const Vector3 ray = static_cast<double>(coordinate) / unit[axis] * unit;
    const Vector rounded = ray.cast<float>();
    const auto error = (rounded.cast<double>() - ray).cwiseAbs().array();
    return (error <= nothing * ray.cwiseAbs().array()).all() ? std::optional(rounded)
                                                             : std::nullopt;
  };
  float below = static_cast<float>(length * unit[axis]), above = below;
  if (const auto ray = is_it(below)) return ray;
  for (int i = 0; i < most_steps; ++i) {
    below = std::nextafter(below, 0.0F);
    if (const auto ray = is_it(below)) return ray;
    above = std::nextafter(above, 2 * above);
    if (const auto ray = is_it(above)) return ray;
  }
  return std::nullopt;
}

/// Of a file with the radius that all spheres of the field have, or 1; else rounded at 100.
Vector in_float32(const Vector3& unit) {
  for (const double length : {100.0, 1.0})
    if (const std::optional<Vector> ray = as_in_file(unit, length)) return *ray;
  return (static_cast<double>(radius) * unit).cast<float>();
}

}  // namespace

Float32Points at_radius_100(const Points& rays) {
  Float32Points result(rays.rows(), 3);
  for (Eigen::Index i = 0; i < rays.rows(); ++i) {
    const Vector ray = in_float32(rays.row(i).normalized());
    const float factor = radius / length(ray);
    for (int k = 0; k < 3; ++k) result(i, k) = ray[k] * factor;
  }
  return result;
}

std::vector<SurfacePoint> nearest_in_float32(const Topology& topology, const Float32Points& sphere,
                                             const Float32Points& points,
                                             std::vector<SurfacePoint> located, int threads) {
  const Facets32 facets(topology, sphere);
  parallel_for(std::ssize(located), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      SurfacePoint& place = located[static_cast<std::size_t>(i)];
      place = facets.nearest(points.row(i), place.face);
    }
  });
  return located;
}

}  // namespace sphparam
