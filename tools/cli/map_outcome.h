#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/source.h"
#include "cli/wording.h"
#include "compare/methods.h"
#include "sphparam/embedding/landmarks.h"
#include "sphparam/parameterize.h"

namespace sphparam::tools {

/// What one run found. `certificate` is of the map in memory; what is written must have the same
/// verdict when it is read back.
struct MapOutcome {
  Source source;
  Parameterization result = {};
  std::optional<RivalAccount> account = std::nullopt;  // of a method of others
  Certificate certificate = {};
  std::optional<Distortion> distortion = std::nullopt;
  std::optional<DistortionSummary> figures = std::nullopt;
  std::vector<Landmark> pins = {};  // vertices of the mesh

  /// The paper's method makes none where no pair of poles is usable.
  bool has_map() const { return result.map.points.rows() > 0; }
  /// Every pin exactly where it was wanted; also where none was.
  bool pins_hold() const {
    return pins.empty() ||
           (result.pin_residuals.size() == pins.size() && all_exact(result.pin_residuals));
  }
  /// What the program is for: exit code 0.
  bool succeeded() const { return certificate.bijective() && pins_hold(); }
  const Topology& topology() const { return source.topology.value(); }
  std::string verdict() const { return has_map() ? tools::verdict(certificate) : "no map"; }
};

}  // namespace sphparam::tools
