#include "sphere/body_centre.h"

#include <cmath>
#include <numbers>

#include "mesh/box.h"
#include "place_text.h"
#include "sphere/solid_angle.h"
#include "sphparam/mesh/mass_properties.h"

namespace sphparam {
namespace {

/// The vertices as they are seen from a point, at a size whose cubes doubles have.
Points seen_from(const TriangleMesh& mesh, const Vector3& point) {
  const double side = longest_side(mesh), size = side > 0 ? side : 1;
  return (mesh.positions / size).rowwise() - (point / size).transpose();
}

}  // namespace

Vector3 enclosed_centroid(const TriangleMesh& mesh) {
  if (const auto body = mass_properties(mesh)) return body->centroid;
  const Vector3 lower = box_of(mesh.positions).lower;
  const double side = longest_side(mesh), size = side > 0 ? side : 1;
  return seen_from(mesh, lower).colwise().mean().transpose() * size + lower;
}

bool winds_about(const TriangleMesh& mesh, const Vector3& point) {
  const Points places = seen_from(mesh, point);
  const VectorX distances = places.rowwise().norm();
  if (!(distances.minCoeff() > 0)) return true;
  const Points rays = places.array().colwise() / distances.array();
  double sum = 0;
  for (Face f = 0; f < mesh.face_count(); ++f)
    sum += solid_angle(rays.row(mesh.triangles(f, 0)), rays.row(mesh.triangles(f, 1)),
                       rays.row(mesh.triangles(f, 2)));
  return std::abs(sum) > 2 * std::numbers::pi;  // half a turn, of what is a whole one or none
}

std::string line_of_outside(const TriangleMesh& mesh, const Vector3& centre) {
  if (winds_about(mesh, centre)) return "";
  const auto typed = [&](const Vector3& point) {
    return place_text(point, longest_side(mesh), ",");
  };
  const std::string told = "the centre " + typed(centre) + " lies outside of the surface";
  const Vector3 centroid = enclosed_centroid(mesh);
  if (!winds_about(mesh, centroid)) return told + ", as the centroid of what it encloses does";
  return told + ": --centre centroid is " + typed(centroid) + ", that of what it encloses";
}

}  // namespace sphparam
