#pragma once

#include <string>

#include "bake/georeference/body_places.h"
#include "bake/image_plan.h"

namespace sphparam {

/// What geographic programs call the longitude and latitude of images of a map: those of the body
/// where the map is radial about its centre and nothing is off; else it says that they are the
/// map's, or how far they may be off.
struct CoordinateSystem {
  std::string name;  // "Vesta (2015) - Sphere / Ocentric", "sphparam map of Vesta"
  std::string wkt;   // of 2019
};
/// `places`: none where the longitudes are the map's. `source`: the name of the mesh, for a body
/// without one.
CoordinateSystem coordinate_system(const Body& body, const std::optional<BodyPlaces>& places,
                                   const std::string& source);

/// The bytes of the file beside an image (GDAL's PAM) that says where on the body it lies, and of
/// each band what it is, its unit, and, of integers, scale and offset.
/// Requires: an image in Convention::Gis; settings with a body; a range where it has integers.
std::string sidecar_of(const PlannedImage& image, const BakeSettings& settings,
                       const CoordinateSystem& system);

}  // namespace sphparam
