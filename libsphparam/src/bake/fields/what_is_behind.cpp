// Where a line from p along the unit way meets the plane of a triangle a, b, c:
//   p − a = x (b − a) + y (c − a) − t way,
// linear in p, so that what a texel covers is carried along with the point.

#include "bake/fields/what_is_behind.h"

#include <limits>

#include "bake/projected_surface.h"
#include "rays/flat_normal.h"
#include "sphparam/io/fillers.h"

namespace sphparam {
namespace {

constexpr int most_faces = 64;  // behind one another that nobody draws

Vector3 normal_of(const Eigen::Matrix3d& corners) {
  return flat_normal(corners.col(0), corners.col(1), corners.col(2));
}

}  // namespace

WhatIsBehind::WhatIsBehind(const BakeScene& scene) : file_(&scene.source.file()) {
  if (scene.source.surface) {
    rays_ = &scene.source.surface->rays();
    return;
  }
  surface_ = surface_in_place(file_->mesh, fillers_of(*file_));
  own_ = std::make_unique<const RayScene>(surface_);
  rays_ = own_.get();
}

Eigen::Matrix3d WhatIsBehind::corners(Face f) const {
  Eigen::Matrix3d columns;
  for (int k = 0; k < 3; ++k) columns.col(k) = file_->mesh.position(file_->mesh.triangles(f, k));
  return columns;
}

bool WhatIsBehind::is_drawn(Face f, const Vector3& way) const {
  if (normal_of(corners(f)).dot(way) < 0) return true;
  const Property* const material = file_->find_face_property("material");
  const double id = material ? material->values[static_cast<size_t>(f)] : -1;
  return id >= 0 && id < static_cast<double>(file_->channels.size()) &&
         file_->channels[static_cast<size_t>(id)].double_sided;
}

Sight WhatIsBehind::through(const SurfaceRun& run, int i) const {
  const Eigen::Matrix3d places = corners(run.face);
  const Vector3 normal = normal_of(places);
  return {.from = places * (run.first + i * run.step),
          .way = is_back(run.found) ? normal : Vector3(-normal),
          .step = places * run.step,
          .below = places * run.below};
}

std::optional<SurfaceRun> WhatIsBehind::next(Sight& sight) const {
  if (sight.way.isZero(0)) return std::nullopt;
  for (int passed = 0; passed < most_faces; ++passed) {
    sight.from += rays_->clearance() * sight.way;
    const RayHit hit =
        rays_->first_hit(sight.from, sight.way, std::numeric_limits<double>::infinity());
    if (hit.face < 0) return std::nullopt;
    const Eigen::Matrix3d places = corners(hit.face);
    Eigen::Matrix3d axes;
    axes << places.col(1) - places.col(0), places.col(2) - places.col(0), -sight.way;
    const Eigen::Matrix3d inverse = axes.inverse();
    const auto weights = [&](const Vector3& at) -> Vector3 {
      const Vector3 xyt = inverse * at;
      return {-xyt[0] - xyt[1], xyt[0], xyt[1]};
    };
    const Vector3 place = Vector3::UnitX() + weights(sight.from - places.col(0));
    sight.from += hit.distance * sight.way;
    if (!is_drawn(hit.face, sight.way) || !place.allFinite()) continue;
    return SurfaceRun{hit.face, 1, place, weights(sight.step), weights(sight.below)};
  }
  return std::nullopt;
}

}  // namespace sphparam
