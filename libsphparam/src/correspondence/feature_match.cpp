#include "correspondence/feature_match.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <stdexcept>
#include <utility>

#include "correspondence/bounded_curvature.h"
#include "correspondence/stance.h"
#include "correspondence/turned_starts.h"
#include "embedding/frame/nearest_rotation.h"
#include "sphparam/correspondence/map_alignment.h"
#include "sphparam/mesh/vertex_areas.h"

// Flat triangles of a coarse level say nothing of a cortex, whose folds they cut across; both maps
// to the sphere distort little, so between the spheres is a good first place. There, features are
// looked at from afar first; steps between the folded surfaces come last.

namespace sphparam {
namespace {

constexpr int most_turns = 4, most_shape_turns = 8, most_shared_turns = 8;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr int last_steps = 6;            // of Newton, at most, between the surfaces
constexpr int starts = 3;                // with landmarks
constexpr size_t telling_landmarks = 2;  // fewer tell no turn

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

/// What is known of features; `values`: these, centred and cut.
PartlyKnown known_part(const MappedMesh& mapped, const Functions& features, const Functions& values,
                       int threads) {
  const MapSignalOptions options{.threads = threads};
  const Functions known = features.array().isFinite().cast<double>();
  const Functions there = values.cwiseProduct(known);
  return {map_signals(mapped, known, options), map_signals(mapped, there, options),
          map_signals(mapped, there.cwiseAbs2(), options)};
}

/// By what both know after the turn; perhaps none.
FeatureTurns turns_by_shared_features(const MappedMesh& from, const MappedMesh& to,
                                      const MatchFeatures& features, const FeatureField& field,
                                      int threads) {
  PartlyKnown here = known_part(from, features.from, field.from, threads);
  const PartlyKnown there = known_part(to, features.to, field.to, threads);
  FeatureTurns result{turns_by_shared_correlation(here, there, most_shared_turns, threads), -1};
  here.values *= -1;
  const auto opposed = turns_by_shared_correlation(here, there, 1, threads);
  if (!opposed.empty()) result.opposed = opposed.front().correlation;
  return result;
}

/// Values where the others are known, too, at the corners of the face that a direction is in.
void leave_out_unknown(Functions& values, const Points& directions, const Functions& others,
                       const MappedMesh& other) {
  for (Vertex v = 0; v < values.rows(); ++v) {
    const Face face = other.locator().locate(directions.row(v)).face;
    for (int k = 0; k < 3; ++k)
      for (Eigen::Index c = 0; c < values.cols(); ++c)
        if (!std::isfinite(others(other.topology().vertex(face, k), c))) values(v, c) = nothing;
  }
}

/// Features as they are compared after turns of the map of `from`: each where both sides know it.
class SharedFeatures {
 public:
  /// Borrows all.
  SharedFeatures(const MappedMesh& from, const MappedMesh& to, const TriangleMesh& from_sphere,
                 const TriangleMesh& to_sphere, const MatchFeatures& features)
      : from_(from),
        to_(to),
        from_sphere_(from_sphere),
        to_sphere_(to_sphere),
        features_(features) {}

  /// They stay. Where nothing is shared that varies, features are compared as they are.
  const FeatureScales& after(const Eigen::Matrix3d& rotation) {
    for (const auto& [before, scales] : made_)
      if (before == rotation) return scales;
    MatchFeatures shared = features_;
    leave_out_unknown(shared.from, from_.map().points * rotation.transpose(), features_.to, to_);
    leave_out_unknown(shared.to, to_.map().points * rotation, features_.from, from_);
    bool vary = true;
    for (Eigen::Index c = 0; c < shared.from.cols(); ++c)
      vary = vary && varies(shared.from.col(c)) && varies(shared.to.col(c));
    made_.emplace_back(rotation, FeatureScales(from_sphere_, from_.topology(), to_sphere_,
                                               to_.topology(), vary ? shared : features_));
    return made_.back().second;
  }

 private:
  const MappedMesh &from_, &to_;
  const TriangleMesh &from_sphere_, &to_sphere_;
  const MatchFeatures& features_;
  std::list<std::pair<Eigen::Matrix3d, FeatureScales>> made_;
};

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

/// Correlation of each column by a map.
VectorX agreement_of(const MappedMesh& from, const TargetSurface& target, const Functions& here,
                     const Functions& values, const SphereMap& map) {
  Functions there = Functions::Zero(here.rows(), here.cols());
  for (Vertex v = 0; v < there.rows(); ++v) {
    const Place place = target.place(map.point(v));
    for (int k = 0; k < 3; ++k)
      there.row(v) += place.at.barycentric[k] * values.row(target.corner(place, k));
  }
  const VectorX area = vertex_areas(from.surface());
  VectorX agreement(there.cols());
  for (Eigen::Index c = 0; c < there.cols(); ++c)
    agreement[c] = correlation_of(here.col(c), there.col(c), area);
  return agreement;
}

ComposedOptions with_features(ComposedOptions options, const FeatureScales& features) {
  options.features = &features;
  return options;
}

/// A match by features, and what it is made with.
class FeatureMatching {
 public:
  /// Borrows all.
  FeatureMatching(const MappedMesh& from, const MappedMesh& to, const TargetSurface& target,
                  const ComposedOptions& options, const MatchFeatures& features)
      : from_(from),
        to_(to),
        target_(target),
        features_(features),
        from_sphere_(sphere_of(from)),
        to_sphere_(sphere_of(to)),
        scales_(from_sphere_, from.topology(), to_sphere_, to.topology(), features),
        shared_(from, to, from_sphere_, to_sphere_, features),
        one_sided_(one_sided_feature(features, from, to).has_value()),
        options_(with_features(options, scales_)),
        on_sphere_(to, to_sphere_.positions),
        way_(from_sphere_, from.topology(), on_sphere_, options_) {}

  FeatureMatch run(bool alike) {
    // 1. A coarse level.
    const bool by_landmarks = !options_.landmarks.empty();
    if (by_landmarks) {
      if (!start_at_landmarks()) return {std::nullopt, way_.residuals()};
    } else if (alike) {
      start_by_stance();
    } else {
      start_by_features();
    }
    // 2. Up to the whole sphere, then between the surfaces.
    const SphereMap map = way_.finish();
    if (map.points.rows() == 0) return {std::nullopt, way_.residuals()};
    result_.map =
        improve_composition(from_.mesh(), from_.topology(), target_, map, options_, last_steps);
    const VectorX agreement = agreement_by(*result_.map);
    result_.agreement = agreement.mean();
    if (alike) result_.place_agreement = place_agreement_by(*result_.map);
    if (by_landmarks) result_.begun_with = agreement;
    return std::move(result_);
  }

 private:
  /// Features as they are compared after this turn of the map of `from`.
  void prepare(const Eigen::Matrix3d& rotation) {
    if (one_sided_) options_.features = &shared_.after(rotation);
  }

  VectorX agreement_by(const SphereMap& map) const {
    const FeatureField& field = options_.features->raw();
    return agreement_of(from_, target_, field.from, field.to, map);
  }

  /// Correlation of places in space, the mean over axes.
  double place_agreement_by(const SphereMap& map) const {
    return agreement_of(from_, target_, stance_of(from_.mesh()), stance_of(to_.mesh()), map).mean();
  }

  VectorX agreement_after(const Eigen::Matrix3d& rotation) {
    prepare(rotation);
    return agreement_by(turned(from_.map(), rotation));
  }

  /// False: these cannot be reached.
  bool start_at_landmarks() {
    if (options_.landmarks.size() >= telling_landmarks)
      prepare(best_rotation(from_.map(), options_.landmarks));
    return way_.start(starts).has_value();
  }

  void start_by_stance() {
    const std::vector<TurnOfFunctions> turns = turns_by_stance(from_, to_, options_.threads);
    result_.begun_with = agreement_after(turns.front().rotation);
    result_.places_begun_with = place_agreement_by(turned(from_.map(), turns.front().rotation));
    result_.confidence = start_alike(way_, from_.map(), turns);
  }

  FeatureTurns turns() const {
    if (one_sided_) {
      FeatureTurns found =
          turns_by_shared_features(from_, to_, features_, scales_.raw(), options_.threads);
      if (!found.turns.empty()) return found;
    }
    return turns_by_features(from_, to_, scales_.raw(), options_.threads);
  }

  void start_by_features() {
    const FeatureTurns found = turns();
    result_.begun_with = agreement_after(found.turns.front().rotation);
    result_.better_opposed = found.opposed - found.turns.front().correlation;
    result_.confidence =
        start_at_best(way_, from_.map(), found.turns, options_.energy,
                      [this](const Eigen::Matrix3d& rotation) { prepare(rotation); });
  }

  const MappedMesh &from_, &to_;
  const TargetSurface& target_;
  const MatchFeatures& features_;
  const TriangleMesh from_sphere_, to_sphere_;
  const FeatureScales scales_;
  SharedFeatures shared_;
  const bool one_sided_;     // parts that both leave out tell the turn, too: they are the same
  ComposedOptions options_;  // with the features that are compared
  const TargetSurface on_sphere_;
  CoarseToFine way_;
  FeatureMatch result_;
};

}  // namespace

FeatureMatch match_by_features(const MappedMesh& from, const MappedMesh& to,
                               const TargetSurface& target, const ComposedOptions& options,
                               const MatchFeatures& features, bool alike) {
  return FeatureMatching(from, to, target, options, features).run(alike);
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
