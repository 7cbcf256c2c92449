#include "mesh/enclosed_volume.h"

#include <cmath>
#include <optional>

#include "mesh/box.h"
#include "mesh/triangle_geometry.h"
#include "mesh/unit_size.h"

namespace sphparam {

double enclosed(const TriangleMesh& mesh) {
  const Box box = box_of(mesh.positions);
  const double size = (box.upper / 2 - box.lower / 2).maxCoeff();  // halves do not overflow
  double volume = 0, area = 0;
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    const auto corner = [&](int k) {
      return Vector3((mesh.position(mesh.triangles(f, k)) / 2 - box.lower / 2) / size);
    };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    volume += a.dot(b.cross(c)) / 6;
    area += triangle_area(a, b, c);
  }
  return volume / (area * std::sqrt(area));
}

bool is_sheet(const TriangleMesh& mesh, const FillerMarks& fillers) {
  if (fillers.empty()) return false;
  const std::optional<Rescaled> unit = at_unit_size(mesh);
  double area = 0, filled = 0;
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    const double of_face = face_area(unit ? unit->mesh : mesh, f);
    area += of_face;
    if (fillers[static_cast<size_t>(f)]) filled += of_face;
  }
  return filled > most_filled * area;
}

}  // namespace sphparam
