#pragma once

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "chart/sheet.h"

namespace sphparam {

/// Vertices of a sheet that move together, as unknowns of a system: two coordinates each, on the
/// seam one. Our own. Cost: O(#faces at them · log).
struct SheetRegion {
  SheetRegion(const Sheet& sheet, const std::vector<Vertex>& vertices) {
    for (const Vertex v : vertices) {
      first_unknown[v] = unknowns;
      unknowns += sheet.on_seam(v) ? 1 : 2;
      sheet.for_each_spoke(v, [&](Halfedge h) { faces.push_back(Topology::face(h)); });
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  }

  std::unordered_map<Vertex, int> first_unknown;
  int unknowns = 0;
  std::vector<Face> faces;  // at the vertices, in order
};

}  // namespace sphparam
