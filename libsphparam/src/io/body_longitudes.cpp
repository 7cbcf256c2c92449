#include "sphparam/io/body_longitudes.h"

#include <numbers>
#include <optional>

#include "embedding/frame/nearest_rotation.h"
#include "number_text.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/sphere/radial_directions.h"

namespace sphparam {
namespace {

/// Nearly all of a body looks away from its centre, which of a statue a tenth and more does not.
bool is_like_body(const MappedMesh& mapped, const SphereMap& directions, int threads) {
  constexpr double most_folded = 0.05;  // of the triangles
  const Certificate found = certify(mapped.topology(), directions, threads);
  return static_cast<double>(found.fold_count()) <=
         most_folded * static_cast<double>(mapped.mesh().face_count());
}

/// What a map is that says that it is radial and has not the longitudes of a body.
std::string what_it_is(const MappedMesh& mapped, const std::optional<Planetocentric>& radial,
                       const Vector3& centre) {
  if (!radial) return "";
  if (!is_about(*radial, centre, mapped.mesh())) return "it is radial about another centre; ";
  if (radial->made_anew) return "it was made anew, for too much folds; ";
  if (is_as_said(*radial, mapped.file(), mapped.map())) return "it moved what folds";
  return "mesh or map were moved since it was made; ";
}

/// Why a map's longitudes are not those of a body about this centre, and what would have them.
std::string why_off(const MappedMesh& mapped, const std::optional<Planetocentric>& radial,
                    const Vector3& centre) {
  const std::string why = what_it_is(mapped, radial, centre);
  if (!why.empty() && !why.ends_with("; ")) return why;  // no other has them
  const std::string typed =
      shortest(centre.x()) + "," + shortest(centre.y()) + "," + shortest(centre.z());
  const std::string what = radial && radial->made_anew
                               ? "`sphparam map` --align body comes near"
                               : "`sphparam map` --method radial has the body's, --align body "
                                 "comes near";
  return why + what + (centre.isZero(0) ? "" : ", with --centre " + typed);
}

std::string line_of(const MappedMesh& mapped, const std::optional<Planetocentric>& radial,
                    const Vector3& centre, double angle) {
  return "the map's longitudes and latitudes are " + short_number(angle) +
         "° from those of the body (RMS over the surface); " + why_off(mapped, radial, centre);
}

/// Degrees, RMS over the surface.
double degrees_off(const MappedMesh& mapped, const SphereMap& directions) {
  constexpr double degrees = 180 / std::numbers::pi;
  return degrees * rms_angle(mapped.map(), directions,
                             vertex_areas(surface_of(mapped.mesh(), mapped.fillers())));
}

/// Empty where it is less, and of what is no body.
std::string line_of_body(const MappedMesh& mapped, const Vector3& centre, double least,
                         bool of_bodies_only, int threads) try {
  const std::optional<Planetocentric> radial = planetocentric(mapped.provenance());
  const SphereMap directions = body_directions(mapped.file(), centre);
  if (of_bodies_only && !radial && !is_like_body(mapped, directions, threads)) return "";
  const double angle = degrees_off(mapped, directions);
  return angle >= least ? line_of(mapped, radial, centre, angle) : "";
} catch (const VertexAtCentre&) {  // no body about it
  return "";
}

}  // namespace

std::string longitudes_off(const MappedMesh& mapped, const Vector3& centre, bool of_bodies_only,
                           int threads) {
  constexpr double nothing = 1e-4;
  return line_of_body(mapped, centre, nothing, of_bodies_only, threads);
}

std::string directions_turned(const MappedMesh& mapped, const std::optional<Vector3>& centre,
                              int threads) {
  constexpr double turned = 45;
  return line_of_body(mapped, body_centre(planetocentric(mapped.provenance()), centre), turned,
                      true, threads);
}

}  // namespace sphparam
