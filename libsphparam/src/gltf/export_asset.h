#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gltf/chart_surface.h"
#include "gltf/export_chart.h"
#include "gltf/textured_mesh.h"
#include "sphparam/gltf/asset.h"

namespace sphparam {

/// What a mesh becomes in an asset, beside its chart and its materials.
struct GeometryOptions {
  ShapeKind shape = ShapeKind::Mesh;
  Morph morph = Morph::None;            // Flat: first to the sphere, then to the rectangle
  std::vector<OtherShape> others = {};  // then to these
  UprightAxes up = upright_axes({});
  bool front_at_zero = false;   // the map has the front of the mesh at θ = 0
  SurfaceOptions buffers = {};  // `uv.mirrored` is the chart's
  int threads = 0;
};

/// A mesh as it goes into a file, and what is proved of its texture coordinates there.
struct ExportGeometry {
  Surface surface;
  ChartCertificate stored;        // of (u, v) as stored
  long stored_sphere_folds = -1;  // of a sphere: triangles that float32 turns over; −1: no sphere
};

/// Throws: std::range_error; UnmeasurableMesh; std::invalid_argument where source coordinates are
/// wanted and missing.
ExportGeometry export_geometry(const ExportChart& chart, const MeshFile& source,
                               const GeometryOptions& options = {});

/// What the asset's extras say of a chart: convention, splits, verdicts.
std::vector<std::pair<std::string, std::string>> chart_extras(const ExportChart& chart,
                                                              const ExportGeometry& geometry,
                                                              const ExportChartOptions& options);

}  // namespace sphparam
