#include "bake/make_scene.h"

#include "bake/projected_surface.h"
#include "io/attributes/hard_edges.h"
#include "io/attributes/shading_normals.h"
#include "mesh/vertex_normals.h"
#include "number_text.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/chart/refine_poles.h"
#include "sphparam/chart/tangent_frame.h"

namespace sphparam {

namespace {

BakeTarget target_on(SphericalChart chart, const MeshFile& file, bool is_source, int threads,
                     int pole_wedges) {
  BakeTarget target{
      .chart = std::move(chart), .positions = {}, .normals = {}, .is_source = is_source};
  const Triangles& triangles = file.mesh.triangles;
  if (pole_wedges > 1 && target.chart.certificate.one_to_one())
    target.chart = refine_poles(std::move(target.chart), triangles, pole_wedges, threads);
  target.wedge_normals = split_at_hard_edges(target.chart, file, threads);
  target.positions = carry_vertex_attribute(target.chart, triangles, file.mesh.positions, threads);
  target.normals = carry_normals(target.chart, triangles, shading_normals(file), threads);
  if (!is_source)
    target.outward =
        carry_normals(target.chart, triangles, angle_weighted_normals(file.mesh), threads);
  return target;
}

}  // namespace

BakeTarget make_target(const MeshFile& file, const Topology& topology, const SphereMap& map,
                       bool is_source, int threads, int pole_wedges, const Progress& progress) {
  return target_on(spherical_chart(file.mesh, topology, map, threads, progress), file, is_source,
                   threads, pole_wedges);
}

BakeTarget make_target(const MappedMesh& mapped, bool is_source, int threads, int pole_wedges,
                       const Progress& progress) {
  return target_on(chart_of(mapped, threads, progress), mapped.file(), is_source, threads,
                   pole_wedges);
}

std::string unit_of_lengths(const FieldOptions& options) {
  if (!options.body) return "";
  const double unit = options.body->unit;
  return unit == 1 ? "m" : unit == 1000 ? "km" : shortest(unit) + " m";
}

BakeSource make_source(const MappedMesh& mapped) {
  return {.mapped = mapped, .normals = shading_normals(mapped.file()), .textures = {}};
}

BakeSource make_source(MeshFile surface) {
  Points normals = shading_normals(surface);
  return {.mapped = std::nullopt,
          .normals = std::move(normals),
          .textures = {},
          .surface = std::make_shared<const ProjectedSurface>(std::move(surface))};
}

const MeshFile& BakeSource::file() const { return mapped ? mapped->file() : surface->file(); }

const FillerMarks& BakeSource::fillers() const {
  static const FillerMarks none;
  return mapped ? mapped->fillers() : none;
}

const MappedMesh& BakeSource::map_for(const char* field) const {
  if (mapped) return *mapped;
  throw FieldError(std::string(field) +
                   ": is of a closed surface with a map, which the surface baked from is not");
}

}  // namespace sphparam
