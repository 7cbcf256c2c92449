#include "sphparam/mesh/topology.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "mesh/index_range.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/parallel.h"

// Corners are bucketed by vertex (a counting sort). At a vertex, every face has one half-edge that
// leaves to `target` and one that comes from `source`; the leaving one's twin is the arriving one
// of the face that comes from its target. So twins are matched vertex by vertex, in place and in
// parallel: pair by pair at small vertices, by sorting at large ones, never quadratic. The matching
// is a permutation of the faces at the vertex; one fan means one cycle.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 2048;
constexpr int most_pairwise = 16;  // faces at a vertex

/// A face, seen from one of its vertices.
struct Corner {
  Vertex target, source;
  Halfedge leaving;
};

size_t at(std::int64_t i) { return static_cast<size_t>(i); }

/// For each corner, the one whose source is its target. False: that is not one to one.
bool match_pairwise(const Corner* corners, int count, int* partner) {
  std::uint32_t taken = 0;
  for (int i = 0; i < count; ++i) {
    int found = 0;
    for (int j = 0; j < count; ++j) {
      if (corners[j].source != corners[i].target) continue;
      partner[i] = j;
      ++found;
    }
    if (found != 1 || (taken >> partner[i] & 1)) return false;
    taken |= std::uint32_t{1} << partner[i];
  }
  return true;
}

bool match_sorted(const Corner* corners, int count, int* partner) {
  std::vector<std::pair<Vertex, int>> targets, sources;
  for (int i = 0; i < count; ++i) {
    targets.emplace_back(corners[i].target, i);
    sources.emplace_back(corners[i].source, i);
  }
  std::ranges::sort(targets);
  std::ranges::sort(sources);
  for (size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].first != sources[i].first) return false;
    if (i > 0 && targets[i].first == targets[i - 1].first) return false;
    partner[targets[i].second] = sources[i].second;
  }
  return true;
}

/// Is the permutation one cycle?
bool is_one_fan(const int* partner, int count) {
  int steps = 0, i = 0;
  do {
    i = partner[i];
    ++steps;
  } while (i != 0 && steps <= count);
  return steps == count;
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

int vertex_count_of(const TriangleMesh& mesh) {
  require_numbered(mesh.face_count(), mesh.vertex_count());
  return static_cast<int>(mesh.vertex_count());
}

}  // namespace

Topology::Topology(const TriangleMesh& mesh, int threads)
    : Topology(mesh.triangles, vertex_count_of(mesh), threads) {}

Topology::Topology(const Triangles& triangles, int vertex_count, int threads) {
  if (!build(triangles, vertex_count, threads)) refuse(triangles, vertex_count);
  for (const Halfedge h : outgoing_) {
    if (h < 0) refuse(triangles, vertex_count);
  }
}

std::optional<Topology> Topology::try_build(const Triangles& triangles, int vertex_count,
                                            int threads) {
  Topology topology;
  if (!topology.build(triangles, vertex_count, threads)) return std::nullopt;
  return topology;
}

bool Topology::is_of(const Triangles& triangles) const {
  return std::equal(origin_.begin(), origin_.end(), triangles.data(),
                    triangles.data() + triangles.size());
}

bool Topology::build(const Triangles& triangles, int vertex_count, int threads) {
  require_numbered(triangles.rows(), vertex_count);
  // 1. How many corners every vertex has, and where the list of them starts.
  const size_t halfedges = at(triangles.size());
  origin_.assign(triangles.data(), triangles.data() + halfedges);
  std::vector<int> start(at(vertex_count) + 1, 0);
  for (const Vertex v : origin_) {
    if (v < 0 || v >= vertex_count) return false;
    ++start[at(v) + 1];
  }
  for (size_t v = 0; v < at(vertex_count); ++v) start[v + 1] += start[v];

  // 2. The corners, vertex by vertex.
  const auto corners = std::make_unique_for_overwrite<Corner[]>(halfedges);
  {
    std::vector<int> place(start.begin(), start.end() - 1);
    for (Halfedge h = 0; h < static_cast<Halfedge>(halfedges); h += 3) {
      const Vertex a = origin(h), b = origin(h + 1), c = origin(h + 2);
      if (a == b || b == c || c == a) return false;
      corners[at(place[at(a)]++)] = {b, c, h};
      corners[at(place[at(b)]++)] = {c, a, h + 1};
      corners[at(place[at(c)]++)] = {a, b, h + 2};
    }
  }

  // 3. At every vertex each corner's next one about it: together they must be one closed fan.
  twin_.resize(halfedges);
  outgoing_.resize(at(vertex_count));
  std::atomic<bool> sound{true};
  parallel_for(vertex_count, grain, threads, [&](std::int64_t first, std::int64_t last) {
    std::vector<int> partner;
    for (std::int64_t v = first; v < last; ++v) {
      const Corner* at_v = &corners[at(start[at(v)])];
      const int count = start[at(v) + 1] - start[at(v)];
      outgoing_[at(v)] = count > 0 ? at_v->leaving : -1;
      if (count == 0) continue;
      partner.resize(std::max(partner.size(), at(count)));
      const bool matched = count <= most_pairwise ? match_pairwise(at_v, count, partner.data())
                                                  : match_sorted(at_v, count, partner.data());
      if (!matched || !is_one_fan(partner.data(), count)) {
        sound = false;
        return;
      }
      for (int i = 0; i < count; ++i) {
        twin_[at(at_v[i].leaving)] = previous(at_v[at(partner[at(i)])].leaving);
      }
    }
  });
  return sound;
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
