#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// What was proved about a map, and where the proof fails.
///
/// The geodesic map of a closed oriented triangle mesh is a homeomorphism onto the sphere if and
/// only if (a) det(a, b, c) > 0 for every triangle and (b) a generic ray lies in exactly one
/// triangle; the proof is in the source file. Both are decided with exact signs of the doubles
/// as given.
struct Certificate {
  std::vector<Vertex> unusable_points;  // not finite, zero, or beyond 2⁶⁴
  std::vector<Face> folded;             // det < 0
  std::vector<Face> degenerate;         // det = 0
  int degree = 0;       // faces hit by a generic ray; counted when nothing is folded
  double covering = 0;  // Σ solid angle / 4π, in floating point: a cross-check of `degree`
  double max_length_error = 0;          // max ||x| − 1|
  bool reversed = false;                // every det < 0: the sphere is seen from inside
  std::vector<Vertex> branch_vertices;  // stars that wind more than once, when degree ≠ 1

  long fold_count() const { return static_cast<long>(folded.size() + degenerate.size()); }
  /// The one question: is the map one-to-one?
  bool bijective() const {
    return unusable_points.empty() && folded.empty() && degenerate.empty() && degree == 1;
  }
};

/// Certifies a map. Cost: 4 signs a triangle, one pass.
/// Throws: std::invalid_argument but for one ray a vertex. Same result for any number of threads.
Certificate certify(const Topology& topology, const SphereMap& map, int threads = 0);

/// "one-to-one", "folded N" (N faces are not positive), "unusable points N", or "degree N".
std::string verdict(const Certificate& certificate);

/// Several lines for people: what is not one-to-one, with the first ids. Empty when nothing.
std::string complaint(const Certificate& certificate);

/// Throws NotCertifiedError unless the certificate says one-to-one: `what`, and the faces at fault.
void require_certified(const Certificate& certificate, const std::string& what);

}  // namespace sphparam
