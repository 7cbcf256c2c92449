#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/chart_report.h"
#include "commands/repairing.h"
#include "commands/source.h"
#include "compare/entry.h"
#include "compare/methods.h"
#include "sphparam/parameterize.h"

namespace sphparam::cli {

/// What `--json` tells, gathered by a subcommand while it works. References are to values that
/// outlive the report. The keys are documented in docs/commands/index.md and
/// never change their meaning.

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

struct InputReport {
  const std::string& file;
  const MeshSource& source;
};

struct MapReport {
  InputReport input;
  std::string method;
  const ParameterizeOptions& options;
  std::vector<std::string> repairs_wanted;  // by the names of --repair
  const Parameterization& result;
  const std::optional<BaselineAccount>& account;  // of a method of others
  const std::vector<Landmark>& pins;           // of vertices of the mesh
  std::vector<double> pole_residuals;          // of poles asked for, in radians; empty: none were
  const Certificate& certificate;              // of what was written, where something was
  const std::optional<DistortionSummary>& distortion;
  const std::optional<ChartReport>& chart;
  NamedTexts outputs;  // what it is, where it is
  double seconds = 0;
};

struct InfoReport {
  InputReport input;
  NamedTexts provenance;                     // of a .sph.ply
  const std::optional<RepairTrial>& repair;  // of a mesh that cannot be mapped as it is
  double seconds = 0;
};

struct VerifyReport {
  const std::string& file;
  const Certificate& certificate;
  std::string rays;  // where they were found
  double mean_length = 1;
  double length_deviation = 0;  // largest | length / mean − 1 |
  std::optional<DistortionSummary> distortion = std::nullopt;
  bool chart_wanted = false;  // with --chart
  std::optional<ChartReport> chart = std::nullopt;
  std::vector<std::string> notes = {};
  double seconds = 0;
};

struct CompareReport {
  InputReport input;
  const std::vector<Entry>& entries;
  double seconds = 0;
};

std::string to_json(const MapReport& report);
std::string to_json(const InfoReport& report);
std::string to_json(const VerifyReport& report);
std::string to_json(const CompareReport& report);

}  // namespace sphparam::cli
