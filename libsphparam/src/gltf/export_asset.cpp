#include "gltf/export_asset.h"

#include <array>
#include <cmath>
#include <numbers>

#include "io/attributes/shading_normals.h"
#include "sphparam/sphere/orientation.h"

// The sphere that a mesh is morphed into has its area and its middle, and so has the rectangle.

namespace sphparam {
namespace {

/// What is in front on the sphere: the mesh's front, where the map has it at θ = 0; the chart's
/// points are turned by quarters.
Vector3 sphere_front(const ExportChart& chart, const GeometryOptions& options) {
  if (!options.front_at_zero) return {0, -1, 0};
  const auto quarters = std::lround(-chart.theta_offset / (std::numbers::pi / 2));
  const std::array<Vector3, 4> fronts = {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(-1, 0, 0),
                                         Vector3(0, -1, 0)};
  return fronts[static_cast<std::size_t>(quarters)];
}

Shape shape_of(const ExportChart& chart, const MeshFile& source, const GeometryOptions& options) {
  switch (options.shape) {
    case ShapeKind::Sphere:
      return sphere_shape(chart.chart, sphere_front(chart, options), options.threads);
    case ShapeKind::Flat:
      return flat_shape(chart.chart);
    case ShapeKind::Mesh:
      break;
  }
  if (chart.wedge_normals) {
    return lit_shape(chart.chart, source.mesh, *chart.wedge_normals, options.up, options.threads);
  }
  return mesh_shape(chart.chart, source.mesh, shading_normals(source), options.up, options.threads);
}

/// The sphere, and the rectangle where it is wanted.
std::vector<NamedShape> map_shapes(const ExportChart& chart, const Shape& base,
                                   const GeometryOptions& options) {
  std::vector<NamedShape> targets;
  if (options.morph == Morph::None) return targets;
  const double area = area_of(base, chart.chart, options.threads);
  const Vector3 middle = middle_of(base);
  const double radius = std::sqrt(area / (4 * std::numbers::pi)), height = std::sqrt(area / 2);
  targets.push_back(
      {"sphere", placed(sphere_shape(chart.chart, sphere_front(chart, options), options.threads),
                        radius, middle)});
  if (options.morph == Morph::Flat)
    targets.push_back({"flat", placed(flat_shape(chart.chart), height, middle)});
  return targets;
}

std::vector<NamedShape> targets_of(const ExportChart& chart, const Shape& base,
                                   const MeshFile& source, const GeometryOptions& options) {
  std::vector<NamedShape> targets = map_shapes(chart, base, options);
  for (const OtherShape& other : options.others) {
    const TriangleMesh mesh{other.positions, source.mesh.triangles};
    targets.push_back(
        {other.name, mesh_shape(chart.chart, mesh, other.normals, options.up, options.threads)});
  }
  return targets;
}

/// Triangles that are not counter-clockwise about the origin, of positions as stored; with what
/// _POSITION_LO adds, where it is there.
long sphere_folds(const Surface& surface) {
  Points points = surface.positions.cast<double>();
  for (const CustomAttribute& custom : surface.custom) {
    if (custom.name == "_POSITION_LO") points += custom.values.cast<double>();
  }
  long folds = 0;
  for (size_t i = 0; i < surface.indices.size(); i += 3) {
    const auto point = [&](size_t k) -> Vector3 { return points.row(surface.indices[i + k]); };
    folds += orientation(point(0), point(1), point(2)) <= 0;
  }
  return folds;
}

std::string verdict_of(const ChartCertificate& certificate) {
  if (certificate.one_to_one()) return "one-to-one";
  return "not one-to-one: " + std::to_string(certificate.folded.size()) + " folded, " +
         std::to_string(certificate.torn.size()) + " torn, " +
         std::to_string(certificate.around_pole.size()) + " around a pole";
}

}  // namespace

ExportGeometry export_geometry(const ExportChart& chart, const MeshFile& source,
                               const GeometryOptions& options) {
  const Shape shape = shape_of(chart, source, options);
  SurfaceOptions buffers = options.buffers;
  buffers.uv.mirrored = chart.mirrored;
  buffers.threads = options.threads;
  ExportGeometry geometry;
  geometry.surface = chart_surface(chart.chart, shape, targets_of(chart, shape, source, options),
                                   source, buffers, chart.theta_offset);
  geometry.stored =
      certify_stored(chart.chart, stored_uv(chart.chart, buffers.uv), buffers.uv, options.threads);
  if (options.shape == ShapeKind::Sphere)
    geometry.stored_sphere_folds = sphere_folds(geometry.surface);
  return geometry;
}

std::vector<std::pair<std::string, std::string>> chart_extras(const ExportChart& chart,
                                                              const ExportGeometry& geometry,
                                                              const ExportChartOptions& options) {
  const ConventionInfo& info = info_of(options.convention);
  std::vector<std::pair<std::string, std::string>> extras = {
      {"convention", info.name},
      {"topology", options.keep_topology ? "kept: no vertex was added" : "split for the chart"},
      {"splits", std::to_string(chart.chart.counts.splits())},
      {"refine_poles", std::to_string(options.refine_poles)},
      {"chart", verdict_of(chart.chart.certificate)},
      {"chart_as_stored", verdict_of(geometry.stored)}};
  if (geometry.stored_sphere_folds >= 0) {
    extras.emplace_back("sphere_as_stored",
                        geometry.stored_sphere_folds == 0
                            ? "one-to-one"
                            : std::to_string(geometry.stored_sphere_folds) + " triangles folded");
  }
  return extras;
}

}  // namespace sphparam
