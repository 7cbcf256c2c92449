#include "correspondence/landmark_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "correspondence/bounded_curvature.h"
#include "correspondence/end_pairings.h"
#include "correspondence/extremities.h"
#include "correspondence/stance.h"
#include "mesh/mesh_hierarchy.h"
#include "sphparam/mesh/curvature.h"
#include "sphparam/parallel.h"

// Lengths pair ends, but know no sides: a body and its mirror image have the same. Of the pairings
// that they leave, maps are made between coarse levels; the energy of the best is that of a good
// map, and what tells front from back there is where the surface is convex, or, of surfaces that
// lie alike in space, where they are.

namespace sphparam {
namespace {

constexpr int small_vertices = 2000;  // of the surfaces whose ends are sought
constexpr int most_ends = 7;
constexpr int tried = 24, finished = 6;  // pairings whose maps are begun, and made

size_t at(int i) { return static_cast<size_t>(i); }

/// A surface of fewer vertices, and their names on the whole one.
struct SmallSurface {
  TriangleMesh mesh;
  Topology topology;
  std::vector<Vertex> names;
  MatrixX bend, stance;  // of the whole surface
  VectorX area;
};

/// The coarsest level of enough vertices, complete.
size_t complete_down_to(MeshHierarchy& levels, int vertices, int threads) {
  size_t level = levels.size() - 1;
  while (level > 0 && levels[level].vertex_count() < vertices) {
    --level;
    complete_positions(levels[level], levels[level + 1], threads);
  }
  return level;
}

SmallSurface small_surface(const MappedMesh& mapped, int threads) {
  MeshHierarchy levels = build_hierarchy(mapped.mesh(), mapped.topology(), threads);
  const size_t level = complete_down_to(levels, small_vertices, threads);
  TriangleMesh mesh = triangle_mesh(levels[level]);
  Topology topology(mesh, threads);
  VectorX area = measure_curvature(mesh, topology, 0, threads).area;
  return {std::move(mesh),
          std::move(topology),
          names_on_finest(levels, level),
          bounded_curvature(mapped, threads),
          stance_of(mapped.mesh()),
          std::move(area)};
}

double mean_product(const VectorX& weight, const MatrixX& a, const MatrixX& b) {
  double sum = 0;
  for (Eigen::Index c = 0; c < a.cols(); ++c) sum += weight.cwiseProduct(a.col(c)).dot(b.col(c));
  return sum / weight.sum();
}

MatrixX centred(const VectorX& weight, MatrixX values) {
  const VectorX one = VectorX::Ones(weight.size());
  for (Eigen::Index c = 0; c < values.cols(); ++c)
    values.col(c).array() -= mean_product(weight, values.col(c), one);
  return values;
}

/// Of all columns together.
double correlation(const VectorX& weight, const MatrixX& here, const MatrixX& there) {
  const MatrixX a = centred(weight, here), b = centred(weight, there);
  const double of_both = mean_product(weight, a, a) * mean_product(weight, b, b);
  return of_both > 0 ? mean_product(weight, a, b) / std::sqrt(of_both) : 0;
}

/// What `make` makes of each, in order, without nothings.
template <class Item, class Make>
auto made_of(const std::vector<Item>& items, int threads, const Make& make) {
  using Made = decltype(make(items[0]));
  std::vector<Made> made(items.size());
  parallel_for(std::ssize(items), 1, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i)
      made[i] = make(items[i]);
  });
  std::vector<typename Made::value_type> result;
  for (Made& item : made)
    if (item) result.push_back(std::move(*item));
  return result;
}

class LandmarkSearch {
 public:
  LandmarkSearch(const MappedMesh& from, const MappedMesh& to, const TargetSurface& target,
                 const ComposedOptions& options, bool alike)
      : to_(to),
        target_(target),
        options_(options),
        alike_(alike),
        a_(small_surface(from, options.threads)),
        b_(small_surface(to, options.threads)),
        ends_(find_extremities(a_.mesh, a_.topology, most_ends, options.threads)),
        others_(find_extremities(b_.mesh, b_.topology, most_ends, options.threads)) {}

  std::vector<SuggestedLandmarks> run() const {
    report(options_.progress, "landmarks", 0);
    const std::vector<EndPairing> likely = likely_pairings(ends_, others_, tried, apart());
    const auto begun =
        made_of(likely, options_.threads, [&](const EndPairing& pairing) -> std::optional<Begun> {
          const std::optional<double> energy = way(options_of(pairing)).start(1);
          return energy ? std::optional<Begun>({pairing, *energy}) : std::nullopt;
        });
    report(options_.progress, "landmarks", 0.5);
    std::vector<SuggestedLandmarks> suggestions = made_of(
        best_of(begun), options_.threads, [&](const Begun& best) { return judged(best.first); });
    report(options_.progress, "landmarks", 1);
    std::ranges::stable_sort(suggestions, {}, &SuggestedLandmarks::score);
    return suggestions;
  }

 private:
  Vertex end(int i) const { return ends_.vertices[at(i)]; }
  Vertex partner(int i) const { return b_.names[at(others_.vertices[at(i)])]; }

  using Begun = std::pair<EndPairing, double>;  // and its energy

  static std::vector<Begun> best_of(std::vector<Begun> begun) {
    std::ranges::stable_sort(begun, {}, &Begun::second);
    if (std::ssize(begun) > finished) begun.resize(finished);
    return begun;
  }

  CoarseToFine way(const ComposedOptions& options) const {
    return {a_.mesh, a_.topology, target_, options};
  }

  /// The map that a pairing leads to when no end is held any more.
  std::optional<SuggestedLandmarks> judged(const EndPairing& pairing) const {
    const ComposedOptions options = options_of(pairing);
    CoarseToFine coarse = way(options);
    if (!coarse.start(1)) return std::nullopt;
    const SphereMap map = coarse.finish();
    if (map.points.rows() == 0) return std::nullopt;
    SuggestedLandmarks result{.agreement = agreement(map, a_.bend, b_.bend)};
    if (alike_) result.place_agreement = agreement(map, a_.stance, b_.stance);
    result.energy = energy_of_composition(a_.mesh, a_.topology, target_, map, options.energy, 1);
    result.score = result.energy * (1 - result.agreement) * (1 - result.place_agreement);
    for (const auto& [x, y] : pairing.pairs)
      result.landmarks.push_back({a_.names[at(end(x))], partner(y)});
    return result;
  }

  /// Correlation of values of the whole surfaces.
  double agreement(const SphereMap& map, const MatrixX& of_a, const MatrixX& of_b) const {
    MatrixX here(map.points.rows(), of_a.cols());
    MatrixX there = MatrixX::Zero(map.points.rows(), of_a.cols());
    for (Vertex v = 0; v < map.points.rows(); ++v) {
      const SurfacePoint point = target_.place(map.point(v)).at;
      here.row(v) = of_a.row(a_.names[at(v)]);
      for (int k = 0; k < 3; ++k)
        there.row(v) += point.barycentric[k] * of_b.row(to_.mesh().triangles(point.face, k));
    }
    return correlation(a_.area, here, there);
  }

  /// Between ends of both, in space; nothing where that says nothing.
  MatrixX apart() const {
    if (!alike_) return {};
    MatrixX result(ends_.vertices.size(), others_.vertices.size());
    for (int x = 0; x < result.rows(); ++x)
      for (int y = 0; y < result.cols(); ++y)
        result(x, y) = (a_.stance.row(a_.names[at(end(x))]) - b_.stance.row(partner(y))).norm();
    return result;
  }

  ComposedOptions options_of(const EndPairing& pairing) const {
    ComposedOptions result{
        .energy = options_.energy, .release = true, .threads = 1, .progress = {}};
    for (const auto& [x, y] : pairing.pairs)
      result.landmarks.push_back({end(x), to_.map().point(partner(y))});
    return result;
  }

  const MappedMesh& to_;
  const TargetSurface& target_;
  const ComposedOptions& options_;
  bool alike_;  // in space
  SmallSurface a_, b_;
  Extremities ends_, others_;
};

/// Whether no end of one has another partner in the other.
bool says_the_same(const SuggestedLandmarks& a, const SuggestedLandmarks& b) {
  return std::ranges::all_of(a.landmarks, [&](const LandmarkPair& p) {
    return std::ranges::all_of(
        b.landmarks, [&](const LandmarkPair& q) { return (p.from == q.from) == (p.to == q.to); });
  });
}

}  // namespace

std::vector<SuggestedLandmarks> suggest_landmarks(const MappedMesh& from, const MappedMesh& to,
                                                  const TargetSurface& target,
                                                  const ComposedOptions& options, bool alike) {
  return LandmarkSearch(from, to, target, options, alike).run();
}

double confidence_of(const std::vector<SuggestedLandmarks>& suggestions) {
  const SuggestedLandmarks& best = suggestions.front();
  for (const SuggestedLandmarks& other : suggestions)
    if (!says_the_same(best, other))
      return other.score > 0 ? std::clamp(1 - best.score / other.score, 0.0, 1.0) : 0;
  return 1;
}

}  // namespace sphparam
