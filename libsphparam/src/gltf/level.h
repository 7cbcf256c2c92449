#pragma once

#include <string>
#include <vector>

#include "gltf/export_chart.h"
#include "sphparam/gltf/export.h"

namespace sphparam {

// What glTF and text formats do alike for each mesh.

ExportChartOptions chart_options(const ExportOptions& options);

/// The chart of a mesh in the convention asked for, with its hard edges where the mesh itself is
/// shown. Throws as `make_asset`.
ExportChart chart_of_level(const MappedMesh& mapped, const ExportOptions& options);

/// Appends a warning of what folds as stored, by number and first ids: "NAME: 3 of 320 triangles
/// fold in (u, v) as stored, being smaller than its rounding: 4 7 12".
void warn_of_folds(const std::string& name, const ChartFigures& figures, bool topology_is_kept,
                   std::vector<std::string>& warnings);

/// Appends a line of how many vertices were moved in (u, v) to be told apart in float32, if any
/// were.
void warn_of_moves(const std::string& name, const ExportChart& chart,
                   std::vector<std::string>& warnings);

/// Without what is known of the coordinates as stored.
ChartFigures figures_of(const ExportChart& chart);

}  // namespace sphparam
