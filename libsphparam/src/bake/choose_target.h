#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake_scene.h"
#include "sphparam/bake/bake.h"

namespace sphparam {

/// What images are baked for, and what is to be said of it.
struct ChosenTarget {
  BakeTarget target;
  std::optional<double> distance;  // see `disagreement`; nothing where it is the source
  std::vector<std::string> warnings;
};

/// The target of the settings, or the source: its chart, with the triangles at the poles refined.
/// Throws: OtherSphereError; NotCertifiedError where the chart is not one-to-one; BakeSettingError
/// where the poles cannot be refined so; Cancelled. Cost: as `make_target`, `disagreement`.
ChosenTarget choose_target(const MappedMesh& source, const BakeSettings& settings);

/// As the user knows the source.
const std::string& source_name(const MappedMesh& source, const BakeSettings& settings);

}  // namespace sphparam
