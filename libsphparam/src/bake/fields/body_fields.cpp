#include "bake/fields/body_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "bake/fields/far_values.h"
#include "elementary.h"
#include "mesh/float32_size.h"
#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "rays/flat_normal.h"
#include "rays/interpolation.h"

namespace sphparam {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Vector3 centre_of(const BakeScene& scene) {
  return scene.options.centre.value_or(Vector3(0, 0, 0));
}

bool to_the_west(const BakeScene& scene) {
  return scene.options.positive_west || (scene.options.body && scene.options.body->positive_west);
}

double longitude(const Vector3& p, bool west) {
  if (p.x() == 0 && p.y() == 0) return 0;  // a pole has none
  const double east = elementary::atan2(p.y(), p.x()) * degrees;
  if (!west) return east > -180 ? east : 180;
  return east < 180 ? 0 - east : 180;
}

double latitude(const Vector3& p) {
  return elementary::atan2(p.z(), elementary::hypot(p.x(), p.y())) * degrees;
}

/// A field of what `value(face, p, out)` makes of points p as seen from the centre, in the frame of
/// the body.
template <class Value>
SurfaceField field_of_places(SurfaceField described, const BakeScene& scene, const Value& value) {
  const TriangleMesh& mesh = scene.source.mesh();
  const int channels = described.channels;
  described.evaluate = [&mesh, centre = centre_of(scene), axes = scene.body_axes, channels, value](
                           std::span<const SurfaceSample> samples, float* values) {
    for (const SurfaceSample& sample : samples) {
      const Vector3 p = interpolate(mesh.positions, mesh.triangles, sample.point) - centre;
      value(sample.point.face, Vector3(axes * p), values);
      values += channels;
    }
  };
  return described;
}

/// The same of one length, which far from 0 for the extent of the mesh is counted from the least at
/// a vertex.
template <class Value>
SurfaceField field_of_lengths(SurfaceField described, const BakeScene& scene, const Value& value) {
  const Points& positions = scene.source.mesh().positions;
  double least = std::numeric_limits<double>::infinity(), size = 0;
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const Vector3 p = positions.row(v).transpose() - centre_of(scene);
    const double here = value(Vector3(scene.body_axes * p));
    least = std::min(least, here);
    size = std::max(size, std::abs(here));
  }
  const double origin = is_far(size, box_of(positions)) ? least : 0;
  described.origin[0] = origin;
  described.unit = unit_of_lengths(scene.options);
  return field_of_places(std::move(described), scene,
                         [value, origin](Face, const Vector3& p, float* out) {
                           out[0] = static_cast<float>(value(p) - origin);
                         });
}

std::string east_or_west(const BakeScene& scene) {
  return std::string("degrees, positive ") + (to_the_west(scene) ? "west" : "east");
}

/// That of the body, from a centre in units of the mesh.
double radius_of(const Vector3& axes, const Vector3& p) {
  const double length = p.stableNorm();
  return length > 0 ? 1 / (p / length).cwiseQuotient(axes).norm() : 0;
}

}  // namespace

SurfaceField make_longitude(const BakeScene& scene, const std::string&) {
  return field_of_places({.name = "lon",
                          .kind = FieldKind::Place,
                          .about = "planetocentric longitude, " + east_or_west(scene),
                          .unit = "degree",
                          .range = std::pair(-180.0, 180.0)},
                         scene, [west = to_the_west(scene)](Face, const Vector3& p, float* out) {
                           out[0] = static_cast<float>(longitude(p, west));
                         });
}

SurfaceField make_latitude(const BakeScene& scene, const std::string&) {
  return field_of_places(
      {.name = "lat",
       .kind = FieldKind::Place,
       .about = "planetocentric latitude, degrees",
       .unit = "degree",
       .range = std::pair(-90.0, 90.0)},
      scene, [](Face, const Vector3& p, float* out) { out[0] = static_cast<float>(latitude(p)); });
}

SurfaceField make_longitude_latitude(const BakeScene& scene, const std::string&) {
  return field_of_places({.name = "lonlat",
                          .channels = 3,
                          .kind = FieldKind::Place,
                          .about = "planetocentric longitude and latitude, " + east_or_west(scene) +
                                   "; the third channel is 0",
                          .unit = "degree",
                          .range = std::pair(-180.0, 180.0)},
                         scene, [west = to_the_west(scene)](Face, const Vector3& p, float* out) {
                           out[0] = static_cast<float>(longitude(p, west));
                           out[1] = static_cast<float>(latitude(p));
                           out[2] = 0;
                         });
}

SurfaceField directions_from_centre(const BakeScene& scene) {
  return field_of_places({.name = "direction", .channels = 3, .kind = FieldKind::Place}, scene,
                         [](Face, const Vector3& p, float* out) {
                           const Vector3 direction = p.stableNormalized();
                           for (int k = 0; k < 3; ++k) out[k] = static_cast<float>(direction[k]);
                         });
}

SurfaceField make_radius(const BakeScene& scene, const std::string&) {
  require_float32_size(scene.source.mesh().positions, "radius");
  return field_of_lengths(
      {.name = "radius", .about = "distance from the centre of the body, in units of the mesh"},
      scene, [](const Vector3& p) { return p.stableNorm(); });
}

SurfaceField make_slope(const BakeScene& scene, const std::string&) {
  const TriangleMesh& mesh = scene.source.mesh();
  return field_of_places(
      {.name = "slope",
       .about = "degrees between the surface's normal and the direction from the centre",
       .unit = "degree",
       .range = std::pair(0.0, 180.0)},
      scene, [&mesh, axes = scene.body_axes](Face f, const Vector3& p, float* out) {
        const Vector3 normal = axes * flat_normal(mesh.position(mesh.triangles(f, 0)),
                                                  mesh.position(mesh.triangles(f, 1)),
                                                  mesh.position(mesh.triangles(f, 2)));
        out[0] = static_cast<float>(angle_between(normal, p.stableNormalized()) * degrees);
      });
}

SurfaceField make_elevation(const BakeScene& scene, const std::string&) {
  if (!scene.options.body) {
    throw FieldError(
        "elevation: above which body? Its name, radius or semi-axes are needed (--body)");
  }
  require_float32_size(scene.source.mesh().positions, "elevation");
  const Body& body = *scene.options.body;
  const Vector3 axes = body.semi_axes / body.unit;
  const bool round = axes.x() == axes.y() && axes.x() == axes.z();
  const std::string shape = round ? "the sphere of radius " + shortest(axes.x())
                                  : "the ellipsoid of semi-axes " + shortest(axes.x()) + ", " +
                                        shortest(axes.y()) + ", " + shortest(axes.z());
  return field_of_lengths(
      {.name = "elevation", .about = "radius minus that of " + shape + ", in units of the mesh"},
      scene, [axes](const Vector3& p) { return p.stableNorm() - radius_of(axes, p); });
}

}  // namespace sphparam
