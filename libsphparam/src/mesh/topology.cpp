#include "sphparam/mesh/topology.h"

#include "sphparam/mesh/mesh_defects.h"

// Twins are matched by bucketing half-edges by origin (a counting sort) and looking for the
// opposite one in the bucket of the target: linear for bounded valence, and linear all the same at
// a vertex of huge valence because the search always walks the smaller of the two buckets.

namespace sphparam {
namespace {

struct Buckets {
  std::vector<int> start;           // #V+1
  std::vector<Halfedge> halfedges;  // grouped by origin
};

Buckets bucket_by_origin(const std::vector<Vertex>& origin, int vertex_count) {
  Buckets buckets;
  buckets.start.assign(static_cast<size_t>(vertex_count) + 1, 0);
  for (const Vertex v : origin) ++buckets.start[static_cast<size_t>(v) + 1];
  for (size_t v = 0; v < static_cast<size_t>(vertex_count); ++v) {
    buckets.start[v + 1] += buckets.start[v];
  }
  buckets.halfedges.resize(origin.size());
  std::vector<int> fill(buckets.start.begin(), buckets.start.end() - 1);
  for (size_t h = 0; h < origin.size(); ++h) {
    buckets.halfedges[static_cast<size_t>(fill[static_cast<size_t>(origin[h])]++)] =
        static_cast<Halfedge>(h);
  }
  return buckets;
}

[[noreturn]] void refuse(const Triangles& triangles, int vertex_count) {
  TriangleMesh mesh;
  mesh.positions = Points::Zero(vertex_count, 3);
  mesh.triangles = triangles;
  std::vector<MeshDefect> reasons;
  for (MeshDefect& defect : inspect_mesh(mesh).defects) {
    if (defect.fatal || defect.kind == DefectKind::UnusedVertex) reasons.push_back(defect);
  }
  throw MeshError(std::move(reasons));
}

}  // namespace

Topology::Topology(const TriangleMesh& mesh)
    : Topology(mesh.triangles, static_cast<int>(mesh.vertex_count())) {}

Topology::Topology(const Triangles& triangles, int vertex_count) {
  if (!build(triangles, vertex_count)) refuse(triangles, vertex_count);
  for (const Halfedge h : outgoing_) {
    if (h < 0) refuse(triangles, vertex_count);
  }
}

std::optional<Topology> Topology::try_build(const Triangles& triangles, int vertex_count) {
  Topology topology;
  if (!topology.build(triangles, vertex_count)) return std::nullopt;
  return topology;
}

bool Topology::build(const Triangles& triangles, int vertex_count) {
  const size_t halfedges = static_cast<size_t>(triangles.size());
  origin_.assign(triangles.data(), triangles.data() + halfedges);
  for (const Vertex v : origin_) {
    if (v < 0 || v >= vertex_count) return false;
  }
  const Buckets buckets = bucket_by_origin(origin_, vertex_count);
  const auto bucket_size = [&](Vertex v) {
    return buckets.start[static_cast<size_t>(v) + 1] - buckets.start[static_cast<size_t>(v)];
  };

  // For the edge of h = (a → b): the face on its other side has a half-edge b → a. Its own
  // half-edge leaves b; the one after it leaves a. Search the smaller bucket for either.
  twin_.assign(halfedges, -1);
  for (Halfedge h = 0; h < static_cast<Halfedge>(halfedges); ++h) {
    if (twin(h) >= 0) continue;
    const Vertex a = origin(h), b = target(h);
    if (a == b) return false;
    const bool search_b = bucket_size(b) <= bucket_size(a);
    const auto bucket = static_cast<size_t>(search_b ? b : a);
    Halfedge opposite = -1;
    int found = 0;
    for (int i = buckets.start[bucket]; i < buckets.start[bucket + 1]; ++i) {
      const Halfedge leaving = buckets.halfedges[static_cast<size_t>(i)];
      const Halfedge candidate = search_b ? leaving : previous(leaving);
      if (origin(candidate) == b && target(candidate) == a) {
        opposite = candidate;
        ++found;
      }
    }
    // Taken already: a second a → b. Found here, many copies of a face do not each search a bucket
    // that they made huge themselves.
    if (found != 1 || twin(opposite) >= 0) return false;
    twin_[static_cast<size_t>(h)] = opposite;
    twin_[static_cast<size_t>(opposite)] = h;
  }

  outgoing_.assign(static_cast<size_t>(vertex_count), -1);
  for (int v = 0; v < vertex_count; ++v) {
    const int faces_at_v = bucket_size(v);
    if (faces_at_v == 0) continue;
    const Halfedge first =
        buckets.halfedges[static_cast<size_t>(buckets.start[static_cast<size_t>(v)])];
    outgoing_[static_cast<size_t>(v)] = first;
    int steps = 0;
    Halfedge h = first;
    do {
      h = rotate_ccw(h);
      ++steps;
    } while (h != first);
    if (steps != faces_at_v) return false;
  }
  return true;
}

int Topology::valence(Vertex v) const {
  int count = 0;
  for_each_outgoing(v, [&](Halfedge) { ++count; });
  return count;
}

Halfedge Topology::find_halfedge(Vertex a, Vertex b) const {
  Halfedge found = -1;
  for_each_outgoing(a, [&](Halfedge h) {
    if (target(h) == b) found = h;
  });
  return found;
}

}  // namespace sphparam
