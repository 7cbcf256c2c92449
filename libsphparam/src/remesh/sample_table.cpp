#include <algorithm>
#include <charconv>
#include <numbers>

#include "csv_field.h"
#include "sphparam/io/fillers.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam {

namespace {

template <class Number>
void put(std::string& text, Number number) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

/// In degrees, in their order.
SphericalCoordinates longitude_and_latitude(SphericalCoordinates place) {
  constexpr double degrees = 180 / std::numbers::pi;
  const double east = place.theta * degrees;
  return {east > 180 ? east - 360 : east, 90 - place.phi * degrees};
}

}  // namespace

std::string sample_table(const MappedMesh& mesh, TableAngles angles, const TableHoles& holes,
                         char separator) {
  const MeshFile& file = mesh.file();
  constexpr size_t expected_bytes = 100;  // of a row
  const bool in_degrees = angles == TableAngles::Degrees;
  std::string text = in_degrees ? "vertex,lon,lat,x,y,z" : "vertex,theta,phi,x,y,z";
  std::ranges::replace(text, ',', separator);
  for (const Property& property : file.vertex_properties)
    text.append(1, separator).append(csv_field(property.name));
  const bool marked = !holes.in_hole.empty() && !holes.left_out;
  if (marked) text.append(1, separator).append(filler_property);
  text += "\n";
  const auto count = static_cast<size_t>(file.mesh.vertex_count());
  text.reserve(text.size() + expected_bytes * count);
  for (size_t v = 0; v < count; ++v) {
    const bool in_hole = !holes.in_hole.empty() && holes.in_hole[v] == 1;
    if (in_hole && holes.left_out) continue;
    const auto row = static_cast<Vertex>(v);
    SphericalCoordinates place = to_spherical(mesh.map().point(row));
    if (in_degrees) place = longitude_and_latitude(place);
    put(text, row);
    for (const double x : {place.theta, place.phi, file.mesh.positions(row, 0),
                           file.mesh.positions(row, 1), file.mesh.positions(row, 2)}) {
      text += separator;
      put(text, x);
    }
    for (const Property& property : file.vertex_properties) {
      text += separator;
      put(text, property.values[v]);
    }
    if (marked) text.append(1, separator).append(in_hole ? "1" : "0");
    text += '\n';
  }
  return text;
}

}  // namespace sphparam
