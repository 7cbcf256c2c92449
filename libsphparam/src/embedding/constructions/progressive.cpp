#include "embedding/constructions/progressive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "elementary.h"
#include "embedding/constructions/kneading.h"
#include "embedding/constructions/level_embedding.h"
#include "embedding/constructions/rising_progress.h"
#include "embedding/constructions/slivers.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/energy/map_image.h"
#include "embedding/energy/rest_floors.h"
#include "embedding/frame/pin_domain.h"
#include "embedding/newton/freed_memory.h"
#include "embedding/newton/minimise.h"
#include "embedding/newton/newton_refinement.h"
#include "embedding/newton/optimise.h"
#include "embedding/sweeps/relaxation.h"

// One embedding from coarse to fine (level_embedding.cpp) does for most shapes. Where it finds no
// room areas weigh more; last, the shape is forgotten and everything equilateral.
// Limbs give the energy many minima: how a coarse level folds them stays. The nearly conformal
// energy has hardly more than one. A map of it, led from λ to λ, ends several per cent lower, and
// nearly alike from wherever it came. It costs an embedding more: maps of great energy are worth
// that, and of less where the best is wanted. Where a map ends far from its energy it is the other
// way round: maps in which areas weigh more lead to the lower minima.
// Among slivers no way leads far: each that is about to fold stops all that moves. Where they are
// in the way, all of the above is done as if they were fatter, and the map of that is led to what
// they are (slivers.cpp). The best of many minima is looked for there, too.
// Around pins all starts have their way to find, and may fold what no pin asks for. A map without
// pins has found its own: where one is known, the pins are led from where it has them.
// Limbs that are long have more minima than starts find: the lowest map is kneaded (kneading.cpp),
// as long as that lowers it.
// Steps that stop with much left even so go on in the end as the best's do: of the lowest map
// alone, and no longer than a budget lasts.

namespace sphparam {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int shape_sweeps = 30;  // of relaxation, where the embedding knew nothing of the shape
// Tried in turn when vertices found no room at the λ asked for.
constexpr double roomier_lambdas[] = {10, 100, 1000};
// Of moves of pins from where the free map has them: they cost every vertex a distance from each.
constexpr double most_free_map_rounds = 20, free_map_work = 5e7;
constexpr double alike = 1e-9;  // radians by which two maps miss their pins
constexpr int free_map_sweeps = 5;
constexpr double far_from_energy = 0.1;  // the share that steps to come would take
// Times an isometry's energy, before the finest level gets its steps: worth another start.
constexpr double much_energy = 2.75, much_for_best = 1.6;
constexpr double many_minima = 5;       // and here, at last, even nearly conformal starts differ
constexpr double clearly_lower = 0.95;  // than a map that has not had its steps
// Of λ: a map on its way up has at most λ to this power times the first map's energy. (Limbs have
// half of that, slivers twice as much: there angles are kept at the cost of areas that do not come
// back.)
constexpr double hopeless = -0.75;
// Of the progress: the first start where the best is wanted, and any other, of what is left.
constexpr double part_before_best = 0.3, part_of_start = 0.5;
constexpr double agreement = 5e-4;  // of two minima's energies: they are one
// Of the energy: with more left, or minima that far apart, steps go on, within a budget. A draft is
// not to take longer than a map by Normal, and slimmed maps have hardly more to gain.
constexpr double much_left = 5e-3, much_left_of_draft = 3e-2, far_apart = 1e-2;
constexpr Budget more_steps{2e6, 60, 1200}, more_for_draft{5e5, 20, 300};
constexpr Budget more_for_slimmed{1e5, 10, 60};

/// As long as it gains: rounds × vertices at most, where minima are some, and many.
struct KneadingLimits {
  double least_gain, work_on_some, work_on_many;
};
constexpr double some_minima = 3;  // times an isometry's energy: below, none is worth it
constexpr KneadingLimits kneading_of_draft{1e-2, 0, 2.5e4}, kneading_of_normal{1e-3, 1e4, 5e4},
    kneading_of_best{5e-4, 2e5, 2e5};
constexpr double least_kneaded = 0.1;  // λ: below, minima are few

const KneadingLimits& kneading_of(Quality quality) {
  if (quality == Quality::Best) return kneading_of_best;
  return quality == Quality::Draft ? kneading_of_draft : kneading_of_normal;
}

/// From λ to λ, a few steps at each.
struct Way {
  double factor, least_gain;
  int steps;
};
constexpr Way up{10, 1e-2, 10}, down{0.25, 1e-2, 6};
// Among slivers steps of the first map end after so many that were cut short; one of the first few
// tells of a map that has had none. Then the way of a fattened map, and steps at its end.
constexpr int blocked_in_a_row = 4, first_steps = 4;
constexpr double slimming_gain = 1e-3;
constexpr int slimming_steps = 80, steps_of_slim = 12;
constexpr double nearly_conformal = 1e-6, others_nearly_conformal[] = {1e-8, 1e-4};
constexpr double nearly_equal_area[] = {10, 100, 1000};

/// Embeds one mesh in several ways, and keeps the lowest map.
class Starts {
 public:
  Starts(const TriangleMesh& mesh, const Topology& topology, const ProgressiveOptions& options,
         const KeptVertices& keep)
      : mesh_(mesh),
        topology_(topology),
        options_(options),
        keep_(keep),
        wanted_(options.energy),
        rising_(options.progress),
        progress_(rising_.progress()) {
    rising_.begin(options.quality == Quality::Best ? part_before_best : 1);
  }
  Starts(const Starts&) = delete;
  Starts& operator=(const Starts&) = delete;

  ProgressiveEmbedding first() { return embed_with_room(wanted_); }

  /// No map: nothing found room. One with pressed fillers is the first, for the caller to settle.
  ProgressiveEmbedding lowest() {
    const bool best = options_.quality == Quality::Best;
    const double demanding = best ? much_for_best : much_energy;
    lowest_ = embed_with_room(wanted_, demanding, blocked_in_a_row);
    if (lowest_.report.pressure > 0) {
      rising_.end();
      return std::move(lowest_);
    }
    const bool sufficed = lowest_.map && lowest_.report.sweeps_sufficed;
    if (!sufficed && (!try_free_map() || best)) try_more(demanding);
    if (!lowest_.map) return std::move(lowest_);
    rising_.begin(part_of_start);
    if (best) refine(lowest_, steps(wanted_, Quality::Best));
    if (!sufficed && !slimmed_) knead_lowest();
    rising_.begin(1);
    if (!best) go_on();
    std::optional<double>& left = lowest_.report.energy_left;
    if (left) left = std::max(*left, apart_);
    rising_.end();
    return std::move(lowest_);
  }

  RefinementOptions steps(const DistortionEnergy& energy, Quality quality) const {
    return {.quality = quality,
            .energy = energy,
            .threads = options_.threads,
            .progress = progress_,
            .fatness = fatness_};
  }

  /// Steps towards the energy of a map that was found by another one; notes what they leave.
  void refine(ProgressiveEmbedding& embedding, const RefinementOptions& how) const {
    std::vector<ImagePoint> image = image_of(*embedding.map);
    NewtonRefinement refinement(topology_.vertex_count(), how);
    refinement.improve(mesh_, topology_, keep_.vertices, image);
    embedding.map = map_of(image);
    embedding.report.energy_left = refinement.energy_left();
    embedding.report.left_slivers = refinement.left_slivers();
    embedding.report.pressure = 0;  // steps know of none
  }

 private:
  enum class Found { Lower, Same, Higher };

  /// The best is made of what is lowest, at last.
  Quality made_quality() const { return std::min(options_.quality, Quality::Normal); }

  ProgressiveEmbedding embed(const DistortionEnergy& energy, Quality quality,
                             double demanding = infinity, int most_blocked = 0) const {
    ProgressiveOptions how = options_;
    how.energy = energy;
    how.quality = quality;
    how.progress = progress_;
    return embed_by_levels(mesh_, topology_, how, keep_, {demanding, fatness_, most_blocked});
  }

  /// By this energy, or else first with greater λ: weighing areas more keeps protrusions from
  /// shrinking to where doubles have no room left.
  ProgressiveEmbedding embed_with_room(const DistortionEnergy& energy, double demanding = infinity,
                                       int most_blocked = 0) const {
    ProgressiveEmbedding embedding = embed(energy, made_quality(), demanding, most_blocked);
    for (const double lambda : roomier_lambdas) {
      if (embedding.map) break;
      const int retries = embedding.report.retries;
      embedding = embed({.lambda = std::max(lambda, energy.lambda)}, Quality::Draft);
      embedding.report.retries += retries;
      if (embedding.map) refine(embedding, steps(energy, made_quality()));
    }
    return embedding;
  }

  /// The pins, led from where the free map has them; the rest stays folded as it is there. Is that
  /// as good as the lowest, or is now?
  bool try_free_map() {
    if (!options_.free_map || options_.pins.empty()) return false;
    rising_.begin(part_of_start);
    const double rounds = free_map_work / work_of_pins();
    const LandmarkPlacement placed =
        place_landmarks(topology_, source(), *options_.free_map, options_.pins,
                        {.energy = wanted_,
                         .sweeps = free_map_sweeps,
                         .most_rounds = static_cast<int>(std::min(rounds, most_free_map_rounds)),
                         .most_detours = 0,
                         .threads = options_.threads,
                         .progress = progress_});
    if (nearer_pins(placed.map) < 0) return false;
    ProgressiveEmbedding start{placed.map, {}};
    refine(start, steps(wanted_, made_quality()));
    if (lowest_.map) energy_ = energy_of(*lowest_.map);
    give_steps_unless(start);
    return keep_lower(std::move(start)) != Found::Higher;
  }

  /// Of a round that moves them.
  double work_of_pins() const {
    const auto pins = static_cast<double>(options_.pins.size());
    return pins * (topology_.vertex_count() + pins * pins);
  }

  /// Than by the lowest map, in radians of all pins together. Only exact ones are better than next
  /// to exact ones.
  double nearer_pins(const SphereMap& map) const {
    if (!lowest_.map) return infinity;
    const double before = missed_by(*lowest_.map), now = missed_by(map);
    const bool are_alike = before > 0 && now > 0 && std::abs(before - now) < alike;
    return are_alike ? 0 : before - now;
  }

  double missed_by(const SphereMap& map) const {
    const std::vector<double> residuals = pin_residuals(map, options_.pins);
    return std::accumulate(residuals.begin(), residuals.end(), 0.0);
  }

  /// Other starts, where sweeps did not suffice.
  void try_more(double demanding) {
    if (finds_slivers_in_the_way()) {
      ProgressiveEmbedding fat = embed_fattened(demanding);
      slimmed_ = fat.map && nearer_pins(*fat.map) >= 0 &&
                 (!lowest_.map || energy_of(*fat.map) < clearly_lower * energy_of(*lowest_.map));
      if (slimmed_) std::swap(lowest_, fat);
      if (slimmed_ || !lowest_.map) return;
      try_others();
      slimmed_ = keep_lower(std::move(fat)) == Found::Lower;
    } else if (lowest_.map) {
      try_others();
      if ((ended_early() || best_of_many()) && has_slivers(source()))
        slimmed_ = keep_lower(embed_fattened(demanding)) == Found::Lower;
    }
  }

  /// They stopped the lowest map's steps, or one of the first, which are made where it has had
  /// none; where there is no map, they may have left no room.
  bool finds_slivers_in_the_way() {
    if (!has_slivers(source())) return false;
    if (!lowest_.map) return true;
    if (!lowest_.report.demanding) return lowest_.report.left_slivers;
    RefinementOptions few = steps(wanted_, made_quality());
    few.finest_steps = first_steps;
    few.most_blocked = 1;
    refine(lowest_, few);
    lowest_.report.energy_left.reset();
    return lowest_.report.left_slivers;
  }

  /// With the slivers fat at first, and slimmed.
  ProgressiveEmbedding embed_fattened(double demanding) {
    ProgressiveEmbedding before = std::exchange(lowest_, {});
    const double apart = apart_;
    rising_.begin(part_of_start);
    fatness_ = fattening;
    lowest_ = embed_with_room(wanted_, demanding);
    if (lowest_.map && !lowest_.report.sweeps_sufficed) try_others();
    fatness_ = 0;
    apart_ = apart;  // as fat ones they were others
    ProgressiveEmbedding fat = std::exchange(lowest_, std::move(before));
    if (lowest_.map) energy_ = energy_of(*lowest_.map);
    if (!fat.map) return fat;
    rising_.begin(part_of_start);
    const OptimiseOptions slimming = step_of(wanted_, slimming_gain, slimming_steps);
    fat.map = slim_down(topology_, source(), *std::move(fat.map), slimming);
    RefinementOptions how = steps(wanted_, made_quality());
    how.finest_steps = steps_of_slim;
    refine(fat, how);
    fat.report.sweeps_sufficed = false;
    return fat;
  }

  OptimiseOptions step_of(const DistortionEnergy& energy, double least_gain, int steps) const {
    return {.energy = energy,
            .least_gain = least_gain,
            .max_steps = steps,
            .pinned = keep_.vertices,
            .threads = options_.threads,
            .progress = progress_};
  }

  void try_others() {
    energy_ = first_energy_ = energy_of(*lowest_.map);
    const bool best = options_.quality == Quality::Best;
    Found found = Found::Same;
    if (lowest_.report.demanding || (best && (is_much() || !lowest_.report.limbs)))
      found = try_nearly_conformal(nearly_conformal);
    if (!best && found == Found::Lower) compare_minima();
    for (const double lambda : others_nearly_conformal) {
      if (!best || found != Found::Lower) break;
      found = try_nearly_conformal(lambda);
      if (found == Found::Same) return;
    }
    const bool other_way = best && found == Found::Higher;
    for (const double more : nearly_equal_area) {
      if (!other_way && !is_far()) return;
      const double lambda = more * std::max(1.0, wanted_.lambda);
      rising_.begin(part_of_start);
      ProgressiveEmbedding start = embed_with_room({.lambda = lambda});
      lead(start, lambda, down);
      if (keep_lower(std::move(start)) == Found::Same) return;
    }
  }

  /// Of a map that does not wait for its steps.
  bool is_much() const { return energy_ > much_for_best * isometric_energy(source(), wanted_, {}); }

  bool has_many_minima() const {
    return energy_ > many_minima * isometric_energy(source(), wanted_, {});
  }

  bool best_of_many() const { return options_.quality == Quality::Best && has_many_minima(); }

  /// Where minima may be many, of how much energy may be left says also how far two are apart.
  void compare_minima() {
    if (!has_many_minima()) return;
    const double one = energy_;
    try_nearly_conformal(others_nearly_conformal[0]);
    if (latest_) apart_ = std::abs(*latest_ - one) / energy_;
  }

  /// By angles as long as that pays, and by areas, until neither does. What the last round gained
  /// may be left.
  void knead_lowest() {
    const KneadingLimits& how = kneading_of(options_.quality);
    energy_ = energy_of(*lowest_.map);
    const double demanding = some_minima * isometric_energy(source(), wanted_, {});
    if (energy_ <= demanding || wanted_.lambda < least_kneaded) return;
    const double work = has_many_minima() ? how.work_on_many : how.work_on_some;
    double rounds = work / topology_.vertex_count();
    double gain = 0;
    Kneading kneading = Kneading::ByAngles;
    for (int in_vain = 0; in_vain < 2 && rounds >= 1; --rounds) {
      gain = gain_by(kneading);
      in_vain = gain > how.least_gain ? 0 : in_vain + 1;
      if (in_vain > 0)
        kneading = kneading == Kneading::ByAngles ? Kneading::ByAreas : Kneading::ByAngles;
    }
    apart_ = std::max(apart_, gain);
  }

  /// Of the energy, by a round that goes as far as the quality does.
  double gain_by(Kneading kneading) {
    rising_.begin(part_of_start);
    const OptimiseOptions how = step_of({.lambda = wanted_.lambda}, 0, 0);
    ProgressiveEmbedding start{knead(topology_, source(), *lowest_.map, kneading, how), {}};
    refine(start, steps(wanted_, options_.quality));
    const double before = energy_;
    keep_lower(std::move(start));
    return (before - energy_) / energy_;
  }

  bool is_draft() const { return options_.quality == Quality::Draft; }

  bool ended_early() const {
    const double much = is_draft() ? much_left_of_draft : much_left;
    return lowest_.report.energy_left > much || apart_ > far_apart;
  }

  /// As the best does, where steps ended early or minima are far apart.
  void go_on() {
    if (!ended_early() || lowest_.report.sweeps_sufficed) return;
    RefinementOptions how = steps(wanted_, Quality::Best);
    how.budget = is_draft() || slimmed_ ? more_for_draft : more_steps;
    if (slimmed_ && lowest_.report.energy_left < much_left_of_draft) how.budget = more_for_slimmed;
    refine(lowest_, how);
  }

  Found try_nearly_conformal(double lambda) {
    rising_.begin(part_of_start);
    ProgressiveEmbedding start = embed({.lambda = lambda}, made_quality());
    lead(start, lambda, up);
    give_steps_unless(start);
    return keep_lower(std::move(start));
  }

  /// The first map waits for its steps until it is clear that it needs them: where the best is
  /// wanted it does, and else where the start is not clearly better.
  void give_steps_unless(const ProgressiveEmbedding& start) {
    if (!std::exchange(lowest_.report.demanding, false)) return;
    if (options_.quality != Quality::Best && start.map && is_clearly_better(*start.map)) return;
    refine(lowest_, steps(wanted_, made_quality()));
    energy_ = energy_of(*lowest_.map);
  }

  bool is_clearly_better(const SphereMap& map) const {
    const double nearer = nearer_pins(map);
    return nearer > 0 || (nearer == 0 && energy_of(map) < clearly_lower * energy_);
  }

  /// Not a number: nobody knows.
  bool is_far() const { return !(lowest_.report.energy_left.value_or(0) < far_from_energy); }

  /// From the λ by which a map was made to the energy wanted. No map: it is not worth it.
  void lead(ProgressiveEmbedding& start, double lambda, const Way& way) const {
    const bool rising = way.factor > 1;
    while (start.map) {
      lambda *= way.factor;
      if (rising ? lambda >= wanted_.lambda : lambda <= wanted_.lambda) break;
      const OptimiseOptions how = step_of({.lambda = lambda}, way.least_gain, way.steps);
      start.map = optimise(topology_, source(), *start.map, how).map;
      const double most = elementary::pow(lambda / wanted_.lambda, hopeless) * first_energy_;
      if (rising && !(energy_of(*start.map) <= most)) start.map.reset();
    }
    if (start.map) refine(start, steps(wanted_, made_quality()));
  }

  /// Of maps that miss pins alike; else the one that misses them less.
  Found keep_lower(ProgressiveEmbedding start) {
    latest_.reset();
    if (!start.map) return Found::Higher;
    const double nearer = nearer_pins(*start.map), energy = energy_of(*start.map);
    if (nearer < 0 || !std::isfinite(energy)) return Found::Higher;
    latest_ = energy;
    const bool same = nearer == 0 && std::abs(energy - energy_) <= agreement * energy_;
    if (nearer == 0 && !(energy < energy_)) return same ? Found::Same : Found::Higher;
    energy_ = energy;
    lowest_.map = std::move(start.map);
    lowest_.report.energy_left = start.report.energy_left;
    lowest_.report.left_slivers = start.report.left_slivers;
    return same ? Found::Same : Found::Lower;
  }

  double energy_of(const SphereMap& map) const {
    return distortion_energy(topology_, source(), map, wanted_, options_.threads);
  }

  /// Measured whenever it is needed: cheaper than its room while levels are embedded.
  RestTriangles source() const {
    return fattened(measure_source(mesh_, options_.threads), fatness_, options_.threads);
  }

  const TriangleMesh& mesh_;
  const Topology& topology_;
  const ProgressiveOptions& options_;
  const KeptVertices& keep_;
  const DistortionEnergy wanted_;
  RisingProgress rising_;
  const Progress progress_;
  ProgressiveEmbedding lowest_;
  // As wanted: of the lowest map, the first, and the one that came last.
  double energy_ = 0, first_energy_ = 0;
  std::optional<double> latest_;
  double apart_ = 0;      // two minima, as a share of the energy
  double fatness_ = 0;    // of all that is measured
  bool slimmed_ = false;  // the lowest map, from fattened slivers
};

/// As if all triangles were equilateral, then relaxed and refined for the shape they have. No
/// shape is too hard for that, but what neither reaches stays distorted.
ProgressiveEmbedding embed_by_valences(const TriangleMesh& mesh, const Topology& topology,
                                       const ProgressiveOptions& options,
                                       const KeptVertices& keep) {
  TriangleMesh shapeless = mesh;
  shapeless.positions.setZero();
  ProgressiveOptions draft = options;
  draft.quality = Quality::Draft;
  draft.least_area = 1;  // all are as large as the mean: the source has the sphere's area
  ProgressiveEmbedding embedding = Starts(shapeless, topology, draft, keep).first();
  if (!embedding.map) return embedding;
  embedding.map = relax(topology, measure_source(mesh, options.threads), *embedding.map,
                        {.energy = options.energy,
                         .sweeps = shape_sweeps,
                         .pinned = keep.vertices,
                         .threads = options.threads,
                         .progress = options.progress,
                         .measure_energy = false})
                      .map;
  const Starts starts(mesh, topology, options, keep);
  starts.refine(embedding, starts.steps(options.energy, options.quality));
  return embedding;
}

void require_domain(const ProgressiveOptions& options, int vertices) {
  require_domain(options.energy);
  require_one_of("quality", options.quality, Quality::Best);
  require_at_least("sweeps", options.sweeps, 0);
  require_at_least("most_sweeps", options.most_sweeps, 0);
  require_between("over_relaxation", options.over_relaxation, 0, most_over_relaxation);
  require_between("retries", options.retries, 0, most_retries);
  require_at_least("pin_level", options.pin_level, 0);
  require_between("least_area", options.least_area, 0, 1);
  require_between("filler_share", options.filler_share, 0, 1);
  require_pins(options.pins, vertices);
}

}  // namespace

ProgressiveEmbedding embed_progressively(const TriangleMesh& mesh, const Topology& topology,
                                         const ProgressiveOptions& options) {
  require_domain(options, topology.vertex_count());
  report(options.progress, "hierarchy", 0);
  KeptVertices keep{{}, std::max(options.pin_level, 20 * static_cast<int>(options.pins.size()))};
  for (const Pin& pin : options.pins) keep.vertices.push_back(pin.vertex);
  ProgressiveEmbedding embedding = Starts(mesh, topology, options, keep).lowest();
  if (embedding.map && !options.pins.empty())
    embedding.report.pin_residuals = pin_residuals(*embedding.map, options.pins);
  give_back_freed_memory();  // before the caller measures and turns the map
  if (embedding.map) return embedding;
  const int retries = embedding.report.retries;
  embedding = embed_by_valences(mesh, topology, options, keep);
  embedding.report.retries += retries;
  return embedding;
}

}  // namespace sphparam
