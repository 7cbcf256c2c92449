#include "pipeline/poles_on_map.h"

#include <optional>
#include <string>
#include <utility>

#include "embedding/frame/axis_choice.h"
#include "embedding/frame/pole_placement.h"
#include "embedding/newton/optimise.h"
#include "number_text.h"
#include "pipeline/balanced_embedding.h"
#include "pipeline/meridian.h"

// The axis crosses the map where poles disturb least; the vertices nearest to it are moved there,
// and pinned sweeps make good what that cost. Where limbs hang on what was moved they do not: there
// Newton steps of all vertices do.

namespace sphparam {
namespace {

constexpr int pole_sweeps = 10;                // of pinned relaxation after poles were moved
constexpr double greatest_silent_cost = 0.03;  // of the energy, that poles are
constexpr int most_pole_moves = 20;  // on finished maps, which are fine: each costs such sweeps

/// Steps of all vertices, where poles cost more than a share of the energy.
struct Settling {
  double least_cost, least_gain;
  int steps;
};
constexpr Settling brief{1e-3, 1e-4, 10}, thorough{1e-5, 1e-6, 30};

PolePlacementOptions pole_options(const MapInProgress& work) {
  return {.energy = work.energy,
          .sweeps = pole_sweeps,
          .most_moves = most_pole_moves,
          .no_pole = work.options.meridian,
          .threads = work.options.threads,
          .progress = work.options.progress};
}

/// Of a few large triangles poles may be a large part of the map.
void tell_cost(MapInProgress& work) {
  if (!(work.result.pole_cost > greatest_silent_cost)) return;
  work.warn("poles raise the energy by " + percent(work.result.pole_cost) +
            ": a map without them has less");
}

/// A meridian needs none.
void go_without_poles(MapInProgress& work, const std::string& reason) {
  work.warn(reason +
            ": the map has no vertices at ±z, where triangles are split for textures, no more");
  if (work.options.meridian) turn(work, work.result.map, *work.options.meridian);
}

double energy_of(MapInProgress& work, const SphereMap& map) {
  return distortion_energy(work.topology, work.aim(), map, work.energy, work.options.threads);
}

/// Without what a balance makes of it.
double wanted_energy_of(MapInProgress& work, const SphereMap& map) {
  return distortion_energy(work.topology, work.source(), map, work.options.energy,
                           work.options.threads);
}

/// Of maps that were made for their energy alone.
void settle(MapInProgress& work, PolePlacement& placement) {
  if (!work.result.energy_gap || !work.options.fillers.empty()) return;
  const Settling& how = work.options.quality == Quality::Best ? thorough : brief;
  if (!(placement.energy_after > (1 + how.least_cost) * placement.energy_before)) return;
  SphereMap settled = optimise(work.topology, work.aim(), placement.map,
                               {.energy = work.energy,
                                .least_gain = how.least_gain,
                                .max_steps = how.steps,
                                .pinned = {placement.north, placement.south},
                                .threads = work.options.threads,
                                .progress = work.options.progress})
                          .map;
  const double energy = energy_of(work, settled);
  if (!(energy < placement.energy_after)) return;  // steps see the source rounded to floats
  placement.map = std::move(settled);
  placement.energy_after = energy;
}

/// What is relaxed about a pole may be most of a small mesh, and fillers with it.
void balance_and_press_again(MapInProgress& work, PolePlacement& placement) {
  if (work.options.method != Method::Progressive) return;
  const Vector3 up = Vector3::UnitZ();
  const std::vector<Pin> poles{{placement.north, up}, {placement.south, -up}};
  const bool balanced = balance_again(work, placement.map, poles);
  const bool pressed = press_fillers_again(work, placement.map, poles);
  if (balanced) {  // which aims at something else
    placement.energy_before = wanted_energy_of(work, work.result.map);
    placement.energy_after = wanted_energy_of(work, placement.map);
  } else if (pressed) {
    placement.energy_after = energy_of(work, placement.map);
  }
}

/// Equal areas were promised, poles are chosen where they do no harm.
bool break_promise(MapInProgress& work, const MapInProgress::BalanceState& before,
                   const SphereMap& map) {
  const double most = BalanceOptions{}.area_error;
  return work.options.balance == Balance::EqualArea && work.options.fillers.empty() &&
         before.record && before.record->area_error <= most && area_error_of(work, map) > most;
}

}  // namespace

void move_to_poles(MapInProgress& work, Poles poles) {
  std::optional<PolePlacement> placement = place_poles(
      work.topology, work.aim(), work.result.map, poles.north, poles.south, pole_options(work));
  if (!placement) return;
  work.record("pole placement", placement->map);
  work.accept_if_certified(std::move(placement->map));
}

void choose_poles_on_map(MapInProgress& work) {
  report(work.options.progress, "poles", 0);
  const AxisChoice choice =
      choose_axis(work.topology, work.source(), work.result.map, {.threads = work.options.threads});
  std::optional<PolePlacement> placement = place_poles_on_axis(
      work.topology, work.aim(), work.result.map, choice.axis, pole_options(work));
  if (!placement) return go_without_poles(work, "no vertex could be moved to -z");
  settle(work, *placement);
  MapInProgress::BalanceState before = work.balance_state();
  balance_and_press_again(work, *placement);
  if (break_promise(work, before, placement->map)) {
    work.restore(std::move(before));
    return go_without_poles(work, "poles would keep areas from being equal");
  }
  const Vertex meridian =
      work.options.meridian ? *work.options.meridian : quiet_meridian(work, placement->map);
  if (!work.options.fillers.empty()) {  // which may weigh more than all of the surface
    placement->energy_before = work.surface_energy(work.result.map, work.options.energy);
    placement->energy_after = work.surface_energy(placement->map, work.options.energy);
  }
  if (!turn(work, placement->map, meridian) &&
      !work.accept_if_certified(std::move(placement->map))) {
    work.restore(std::move(before));
    return go_without_poles(work, "turning the map to its poles folds it by rounding");
  }
  work.result.poles = {placement->north, placement->south};
  work.result.pole_cost = placement->energy_after / placement->energy_before - 1;
  tell_cost(work);
  work.record("pole placement", work.result.map);
}

}  // namespace sphparam
