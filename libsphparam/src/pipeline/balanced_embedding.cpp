#include "pipeline/balanced_embedding.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "embedding/constructions/progressive.h"
#include "embedding/energy/map_image.h"
#include "embedding/energy/solid_angle_aim.h"
#include "embedding/newton/optimise.h"
#include "embedding/newton/pressed_fillers.h"
#include "number_text.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/sphere/sphere_share.h"

// The embedding's own sweeps and steps serve λ near 1, and the nearly conformal energy, which has
// hardly more than one minimum; from there on λ goes step by step.

namespace sphparam {
namespace {

constexpr double least_direct_lambda = 0.1, greatest_direct_lambda = 10;  // others by continuation
constexpr double first_of_equal_areas = 4;  // next to no shape's areas are equal before

double first_lambda(const ParameterizeOptions& options) {
  if (options.balance == Balance::Conformal) return least_lambda;
  if (options.balance == Balance::EqualArea) return first_of_equal_areas;
  return std::clamp(options.energy.lambda, least_direct_lambda, greatest_direct_lambda);
}

/// Is λ too far from 1 for sweeps and a few steps?
bool needs_balancing(const ParameterizeOptions& options) {
  return options.energy.kind == EnergyKind::AngleAndArea &&
         (options.balance != Balance::Lambda || options.energy.lambda != first_lambda(options));
}

std::vector<Vertex> vertices_of(const std::vector<Pin>& pins) {
  std::vector<Vertex> vertices;
  for (const Pin& pin : pins) vertices.push_back(pin.vertex);
  return vertices;
}

double least_gain_of(Quality quality) {
  return quality == Quality::Draft ? 1e-2 : quality == Quality::Normal ? 1e-3 : 1e-6;
}

ProgressiveOptions embedding_options(const MapInProgress& work, const std::vector<Pin>& pins) {
  return {.quality = work.options.quality,
          .sweeps = work.options.sweeps,
          .pins = pins,
          .free_map = !pins.empty() && work.certified() ? &work.result.map : nullptr,
          .fillers = work.options.fillers,
          .filler_share = work.options.filler_share,
          .threads = work.options.threads,
          .progress = work.options.progress};
}

/// Of the steps that settle fillers, where sweeps nearly do or not.
double settling_gain_of(Quality quality, bool sweeps_sufficed) {
  return sweeps_sufficed && quality == Quality::Normal ? 1e-2 : least_gain_of(quality);
}

/// The same map where there are no fillers, or where they are small enough.
PressedMap press(const MapInProgress& work, SphereMap map, const std::vector<Pin>& pins,
                 double known, double least_gain) {
  if (work.options.fillers.empty()) return {std::move(map), 0, 0};
  return press_fillers(work.topology, measure_source(work.mesh, work.options.threads), map,
                       work.options.filler_share,
                       {.energy = work.energy,
                        .least_gain = least_gain,
                        .pinned = vertices_of(pins),
                        .pressed = work.options.fillers,
                        .threads = work.options.threads,
                        .progress = work.options.progress},
                       known);
}

bool is_better(const PressedMap& one, const PressedMap& other, double most) {
  if (one.share <= most && other.share <= most) return one.energy < other.energy;
  return one.share < other.share;
}

/// Settles what was pressed on its way. That way knows one start alone: where sweeps do not suffice
/// the map made by `how`, without fillers, is pressed as much, and the better one taken.
PressedMap settled(const MapInProgress& work, const ProgressiveEmbedding& embedding,
                   ProgressiveOptions how, double least_gain) {
  const double pressure = embedding.report.pressure;
  PressedMap on_the_way = press(work, *embedding.map, how.pins, pressure, least_gain);
  if (embedding.report.sweeps_sufficed) return on_the_way;
  how.fillers.clear();
  how.quality = std::min(how.quality, Quality::Normal);
  const ProgressiveEmbedding whole = embed_progressively(work.mesh, work.topology, how);
  if (!whole.map) return on_the_way;
  PressedMap at_last = press(work, *whole.map, how.pins, pressure, least_gain);
  return is_better(at_last, on_the_way, work.options.filler_share) ? at_last : on_the_way;
}

BalancedMap balanced(MapInProgress& work, const SphereMap& map, double from_lambda,
                     const std::vector<Pin>& pins) {
  return optimise_balance(work.topology, work.source(), map,
                          {.balance = work.options.balance,
                           .from_lambda = from_lambda,
                           .optimise = {.energy = work.options.energy,
                                        .least_gain = least_gain_of(work.options.quality),
                                        .pinned = vertices_of(pins),
                                        .threads = work.options.threads,
                                        .progress = work.options.progress}});
}

SphereMap balance(MapInProgress& work, const SphereMap& map, double from_lambda,
                  const std::vector<Pin>& pins) {
  BalancedMap result = balanced(work, map, from_lambda, pins);
  work.energy.lambda = result.lambda;
  work.aim_at(std::move(result.aim));
  const bool moved = result.report.steps > 0 && result.lambda != 1;
  work.result.balance = {moved ? result.lambda : from_lambda, result.area_error, moved};
  work.record(balanced_map, result.map);
  return std::move(result.map);
}

double greatest_gap_of(Quality quality) {
  if (quality == Quality::Best) return greatest_gap_of_best;
  return quality == Quality::Draft ? greatest_gap_of_draft : greatest_energy_gap;
}

}  // namespace

bool press_fillers_again(MapInProgress& work, SphereMap& map, const std::vector<Pin>& pins) {
  PressedMap pressed = press(work, map, pins, 0, settling_gain_of(work.options.quality, true));
  if (!pressed.energy) return false;
  work.record("fillers pressed", pressed.map);
  map = std::move(pressed.map);
  work.result.energy_gap.reset();
  return true;
}

double area_error_of(MapInProgress& work, const SphereMap& map) {
  return area_error(work.topology, work.source(), image_of(map), work.options.threads);
}

bool balance_again(MapInProgress& work, SphereMap& map, const std::vector<Pin>& pins) {
  std::optional<BalanceRecord>& balance = work.result.balance;
  if (!balance || work.options.balance != Balance::EqualArea) return false;
  const double error = area_error_of(work, map);
  if (error <= std::max(balance->area_error, BalanceOptions{}.area_error)) return false;
  BalancedMap again = balanced(work, map, balance->lambda, pins);
  if (!(again.area_error < error)) return false;
  balance = {again.lambda, again.area_error, true};
  work.energy.lambda = again.lambda;
  work.aim_at(std::move(again.aim));
  work.record(balanced_map, again.map);
  map = std::move(again.map);
  return true;
}

void warn_of_balance(MapInProgress& work) {
  const Balance wanted = work.options.balance;
  if (wanted == Balance::Lambda) return;
  const std::string name = wanted == Balance::Conformal ? "conformal" : "equal-area";
  std::optional<BalanceRecord>& balance = work.result.balance;
  if (!balance) {
    return work.warn(name + ": the map is not balanced: it was made by the " + work.result.made_by);
  }
  const DistortionSummary summary = summarise_distortion(
      surface_of(work.mesh, work.options.fillers), work.result.map, work.options.threads);
  balance->area_error = summary.weighted_abs_log2_area;
  if (!std::isfinite(balance->area_error)) {
    return work.warn(name + ": a mesh without area has no ratios of areas");
  }
  const bool even = balance->area_error <= BalanceOptions{}.area_error;
  if (wanted == Balance::EqualArea ? even : balance->moved) return;
  work.warn(name +
            (wanted == Balance::EqualArea
                 ? ": the mean |log2 area ratio| is " + short_number(balance->area_error) +
                       ", not at most " + short_number(BalanceOptions{}.area_error)
                 : ": the mean |ln angle ratio| is " + short_number(summary.mean_abs_ln_angle)) +
            (balance->moved ? " (lambda " + short_number(balance->lambda) + ")"
                            : ", as in the map of lambda " + short_number(balance->lambda) +
                                  ": nothing could be gained"));
}

void warn_of_gap(MapInProgress& work) {
  const std::optional<double>& gap = work.result.energy_gap;
  const bool best = work.options.quality == Quality::Best;
  if (!gap || *gap <= greatest_gap_of(work.options.quality)) return;
  const std::string share = short_number(100 * *gap) + " %";
  work.warn(*gap < 0.5 ? "the map is not at its least energy: about " + share + " of it is left" +
                             (best ? ": quality best stopped before it converged"
                                   : "; quality best goes on")
                       : "the map is far from its least energy: distortions are much greater than "
                         "they need be");
}

void tell_filler_share(MapInProgress& work) {
  if (work.options.fillers.empty()) return;
  const double share = sphere_share(work.mesh.triangles, work.result.map, work.options.fillers);
  work.result.filler_share = share;
  if (share <= work.options.filler_share) return;
  work.warn("fillers take " + short_number(100 * share) + " % of the sphere, more than the " +
            short_number(100 * work.options.filler_share) + " % that they may");
}

bool embed(MapInProgress& work, const std::vector<Pin>& pins) {
  work.tried_to_embed = true;
  DistortionEnergy energy = work.options.energy;
  const bool balanced = needs_balancing(work.options);
  if (balanced) energy.lambda = first_lambda(work.options);
  ProgressiveOptions how = embedding_options(work, pins);
  how.energy = energy;
  if (balanced) how.quality = std::min(how.quality, Quality::Normal);
  ProgressiveEmbedding embedding = embed_progressively(work.mesh, work.topology, how);
  if (!embedding.map) return false;
  work.record(pins.empty() ? "progressive embedding" : "pinned embedding", *embedding.map);
  if (balanced) *embedding.map = balance(work, *embedding.map, energy.lambda, pins);
  const double least_gain =
      settling_gain_of(work.options.quality, embedding.report.sweeps_sufficed);
  PressedMap pressed = !balanced && embedding.report.pressure > 0
                           ? settled(work, embedding, how, least_gain)
                           : press(work, *std::move(embedding.map), pins, 0, least_gain);
  if (pressed.energy) work.record("fillers pressed", pressed.map);
  work.accept(balanced ? balanced_map : "progressive embedding", std::move(pressed.map));
  if (!balanced && !pressed.energy) work.result.energy_gap = embedding.report.energy_left;
  return true;
}

}  // namespace sphparam
