#pragma once

#include <vector>

#include "chart/longitude.h"
#include "chart/refined_mesh.h"
#include "sphere/planar_orientation.h"

namespace sphparam {

/// A refined mesh laid out in the (u, v) rectangle. Requires: no face across the meridian.
struct FlatMesh {
  RefinedMesh mesh;
  Vertex north = -1, south = -1;
  std::vector<ChartPoint> uv = {};  // of each vertex; u = 0 on the meridian

  bool is_pole(Vertex v) const { return v == north || v == south; }
  bool on_seam(Vertex v) const { return uv[static_cast<size_t>(v)].u == 0 && !is_pole(v); }

  /// Does the face lie west of the meridian, where that is u = 1?
  bool in_west(Face f) const {
    for (int k = 0; k < 3; ++k) {
      if (sphparam::in_west(mesh.point(mesh.vertex(f, k)))) return true;
    }
    return false;
  }

  /// (u, v) of the origin of h as its face sees it. Requires: not a pole.
  ChartPoint corner(Halfedge h) const {
    const ChartPoint p = uv[static_cast<size_t>(mesh.origin(h))];
    return p.u == 0 && in_west(Topology::face(h)) ? ChartPoint{1, p.v} : p;
  }

  /// The half-edge of a face that starts at a pole, or −1.
  Halfedge pole_halfedge(Face f) const {
    for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
      if (is_pole(mesh.origin(h))) return h;
    }
    return -1;
  }

  /// Is the face strictly positive in (u, v)? A pole triangle is the trapezoid over its link edge.
  bool positive(Face f) const {
    const Halfedge pole = pole_halfedge(f);
    if (pole < 0)
      return planar_orientation(corner(3 * f), corner(3 * f + 1), corner(3 * f + 2)) > 0;
    const double from = corner(Topology::next(pole)).u, to = corner(Topology::previous(pole)).u;
    return mesh.origin(pole) == north ? from < to : from > to;
  }
};

}  // namespace sphparam
