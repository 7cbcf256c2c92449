// A viewer that reads (x, y, z) makes x T + y B + z N unit: so the matrix (T B N), as it
// interpolates it, is inverted at every sample.

#include "bake/fields/normal_fields.h"

#include <memory>

#include "bake/fields/source_normal.h"
#include "bake/texels/calm_walls.h"
#include "sphparam/chart/tangent_frame.h"

namespace sphparam {
namespace {

void put(const Vector3& n, float*& values) {
  for (int c = 0; c < 3; ++c) *values++ = static_cast<float>(n[c]);
}

/// Tangent, bitangent and normal as the vertices of a triangle have them: of any length.
Eigen::Matrix3d axes_at(const ShadingFrame& frame, const Triangles& wedges,
                        const SurfacePoint& place) {
  Vector3 tangent = Vector3::Zero(), normal = Vector3::Zero();
  double sign = 0;
  for (int k = 0; k < 3; ++k) {
    const int wedge = wedges(place.face, k);
    const double weight = place.barycentric[k];
    tangent += weight * frame.tangents.row(wedge).head<3>();
    normal += weight * frame.normals.row(wedge);
    sign += weight * frame.tangents(wedge, 3);
  }
  Eigen::Matrix3d axes;
  axes << tangent, (sign < 0 ? -1 : 1) * normal.cross(tangent), normal;
  return axes;
}

/// Where axes have no room (normals or tangents that cancel), nothing can be told of them: z.
Vector3 in_axes(const Eigen::Matrix3d& axes, const Vector3& n) {
  const Vector3 local = axes.inverse() * n;
  return local.allFinite() && local.squaredNorm() > 0 ? Vector3(local.normalized())
                                                      : Vector3(Vector3::UnitZ());
}

}  // namespace

SurfaceField make_object_normal(const BakeScene& scene, const std::string&) {
  const auto source = std::make_shared<const SourceNormal>(scene);
  SurfaceField field{.name = "normal-object",
                     .channels = 3,
                     .kind = FieldKind::Direction,
                     .about = "unit normal in the axes of the mesh"};
  field.evaluate_runs = [source](std::span<const SurfaceRun> runs, float* values) {
    for (const SurfaceRun& run : runs) {
      for (int i = 0; i < run.count; ++i) {
        const SurfacePoint point{run.face, run.first + i * run.step};
        put(source->at({.point = point,
                        .seed = 0,
                        .step = run.step,
                        .below = run.below,
                        .found = run.found}),
            values);
      }
    }
  };
  return field;
}

SurfaceField make_tangent_normal(const BakeScene& scene, const std::string&) {
  const BakeTarget& target = scene.target;
  const auto source = std::make_shared<const SourceNormal>(scene);
  const auto frame = std::make_shared<const ShadingFrame>(
      tangent_frame(target.chart, target.positions,
                    target.wedge_normals ? *target.wedge_normals : target.normals, scene.threads));
  const double x_sign = scene.mirrored ? -1 : 1, y_sign = scene.options.normal_y_down ? -1 : 1;
  SurfaceField field{.name = "normal-tangent",
                     .channels = 3,
                     .kind = FieldKind::Direction,
                     .about = scene.options.normal_y_down ? "tangent space, +Y down (DirectX)"
                                                          : "tangent space, +Y up (OpenGL, glTF)"};
  field.calm = scene.walls != nullptr;
  field.evaluate = [&scene, source, frame, x_sign, y_sign](std::span<const SurfaceSample> samples,
                                                           float* values) {
    const Triangles& wedges = scene.target.chart.wedges;
    for (const SurfaceSample& sample : samples) {
      const Vector3 found = source->at(sample);
      const Vector3 n = scene.walls ? scene.walls->normal(sample, found) : found;
      const Vector3 local = in_axes(axes_at(*frame, wedges, sample.place), n);
      put({x_sign * local[0], y_sign * local[1], local[2]}, values);
    }
  };
  return field;
}

}  // namespace sphparam
