#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "mesh/index_range.h"
#include "mesh/repair/paired_faces.h"
#include "mesh/repair/repair_state.h"
#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "sphparam/mesh/topology.h"

// An edge is halved that is the longest of both of its faces, so that both are cut across: the
// least angle stays at least half of what it was, however often. From a face that is too long such
// an edge is found across longest edges, each longer than the one before (Rivara, "New longest-edge
// algorithms for the refinement and/or improvement of unstructured triangulations", 1997).

namespace sphparam {
namespace {

class EdgeHalver {
 public:
  EdgeHalver(RepairState& state, std::vector<Halfedge> twin, double longest)
      : state_(state), faces_(state, std::move(twin)), longest_(longest) {}

  void run() {
    for (Face f = 0; f < state_.face_count(); ++f) {  // those that come are looked at, too
      while (length(longest_side(f)) > longest_) halve(longest_near(longest_side(f)));
    }
  }

 private:
  double length(Halfedge h) const {
    return (state_.shape[faces_.target(h)] - state_.shape[faces_.origin(h)]).norm();
  }

  /// Longer or, of equals, the one whose vertices have greater numbers: the same from both faces.
  bool is_longer(Halfedge h, Halfedge than) const {
    const auto rank = [&](Halfedge of) {
      const auto ends = std::minmax({faces_.origin(of), faces_.target(of)});
      return std::tuple(length(of), ends.first, ends.second);
    };
    return rank(h) > rank(than);
  }

  Halfedge longest_side(Face f) const {
    Halfedge longest = 3 * f;
    for (const Halfedge h : {3 * f + 1, 3 * f + 2})
      if (is_longer(h, longest)) longest = h;
    return longest;
  }

  Halfedge longest_near(Halfedge h) const {
    for (;;) {
      const Halfedge beyond = longest_side(faces_.twin(h) / 3);
      if (!is_longer(beyond, h)) return h;
      h = beyond;
    }
  }

  void halve(Halfedge h) {
    state_.log(RepairKind::EdgeHalved, {});  // where is of no use: halves of halves
    faces_.split(h);
  }

  RepairState& state_;
  PairedFaces faces_;
  double longest_;
};

/// About how many faces there will be, from below: as their sides and their areas have it.
double pieces(const RepairState& state, double longest) {
  double count = 0;
  for (const auto& [a, b, c] : state.faces) {
    const Vector3 &p = state.shape[a], &q = state.shape[b], &r = state.shape[c];
    const double side =
        std::sqrt(std::max({(q - p).squaredNorm(), (r - q).squaredNorm(), (p - r).squaredNorm()}));
    const double area = triangle_area(p, q, r);
    count += std::max({1.0, side / longest, 2 * area / (longest * longest)});
  }
  return count;
}

void require_few(const RepairState& state, double longest) {
  const double count = pieces(state, longest);
  if (count <= most_faces) return;
  throw std::range_error("edges of at most " + short_number(longest * state.scale) +
                         " would make " + short_number(count) + " faces of the mesh, and only " +
                         std::to_string(most_faces) + " have numbers: let them be longer");
}

}  // namespace

void halve_long_edges(RepairState& state, const RepairOptions& options) {
  const auto topology = Topology::try_build(state.triangles(), state.vertex_count());
  if (!topology) return;
  const double longest = options.edge_length > 0 ? options.edge_length / state.scale
                                                 : options.edge_share * state.diagonal();
  if (!(longest > 0)) return;
  require_few(state, longest);
  std::vector<Halfedge> twin;
  for (Halfedge h = 0; h < 3 * state.face_count(); ++h) twin.push_back(topology->twin(h));
  EdgeHalver(state, std::move(twin), longest).run();
}

}  // namespace sphparam
