#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/chart/chart_report.h"
#include "sphparam/correspondence/likeness.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/parameterize.h"

namespace sphparam {

/// What a file brought, by name, when it was read: its map is attached to it later.
struct InputNames {
  std::vector<std::string> vertex_properties, comments;
};
InputNames input_names(const MeshFile& file);

/// What looks wrong on any map of a mesh: it is inside out, and no sheet, whose holes are kept.
std::vector<std::string> shape_warnings(const MeshSource& source);

/// A map and how it came about. References are to values that outlive the record.
struct MapRecord {
  const MeshSource& source;            // the mesh, mended where that was wanted
  const ParameterizeOptions& options;  // poles and meridian in them are told as they are here: by
                                       // their numbers in the file
  const Parameterization& result;
  std::string method = {};                        // empty: that of the options
  RepairOptions repairs = RepairOptions::none();  // that were wanted
  std::optional<BaselineAccount> account = {};    // of a method of others
  std::vector<Landmark> pins = {};                // that were wanted, of vertices of the mesh
  std::vector<double> pole_residuals = {};        // of poles that were wanted, in radians: north,
                                                  // south; empty: none were
  std::string upright = {};                       // `upright_words`; empty: not asked for
  std::optional<Likeness> likeness = {};          // of a map that follows another mesh's, …
  std::string other = {};                         // … which has this name
  std::optional<DistortionSummary> distortion = {};
  std::optional<ChartReport> chart = {};
  std::vector<std::pair<std::string, std::string>> outputs = {};  // what it is, where it is
  double seconds = 0;
  std::optional<InputNames> input = {};  // where the mesh has got its map since
};

/// As `sphparam map --json` tells it: vertices go by their numbers in the file.
std::string to_json(const MapRecord& record);

}  // namespace sphparam
