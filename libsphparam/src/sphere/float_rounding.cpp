#include "sphparam/sphere/float_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/faces_where.h"
#include "mesh/rings.h"
#include "option_domain.h"
#include "sphere/face_rays.h"
#include "sphere/required_rays.h"
#include "sphparam/sphere/orientation.h"

// Rounding moves a ray of length r by at most δ = √3·ulp(r)/2, which for r = 1 is √3·2⁻²⁵: its
// coordinates are below r. A triangle can only turn over if a plane through 0 comes that near to
// its three corners, so one whose least altitude is above 2δ is safe. What did turn over is mended
// in rounds: nudge single vertices on the grid of floats; what is left is smoothed in double
// (towards the mean of the ring, by steps that keep every triangle exactly positive and do not
// shrink the smallest one of the star) in a neighbourhood that doubles from round to round, and
// rounded anew. All decisions are exact signs, in the order of vertices.

namespace sphparam {
namespace {

constexpr double least_radius = 1e-6, most_radius = 1e6;
constexpr int most_ulps = 8;
constexpr int first_rings = 4;
constexpr int most_rounds = 6;  // so at most 128 rings around a fold
constexpr int sweeps = 16;      // a round, forth and back
constexpr int halvings = 4;

// Volatile, as GCC 12 drops double → float → double when it vectorises neighbouring coordinates.
double to_float(double x) {
  const volatile float nearest = static_cast<float>(x);
  return nearest;
}

Vector3 to_float(const Vector3& x) { return {to_float(x[0]), to_float(x[1]), to_float(x[2])}; }

/// Twice the altitude that is safe on the unit sphere when one of this radius is rounded:
/// neighbours are rounded too.
double safe_altitude(double radius) {
  const double unit_spacing = std::ldexp(1.0, std::ilogb(radius) - 23);
  const double largest_below = radius == std::ldexp(1.0, std::ilogb(radius)) ? 0.5 : 1;
  return 4 * std::sqrt(3.0) * largest_below * unit_spacing / 2 / radius;
}

double stepped(double x, int ulps) {
  const float towards =
      ulps < 0 ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity();
  auto value = static_cast<float>(x);
  for (int i = std::abs(ulps); i > 0; --i) value = std::nextafter(value, towards);
  return value;
}

std::vector<Face> bad_faces(const Topology& topology, const SphereMap& map, int threads) {
  return faces_where(topology.face_count(), threads,
                     [&](Face f) { return face_orientation(topology, map, f) <= 0; });
}

/// True when all triangles at v are positive with v at x.
bool star_is_positive(const Topology& topology, const SphereMap& map, Vertex v, const Vector3& x) {
  const Halfedge first = topology.outgoing(v);
  Halfedge h = first;
  do {
    if (orientation(x, map.point(topology.target(h)), map.point(topology.apex(h))) <= 0)
      return false;
    h = topology.rotate_ccw(h);
  } while (h != first);
  return true;
}

/// How small the triangles at a vertex are.
struct StarSize {
  double least_altitude = std::numeric_limits<double>::infinity();
  double least_area = std::numeric_limits<double>::infinity();
};

/// The altitude of a positive triangle is det / longest side: how far its corners are from a plane
/// through 0 that turns it over. Differences first, so that small triangles keep their digits.
StarSize star_size(const Topology& topology, const SphereMap& map, Vertex v, const Vector3& x) {
  StarSize size;
  topology.for_each_outgoing(v, [&](Halfedge h) {
    const Vector3 b = map.point(topology.target(h)), c = map.point(topology.apex(h));
    const Vector3 xb = b - x, xc = c - x;
    const double longest = std::max({xb.squaredNorm(), xc.squaredNorm(), (c - b).squaredNorm()});
    const double area = x.dot(xb.cross(xc));
    size.least_area = std::min(size.least_area, area);
    size.least_altitude = std::min(size.least_altitude, area / std::sqrt(longest));
  });
  return size;
}

/// Looks on the grid of floats around v for a place where its star is positive, nearest first.
bool nudge(const Topology& topology, SphereMap& rounded, Vertex v) {
  const Vector3 start = rounded.point(v);
  for (int ulps = 1; ulps <= most_ulps; ++ulps) {
    std::array<std::array<double, 3>, 3> choices;
    for (int axis = 0; axis < 3; ++axis)
      choices[axis] = {start[axis], stepped(start[axis], -ulps), stepped(start[axis], ulps)};
    for (int i = 1; i < 27; ++i) {
      const Vector3 x(choices[0][i % 3], choices[1][i / 3 % 3], choices[2][i / 9]);
      if (!star_is_positive(topology, rounded, v, x)) continue;
      rounded.points.row(v) = x;
      return true;
    }
  }
  return false;
}

void nudge_all(const Topology& topology, SphereMap& rounded, const std::vector<Face>& bad) {
  for (const Vertex v : vertices_of(topology, bad))
    if (!star_is_positive(topology, rounded, v, rounded.point(v))) nudge(topology, rounded, v);
}

/// Moves v towards the mean of its ring if its star is lower than `safe`, too low for float32.
void make_room(const Topology& topology, SphereMap& map, Vertex v, double safe) {
  const Vector3 start = map.point(v);
  const StarSize before = star_size(topology, map, v, start);
  if (before.least_altitude >= safe) return;
  Vector3 sum = Vector3::Zero();
  topology.for_each_outgoing(v, [&](Halfedge h) { sum += map.point(topology.target(h)); });
  const Vector3 mean = sum.stableNormalized();
  double step = 1;
  for (int halving = 0; halving < halvings; ++halving, step /= 2) {
    const Vector3 x = (start + step * (mean - start)).stableNormalized();
    const StarSize after = star_size(topology, map, v, x);
    if (after.least_area < before.least_area && after.least_altitude < safe) continue;
    if (!star_is_positive(topology, map, v, x)) continue;
    map.points.row(v) = x;
    return;
  }
}

void make_room(const Topology& topology, SphereMap& map, const std::vector<Vertex>& vertices,
               double safe) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    if (sweep % 2 == 0) {
      for (const Vertex v : vertices) make_room(topology, map, v, safe);
    } else {
      std::for_each(vertices.rbegin(), vertices.rend(),
                    [&](Vertex v) { make_room(topology, map, v, safe); });
    }
  }
}

/// Rounds `exact`, unit rays, at the radius; they may be changed where that gives triangles room.
SphereMap mended(const Topology& topology, SphereMap exact, SphereMap rounded,
                 std::vector<Face> bad, int threads, double radius) {
  nudge_all(topology, rounded, bad);
  bad = bad_faces(topology, rounded, threads);
  int rings = first_rings;
  for (int round = 0; round < most_rounds && !bad.empty(); ++round, rings *= 2) {
    const std::vector<Vertex> vertices = rings_around(topology, vertices_of(topology, bad), rings);
    make_room(topology, exact, vertices, safe_altitude(radius));
    for (const Vertex v : vertices) rounded.points.row(v) = to_float(radius * exact.point(v));
    nudge_all(topology, rounded, bad_faces(topology, rounded, threads));
    bad = bad_faces(topology, rounded, threads);
  }
  return rounded;
}

}  // namespace

FloatRounding round_to_float(const Topology& topology, const SphereMap& map, int threads,
                             double radius) {
  require_between("radius", radius, least_radius, most_radius);
  require_rays("round_to_float", map, topology.vertex_count());
  SphereMap nearest = map;
  for (double& x : nearest.points.reshaped()) x = to_float(radius * x);
  FloatRounding result{nearest, certify(topology, nearest, threads)};
  if (!result.certificate.unusable_points.empty()) return result;
  result.bad_before = result.bad_after = result.certificate.fold_count();
  if (result.bad_before == 0 || !bad_faces(topology, map, threads).empty()) return result;

  std::vector<Face> bad = result.certificate.folded;
  bad.insert(bad.end(), result.certificate.degenerate.begin(), result.certificate.degenerate.end());
  result.map = mended(topology, map, nearest, std::move(bad), threads, radius);
  result.certificate = certify(topology, result.map, threads);
  result.bad_after = result.certificate.fold_count();
  for (Eigen::Index v = 0; v < map.points.rows(); ++v)
    result.moved += result.map.points.row(v) != nearest.points.row(v);
  return result;
}

}  // namespace sphparam
