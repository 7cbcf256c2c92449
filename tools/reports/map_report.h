#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/methods.h"
#include "reports/json_parts.h"
#include "sphparam/parameterize.h"

namespace sphparam::cli {

/// What `sphparam map` found.
struct MapReport {
  InputReport input;
  std::string method;
  const ParameterizeOptions& options;
  std::vector<std::string> repairs_wanted;  // by the names of --repair
  const Parameterization& result;
  const std::optional<BaselineAccount>& account;  // of a method of others
  const std::vector<Landmark>& pins;              // of vertices of the mesh
  std::vector<double> pole_residuals;  // of poles asked for, in radians; empty: none were
  const Certificate& certificate;      // of what was written, where something was
  const std::optional<DistortionSummary>& distortion;
  const std::optional<ChartReport>& chart;
  NamedTexts outputs;  // what it is, where it is
  double seconds = 0;
};

std::string to_json(const MapReport& report);

}  // namespace sphparam::cli
