#include "pipeline/held_pins.h"

#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "embedding/frame/landmarks.h"
#include "pipeline/balanced_embedding.h"
#include "pipeline/mirrored_pins.h"
#include "pipeline/poles_on_map.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/sphere/spherical_coordinates.h"

// Pins bind every level of the progressive embedding. Poles that it does not reach may still be
// moved to on the finished map.

namespace sphparam {
namespace {

std::string words_of_fold(const Topology& topology, Face face) {
  const auto corner = [&](int k) { return std::to_string(topology.vertex(face, k)); };
  return "no map has these pins: they fold the triangle of the vertices " + corner(0) + ", " +
         corner(1) + " and " + corner(2) + "; no pin and no given pole was tried";
}

/// For its pins: poles that it has are held with them then, or it loses them.
bool is_to_be_made_anew(const MapInProgress& work) {
  return work.options.method != Method::Paper && !work.options.pins.empty();
}

}  // namespace

std::vector<Pin> wanted_pins(MapInProgress& work) {
  std::vector<Pin> pins;
  if (work.options.poles && (!work.result.poles || is_to_be_made_anew(work))) {
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

bool note_residuals(MapInProgress& work, const std::vector<Pin>& pins) {
  const std::vector<double> residuals = pin_residuals(work.result.map, pins);
  const auto of_pins = residuals.end() - std::ssize(work.options.pins);
  work.result.pin_residuals.assign(of_pins, residuals.end());
  if (of_pins == residuals.begin()) return true;
  const bool there = residuals[0] == 0 && residuals[1] == 0;
  if (there) work.result.poles = work.options.poles;
  return there;
}

void hold(MapInProgress& work, const std::vector<Pin>& pins) {
  if (const std::optional<Face> face = face_folded_by(work.topology, pins)) {
    work.warn(words_of_fold(work.topology, *face));
    note_residuals(work, pins);
    return;
  }
  if (const std::optional<std::string> suspicion = suspicion_of_mirror(work.result.map, pins)) {
    work.warn(*suspicion);
  }
  const DistortionEnergy measure = work.energy;
  const double energy = work.surface_energy(work.result.map, measure);
  Parameterization before = work.result;
  MapInProgress::BalanceState balance = work.balance_state();
  work.forget_poles();
  const bool held = embed(work, pins) && work.certified();
  if (!held || (work.options.pins.empty() && !all_exact(pin_residuals(work.result.map, pins)))) {
    work.result = std::move(before);
    work.restore(std::move(balance));  // λ is the map's
    if (work.options.pins.empty()) move_to_poles(work, {pins[0].vertex, pins[1].vertex});
  }
  if (!note_residuals(work, pins)) work.warn("the poles could not be moved to ±z without folds");
  work.result.pole_cost = work.surface_energy(work.result.map, measure) / energy - 1;
}

}  // namespace sphparam
