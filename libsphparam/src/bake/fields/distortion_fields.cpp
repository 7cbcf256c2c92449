#include "bake/fields/distortion_fields.h"

#include <array>
#include <cmath>

#include "bake/fields/heat_field.h"
#include "bake/fields/linear_field.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam {
namespace {

constexpr double extreme = 32;  // log₂ of what stands for 0 and ∞

/// As if the surface were all that there is: its area alone is made that of the sphere.
void leave_out_areas(Distortion& distortion, const FillerMarks& fillers) {
  if (fillers.empty()) return;
  double share = 0;
  for (Eigen::Index f = 0; f < std::ssize(fillers); ++f) {
    if (!fillers[static_cast<size_t>(f)]) share += distortion.source_area[f];
  }
  distortion.area_ratio *= share;
  distortion.sigma_max *= std::sqrt(share);
  distortion.sigma_min *= std::sqrt(share);
}

SurfaceField distortion_field(Heat heat, const char* name, const char* about,
                              const BakeScene& scene) {
  const MappedMesh& mapped = scene.source.map_for(name);
  Distortion distortion = measure_distortion(mapped.mesh(), mapped.map(), scene.threads);
  leave_out_areas(distortion, mapped.fillers());
  VectorX values = heat_values(heat, distortion).cwiseMax(-extreme).cwiseMin(extreme);
  const HeatScale& scale = heat_scale(heat);
  SurfaceField field =
      linear_field<1>({.name = name, .about = about, .range = {{scale.low, scale.high}}},
                      [values = std::move(values)](Face face, int, std::array<double, 1>& value) {
                        value[0] = values[face];
                      });
  if (scene.options.heat) return as_heat(std::move(field));
  return field;
}

}  // namespace

SurfaceField area_field(const BakeScene& scene, const std::string&) {
  return distortion_field(Heat::Area, "area",
                          "log2 of area on the sphere / area on the mesh, total areas made equal",
                          scene);
}

SurfaceField angle_field(const BakeScene& scene, const std::string&) {
  return distortion_field(Heat::Angle, "angle",
                          "mean |log2(angle on the sphere / angle on the mesh)| of a triangle",
                          scene);
}

SurfaceField stretch_field(const BakeScene& scene, const std::string&) {
  return distortion_field(
      Heat::Stretch, "stretch",
      "log2 of length on the mesh / length on the sphere, root mean square over directions, total "
      "areas made equal",
      scene);
}

}  // namespace sphparam
