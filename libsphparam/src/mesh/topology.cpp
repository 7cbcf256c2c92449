#include "sphparam/mesh/topology.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "mesh/index_range.h"
#include "mesh/sphere_gate.h"
#include "sphparam/parallel.h"

// Corners are bucketed by vertex (a counting sort). At a vertex, every face has one half-edge that
// leaves to `target` and one that comes from `source`; the leaving one's twin is the arriving one
// of the face that comes from its target. So twins are matched vertex by vertex, in place and in
// parallel: pair by pair at small vertices, by sorting at large ones, never quadratic. The matching
// is a permutation of the faces at the vertex; one fan means one cycle.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 2048;
constexpr int few = 8, most_pairwise = 16;  // faces at a vertex

/// A face, seen from one of its vertices.
struct Corner {
  Vertex target, source;
  Halfedge leaving;
};

size_t at(std::int64_t i) { return static_cast<size_t>(i); }

/// For each corner, the one whose source is its target. False: that is not one to one. Each source
/// is held against all targets side by side, of which there are `most` at most.
template <int most>
bool match_pairwise(const Corner* corners, int count, int* partner) {
  std::array<Vertex, most> targets, found{}, place{};
  targets.fill(-1);
  for (int i = 0; i < count; ++i) targets[at(i)] = corners[i].target;
  for (int j = 0; j < count; ++j) {
    const Vertex source = corners[j].source;
    for (size_t i = 0; i < most; ++i) {
      const int same = -int{targets[i] == source};
      found[i] -= same;
      place[i] |= same & j;
    }
  }
  std::uint32_t taken = 0;
  for (int i = 0; i < count; ++i) {
    partner[i] = place[at(i)];
    if (found[at(i)] != 1 || (taken >> partner[i] & 1)) return false;
    taken |= std::uint32_t{1} << partner[i];
  }
  return true;
}

/// The same for any number.
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

/// For each corner of a vertex, the next one about it. False: they are not one closed fan.
bool find_fan(std::span<const Corner> corners, std::vector<int>& partner) {
  const int count = static_cast<int>(corners.size());
  partner.resize(std::max(partner.size(), corners.size()));
  const bool matched = count <= few ? match_pairwise<few>(corners.data(), count, partner.data())
                       : count <= most_pairwise
                           ? match_pairwise<most_pairwise>(corners.data(), count, partner.data())
                           : match_sorted(corners.data(), count, partner.data());
  return matched && is_one_fan(partner.data(), count);
}

/// All corners, those of a vertex together.
struct VertexCorners {
  std::vector<int> start;  // #V + 1
  std::unique_ptr<Corner[]> corners;

  std::span<const Corner> of(std::int64_t v) const {
    return {corners.get() + start[at(v)], corners.get() + start[at(v) + 1]};
  }
};

/// Nothing: a face names a vertex that is not there, or one twice.
std::optional<VertexCorners> corners_by_vertex(const std::vector<Vertex>& origin,
                                               int vertex_count) {
  VertexCorners by_vertex{std::vector<int>(at(vertex_count) + 1, 0), nullptr};
  std::vector<int>& start = by_vertex.start;
  for (const Vertex v : origin) {
    if (v < 0 || v >= vertex_count) return std::nullopt;
    ++start[at(v) + 1];
  }
  for (size_t v = 0; v < at(vertex_count); ++v) start[v + 1] += start[v];

  by_vertex.corners = std::make_unique_for_overwrite<Corner[]>(origin.size());
  std::vector<int> place(start.begin(), start.end() - 1);
  for (Halfedge h = 0; h < std::ssize(origin); h += 3) {
    const Vertex a = origin[at(h)], b = origin[at(h) + 1], c = origin[at(h) + 2];
    if (a == b || b == c || c == a) return std::nullopt;
    by_vertex.corners[at(place[at(a)]++)] = {b, c, h};
    by_vertex.corners[at(place[at(b)]++)] = {c, a, h + 1};
    by_vertex.corners[at(place[at(c)]++)] = {a, b, h + 2};
  }
  return by_vertex;
}

/// By its triangles alone.
[[noreturn]] void refuse(const Triangles& triangles, int vertex_count) {
  refuse_mesh({Points::Zero(vertex_count, 3), triangles});
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
  origin_.assign(triangles.data(), triangles.data() + triangles.size());
  const std::optional<VertexCorners> by_vertex = corners_by_vertex(origin_, vertex_count);
  if (!by_vertex) return false;
  twin_.resize(origin_.size());
  outgoing_.resize(at(vertex_count));
  std::atomic<bool> sound{true};
  parallel_for(vertex_count, grain, threads, [&](std::int64_t first, std::int64_t last) {
    std::vector<int> partner;
    for (std::int64_t v = first; v < last; ++v) {
      const std::span<const Corner> corners = by_vertex->of(v);
      outgoing_[at(v)] = corners.empty() ? -1 : corners.front().leaving;
      if (corners.empty()) continue;
      if (!find_fan(corners, partner)) {
        sound = false;
        return;
      }
      for (size_t i = 0; i < corners.size(); ++i)
        twin_[at(corners[i].leaving)] = previous(corners[at(partner[i])].leaving);
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
