#include "embedding/constructions/untangle.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "elementary.h"
#include "embedding/newton/newton_patch.h"
#include "option_domain.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// A round: breadth-first rings around the corners of the folded triangles; the connected pieces of
// what they reach are the patches. In a patch, ε² = (median |s| / 100)² + (min(0, s_min))²: the
// barrier stands clear of the deepest fold and follows it down. Pieces that are not neighbours
// share no triangle, so they are solved at the same time and in place.

namespace sphparam {
namespace {

constexpr double share_of_median = 0.01;
constexpr std::array shares_of_deepest{1.0, 2.0, 0.5};  // tried in turn
constexpr int patience = 15;                            // steps without fewer or shallower folds
constexpr double noticeably_shallower = 0.98;           // of the shallowest depth so far
constexpr int steps_to_clear = 3;  // without regularisation, once there is no fold

std::vector<Face> folded_faces(const Topology& topology, const Points& points, int threads) {
  std::vector<char> folded(static_cast<size_t>(topology.face_count()), 0);
  parallel_for(topology.face_count(), 4096, threads, [&](std::int64_t first, std::int64_t last) {
    for (Face f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      folded[static_cast<size_t>(f)] =
          orientation(points.row(topology.vertex(f, 0)), points.row(topology.vertex(f, 1)),
                      points.row(topology.vertex(f, 2))) <= 0;
    }
  });
  std::vector<Face> faces;
  for (Face f = 0; f < topology.face_count(); ++f) {
    if (folded[static_cast<size_t>(f)]) faces.push_back(f);
  }
  return faces;
}

constexpr int unreached = -1;

/// Edges from the nearest corner of a fold, up to `rings`; pinned vertices are never reached.
std::vector<int> ring_numbers(const Topology& topology, const std::vector<Face>& folds, int rings,
                              const std::vector<Vertex>& pinned) {
  constexpr int barred = -2;
  std::vector<int> ring(static_cast<size_t>(topology.vertex_count()), unreached);
  for (const Vertex v : pinned) ring[static_cast<size_t>(v)] = barred;
  std::vector<Vertex> front;
  const auto reach = [&](Vertex v, int number) {
    if (ring[static_cast<size_t>(v)] != unreached) return;
    ring[static_cast<size_t>(v)] = number;
    front.push_back(v);
  };
  for (const Face f : folds) {
    for (int k = 0; k < 3; ++k) reach(topology.vertex(f, k), 0);
  }
  for (size_t i = 0; i < front.size(); ++i) {
    const int number = ring[static_cast<size_t>(front[i])];
    if (number == rings) break;
    topology.for_each_outgoing(front[i],
                               [&](Halfedge h) { reach(topology.target(h), number + 1); });
  }
  std::replace(ring.begin(), ring.end(), barred, unreached);
  return ring;
}

/// The connected pieces of the vertices with a ring number.
std::vector<std::vector<Vertex>> pieces(const Topology& topology, const std::vector<int>& ring) {
  std::vector<std::vector<Vertex>> result;
  std::vector<char> seen(ring.size(), 0);
  for (Vertex seed = 0; seed < topology.vertex_count(); ++seed) {
    const auto enter = [&](Vertex v) {
      if (ring[static_cast<size_t>(v)] < 0 || seen[static_cast<size_t>(v)]) return false;
      seen[static_cast<size_t>(v)] = 1;
      return true;
    };
    if (!enter(seed)) continue;
    std::vector<Vertex> piece{seed};
    for (size_t i = 0; i < piece.size(); ++i) {
      topology.for_each_outgoing(piece[i], [&](Halfedge h) {
        if (enter(topology.target(h))) piece.push_back(topology.target(h));
      });
    }
    result.push_back(std::move(piece));
  }
  return result;
}

/// Takes the outer rings off pieces with more than `limit` vertices.
void trim(const std::vector<std::vector<Vertex>>& pieces, int rings, int limit,
          std::vector<int>& ring) {
  for (const std::vector<Vertex>& piece : pieces) {
    if (static_cast<long>(piece.size()) <= limit) continue;
    std::vector<long> up_to(static_cast<size_t>(rings) + 1, 0);
    for (const Vertex v : piece) ++up_to[static_cast<size_t>(ring[static_cast<size_t>(v)])];
    int kept = -1;
    for (long sum = 0; kept < rings && (sum += up_to[static_cast<size_t>(kept + 1)]) <= limit;) {
      ++kept;
    }
    for (const Vertex v : piece) {
      if (ring[static_cast<size_t>(v)] > kept) ring[static_cast<size_t>(v)] = unreached;
    }
  }
}

/// What the triangles' s say about a patch.
struct Depth {
  double deepest;  // least s, where it is negative, else 0
  double median;   // of |s|
};

Depth depth_of(const NewtonPatch& patch) {
  std::vector<double> s = patch.stretches();
  const double deepest = std::min(0.0, *std::min_element(s.begin(), s.end()));
  for (double& value : s) value = std::abs(value);
  const auto middle = s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2);
  std::nth_element(s.begin(), middle, s.end());
  return {deepest, *middle};
}

/// Newton steps with a regularisation of `share` times the deepest fold, until there is no fold or
/// no progress. Returns the number of steps.
int unfold(NewtonPatch& patch, double share, const UntangleOptions& options) {
  DistortionEnergy energy{.lambda = options.lambda};
  int steps = 0, folds = patch.folds(), fewest = folds, waited = 0;
  Depth depth = depth_of(patch);
  for (double shallowest = depth.deepest; folds > 0 && waited < patience; ++steps) {
    energy.epsilon = elementary::hypot(share_of_median * depth.median, share * depth.deepest);
    if (steps == options.max_steps || !(energy.epsilon > 0) || !patch.step(energy).moved) break;
    folds = patch.folds();
    depth = depth_of(patch);
    // Many shallow folds are nearer to none than a few deep ones.
    const bool better = folds < fewest || depth.deepest > noticeably_shallower * shallowest;
    waited = better ? 0 : waited + 1;
    fewest = std::min(fewest, folds);
    shallowest = std::max(shallowest, depth.deepest);
  }
  return steps;
}

/// Unfolds a patch; leaves it at the best try if none gets rid of every fold. Returns the number of
/// Newton steps.
int unfold(NewtonPatch& patch, const UntangleOptions& options) {
  int steps = 0, fewest = patch.folds();
  const Points start = patch.positions();
  Points best = start;
  patch.fit_source_area();
  for (const double share : shares_of_deepest) {
    patch.set_positions(start);
    steps += unfold(patch, share, options);
    if (const int folds = patch.folds(); folds < fewest) {
      fewest = folds;
      best = patch.positions();
    }
    if (fewest == 0) break;
  }
  patch.set_positions(best);
  const DistortionEnergy energy{.lambda = options.lambda};
  for (int i = 0; i < steps_to_clear && fewest == 0; ++i, ++steps) {
    if (!std::isfinite(patch.energy(energy)) || !patch.step(energy).moved) break;
  }
  return steps;
}

using Patches = std::vector<std::vector<Vertex>>;

Patches patches_around(const Topology& topology, const std::vector<Face>& folds, int rings,
                       const UntangleOptions& options) {
  std::vector<int> ring = ring_numbers(topology, folds, rings, options.pinned);
  trim(pieces(topology, ring), rings, options.max_patch, ring);
  return pieces(topology, ring);
}

/// Unfolds every patch; one that would end with more folds stays as it was.
void unfold_all(const Topology& topology, const RestTriangles& source, const Patches& patches,
                const UntangleOptions& options, Points& points, UntangleReport& report) {
  const std::int64_t count = static_cast<std::int64_t>(patches.size());
  std::vector<int> steps(patches.size(), 0);
  parallel_for(count, 1, options.threads, [&](std::int64_t first, std::int64_t) {
    const size_t i = static_cast<size_t>(first);
    NewtonPatch patch(topology, source, points, patches[i]);
    const int before = patch.folds();
    if (before == 0) return;
    steps[i] = unfold(patch, options);
    if (patch.folds() < before) patch.write_to(points);
  });
  for (size_t i = 0; i < patches.size(); ++i) {
    report.patches += steps[i] > 0;
    report.steps += steps[i];
    report.work += static_cast<double>(patches[i].size()) * steps[i];
    report.largest_patch = std::max(report.largest_patch, static_cast<long>(patches[i].size()));
  }
}

void require_domain(const UntangleOptions& options, int vertices) {
  require_between("lambda", options.lambda, 0, greatest_lambda);
  require_at_least("rings", options.rings, 0);
  require_at_least("max_rounds", options.max_rounds, 0);
  require_at_least("max_patch", options.max_patch, 0);
  require_at_least("max_steps", options.max_steps, 0);
  require_at_least("max_work", options.max_work, 0);
  require_vertices("pinned", options.pinned, vertices);
}

}  // namespace

Untangled untangle(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                   const UntangleOptions& options) {
  require_domain(options, topology.vertex_count());
  const auto start = std::chrono::steady_clock::now();
  Untangled result{map, {}};
  UntangleReport& report = result.report;
  Points& points = result.map.points;
  std::vector<Face> folds = folded_faces(topology, points, options.threads);
  report.folds_before = static_cast<long>(folds.size());
  Patches previous;
  size_t folds_of_previous = 0;
  const auto may_go_on = [&] {
    return !folds.empty() && report.rounds < options.max_rounds && report.work < options.max_work;
  };
  for (int rings = options.rings; may_go_on(); rings = std::max(1, 2 * rings)) {
    Patches patches = patches_around(topology, folds, rings, options);
    // The same patches with the same folds would only be tried in vain again.
    const bool tried = patches == previous && folds.size() == folds_of_previous;
    folds_of_previous = folds.size();
    if (!tried) unfold_all(topology, source, patches, options, points, report);
    previous = std::move(patches);
    folds = folded_faces(topology, points, options.threads);
    ++report.rounds;
    const double left = static_cast<double>(folds.size());
    sphparam::report(options.progress, "untangle",
                     1 - left / static_cast<double>(std::max(1L, report.folds_before)));
  }
  report.folds_after = static_cast<long>(folds.size());
  report.touched = ((points.array() != map.points.array()).rowwise().any()).count();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace sphparam
