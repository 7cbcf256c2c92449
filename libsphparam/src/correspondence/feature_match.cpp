#include "correspondence/feature_match.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "correspondence/bounded_curvature.h"
#include "correspondence/surface_area.h"
#include "correspondence/turned_starts.h"
#include "embedding/frame/nearest_rotation.h"
#include "sphparam/correspondence/map_alignment.h"

// Flat triangles of a coarse level say nothing of a cortex, whose folds they cut across; both maps
// to the sphere distort little, so between the spheres is a good first place. There, features are
// looked at from afar first; steps between the folded surfaces come last.

namespace sphparam {
namespace {

constexpr int most_turns = 4, most_shape_turns = 8;
constexpr int last_steps = 6;  // of Newton, at most, between the surfaces
constexpr int starts = 3;      // with landmarks

TriangleMesh sphere_of(const MappedMesh& mapped) {
  const TriangleMesh& mesh = mapped.mesh();
  return {scaled_to_sphere({mapped.map().points, mesh.triangles}), mesh.triangles};
}

struct FeatureTurns {
  std::vector<TurnOfFunctions> turns;
  double opposed;  // correlation after the best turn with one side's sign changed
};

FeatureTurns turns_by_features(const MappedMesh& from, const MappedMesh& to,
                               const FeatureField& field, int threads) {
  const MapSignalOptions options{.threads = threads};
  const Functions here = map_signals(from, field.from, options);
  const Functions there = map_signals(to, field.to, options);
  return {turns_by_correlation(here, there, most_turns, threads),
          turns_by_correlation(-here, there, 1, threads).front().correlation};
}

/// None where curvature or area is the same everywhere: no turn is better than another.
std::vector<TurnOfFunctions> turns_by_shape(const MappedMesh& from, const MappedMesh& to,
                                            int threads) try {
  return align_maps(from, to, most_shape_turns, {.threads = threads});
} catch (const std::invalid_argument&) {
  return {{Eigen::Matrix3d::Identity(), 0}};
}

std::vector<TurnOfFunctions> turns_by_stance(const MappedMesh& from, const MappedMesh& to,
                                             int threads) {
  const MapSignalOptions options{.threads = threads};
  return turns_by_correlation(map_signals(from, stance_of(from.mesh()), options),
                              map_signals(to, stance_of(to.mesh()), options), most_turns, threads);
}

/// 0 where the second turn is as good as the first, towards 1 where it is nowhere near.
double confidence_in(const std::vector<TurnOfFunctions>& turns) {
  if (turns.size() < 2) return 1;
  const double left_by_second = 1 - turns[1].correlation;
  return left_by_second > 0 ? std::clamp(1 - (1 - turns[0].correlation) / left_by_second, 0.0, 1.0)
                            : 0;
}

/// Starts after the first of turns by which places in space agree; returns the confidence in it.
double start_alike(CoarseToFine& way, const SphereMap& map,
                   const std::vector<TurnOfFunctions>& turns) {
  way.start_at(turned(map, turns.front().rotation));
  return confidence_in(turns);
}

TriangleMesh unit_surface(const MappedMesh& mapped) {
  return {scaled_to_sphere(mapped.mesh()), mapped.mesh().triangles};
}

/// Correlation of each feature by a map.
VectorX agreement_of(const MappedMesh& from, const TargetSurface& target, const FeatureField& field,
                     const SphereMap& map) {
  Functions there = Functions::Zero(field.from.rows(), field.from.cols());
  for (Vertex v = 0; v < there.rows(); ++v) {
    const Place place = target.place(map.point(v));
    for (int k = 0; k < 3; ++k)
      there.row(v) += place.at.barycentric[k] * field.to.row(target.corner(place, k));
  }
  const VectorX area = areas_round_vertices(from.mesh());
  VectorX agreement(there.cols());
  for (Eigen::Index c = 0; c < there.cols(); ++c)
    agreement[c] = correlation_of(field.from.col(c), there.col(c), area);
  return agreement;
}

}  // namespace

FeatureMatch match_by_features(const MappedMesh& from, const MappedMesh& to,
                               const TargetSurface& target, const ComposedOptions& options,
                               const MatchFeatures& features, bool alike) {
  const TriangleMesh from_sphere = sphere_of(from), to_sphere = sphere_of(to);
  const FeatureScales scales(from_sphere, from.topology(), to_sphere, to.topology(), features);
  const FeatureField field = scales.raw();
  ComposedOptions with_features = options;
  with_features.features = &scales;

  // 1. A coarse level.
  const TargetSurface sphere(to, to_sphere.positions);
  CoarseToFine way(from_sphere, from.topology(), sphere, with_features);
  FeatureMatch result;
  const auto after_turn = [&](const std::vector<TurnOfFunctions>& turns) {
    return agreement_of(from, target, field, turned(from.map(), turns.front().rotation));
  };
  if (!options.landmarks.empty()) {
    if (!way.start(starts)) return {std::nullopt, way.residuals()};
  } else if (alike) {
    const std::vector<TurnOfFunctions> turns = turns_by_stance(from, to, options.threads);
    result.begun_with = after_turn(turns);
    result.confidence = start_alike(way, from.map(), turns);
  } else {
    const auto [turns, opposed] = turns_by_features(from, to, field, options.threads);
    result.begun_with = after_turn(turns);
    result.better_opposed = opposed - turns.front().correlation;
    result.confidence = start_at_best(way, from.map(), turns, options.energy);
  }

  // 2. Up to the whole sphere, then between the surfaces.
  SphereMap map = way.finish();
  if (map.points.rows() == 0) return {std::nullopt, way.residuals()};
  result.map =
      improve_composition(from.mesh(), from.topology(), target, map, with_features, last_steps);
  const VectorX agreement = agreement_of(from, target, field, *result.map);
  result.agreement = agreement.mean();
  if (!options.landmarks.empty()) result.begun_with = agreement;
  return result;
}

TurnedMatch match_by_turn(const MappedMesh& from, const MappedMesh& to, const TargetSurface& target,
                          const ComposedOptions& options, bool alike) {
  const TriangleMesh from_unit = unit_surface(from), to_unit = unit_surface(to);
  const FeatureScales bends(
      from_unit, from.topology(), to_unit, to.topology(),
      {bounded_curvature(from, options.threads), bounded_curvature(to, options.threads)});
  ComposedOptions first = options;
  first.features = &bends;
  first.release = true;
  CoarseToFine way(from.mesh(), from.topology(), target, first);
  const double confidence =
      alike ? start_alike(way, from.map(), turns_by_stance(from, to, options.threads))
            : start_at_best(way, from.map(), turns_by_shape(from, to, options.threads),
                            options.energy);
  SphereMap map = way.finish();
  return {map.points.rows() > 0 ? std::move(map) : from.map(), confidence};
}

}  // namespace sphparam
