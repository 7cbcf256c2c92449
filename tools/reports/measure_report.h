#pragma once

#include <optional>
#include <string>

#include "reports/json_parts.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/measure/surface_distance.h"

namespace sphparam::cli {

/// A length as the user gives it: in the unit of the mesh, or in % of the diagonal of the first
/// mesh's bounding box.
struct LengthLimit {
  double value = 0;
  bool of_diagonal = false;  // in %

  double length(double diagonal) const { return of_diagonal ? value / 100 * diagonal : value; }
};

/// A limit that was set, and what was measured.
struct LimitReport {
  std::string option;  // "--max-rms"
  double limit = 0, measured = 0;

  bool exceeded() const { return !(measured <= limit); }
};

/// What `measure` tells. References are to values that outlive the report.
struct MeasureReport {
  const std::string& first;
  const std::string& second;
  const MeshFile& first_file;
  const MeshFile& second_file;
  const DistanceOptions& options;
  const SurfaceDistance& distance;
  const std::vector<LimitReport>& limits;
  NamedTexts outputs;
  double seconds = 0;
};

/// Keys of each direction as MeshLab has them: RMS, max, mean, min, n_samples, diag_mesh_0 (of the
/// mesh sampled) and diag_mesh_1.
std::string to_json(const MeasureReport& report);

/// A table for people.
std::string to_text(const MeasureReport& report);

}  // namespace sphparam::cli
