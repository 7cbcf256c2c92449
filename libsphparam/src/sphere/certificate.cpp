#include "sphparam/sphere/certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "elementary.h"
#include "sphere/face_rays.h"
#include "sphere/required_rays.h"
#include "sphere/solid_angle.h"
#include "sphparam/parallel.h"

// Theorem. Let K be a closed oriented triangle mesh (every directed edge once, its opposite once:
// what Topology guarantees), x_v a ray for each vertex, and f the map that sends the point
// Σ λᵢ vᵢ of a triangle to Σ λᵢ xᵢ / |Σ λᵢ xᵢ|. Then f is an orientation-preserving homeomorphism
// onto the sphere if and only if
//   (a) det(x_a, x_b, x_c) > 0 for every triangle, and
//   (b) some generic ray lies in the open cone of exactly one triangle.
//
// Proof. If: by (a) the rays of a triangle are independent, so f is defined and injective on each
// closed triangle. It is an open map: inside a triangle that is clear; at an edge uv both triangles
// have positive determinants while they run through uv in opposite directions, so their apexes lie
// on opposite sides of the plane span(x_u, x_v); at a vertex the triangles' images are sectors with
// angles in (0, π) that all turn the same way and close after 2πk, k ≥ 1. All local degrees are +1,
// so a generic point has exactly deg f preimages, by (b) one. If f(p) = f(q) with p ≠ q, disjoint
// neighbourhoods of p and q would both cover a neighbourhood of the image, and a generic point of
// it would have two preimages: so f is injective. Its image is compact and open, hence all of S²,
// and a continuous bijection from a compact space to a Hausdorff one is a homeomorphism. Only if:
// injectivity excludes det = 0, orientation gives the sign, degree 1 gives (b).  ∎
//
// (a) alone is not enough: longitudes doubled around two poles leave every determinant positive and
// cover the sphere twice. Signs are exact, rays may have any length. The solid angles sum to
// 4π·degree; their floating-point sum is only a cross-check.

namespace sphparam {
namespace {

constexpr std::int64_t chunk_size = 8192;
constexpr double largest_coordinate = 0x1p64;  // what `orientation` promises to be exact for

bool usable(const Vector3& x) {
  return x.allFinite() && x.cwiseAbs().maxCoeff() <= largest_coordinate && !x.isZero(0);
}

constexpr double largest_product = 1e100;  // of complex numbers, before it could overflow
constexpr double nearly_unit = 1e-9;       // lengths so near 1 do not matter to the cross-check

/// A sum of angles as the product of complex numbers 1 + i tan: one arc tangent for many.
class AngleSum {
 public:
  void add(double sine, double cosine) {
    if (!(std::abs(sine) < cosine)) {
      sum_ += elementary::atan2(sine, cosine);
      return;
    }
    const double t = sine / cosine, real = real_ - imaginary_ * t;
    imaginary_ += real_ * t;
    real_ = real;
    if (std::abs(imaginary_) > real_ || real_ > largest_product) flush();
  }
  double total() {
    flush();
    return sum_;
  }

 private:
  void flush() {  // before the next factor, less than 45°, could pass 180°
    sum_ += elementary::atan2(imaginary_, real_);
    real_ = 1;
    imaginary_ = 0;
  }
  double sum_ = 0, real_ = 1, imaginary_ = 0;
};

/// How many open cones hold a ray; nothing to say if it meets the boundary of one.
struct RayCount {
  int cones = 0;
  bool generic = true;

  /// The cone of a triangle with positive determinant.
  void add(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& ray) {
    const int s1 = orientation(a, b, ray);
    if (s1 < 0) return;
    const int s2 = orientation(b, c, ray);
    if (s2 < 0) return;
    const int s3 = orientation(c, a, ray);
    if (s3 < 0) return;
    if (s1 > 0 && s2 > 0 && s3 > 0) {
      ++cones;
    } else {
      generic = false;
    }
  }
};

template <class Id>
void append(std::vector<Id>& to, const std::vector<Id>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

struct FaceFindings {
  std::vector<Face> folded, degenerate;
  double solid_angle = 0;
  RayCount probed;

  void merge(const FaceFindings& next) {
    append(folded, next.folded);
    append(degenerate, next.degenerate);
    solid_angle += next.solid_angle;
    probed.cones += next.probed.cones;
    probed.generic = probed.generic && next.probed.generic;
  }
};

/// `unit`: all rays are, nearly. Counts the cones of `probe` on the way.
FaceFindings examine_faces(const Topology& topology, const SphereMap& map, bool unit,
                           const Vector3& probe, Face first, Face last) {
  FaceFindings findings;
  AngleSum half_solid_angle;
  // stableNormalized: rays may be tiny or huge, and this is only the cross-check.
  const auto ray = [&](const Vector3& x) { return unit ? x : Vector3(x.stableNormalized()); };
  for (Face f = first; f < last; ++f) {
    const auto [a, b, c] = face_rays(topology, map, f);
    const int sign = orientation(a, b, c);
    if (sign < 0) findings.folded.push_back(f);
    if (sign == 0) findings.degenerate.push_back(f);
    if (sign > 0) findings.probed.add(a, b, c, probe);
    const HalfSolidAngle angle = half_solid_angle_of(ray(a), ray(b), ray(c));
    half_solid_angle.add(angle.sine, angle.cosine);
  }
  findings.solid_angle = 2 * half_solid_angle.total();
  return findings;
}

struct PointFindings {
  std::vector<Vertex> unusable;
  double length_error = 0;

  void merge(const PointFindings& next) {
    append(unusable, next.unusable);
    length_error = std::max(length_error, next.length_error);
  }
};

PointFindings examine_points(const SphereMap& map, Vertex first, Vertex last) {
  PointFindings findings;
  for (Vertex v = first; v < last; ++v) {
    const Vector3 x = map.point(v);
    if (!usable(x)) {
      findings.unusable.push_back(v);
      continue;
    }
    // Squares of what is so near 1 neither overflow nor vanish.
    const double squared = x.squaredNorm();
    const double length = squared > 0.5 && squared < 2 ? std::sqrt(squared) : x.stableNorm();
    findings.length_error = std::max(findings.length_error, std::abs(length - 1));
  }
  return findings;
}

/// What `examine(first, last)` finds of some at a time, merged in their order.
template <class Findings, class Examine>
Findings examine_in_chunks(int count, int threads, const Examine& examine) {
  std::vector<Findings> chunks(static_cast<size_t>((count + chunk_size - 1) / chunk_size));
  parallel_for(count, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    chunks[static_cast<size_t>(first / chunk_size)] =
        examine(static_cast<int>(first), static_cast<int>(last));
  });
  Findings all;
  for (const Findings& chunk : chunks) all.merge(chunk);
  return all;
}

/// Directions that no mesh made by people has on its edges; tried in order until one is generic.
std::array<Vector3, 64> generic_rays() {
  std::array<Vector3, 64> rays;
  for (size_t i = 0; i < rays.size(); ++i) {
    // Low-discrepancy points on the sphere, from multiples of two irrational numbers.
    const double z = 2 * std::fmod(0.37 + static_cast<double>(i) * 0.7548776662466927, 1.0) - 1;
    const double turn = std::fmod(0.61 + static_cast<double>(i) * 0.5698402909980532, 1.0);
    const double r = std::sqrt(1 - z * z), theta = 2 * std::numbers::pi * turn;
    rays[i] = {r * elementary::cos(theta), r * elementary::sin(theta), z};
  }
  return rays;
}

/// Requires: all determinants positive.
RayCount count_cones(const Topology& topology, const SphereMap& map, const Vector3& ray) {
  RayCount count;
  for (Face f = 0; f < topology.face_count(); ++f) {
    const auto [a, b, c] = face_rays(topology, map, f);
    count.add(a, b, c, ray);
  }
  return count;
}

/// `first`: what the first of the rays has met.
int degree_by_ray(const Topology& topology, const SphereMap& map, RayCount first) {
  if (first.generic) return first.cones;
  for (const Vector3& ray : generic_rays()) {
    const RayCount count = count_cones(topology, map, ray);
    if (count.generic) return count.cones;
  }
  return 0;  // fails closed
}

/// How often the star of v winds around its ray, by the angles of its sectors.
int winding(const Topology& topology, const SphereMap& map, Vertex v) {
  const Vector3 x = map.point(v).stableNormalized();
  double angle = 0;
  topology.for_each_outgoing(v, [&](Halfedge h) {
    const Vector3 a = map.point(topology.target(h)), b = map.point(topology.apex(h));
    const Vector3 p = a - x * x.dot(a), q = b - x * x.dot(b);
    angle += elementary::atan2(x.dot(p.cross(q)), p.dot(q));
  });
  return static_cast<int>(std::lround(angle / (2 * std::numbers::pi)));
}

std::vector<Vertex> branch_vertices(const Topology& topology, const SphereMap& map) {
  std::vector<Vertex> result;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    if (winding(topology, map, v) != 1) result.push_back(v);
  }
  return result;
}

}  // namespace

Certificate certify(const Topology& topology, const SphereMap& map, int threads) {
  require_rays("certify", map, topology.vertex_count());
  Certificate certificate;
  // 1. Points: finite, and how far from the sphere.
  PointFindings points = examine_in_chunks<PointFindings>(
      topology.vertex_count(), threads,
      [&](Vertex first, Vertex last) { return examine_points(map, first, last); });
  certificate.unusable_points = std::move(points.unusable);
  certificate.max_length_error = points.length_error;
  if (!certificate.unusable_points.empty()) return certificate;

  // 2. Faces: exact orientations, solid angles, and which of them a ray meets.
  const bool unit = certificate.max_length_error < nearly_unit;
  const Vector3 probe = generic_rays().front();
  const Face count = topology.face_count();
  FaceFindings faces = examine_in_chunks<FaceFindings>(count, threads, [&](Face first, Face last) {
    return examine_faces(topology, map, unit, probe, first, last);
  });
  certificate.folded = std::move(faces.folded);
  certificate.degenerate = std::move(faces.degenerate);
  certificate.covering = faces.solid_angle / (4 * std::numbers::pi);
  certificate.reversed = count > 0 && static_cast<Face>(certificate.folded.size()) == count;
  if (certificate.fold_count() > 0) return certificate;

  // 3. All are positive: the map covers the sphere degree times; once, and it is one-to-one.
  certificate.degree = degree_by_ray(topology, map, faces.probed);
  if (certificate.degree != 1) certificate.branch_vertices = branch_vertices(topology, map);
  return certificate;
}

}  // namespace sphparam
