#include "embedding/twists/strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "elementary.h"

// Few turns come into question: by one vertex or two either way, about the middle of the image of
// either layer. Each is tried on the strip's own triangles.

namespace sphparam {
namespace {

constexpr double least_gain = 1e-3;  // of a strip's energy: not worth it

using Matrix3 = Eigen::Matrix3d;
using Layer = std::span<const ImagePoint>;

/// Rodrigues' formula.
Matrix3 turn_about(const Vector3& axis, double angle) {
  Matrix3 cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return Matrix3::Identity() + elementary::sin(angle) * cross +
         (1 - elementary::cos(angle)) * cross * cross;
}

/// Nothing where a layer is as much on one side of the sphere as on the other.
std::optional<Vector3> middle_of(Layer layer) {
  Vector3 sum = Vector3::Zero();
  for (const ImagePoint& point : layer) sum += point.vector();
  if (!(sum.squaredNorm() > 0)) return std::nullopt;
  return sum.normalized();
}

/// Where a vertex is in a loop; −1: nowhere.
int place_in(const VertexLoop& loop, Vertex v) {
  const auto found = std::ranges::find(loop, v);
  return found == loop.end() ? -1 : static_cast<int>(found - loop.begin());
}

/// visit(half-edge, corners from its origin on) for the triangles with corners in both layers, once
/// each: at the corner that is alone in its layer. The moved layer is numbered after the fixed one.
template <class Visit>
void for_each_between(const Topology& topology, const VertexLoop& fixed, const VertexLoop& moved,
                      const Visit& visit) {
  const int split = static_cast<int>(fixed.size());
  const auto number = [&](Vertex v) {
    const int in_fixed = place_in(fixed, v), in_moved = place_in(moved, v);
    return in_fixed >= 0 ? in_fixed : in_moved >= 0 ? split + in_moved : -1;
  };
  for (const VertexLoop* layer : {&fixed, &moved}) {
    for (const Vertex v : *layer) {
      topology.for_each_outgoing(v, [&](Halfedge h) {
        const int a = number(v), b = number(topology.target(h)), c = number(topology.apex(h));
        if (b < 0 || c < 0) return;
        if ((a < split) != (b < split) && (a < split) != (c < split))
          visit(h, std::array<Vertex, 3>{a, b, c});
      });
    }
  }
}

}  // namespace

std::optional<Strip> Strip::between(const Topology& topology, const RestTriangles& source,
                                    const std::vector<ImagePoint>& image, const VertexLoop& fixed,
                                    const VertexLoop& moved) {
  Strip strip;
  for_each_between(topology, fixed, moved, [&](Halfedge h, const std::array<Vertex, 3>& corners) {
    const RestTriangle& rest = source[static_cast<size_t>(Topology::face(h))];
    strip.triangles_.add(rotated(rest, Topology::corner(h)), corners);
  });
  if (strip.triangles_.count() != static_cast<int>(fixed.size() + moved.size()))
    return std::nullopt;
  for (const VertexLoop* layer : {&fixed, &moved}) {
    for (const Vertex v : *layer) strip.points_.push_back(image[static_cast<size_t>(v)]);
  }
  strip.fixed_ = fixed.size();
  return strip;
}

std::optional<Matrix3> Strip::better_turn(const DistortionEnergy& energy) const {
  double least = (1 - least_gain) * triangles_.energy(points_, energy);
  std::optional<Matrix3> best;
  const Layer all = points_;
  for (const Layer layer : {all.first(fixed_), all.subspan(fixed_)}) {
    const std::optional<Vector3> middle = middle_of(layer);
    if (!middle) continue;
    for (const int by : {-1, 1, -2, 2}) {
      const double angle = by * 2 * std::numbers::pi / static_cast<double>(layer.size());
      const Matrix3 turn = turn_about(*middle, angle);
      const Points there = turned(turn);
      const double value = triangles_.energy(there, energy);
      if (!(value < least) || !winds_alike(there)) continue;
      least = value;
      best = turn;
    }
  }
  return best;
}

Strip::Slide Strip::better_slide(const DistortionEnergy& energy) const {
  const double before = triangles_.energy(points_, energy);
  Slide best{0, least_gain * before};
  for (const int by : {-1, 1, -2, 2}) {
    const Points there = slid(by);
    const double gain = before - triangles_.energy(there, energy);
    if (gain > best.falls_by && winds_alike(there)) best = {by, gain};
  }
  return best;
}

/// Triangles that wind about a middle once more are all positive, too.
bool Strip::winds_alike(const Points& points) const {
  return std::abs(triangles_.solid_angle(points) - triangles_.solid_angle(points_)) < 1;
}

Strip::Points Strip::slid(int by) const {
  Points points = points_;
  const auto moved = points.begin() + static_cast<long>(fixed_);
  const long around = points.end() - moved;
  std::rotate(moved, moved + (by + around) % around, points.end());
  return points;
}

Strip::Points Strip::turned(const Matrix3& turn) const {
  Points points = points_;
  for (size_t i = fixed_; i < points.size(); ++i)
    points[i] = image_point(turn * points[i].vector());
  return points;
}

}  // namespace sphparam
