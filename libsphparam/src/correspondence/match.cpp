#include "sphparam/correspondence/match.h"

#include <algorithm>
#include <numbers>
#include <set>
#include <utility>

#include "correspondence/coarse_to_fine.h"
#include "correspondence/feature_match.h"
#include "correspondence/landmark_search.h"
#include "correspondence/landmark_sides.h"
#include "correspondence/matchable.h"
#include "correspondence/near_places.h"
#include "correspondence/own_map.h"
#include "correspondence/turned_starts.h"
#include "embedding/energy/energy_domain.h"
#include "number_text.h"
#include "option_domain.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/version.h"

// Two starts. The map that `from` has, turned so that the landmarks fit, where they fit all but
// exactly; else from coarse to fine, landmarks first. Where landmarks are searched for, both are
// made, of surfaces that lie alike in space also one from where they are nearest, and the one of
// least energy goes on. Features have a way of their own.

namespace sphparam {
namespace {

constexpr int all_starts = 3;                // of coarse levels, to take the best
constexpr double collapsed = 0.01;           // of its share of the area: a triangle that is lost
constexpr double telling_area = 1e-3;        // share of the surface that is lost: worth a word
constexpr double telling_confidence = 0.15;  // less is worth a word
constexpr double telling_excess = 0.05;      // of a turn's energy, of isometry's, where lengths are
                                             // off by some 15 %: more is worth a word
constexpr double telling_parting = 0.02;     // less correlation of places by features: so, too
constexpr double opposed_agreement = -0.2;   // correlation of a feature: worth a word,
constexpr double telling_opposition = 0.1;   // as is so much more with the opposite sign

void require_landmarks(const MatchOptions& options, const MappedMesh& from, const MappedMesh& to) {
  if (options.search && !options.landmarks.empty())
    throw std::invalid_argument("landmarks: given, and to be searched for");
  if (options.search && options.features)
    throw std::invalid_argument("search: landmarks are searched for without features only");
  std::set<Vertex> firsts, seconds;
  for (const LandmarkPair& pair : options.landmarks) {
    require_vertex("landmarks: from", pair.from, from.mesh().vertex_count());
    require_vertex("landmarks: to", pair.to, to.mesh().vertex_count());
    if (!firsts.insert(pair.from).second || !seconds.insert(pair.to).second)
      throw std::invalid_argument("landmarks: a vertex is in two pairs");
  }
}

void require_features(const MatchFeatures& features, const MappedMesh& from, const MappedMesh& to) {
  require_more_than("features: weight", features.weight, 0);
  const auto columns = features.from.cols();
  if (columns == 0 || features.to.cols() != columns)
    throw std::invalid_argument("features: as many columns are needed of both, at least one");
  if (features.from.rows() != from.mesh().vertex_count() ||
      features.to.rows() != to.mesh().vertex_count())
    throw std::invalid_argument("features: a row a vertex is needed");
  for (const auto& [side, name] :
       {std::pair(&features.from, from.name()), {&features.to, to.name()}})
    for (Eigen::Index c = 0; c < columns; ++c)
      if (!varies(side->col(c)))
        throw std::invalid_argument("features: column " + std::to_string(c + 1) + " of " + name +
                                    " is the same everywhere");
}

std::vector<Pin> pins_of(const std::vector<LandmarkPair>& landmarks, const MappedMesh& to) {
  std::vector<Pin> pins;
  for (const LandmarkPair& pair : landmarks) pins.push_back({pair.from, to.map().point(pair.to)});
  return pins;
}

ComposedOptions composed_options(const MatchOptions& options, const MappedMesh& to) {
  ComposedEnergy energy;
  energy.energy.kind = options.energy.kind;
  energy.energy.lambda = options.energy.lambda;
  return {.energy = energy,
          .landmarks = pins_of(options.landmarks, to),
          .threads = options.threads,
          .progress = options.progress};
}

std::string words_of(const std::vector<double>& residuals) {
  if (residuals.empty()) return "they fold a triangle";
  const double worst = *std::ranges::max_element(residuals);
  return "the worst stays " + short_number(worst * 180 / std::numbers::pi) + "° from its partner";
}

/// Parts of one surface that hardly have a place on the other.
std::optional<std::string> collapse_of(const SurfaceMap& map, int threads) {
  const Distortion distortion = measure_distortion(map, threads);
  const double lost =
      (distortion.area_ratio.array() < collapsed).select(distortion.source_area.array(), 0.0).sum();
  if (lost < telling_area) return std::nullopt;
  return short_number(100 * lost) + " % of the area of " + map.from().name() +
         " shrinks to less than 1/100 on " + map.to().name() +
         ": landmarks at the ends of what sticks out there may help";
}

/// A feature that is known of more of one surface than of the other.
std::optional<std::string> one_sided_line(const MatchFeatures& features, const MappedMesh& from,
                                          const MappedMesh& to) {
  const std::optional<OneSidedFeature> found = one_sided_feature(features, from, to);
  if (!found) return std::nullopt;
  return "feature " + std::to_string(found->column + 1) + " is known on " + percent(found->here) +
         " of " + from.name() + " and on " + percent(found->there) + " of " + to.name() +
         ": it is compared where both are known, as far as that can be told: look at the result";
}

/// Features whose signs mean the opposite on the two sides.
std::optional<std::string> opposed_signs(const FeatureMatch& found) {
  const std::string advice =
      ": signs of curvature and depth differ between programs (positive in sulci by FreeSurfer, "
      "negative by Connectome Workbench and the HCP); change them on one side";
  for (Eigen::Index c = 0; c < found.begun_with.size(); ++c)
    if (found.begun_with[c] < opposed_agreement)
      return "feature " + std::to_string(c + 1) + " agrees with the opposite sign (correlation " +
             short_number(found.begun_with[c]) + ")" + advice;
  if (found.better_opposed > telling_opposition)
    return "after another turn the features agree better with the opposite sign (correlation "
           "greater by " +
           short_number(found.better_opposed) + ")" + advice;
  return std::nullopt;
}

/// Features that lead away from where surfaces that lie alike are by the mere turn.
std::optional<std::string> parted_places(const FeatureMatch& found) {
  if (!found.places_begun_with ||
      found.place_agreement > *found.places_begun_with - telling_parting)
    return std::nullopt;
  return "the features pulled apart what lies alike in space: places correlate by " +
         short_number(found.place_agreement) + ", and by " +
         short_number(*found.places_begun_with) +
         " after the turn that all began with: a smaller --feature-weight, other features or none "
         "may do better";
}

/// One match on its way.
class Matcher {
 public:
  Matcher(const MappedMesh& from, const MappedMesh& to, const MatchOptions& options)
      : from_(from),
        to_(to),
        options_(options),
        target_(to),
        composed_(composed_options(options, to)) {}

  Match run() {
    if (options_.features) return finished(by_features());
    const std::optional<SphereMap> own = fitting_map(from_, composed_.landmarks);
    if (options_.search) return finished(best_start(*own));
    return finished(own ? improved(*own) : coarse_to_fine());
  }

 private:
  struct Start {
    SphereMap map;
    std::string made_by;
    double energy = 0;
  };

  /// From coarse to fine. Throws: UnreachableLandmarks; MirroredLandmarks.
  SphereMap coarse_to_fine() {
    CoarseToFine way(from_.mesh(), from_.topology(), target_, composed_);
    const std::optional<double> energy = way.start(all_starts);
    warn(sphparam::suspicion_of_sides(from_, target_, composed_, energy));
    SphereMap map = energy ? way.finish() : SphereMap{};
    if (map.points.rows() > 0) return map;
    throw unreachable(way.residuals());
  }

  /// What is minimised differs from the plain energy by its ε and its barrier: an isometry is to
  /// stay one.
  SphereMap improved(const SphereMap& own) {
    made_by_ = "own map";
    SphereMap map = improve_composition(from_.mesh(), from_.topology(), target_, own, composed_);
    const DistortionEnergy plain{options_.energy.kind, options_.energy.lambda};
    return energy_of(own, plain) < energy_of(map, plain) ? own : std::move(map);
  }

  /// The start of least energy: from ends or a turn, from the map that `from` has, and, of surfaces
  /// that lie alike, from where they are nearest.
  SphereMap best_start(const SphereMap& own) {
    const size_t told = warnings_.size();
    SphereMap map = searched();
    const Start found = judged(std::move(map), made_by_);
    Start best = found;
    if (std::optional<SphereMap> near = by_nearness()) {
      Start start = judged(*std::move(near), "places");
      if (start.energy < best.energy) best = std::move(start);
    }
    Start start = judged(own, "own map");
    if (!(best.energy < start.energy)) best = std::move(start);
    if (best.made_by != found.made_by && leads_elsewhere(best.map, found.map))
      forget_search(best, found, told);
    made_by_ = best.made_by;
    tell_confidence(confidence_, other_);
    if (found.made_by == "turn" && made_by_ != "places") tell_turn(best.energy, why_turned_);
    return made_by_ == "own map" ? improved(own) : std::move(best.map);
  }

  std::optional<SphereMap> by_nearness() const {
    if (!options_.alike) return std::nullopt;
    const NearPlaces near = near_places(from_, to_, options_.threads);
    if (!is_there(near, diagonal_of(to_.mesh().positions))) return std::nullopt;
    return anchored_map(from_, target_, near, composed_);
  }

  /// Throws: UnreachableLandmarks; MirroredLandmarks.
  SphereMap by_features() {
    made_by_ = "features";
    warn(one_sided_line(*options_.features, from_, to_));
    if (!composed_.landmarks.empty()) warn(suspicion_of_sides());
    FeatureMatch found =
        match_by_features(from_, to_, target_, composed_, *options_.features, options_.alike);
    if (!found.map) throw unreachable(found.residuals);
    agreement_ = found.agreement;
    place_agreement_ = found.place_agreement;
    warn(parted_places(found));
    warn(opposed_signs(found));
    tell_confidence(found.confidence, options_.alike ? "places in space agree after another turn"
                                                     : "the features agree after another turn");
    return std::move(*found.map);
  }

  std::optional<std::string> suspicion_of_sides() const {
    return sphparam::suspicion_of_sides(
        from_, target_, composed_,
        CoarseToFine(from_.mesh(), from_.topology(), target_, composed_).start(1));
  }

  UnreachableLandmarks unreachable(const std::vector<double>& residuals) const {
    return UnreachableLandmarks("no map of " + from_.name() +
                                " with these landmarks was found: " + words_of(residuals));
  }

  /// From ends that are paired, or, where there are none that a map reaches, from a turn.
  SphereMap searched() {
    suggestions_ = suggest_landmarks(from_, to_, target_, composed_, options_.alike);
    if (suggestions_.empty()) return by_turn("neither has three ends");
    composed_.landmarks = pins_of(suggestions_.front().landmarks, to_);
    composed_.release = true;
    try {
      SphereMap map = coarse_to_fine();
      confidence_ = confidence_of(suggestions_);
      other_ = "another pairing of the surfaces' ends fits";
      return map;
    } catch (const UnreachableLandmarks&) {  // nobody gave them
      suggestions_.clear();
      composed_.landmarks.clear();
      return by_turn("no map has the ends that were paired");
    }
  }

  SphereMap by_turn(const std::string& why) {
    made_by_ = "turn";
    TurnedMatch found = match_by_turn(from_, to_, target_, composed_, options_.alike);
    confidence_ = found.confidence;
    other_ = why + ", and their maps fit after another turn";
    why_turned_ = why;
    return std::move(found.map);
  }

  Start judged(SphereMap map, std::string made_by) const {
    const double energy = energy_of(map, composed_.energy.energy);
    return {std::move(map), std::move(made_by), energy};
  }

  /// Nothing that was said of what was found is so of a start that leads elsewhere.
  void forget_search(const Start& taken, const Start& found, size_t warnings_before) {
    const double isometric = isometric_energy();
    warnings_.resize(warnings_before);
    suggestions_.clear();
    confidence_ = confidence_by_excess(taken.energy - isometric, found.energy - isometric);
    other_ = found.made_by == "turn" ? "their maps fit after another turn"
                                     : "a pairing of the surfaces' ends fits";
  }

  double isometric_energy() const { return differentiate(composed_.energy.energy, 1, 1).f; }

  /// A turn is compared with turns alone: that another map fits far better is not looked for, and
  /// is the likelier the less this one is an isometry.
  void tell_turn(double energy, const std::string& why) {
    const double isometric = isometric_energy();
    const double excess = energy / isometric - 1;
    if (!(excess > telling_excess)) return;
    confidence_ = std::min(confidence_, telling_excess / excess);
    warn("nothing but a turn of the maps was found (" + why + "), and it distorts (energy " +
         short_number(energy) + ", of an isometry " + short_number(isometric) +
         "): what is coiled or bent otherwise needs landmarks, three places or more that both "
         "have: `sphparam match --landmarks`");
  }

  void tell_confidence(double confidence, const std::string& other) {
    confidence_ = confidence;
    if (confidence_ >= telling_confidence) return;
    warn(other + " about as well (confidence " + short_number(confidence_) +
         "): look at the result, " +
         (options_.alike ? "" : "say --alike if both lie alike in space, ") +
         "or give --landmarks");
  }

  Match finished(SphereMap map) {
    const double energy = energy_of(map, composed_.energy.energy);
    MappedMesh moved = from_.with_map(std::move(map), {{"version", version},
                                                       {"method", "match"},
                                                       {"stage", made_by_},
                                                       {"verdict", "one-to-one"}});
    std::vector<double> residuals =
        options_.search ? std::vector<double>{} : pin_residuals(moved.map(), composed_.landmarks);
    SurfaceMap both(std::move(moved), to_);
    warn(collapse_of(both, options_.threads));
    warn(collapse_of(both.inverse(), options_.threads));
    return {std::move(both),         energy,      made_by_,   std::move(residuals),
            std::move(suggestions_), confidence_, agreement_, place_agreement_,
            std::move(warnings_)};
  }

  double energy_of(const SphereMap& map, const DistortionEnergy& density) const {
    return energy_of_composition(from_.mesh(), from_.topology(), target_, map, {density, 0},
                                 options_.threads);
  }

  void warn(std::optional<std::string> warning) {
    if (warning) warnings_.push_back(std::move(*warning));
  }

  const MappedMesh &from_, &to_;
  const MatchOptions& options_;
  TargetSurface target_;
  ComposedOptions composed_;
  std::string made_by_ = "coarse to fine";
  std::vector<SuggestedLandmarks> suggestions_;
  double confidence_ = 1;  // in the first of them
  std::string other_;      // that fits about as well where there is little
  std::string why_turned_;
  double agreement_ = 0;        // of features, …
  double place_agreement_ = 0;  // … and of places beside them
  std::vector<std::string> warnings_;
};

}  // namespace

Match match_surfaces(const MappedMesh& from, const MappedMesh& to, const MatchOptions& options) {
  require_domain(options.energy);
  require_landmarks(options, from, to);
  require_area(from);
  require_area(to);
  if (options.features) require_features(*options.features, from, to);
  const std::optional<std::string> facing = opposite_facing(from, to);
  try {
    Match match = Matcher(from, to, options).run();
    if (facing) match.warnings.insert(match.warnings.begin(), *facing);
    return match;
  } catch (const MirroredLandmarks& error) {
    if (!facing) throw;
    throw MirroredLandmarks(error.what() + ("; " + *facing));
  }
}

}  // namespace sphparam
