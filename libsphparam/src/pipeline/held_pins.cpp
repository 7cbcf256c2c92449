#include "pipeline/held_pins.h"

#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "pipeline/balanced_embedding.h"
#include "pipeline/poles_on_map.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/embedding/landmarks.h"
#include "sphparam/sphere/spherical_coordinates.h"

// Pins bind every level of the progressive embedding. Poles that it does not reach may still be
// moved to on the finished map.

namespace sphparam {
namespace {

/// Tells how far the pins are from their points, and whether the poles, which come first, are
/// there.
void note_residuals(MapInProgress& work, const std::vector<Pin>& pins) {
  const std::vector<double> residuals = pin_residuals(work.result.map, pins);
  const auto of_pins = residuals.end() - std::ssize(work.options.pins);
  work.result.pin_residuals.assign(of_pins, residuals.end());
  if (of_pins == residuals.begin()) return;
  if (residuals[0] == 0 && residuals[1] == 0) {
    work.result.poles = work.options.poles;
  } else {
    work.warn("the poles could not be moved to ±z without folds");
  }
}

}  // namespace

std::vector<Pin> wanted_pins(MapInProgress& work) {
  std::vector<Pin> pins;
  if (work.options.poles && !work.result.poles) {
    const auto [north, south] = *work.options.poles;
    if (north == south || work.topology.find_halfedge(north, south) >= 0) {
      work.warn("the poles are the same or share an edge: they cannot lie opposite each other");
    } else {
      pins = {{north, Vector3::UnitZ()}, {south, -Vector3::UnitZ()}};
    }
  }
  for (const Landmark& pin : work.options.pins) {
    pins.push_back({pin.vertex, to_cartesian(pin.coordinates)});
  }
  return pins;
}

void hold(MapInProgress& work, const std::vector<Pin>& pins) {
  if (const std::optional<Face> face = face_folded_by(work.topology, pins)) {
    work.warn("no map has these pins: they fold triangle " + std::to_string(*face) +
              ", all three corners of which are given");
    return note_residuals(work, pins);
  }
  const DistortionEnergy measure = work.energy;
  const double energy = distortion_energy(work.topology, work.source(), work.result.map, measure,
                                          work.options.threads);
  Parameterization before = work.result;
  work.forget_poles();
  const bool held = embed(work, pins) && work.certified();
  if (!held || (work.options.pins.empty() && !all_exact(pin_residuals(work.result.map, pins)))) {
    work.result = std::move(before);
    if (work.options.pins.empty()) move_to_poles(work, {pins[0].vertex, pins[1].vertex});
  }
  note_residuals(work, pins);
  work.result.pole_cost = distortion_energy(work.topology, work.source(), work.result.map, measure,
                                            work.options.threads) /
                              energy -
                          1;
}

}  // namespace sphparam
