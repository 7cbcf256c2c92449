// A point of the target and the point of the source with the same direction on the sphere:
//   h = (p_source − p_target) · n_target
// where the target's surface moved by h along its normals is nearest to the source's.

#include "bake/fields/height_field.h"

#include "bake/field_registry.h"
#include "bake/fields/far_values.h"
#include "mesh/float32_size.h"
#include "rays/interpolation.h"

namespace sphparam {
namespace {

SurfaceField radial_height(const TriangleMesh& mesh) {
  SurfaceField field = {.name = "height",
                        .about = "distance from the origin, in units of the mesh"};
  const double least = mesh.positions.rowwise().norm().minCoeff();
  const double origin = is_far(least, box_of(mesh.positions)) ? least : 0;
  field.origin[0] = origin;
  field.evaluate = [&mesh, origin](std::span<const SurfaceSample> samples, float* values) {
    for (const SurfaceSample& sample : samples) {
      *values++ = static_cast<float>(
          interpolate(mesh.positions, mesh.triangles, sample.point).norm() - origin);
    }
  };
  return field;
}

SurfaceField height_above(const TriangleMesh& mesh, const BakeTarget& target) {
  SurfaceField field = {
      .name = "height",
      .about = "height above the mesh that is baked for, along its normals, in units of the mesh"};
  field.evaluate = [&mesh, &target](std::span<const SurfaceSample> samples, float* values) {
    const Triangles& base = target.chart.triangles;
    // At hard edges each wedge has a normal of its own.
    const Points& normals = target.wedge_normals ? *target.wedge_normals : target.normals;
    const Triangles& lit = target.wedge_normals ? target.chart.wedges : base;
    for (const SurfaceSample& sample : samples) {
      const Vector3 normal = interpolate(normals, lit, sample.place).normalized();
      const Vector3 from = interpolate(target.positions, base, sample.place);
      const Vector3 to = interpolate(mesh.positions, mesh.triangles, sample.point);
      *values++ = static_cast<float>((to - from).dot(normal));
    }
  };
  return field;
}

}  // namespace

SurfaceField height_field(const BakeScene& scene, const std::string& argument) {
  if (!argument.empty() && argument != "radial") {
    throw FieldError("height: there are height and height:radial, not " + argument);
  }
  require_float32_size(scene.source.mesh().positions, "height");
  const bool radial = argument == "radial" || scene.options.height_radial || scene.target.is_source;
  SurfaceField field =
      radial ? radial_height(scene.source.mesh()) : height_above(scene.source.mesh(), scene.target);
  field.unit = unit_of_lengths(scene.options);
  return field;
}

}  // namespace sphparam
