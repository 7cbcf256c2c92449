#include "sphparam/io/creases.h"

#include <algorithm>
#include <compare>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "io/attributes/shading_normals.h"
#include "mesh/flat_face.h"
#include "mesh/triangle_geometry.h"
#include "mesh/union_find.h"
#include "sphparam/io/fillers.h"

// A half-edge is named after the corner that it starts at, 3·face + corner. Corners about a vertex
// are joined across edges that are not hard; each class of them is a fan with one normal.

namespace sphparam {
namespace {

using Twins = std::pair<Halfedge, Halfedge>;

constexpr double slack = 0.001;  // degrees

bool has_normals(const MeshFile& file) {
  return file.corner_normals ||
         (file.find_vertex_property("nx") && file.find_vertex_property("ny") &&
          file.find_vertex_property("nz"));
}

Halfedge next(Halfedge h) { return h % 3 == 2 ? h - 2 : h + 1; }

struct Edge {
  Vertex least, greatest;
  Halfedge halfedge;
  auto operator<=>(const Edge&) const = default;
  bool is_along(const Edge& other) const {
    return least == other.least && greatest == other.greatest;
  }
};

std::vector<Edge> sorted_edges(const Triangles& triangles) {
  std::vector<Edge> edges;
  edges.reserve(static_cast<size_t>(triangles.size()));
  for (Halfedge h = 0; h < triangles.size(); ++h) {
    const auto [least, greatest] = std::minmax({triangles.data()[h], triangles.data()[next(h)]});
    edges.push_back({least, greatest, h});
  }
  std::ranges::sort(edges);
  return edges;
}

/// The half-edges of edges with two faces of one orientation, both surface or both fillers.
std::vector<Twins> twins_of(const Triangles& triangles, const FillerMarks& fillers) {
  const auto is_filler = [&](Halfedge h) {
    return !fillers.empty() && fillers[static_cast<size_t>(h / 3)] == 1;
  };
  const std::vector<Edge> edges = sorted_edges(triangles);
  std::vector<Twins> twins;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto end =
        std::find_if(first, edges.end(), [&](const Edge& e) { return !e.is_along(*first); });
    if (end - first == 2) {
      const Halfedge h = first->halfedge, g = (first + 1)->halfedge;
      if (triangles.data()[h] != triangles.data()[g] && is_filler(h) == is_filler(g))
        twins.emplace_back(h, g);
    }
    first = end;
  }
  return twins;
}

/// Unit; zero of faces without area.
Points face_normals(const TriangleMesh& mesh) {
  Points normals = Points::Zero(mesh.face_count(), 3);
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) { return mesh.position(mesh.triangles(f, k)); };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    if (has_no_area(a, b, c)) continue;
    // Halves and unit sides, so that nothing overflows or vanishes.
    const Vector3 ab = (b / 2 - a / 2).stableNormalized(), ac = (c / 2 - a / 2).stableNormalized();
    normals.row(f) = ab.cross(ac).stableNormalized();
  }
  return normals;
}

/// Faces without area lie on an edge of the surface or within it: with the normal of either side
/// they are joined to that one, and to the other as that would be.
void fill_from_neighbours(Points& normals, const std::vector<Twins>& twins) {
  constexpr int most_passes = 8;  // so many lie side by side, or more where they are in order
  const auto is_bare = [&](Face f) { return normals.row(f).isZero(0); };
  std::vector<Twins> bare;
  for (const auto& [h, g] : twins)
    if (is_bare(h / 3) || is_bare(g / 3)) bare.emplace_back(h, g);
  for (int pass = 0; pass < most_passes; ++pass) {
    for (const auto& [h, g] : bare) {
      if (is_bare(h / 3)) {
        normals.row(h / 3) = normals.row(g / 3);
      } else if (is_bare(g / 3)) {
        normals.row(g / 3) = normals.row(h / 3);
      }
    }
  }
}

double corner_angle(const TriangleMesh& mesh, Halfedge h) {
  const auto side = [&](Halfedge to) -> Vector3 {
    const Vector3 from = mesh.position(mesh.triangles.data()[h]);
    return (mesh.position(mesh.triangles.data()[to]) / 2 - from / 2).stableNormalized();
  };
  return angle_between(side(next(h)), side(next(next(h))));
}

class Fans {
 public:
  Fans(const TriangleMesh& mesh, const FillerMarks& fillers, double degrees)
      : mesh_(mesh), fillers_(fillers), corners_(static_cast<size_t>(mesh.triangles.size())) {
    const std::vector<Twins> twins = twins_of(mesh.triangles, fillers);
    normals_ = face_normals(mesh);
    const Points with_area = normals_;
    fill_from_neighbours(normals_, twins);
    const double most = (degrees + slack) * std::numbers::pi / 180;
    for (const auto& [h, g] : twins) join(h, g, most);
    sum(with_area);
  }

  long hard_edges() const { return hard_edges_; }

  /// Whether a vertex has several fans of surface.
  std::vector<bool> parted() {
    std::vector<int> first(static_cast<size_t>(mesh_.vertex_count()), -1);
    std::vector<bool> parted(first.size(), false);
    for (Halfedge h = 0; h < mesh_.triangles.size(); ++h) {
      if (!fillers_.empty() && fillers_[static_cast<size_t>(h / 3)] == 1) continue;
      const auto v = static_cast<size_t>(mesh_.triangles.data()[h]);
      const int fan = corners_.find(h);
      if (first[v] < 0) first[v] = fan;
      if (first[v] != fan) parted[v] = true;
    }
    return parted;
  }

  /// Of the fan that a corner is of; zero where that has no direction.
  Vector3 normal(Halfedge corner) {
    return sums_.row(corners_.find(corner)).transpose().stableNormalized();
  }

 private:
  void join(Halfedge h, Halfedge g, double most) {
    const Vector3 one = normals_.row(h / 3), other = normals_.row(g / 3);
    if (one.isZero(0) || other.isZero(0) || angle_between(one, other) > most) {
      ++hard_edges_;
      return;
    }
    corners_.unite(h, next(g));
    corners_.unite(next(h), g);
  }

  void sum(const Points& with_area) {
    sums_ = Points::Zero(mesh_.triangles.size(), 3);
    for (Halfedge h = 0; h < mesh_.triangles.size(); ++h)
      if (!with_area.row(h / 3).isZero(0))
        sums_.row(corners_.find(h)) += corner_angle(mesh_, h) * with_area.row(h / 3);
  }

  const TriangleMesh& mesh_;
  const FillerMarks& fillers_;
  UnionFind corners_;
  Points normals_;  // of faces
  Points sums_;     // of fans, at their corner of least number
  long hard_edges_ = 0;
};

}  // namespace

std::optional<long> add_creases(MeshFile& file, double degrees) {
  if (!(degrees >= 0 && degrees <= 180))
    throw std::invalid_argument("creases: an angle from 0 to 180 degrees is needed");
  if (has_normals(file)) return std::nullopt;
  const FillerMarks fillers = fillers_of(file);
  Fans fans(file.mesh, fillers, degrees);
  const std::vector<bool> parted = fans.parted();
  if (std::ranges::find(parted, true) == parted.end()) return fans.hard_edges();
  const Points of_vertices = shading_normals(file);
  CornerNormals normals(file.mesh.triangles.size(), 3);
  for (Halfedge corner = 0; corner < normals.rows(); ++corner) {
    const Vertex v = file.mesh.triangles.data()[corner];
    normals.row(corner) = of_vertices.row(v);
    if (!parted[static_cast<size_t>(v)]) continue;
    const Vector3 own = fans.normal(corner);
    if (!own.isZero(0)) normals.row(corner) = own;
  }
  file.corner_normals = std::move(normals);
  return fans.hard_edges();
}

}  // namespace sphparam
