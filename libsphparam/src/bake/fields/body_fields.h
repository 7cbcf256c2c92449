#pragma once

#include "bake/field_registry.h"

namespace sphparam {

// Where a point of the surface lies as seen from the body's centre: of the interpolated position,
// in double, whatever the map. Longitude and latitude are those of texels' centres, never means.

/// Planetocentric longitude in degrees, above −180 to 180; to the east, or as the options say.
SurfaceField make_longitude(const BakeScene& scene, const std::string&);
/// Planetocentric latitude in degrees.
SurfaceField make_latitude(const BakeScene& scene, const std::string&);
/// Both, and 0.
SurfaceField make_longitude_latitude(const BakeScene& scene, const std::string&);
/// A unit vector, to measure by: no image is made of it.
SurfaceField directions_from_centre(const BakeScene& scene);
/// Distance from the centre, in the mesh's unit.
SurfaceField make_radius(const BakeScene& scene, const std::string&);
/// Degrees between the outward normal of the triangle and the direction from the centre: beyond 90
/// the surface hangs over.
SurfaceField make_slope(const BakeScene& scene, const std::string&);
/// Radius minus that of the body's ellipsoid in the same direction, in the mesh's unit.
/// Throws: FieldError without a body.
SurfaceField make_elevation(const BakeScene& scene, const std::string&);

}  // namespace sphparam
