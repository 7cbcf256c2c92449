#include "correspondence/coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>

#include "correspondence/composition_newton.h"
#include "correspondence/ring_insertion.h"
#include "embedding/constructions/progressive.h"
#include "embedding/frame/nearest_rotation.h"
#include "embedding/sweeps/kernel_placement.h"
#include "mesh/triangle_geometry.h"
#include "sphparam/parallel.h"

// A coarse level of the source gets a map of its own that has the landmarks where they belong; on
// it the energy of the composition is minimised by Newton steps. How limbs are turned about their
// axes is settled there, and differs from start to start: levels of several sizes are tried, and
// what has the least energy when all have climbed to the same level goes on. Then level by level
// up: a removed vertex goes into the kernel of its ring, from there to where it lies in the ring,
// makes local steps, and all are swept; on levels that have grown enough, Newton steps follow.
// Where rounding leaves no room in a ring, the finest level gets a map of its own instead.

namespace sphparam {
namespace {

constexpr int start_vertices = 200;  // of the level that all begins on, at least
constexpr int start_vertices_a_landmark = 20;
constexpr int turned_start_vertices = 300;  // of the level that starts at a map that is there
constexpr int last_growth = 4;              // of the level that all starts climb to
constexpr int start_steps = 30, steps = 8;  // of Newton, at most, there and on finer levels
constexpr double least_gain = 1e-3;         // of a step, of the energy beyond isometry
constexpr double growth = 1.8;              // of levels with Newton steps
constexpr double feature_distance = 3;  // that features are averaged over, in spacings of vertices
constexpr int removed_sweeps = 4, level_sweeps = 2;
/// Levels of so many vertices are near what coarser ones have found.
constexpr int fine_level = 10'000, fine_sweeps = 1, fine_steps = 2;
constexpr std::int64_t insertion_grain = 16;

size_t at(int i) { return static_cast<size_t>(i); }

/// As parts of a source of the area 4π, which a coarse level has less of.
RestTriangles rest_of(const TriangleMesh& level, int threads) {
  RestTriangles rest = measure_source(level, threads);
  const double part = surface_area(level) / (4 * std::numbers::pi);
  for (RestTriangle& triangle : rest) triangle = scaled(triangle, part);
  return rest;
}

/// Of vertices with these names among those that the features know, as averages over distances
/// that such vertices can tell.
FeatureTerm feature_term(const FeatureScales* features, const std::vector<Vertex>& names,
                         const TriangleMesh& mesh, const RestTriangles& rest) {
  if (features == nullptr) return {};
  const double spacing = std::sqrt(4 * std::numbers::pi / static_cast<double>(names.size()));
  const FeatureField& field = features->at(feature_distance * spacing);
  FeatureTerm term{.here = Functions(std::ssize(names), field.from.cols()),
                   .weight = VectorX::Zero(std::ssize(names)),
                   .there = &field.to};
  for (Vertex v = 0; v < std::ssize(names); ++v) term.here.row(v) = field.from.row(names[at(v)]);
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      term.weight[mesh.triangles(f, k)] += features->weight() * rest[at(f)].area / 3;
  return term;
}

double total_area(const RestTriangles& rest) {
  double area = 0;
  for (const RestTriangle& triangle : rest) area += triangle.area;
  return area;
}

/// Of an isometry, a unit of area.
double isometric(const DistortionEnergy& energy) {
  const double density = differentiate(energy, 1, 1).f;
  return std::isfinite(density) ? density : 0;
}

/// Newton steps, each smoothed by a sweep, as long as they pay. Returns the energy of a unit of
/// area.
double lower(MovingSurface& surface, int most_steps, const ComposedOptions& options) {
  CompositionNewton newton(surface, options.threads);
  const double area = total_area(surface.rest());
  const double least = area * isometric(options.energy.energy);
  const auto energy_now = [&] {
    return surface.energy(options.energy, surface.places(), options.threads);
  };
  double energy = energy_now();
  for (int n = 0; n < most_steps; ++n) {
    report(options.progress, "composition", static_cast<double>(n) / most_steps);
    const double before = energy;
    newton.step(options.energy, before);
    surface.sweep(options.energy, options.threads);
    energy = energy_now();
    if (!(before - energy > least_gain * (energy - least))) break;
  }
  return energy / area;
}

SphereMap map_of(const std::vector<Place>& places) {
  SphereMap map{Points(std::ssize(places), 3)};
  for (Vertex v = 0; v < map.points.rows(); ++v) map.points.row(v) = places[at(v)].direction;
  return map;
}

std::vector<Place> places_of(const SphereMap& map, const TargetSurface& target) {
  std::vector<Place> places;
  for (Vertex v = 0; v < map.points.rows(); ++v) places.push_back(target.place(map.point(v)));
  return places;
}

std::vector<Vertex> all_names(int vertices) {
  std::vector<Vertex> names(at(vertices));
  std::iota(names.begin(), names.end(), 0);
  return names;
}

std::vector<char> held_among(int vertices, const std::vector<Pin>& landmarks) {
  std::vector<char> held(at(vertices), 0);
  for (const Pin& pin : landmarks) held[at(pin.vertex)] = 1;
  return held;
}

KeptVertices kept(const std::vector<Pin>& landmarks) {
  KeptVertices keep{
      {}, std::max(start_vertices, start_vertices_a_landmark * static_cast<int>(landmarks.size()))};
  for (const Pin& pin : landmarks) keep.vertices.push_back(pin.vertex);
  return keep;
}

}  // namespace

std::vector<Vertex> names_on_finest(const MeshHierarchy& levels, size_t level) {
  std::vector<Vertex> names(at(levels[level].vertex_count()));
  for (Vertex v = 0; v < std::ssize(names); ++v) {
    names[at(v)] = v;
    for (size_t l = level; l > 0; --l) names[at(v)] = levels[l].finer[at(names[at(v)])];
  }
  return names;
}

CoarseToFine::CoarseToFine(const TriangleMesh& source, const Topology& topology,
                           const TargetSurface& target, const ComposedOptions& options)
    : target_(target), options_(options) {
  const KeptVertices keep = kept(options.landmarks);
  hierarchy_ = build_hierarchy(source, topology, options.threads, keep, options.progress);
  names_.push_back(keep.vertices);
  for (size_t l = 1; l < hierarchy_.size(); ++l) {
    std::vector<Vertex> names = names_.back();
    for (Vertex& v : names) v = v < 0 ? -1 : coarser_name(hierarchy_[l], v);
    names_.push_back(std::move(names));
  }
  for (size_t l = hierarchy_.size() - 1; l-- > 0;)
    complete_positions(hierarchy_[l], hierarchy_[l + 1], options.threads);
}

/// The coarsest level of so many vertices, or the finest.
size_t CoarseToFine::level_of(int vertices) const {
  size_t level = hierarchy_.size() - 1;
  while (level > 0 && hierarchy_[level].vertex_count() < vertices) --level;
  return level;
}

/// Begins on this level, or on a finer one where it cannot, and climbs to `last`.
std::optional<double> CoarseToFine::try_from(size_t level, size_t last) {
  level_ = level;
  while (!start_on(level_)) {
    if (level_ == 0) return std::nullopt;
    level_ = level_of(2 * hierarchy_[level_].vertex_count());
  }
  settle(level_, start_steps);
  while (level_ > last && climb_to(level_ - 1)) --level_;
  return level_ <= last ? std::optional(energy_) : std::nullopt;
}

std::optional<double> CoarseToFine::start(int most_starts) {
  const size_t last = level_of(last_growth * start_vertices);
  std::optional<double> least;
  State best;
  size_t tried = hierarchy_.size();
  for (int i = 0; i < most_starts; ++i) {
    const size_t level = level_of(start_vertices << i);
    if (level == tried) continue;
    tried = level;
    const std::optional<double> energy = try_from(level, last);
    if (!energy || (least && *energy >= *least)) continue;
    least = energy;
    best = {level_, newton_level_, places_};
  }
  if (!least) return least;
  level_ = best.level;
  newton_level_ = best.newton_level;
  places_ = std::move(best.places);
  return energy_ = *least;
}

SphereMap CoarseToFine::finish() {
  if (options_.release) {
    released_ = true;
    settle(level_, start_steps);
  }
  while (level_ > 0) {
    if (climb_to(level_ - 1)) {
      --level_;
      continue;
    }
    level_ = 0;
    if (!start_on(0)) return {};
    settle(0, start_steps);
  }
  return map_of(places_);
}

double CoarseToFine::start_at(const SphereMap& map) {
  level_ = level_of(turned_start_vertices);
  std::optional<SphereMap> own = embedded(level_, {});
  if (!own) level_ = 0;
  const std::vector<Vertex> names = names_on_finest(hierarchy_, level_);
  Points wanted(std::ssize(names), 3);
  for (Vertex v = 0; v < wanted.rows(); ++v) wanted.row(v) = map.points.row(names[at(v)]);
  places_ = places_of(
      own ? turned(*own, nearest_rotation(own->points, wanted, VectorX::Ones(wanted.rows()))) : map,
      target_);
  settle(level_, start_steps);
  return energy_;
}

/// A map of the level that has the landmarks; false: they could not be reached, which each level is
/// asked once, for it takes the longest of all.
bool CoarseToFine::start_on(size_t level) {
  if (const auto known = failed_.find(level); known != failed_.end()) {
    residuals_ = known->second;
    return false;
  }
  if (reaches_landmarks(level)) return true;
  failed_[level] = residuals_;
  return false;
}

bool CoarseToFine::reaches_landmarks(size_t level) {
  std::vector<Pin> pins = options_.landmarks;
  for (size_t i = 0; i < pins.size(); ++i) {
    pins[i].vertex = names_[level][i];
    if (pins[i].vertex < 0) return false;
  }
  const std::optional<SphereMap> map = embedded(level, pins);
  if (!map) return false;
  residuals_ = pin_residuals(*map, pins);
  if (!pins.empty() && !all_exact(residuals_)) return false;
  places_ = places_of(*map, target_);
  return true;
}

/// A map of a level by itself, with these pins as far as they can be reached.
std::optional<SphereMap> CoarseToFine::embedded(size_t level, const std::vector<Pin>& pins) const {
  const TriangleMesh mesh = triangle_mesh(hierarchy_[level]);
  const Topology topology(mesh, options_.threads);
  if (face_folded_by(topology, pins)) return std::nullopt;
  return embed_progressively(mesh, topology,
                             {.quality = Quality::Draft,
                              .pins = pins,
                              .threads = options_.threads,
                              .progress = options_.progress})
      .map;
}

std::vector<char> CoarseToFine::held_on(size_t level) const {
  std::vector<char> held(at(hierarchy_[level].vertex_count()), 0);
  if (released_) return held;
  for (const Vertex v : names_[level])
    if (v >= 0) held[at(v)] = 1;
  return held;
}

void CoarseToFine::settle(size_t level, int most_steps) {
  const TriangleMesh mesh = triangle_mesh(hierarchy_[level]);
  const Topology topology(mesh, options_.threads);
  const RestTriangles rest = rest_of(mesh, options_.threads);
  MovingSurface surface(topology, rest, target_, held_on(level), std::move(places_),
                        feature_term(features(), names_on_finest(hierarchy_, level), mesh, rest));
  energy_ = lower(surface, most_steps, options_);
  newton_level_ = hierarchy_[level].vertex_count();
  places_ = surface.places();
}

/// The places on a finer level; false: rounding left no room in some ring.
bool CoarseToFine::insert(size_t l, std::vector<Place>& places) const {
  const HierarchyLevel &level = hierarchy_[l], &coarser = hierarchy_[l + 1];
  places.resize(at(level.vertex_count()));
  for (Vertex v = 0; v < coarser.vertex_count(); ++v)
    places[at(coarser.finer[at(v)])] = places_[at(v)];
  for (const Vertex v : level.removed) {
    std::vector<Vector3> ring;
    for (int i = 0; i < level.valence(v); ++i)
      ring.push_back(places[at(level.ring_begin(v)[i])].direction);
    const std::optional<Vector3> direction = place_in_kernel(ring);
    if (!direction) return false;
    places[at(v)] = target_.place(*direction);
  }
  return true;
}

bool CoarseToFine::climb_to(size_t l) {
  const HierarchyLevel& level = hierarchy_[l];
  std::vector<Place> places;
  if (!insert(l, places)) return false;
  const TriangleMesh mesh = triangle_mesh(level);
  const Topology topology(mesh, options_.threads);
  const RestTriangles rest = rest_of(mesh, options_.threads);
  MovingSurface surface(topology, rest, target_, held_on(l), std::move(places),
                        feature_term(features(), names_on_finest(hierarchy_, l), mesh, rest));
  parallel_for(std::ssize(level.removed), insertion_grain, options_.threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto i = first; i < last; ++i)
                   put_into_ring(surface, level, level.removed[static_cast<size_t>(i)],
                                 options_.energy);
               });
  const bool fine = level.vertex_count() >= fine_level;
  for (int i = 0; i < (fine ? fine_sweeps : removed_sweeps); ++i)
    surface.sweep(level.removed, options_.energy, options_.threads);
  for (int i = 0; i < (fine ? fine_sweeps : level_sweeps); ++i)
    surface.sweep(options_.energy, options_.threads);
  if (l == 0 || level.vertex_count() >= growth * newton_level_) {
    energy_ = lower(surface, fine ? fine_steps : steps, options_);
    newton_level_ = level.vertex_count();
  }
  places_ = surface.places();
  return true;
}

SphereMap improve_composition(const TriangleMesh& source, const Topology& topology,
                              const TargetSurface& target, const SphereMap& map,
                              const ComposedOptions& options, int most_steps) {
  const RestTriangles rest = measure_source(source, options.threads);
  MovingSurface surface(
      topology, rest, target,
      held_among(topology.vertex_count(), options.release ? std::vector<Pin>{} : options.landmarks),
      places_of(map, target),
      feature_term(options.features, all_names(topology.vertex_count()), source, rest));
  if (!std::isfinite(surface.energy(options.energy, surface.places(), options.threads))) return map;
  lower(surface, most_steps, options);
  return map_of(surface.places());
}

double energy_of_composition(const TriangleMesh& source, const Topology& topology,
                             const TargetSurface& target, const SphereMap& map,
                             const ComposedEnergy& energy, int threads) {
  const RestTriangles rest = measure_source(source, threads);
  const MovingSurface surface(topology, rest, target, held_among(topology.vertex_count(), {}),
                              places_of(map, target));
  return surface.energy(energy, surface.places(), threads) / (4 * std::numbers::pi);
}

}  // namespace sphparam
