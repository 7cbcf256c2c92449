#include "chart/refined_mesh.h"

#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// Where a new vertex lies in the source. Corner j of a refined face is stored as the unit ray
// p_j = Σᵢ λⱼᵢ xᵢ / ℓⱼ. The ray Σⱼ wⱼ pⱼ is then Σᵢ (Σⱼ wⱼ λⱼᵢ / ℓⱼ) xᵢ: these sums, divided by
// their total, are its barycentric coordinates, and ℓ is the length of Σᵢ λᵢ xᵢ.

namespace sphparam {
namespace {

constexpr std::int64_t chunk_size = 16384;

}  // namespace

RefinedMesh::RefinedMesh(const Topology& topology, const SphereMap& map, const Triangles& source,
                         int threads)
    : HalfedgeLinks(topology.halfedge_count()),
      source_(source),
      source_faces_(static_cast<size_t>(topology.face_count())),
      points_(static_cast<size_t>(topology.vertex_count())),
      surface_points_(points_.size()),
      lengths_(points_.size(), 1) {
  parallel_for(topology.face_count(), chunk_size, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
                   source_faces_[static_cast<size_t>(f)] = f;
                   for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) link_as(topology, h);
                 }
               });
  parallel_for(topology.vertex_count(), chunk_size, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v) {
                   const Halfedge h = topology.outgoing(v);
                   points_[static_cast<size_t>(v)] = map.point(v);
                   surface_points_[static_cast<size_t>(v)] = {Topology::face(h),
                                                              Vector3::Unit(Topology::corner(h))};
                 }
               });
}

Points RefinedMesh::points() const {
  Points result(vertex_count(), 3);
  for (Vertex v = 0; v < vertex_count(); ++v) result.row(v) = point(v);
  return result;
}

Triangles RefinedMesh::triangles() const {
  return Eigen::Map<const Triangles>(origin_.data(), face_count(), 3);
}

bool RefinedMesh::fits(Halfedge h, const Vector3& ray) const {
  for (const Halfedge side : {h, twin(h)}) {
    const Vector3& c = point(apex(side));
    if (orientation(point(origin(side)), ray, c) <= 0) return false;
    if (orientation(ray, point(target(side)), c) <= 0) return false;
  }
  return true;
}

Vertex RefinedMesh::split_edge(Halfedge h, double t, const Vector3& point) {
  Vector3 weights = Vector3::Zero();
  weights[Topology::corner(h)] = 1 - t;
  weights[Topology::corner(Topology::next(h))] = t;
  const Vertex p = add_vertex(Topology::face(h), weights, point);

  // Faces (a, b, c) and (b, a, d) become (a, p, c), (p, b, c), (b, p, d), (p, a, d).
  const Halfedge bc = Topology::next(h), g = twin(h), ad = Topology::next(g);
  const Vertex a = origin(h), b = origin(g), c = apex(h), d = apex(g);
  const Halfedge pb = add_face(p, b, c, source_faces_[static_cast<size_t>(Topology::face(h))]);
  const Halfedge pa = add_face(p, a, d, source_faces_[static_cast<size_t>(Topology::face(g))]);
  join(pb + 1, twin(bc));
  join(pa + 1, twin(ad));
  set_origin(bc, p);
  set_origin(ad, p);
  join(bc, pb + 2);
  join(ad, pa + 2);
  join(h, pa);
  join(g, pb);
  return p;
}

Vertex RefinedMesh::split_face(Face f, const Vector3& weights, const Vector3& point) {
  const Vertex p = add_vertex(f, weights, point);
  const Halfedge ab = 3 * f, bc = 3 * f + 1, ca = 3 * f + 2;
  const Vertex a = origin(ab), b = origin(bc), c = origin(ca);
  const Face source = source_faces_[static_cast<size_t>(f)];
  const Halfedge second = add_face(b, c, p, source), third = add_face(c, a, p, source);
  join(second, twin(bc));
  join(third, twin(ca));
  set_origin(ca, p);
  join(bc, second + 2);
  join(second + 1, third + 2);
  join(third + 1, ca);
  return p;
}

Vertex RefinedMesh::add_vertex(Face f, const Vector3& corner_weights, const Vector3& point) {
  const Face source = source_faces_[static_cast<size_t>(f)];
  Vector3 lambda = Vector3::Zero();
  Vector3 ray = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (corner_weights[k] == 0) continue;
    const auto v = static_cast<size_t>(vertex(f, k));
    const double weight = corner_weights[k] / lengths_[v];
    lambda += weight * barycentric_in(source, surface_points_[v], source_);
    ray += corner_weights[k] * points_[v];
  }
  const double total = lambda.sum();
  points_.push_back(point);
  surface_points_.push_back({source, lambda / total});
  lengths_.push_back(ray.stableNorm() / total);
  return vertex_count() - 1;
}

Halfedge RefinedMesh::add_face(Vertex a, Vertex b, Vertex c, Face source) {
  origin_.insert(origin_.end(), {a, b, c});
  twin_.insert(twin_.end(), 3, -1);
  source_faces_.push_back(source);
  return 3 * (face_count() - 1);
}

}  // namespace sphparam
