#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A body whose surface a mesh is: what heights are above, and what its longitudes and latitudes
/// are called where images are opened as maps.
struct Body {
  std::string name = {};                // "Vesta"; empty: only radii are known
  Vector3 semi_axes = Vector3::Ones();  // of its ellipsoid, along the mesh's axes, in metres
  long iau_code = 0;     // of its planetocentric system on a sphere, as IAU_2015:CODE; 0: none
  std::string wkt = {};  // a geographic coordinate system that was given as such
  double unit = 1;       // metres that the unit of the mesh's coordinates has, above 0
  bool positive_west = false;  // longitudes grow to the west
};

/// A body of the IAU's report of 2015, by the name and code that PROJ has for its planetocentric
/// system on a sphere, of this radius in metres.
struct IauBody {
  const char* name;
  double radius;
  long code;
};

/// All of them, by code. Source: Archinal et al., "Report of the IAU Working Group on Cartographic
/// Coordinates and Rotational Elements: 2015" (2018), as PROJ 9.1 has it.
const std::vector<IauBody>& iau_bodies();

/// A text that names no body. `unknown` is the name that is not among `known`; empty: it is no
/// matter of names.
class BodyError : public std::invalid_argument {
 public:
  explicit BodyError(const std::string& message, std::string unknown = {},
                     std::vector<std::string> known = {})
      : std::invalid_argument(message), unknown_(std::move(unknown)), known_(std::move(known)) {}
  const std::string& unknown() const { return unknown_; }
  const std::vector<std::string>& known() const { return known_; }

 private:
  std::string unknown_;
  std::vector<std::string> known_;
};

/// The body of a text: a name of `iau_bodies` in whatever case; a radius, or three semi-axes with
/// commas between, in the mesh's unit; or the WKT of a geographic coordinate system (GEOGCRS,
/// GEODCRS or GEOGCS with an ellipsoid, in the length unit that it names), which also says whether
/// longitude grows to the west.
/// Blanks and line ends around it mean nothing. `unit`: metres that the mesh's unit has. Throws:
/// BodyError, also for radii that are not above 0, for projected systems, for those whose angles
/// are not in degrees, and for those whose latitudes are planetographic: on a flattened ellipsoid,
/// but GEODCRS with CS[spherical].
Body body_of(const std::string& text, double unit = 1);

}  // namespace sphparam
