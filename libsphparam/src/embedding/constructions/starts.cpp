#include "embedding/constructions/starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "elementary.h"
#include "embedding/constructions/slivers.h"
#include "embedding/energy/map_image.h"
#include "embedding/energy/rest_floors.h"
#include "embedding/newton/minimise.h"

// One embedding from coarse to fine (level_embedding.cpp) does for most shapes. Where it finds no
// room areas weigh more.
//
// Limbs give the energy many minima: how a coarse level folds them stays. The nearly conformal
// energy has hardly more than one. A map of it, led from λ to λ, ends several per cent lower, and
// nearly alike from wherever it came. It costs an embedding more: maps of great energy are worth
// that, and of less where the best is wanted. Where a map ends far from its energy it is the other
// way round: maps in which areas weigh more lead to the lower minima.
//
// Among slivers no way leads far: each that is about to fold stops all that moves. Where they are
// in the way, all of the above is done as if they were fatter, and the map of that is led to what
// they are (slivers.cpp). The best of many minima is looked for there, too.
//
// Around pins all starts have their way to find, and may fold what no pin asks for. A map without
// pins has found its own: where one is known, the pins are led from where it has them.
//
// Limbs that are long have more minima than starts find: the lowest map is kneaded (kneading.cpp),
// as long as that lowers it. Steps that stop with much left even so go on in the end as the best's
// do: of the lowest map alone, and no longer than a budget lasts.

namespace sphparam {
namespace {

// The λ tried in turn where vertices found no room at the one asked for.
constexpr double roomier_lambdas[] = {10, 100, 1000};

// --- Which shapes are worth more. Energies are in units of an isometry's. ---

// With more, before the finest level has had its steps, other starts are tried.
constexpr double much_energy = 2.75, much_for_best = 1.6;
// With less, kneading is not worth it.
constexpr double some_minima = 3;
// With more, even nearly conformal starts end in different minima.
constexpr double many_minima = 5;

// --- Which energies differ. As shares of the energy. ---

constexpr double clearly_lower = 0.95;  // is less than this times that of a map without its steps
constexpr double agreement = 5e-4;      // minima that differ by no more are one
constexpr double far_apart = 1e-2;      // where two minima are so far apart, steps go on

// --- How much of the energy steps to come would take. ---

constexpr double far_from_energy = 0.1;  // with more, maps in which areas weigh more are tried
// With more, steps go on, within a budget: a draft is not to take longer than a map by Normal, and
// slimmed maps have hardly more to gain.
constexpr double much_left = 5e-3, much_left_of_draft = 3e-2;
constexpr Budget more_steps{2e6, 60, 1200}, more_for_draft{5e5, 20, 300};
constexpr Budget more_for_slimmed{1e5, 10, 60};

// --- Starts by other λ, and how these are led to the one asked for. ---

constexpr double nearly_conformal = 1e-6, others_nearly_conformal[] = {1e-8, 1e-4};
// Times the λ asked for, or times 1 if that is more.
constexpr double nearly_equal_area[] = {10, 100, 1000};
// A map on its way up is given up where its energy is more than (λ / λ asked for) to this power
// times the first map's. (Limbs have half of that, slivers twice as much: there angles are kept at
// the cost of areas that do not come back.)
constexpr double hopeless = -0.75;

// --- The start from a map without pins. ---

// Rounds that move the pins, at most, and their work: they cost every vertex a distance from each.
constexpr double most_free_map_rounds = 20, free_map_work = 5e7;
constexpr int free_map_sweeps = 5;
constexpr double alike = 1e-9;  // radians by which two maps miss their pins

// --- Slivers. ---

// Steps of the first map end after so many in a row that slivers cut short.
constexpr int blocked_in_a_row = 4;
// A map that has had no steps gets so many, to see whether slivers cut one short.
constexpr int first_steps = 4;
// The way of a fattened map to the slivers as they are, and steps at its end.
constexpr double slimming_gain = 1e-3;
constexpr int slimming_steps = 80, steps_of_slim = 12;

// --- Kneading. ---

/// It goes on while a round gains so much of the energy, for so many rounds × vertices at most,
/// where minima are some, and where they are many.
struct KneadingLimits {
  double least_gain, work_on_some, work_on_many;
};
constexpr KneadingLimits kneading_of_draft{1e-2, 0, 2.5e4}, kneading_of_normal{1e-3, 1e4, 5e4},
    kneading_of_best{5e-4, 2e5, 2e5};
constexpr double least_kneaded = 0.1;  // λ: below, minima are few

const KneadingLimits& kneading_of(Quality quality) {
  if (quality == Quality::Best) return kneading_of_best;
  return quality == Quality::Draft ? kneading_of_draft : kneading_of_normal;
}

// --- Progress: shares of what is left, of the first start where the best is wanted, and of others.

constexpr double part_before_best = 0.3, part_of_start = 0.5;

}  // namespace

const Starts::Way Starts::up{10, 1e-2, 10}, Starts::down{0.25, 1e-2, 6};

Starts::Starts(const TriangleMesh& mesh, const Topology& topology,
               const ProgressiveOptions& options, const KeptVertices& keep)
    : mesh_(mesh),
      topology_(topology),
      options_(options),
      keep_(keep),
      wanted_(options.energy),
      rising_(options.progress),
      progress_(rising_.progress()) {
  rising_.begin(options.quality == Quality::Best ? part_before_best : 1);
}

ProgressiveEmbedding Starts::first() { return embed_with_room(wanted_); }

ProgressiveEmbedding Starts::lowest() {
  const bool best = is_best();
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

RefinementOptions Starts::steps(const DistortionEnergy& energy, Quality quality) const {
  return {.quality = quality,
          .energy = energy,
          .threads = options_.threads,
          .progress = progress_,
          .fatness = fatness_};
}

void Starts::refine(ProgressiveEmbedding& embedding, const RefinementOptions& how) const {
  std::vector<ImagePoint> image = image_of(*embedding.map);
  NewtonRefinement refinement(topology_.vertex_count(), how);
  refinement.improve(mesh_, topology_, keep_.vertices, image);
  embedding.map = map_of(image);
  embedding.report.energy_left = refinement.energy_left();
  embedding.report.left_slivers = refinement.left_slivers();
  embedding.report.pressure = 0;  // steps know of none
}

ProgressiveEmbedding Starts::embed(const DistortionEnergy& energy, Quality quality,
                                   double demanding, int most_blocked) const {
  ProgressiveOptions how = options_;
  how.energy = energy;
  how.quality = quality;
  how.progress = progress_;
  return embed_by_levels(mesh_, topology_, how, keep_, {demanding, fatness_, most_blocked});
}

ProgressiveEmbedding Starts::embed_with_room(const DistortionEnergy& energy, double demanding,
                                             int most_blocked) const {
  ProgressiveEmbedding embedding = embed(energy, start_quality(), demanding, most_blocked);
  for (const double lambda : roomier_lambdas) {
    if (embedding.map) break;
    const int retries = embedding.report.retries;
    embedding = embed({.lambda = std::max(lambda, energy.lambda)}, Quality::Draft);
    embedding.report.retries += retries;
    if (embedding.map) refine(embedding, steps(energy, start_quality()));
  }
  return embedding;
}

ProgressiveEmbedding Starts::embed_fattened(double demanding) {
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
  RefinementOptions how = steps(wanted_, start_quality());
  how.finest_steps = steps_of_slim;
  refine(fat, how);
  fat.report.sweeps_sufficed = false;
  return fat;
}

void Starts::lead(ProgressiveEmbedding& start, double lambda, const Way& way) const {
  const bool rising = way.factor > 1;
  while (start.map) {
    lambda *= way.factor;
    if (rising ? lambda >= wanted_.lambda : lambda <= wanted_.lambda) break;
    const OptimiseOptions how = step_of({.lambda = lambda}, way.least_gain, way.steps);
    start.map = optimise(topology_, source(), *start.map, how).map;
    const double most = elementary::pow(lambda / wanted_.lambda, hopeless) * first_energy_;
    if (rising && !(energy_of(*start.map) <= most)) start.map.reset();
  }
  if (start.map) refine(start, steps(wanted_, start_quality()));
}

bool Starts::try_free_map() {
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
  refine(start, steps(wanted_, start_quality()));
  if (lowest_.map) energy_ = energy_of(*lowest_.map);
  give_steps_unless(start);
  return keep_lower(std::move(start)) != Found::Higher;
}

double Starts::work_of_pins() const {
  const auto pins = static_cast<double>(options_.pins.size());
  return pins * (topology_.vertex_count() + pins * pins);
}

void Starts::try_more(double demanding) {
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

void Starts::try_others() {
  energy_ = first_energy_ = energy_of(*lowest_.map);
  const bool best = is_best();
  Found found = Found::Same;
  if (lowest_.report.demanding || (best && (exceeds(much_for_best) || !lowest_.report.limbs)))
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

Starts::Found Starts::try_nearly_conformal(double lambda) {
  rising_.begin(part_of_start);
  ProgressiveEmbedding start = embed({.lambda = lambda}, start_quality());
  lead(start, lambda, up);
  give_steps_unless(start);
  return keep_lower(std::move(start));
}

void Starts::compare_minima() {
  if (!exceeds(many_minima)) return;
  const double one = energy_;
  try_nearly_conformal(others_nearly_conformal[0]);
  if (latest_) apart_ = std::abs(*latest_ - one) / energy_;
}

bool Starts::finds_slivers_in_the_way() {
  if (!has_slivers(source())) return false;
  if (!lowest_.map) return true;
  if (!lowest_.report.demanding) return lowest_.report.left_slivers;
  RefinementOptions few = steps(wanted_, start_quality());
  few.finest_steps = first_steps;
  few.most_blocked = 1;
  refine(lowest_, few);
  lowest_.report.energy_left.reset();
  return lowest_.report.left_slivers;
}

void Starts::give_steps_unless(const ProgressiveEmbedding& start) {
  if (!std::exchange(lowest_.report.demanding, false)) return;
  if (!is_best() && start.map && is_clearly_better(*start.map)) return;
  refine(lowest_, steps(wanted_, start_quality()));
  energy_ = energy_of(*lowest_.map);
}

void Starts::knead_lowest() {
  const KneadingLimits& how = kneading_of(options_.quality);
  energy_ = energy_of(*lowest_.map);
  const double few_minima = some_minima * isometric_energy(source(), wanted_, {});
  if (energy_ <= few_minima || wanted_.lambda < least_kneaded) return;
  const double work = exceeds(many_minima) ? how.work_on_many : how.work_on_some;
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

double Starts::gain_by(Kneading kneading) {
  rising_.begin(part_of_start);
  const OptimiseOptions how = step_of({.lambda = wanted_.lambda}, 0, 0);
  ProgressiveEmbedding start{knead(topology_, source(), *lowest_.map, kneading, how), {}};
  refine(start, steps(wanted_, options_.quality));
  const double before = energy_;
  keep_lower(std::move(start));
  return (before - energy_) / energy_;
}

void Starts::go_on() {
  if (!ended_early() || lowest_.report.sweeps_sufficed) return;
  RefinementOptions how = steps(wanted_, Quality::Best);
  how.budget = is_draft() || slimmed_ ? more_for_draft : more_steps;
  if (slimmed_ && lowest_.report.energy_left < much_left_of_draft) how.budget = more_for_slimmed;
  refine(lowest_, how);
}

Starts::Found Starts::keep_lower(ProgressiveEmbedding start) {
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

bool Starts::is_clearly_better(const SphereMap& map) const {
  const double nearer = nearer_pins(map);
  return nearer > 0 || (nearer == 0 && energy_of(map) < clearly_lower * energy_);
}

double Starts::nearer_pins(const SphereMap& map) const {
  if (!lowest_.map) return std::numeric_limits<double>::infinity();
  const double before = missed_by(*lowest_.map), now = missed_by(map);
  const bool are_alike = before > 0 && now > 0 && std::abs(before - now) < alike;
  return are_alike ? 0 : before - now;
}

double Starts::missed_by(const SphereMap& map) const {
  const std::vector<double> residuals = pin_residuals(map, options_.pins);
  return std::accumulate(residuals.begin(), residuals.end(), 0.0);
}

double Starts::energy_of(const SphereMap& map) const {
  return distortion_energy(topology_, source(), map, wanted_, options_.threads);
}

OptimiseOptions Starts::step_of(const DistortionEnergy& energy, double least_gain,
                                int steps) const {
  return {.energy = energy,
          .least_gain = least_gain,
          .max_steps = steps,
          .pinned = keep_.vertices,
          .threads = options_.threads,
          .progress = progress_};
}

RestTriangles Starts::source() const {
  return fattened(measure_source(mesh_, options_.threads), fatness_, options_.threads);
}

Quality Starts::start_quality() const { return std::min(options_.quality, Quality::Normal); }

bool Starts::exceeds(double isometries) const {
  return energy_ > isometries * isometric_energy(source(), wanted_, {});
}

bool Starts::best_of_many() const { return is_best() && exceeds(many_minima); }

bool Starts::is_far() const { return !(lowest_.report.energy_left.value_or(0) < far_from_energy); }

bool Starts::ended_early() const {
  const double much = is_draft() ? much_left_of_draft : much_left;
  return lowest_.report.energy_left > much || apart_ > far_apart;
}

}  // namespace sphparam
