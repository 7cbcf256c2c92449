#include "bake/georeference/body_places.h"

#include <algorithm>
#include <numbers>

#include "bake/fields/body_fields.h"
#include "bake/image_plan.h"
#include "elementary.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam {
namespace {

/// Of unit vectors; cosines of small angles are 1.
double angle_between(const Vector3& a, const Vector3& b) {
  return 2 * elementary::atan2((a - b).norm(), (a + b).norm());
}

/// The largest angle between a texel's direction and that of what it shows, from the centre.
double largest_angle(const BakeScene& scene, const BakeSettings& settings) {
  constexpr int enough = 2048;  // texels a row
  constexpr double pi = std::numbers::pi;
  BakeOptions options = engine_options(settings, "range");
  options.width = std::min(options.width, enough);
  options.height = options.width / 2;
  options.samples = 1;
  const SurfaceField shown = directions_from_centre(scene);
  double largest = 0;
  bake(scene, {&shown, 1}, options, [&](size_t, int first, int rows, const float* values) {
    for (int i = 0; i < rows * options.width; ++i, values += 3) {
      const double column = i % options.width + 0.5, row = first + i / options.width + 0.5;
      const Vector3 texel =
          to_cartesian({2 * pi * column / options.width, pi * row / options.height});
      largest = std::max(largest, angle_between(texel, {values[0], values[1], values[2]}));
    }
  });
  return largest;
}

}  // namespace

std::optional<BodyPlaces> body_places(const MappedMesh& source, const BakeScene& scene,
                                      const BakeSettings& settings) {
  const std::optional<Planetocentric> radial = planetocentric(source.provenance());
  if (!radial || !is_about(*radial, *scene.options.centre, source.mesh()) ||
      !is_as_said(*radial, source.file(), source.map()))
    return std::nullopt;
  const bool linear = settings.interpolation == Interpolation::Uv;
  if (!linear && !settings.from) return BodyPlaces{radial->largest_movement, "sphparam radial map"};
  return BodyPlaces{std::max(radial->largest_movement, largest_angle(scene, settings)),
                    settings.from ? "another surface on a sphparam radial map"
                                  : "sphparam radial map, linear in u and v"};
}

}  // namespace sphparam
