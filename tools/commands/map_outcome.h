#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/source.h"
#include "compare/methods.h"
#include "embedding/frame/landmarks.h"
#include "sphparam/parameterize.h"

namespace sphparam::cli {

/// What one run found. `certificate` is of the map in memory; what is written must have the same
/// verdict when it is read back.
struct MapOutcome {
  MeshSource source;
  Parameterization result = {};
  std::optional<BaselineAccount> account = std::nullopt;  // of a method of others
  Certificate certificate = {};
  std::optional<Distortion> distortion = std::nullopt;
  std::optional<DistortionSummary> figures = std::nullopt;
  // What was asked for, as vertices of the mesh:
  std::vector<Landmark> pins = {};
  std::optional<Poles> poles = std::nullopt;
  std::optional<Vertex> meridian = std::nullopt;

  /// The paper's method makes none where no pair of poles is usable.
  bool has_map() const { return result.map.points.rows() > 0; }
  /// Every pin exactly where it was wanted; also where none was.
  bool pins_hold() const {
    return pins.empty() ||
           (result.pin_residuals.size() == pins.size() && all_exact(result.pin_residuals));
  }
  bool poles_hold() const {
    return !poles || (result.poles && result.poles->north == poles->north &&
                      result.poles->south == poles->south);
  }
  bool meridian_holds() const { return !meridian || result.meridian == meridian; }
  /// Radians of the poles asked for from +z and from −z; empty where none were, or no map was made.
  std::vector<double> pole_residuals() const {
    if (!poles || !has_map()) return {};
    return pin_residuals(result.map,
                         {{poles->north, Vector3::UnitZ()}, {poles->south, -Vector3::UnitZ()}});
  }
  /// All that was asked for is where it was wanted: else no map is written.
  bool frame_holds() const { return pins_hold() && poles_hold() && meridian_holds(); }
  /// What the program is for: exit code 0.
  bool succeeded() const { return certificate.bijective() && frame_holds(); }
  const Topology& topology() const { return source.topology.value(); }
  std::string verdict() const { return has_map() ? sphparam::verdict(certificate) : "no map"; }
};

}  // namespace sphparam::cli
