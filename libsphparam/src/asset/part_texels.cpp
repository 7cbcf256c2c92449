#include "asset/part_texels.h"

#include <algorithm>
#include <functional>

#include "bake/connected_faces.h"
#include "mesh/triangle_geometry.h"

namespace sphparam {
namespace {

constexpr int widest = 512;

/// The material of a face; empty: it has none.
std::string material_of(const MeshFile& file, Face f) {
  const Property* const material = file.find_face_property("material");
  const double id = material ? material->values[static_cast<size_t>(f)] : -1;
  const bool known = id >= 0 && id < static_cast<double>(file.materials.size());
  return known ? file.materials[static_cast<size_t>(id)] : "";
}

/// With areas as shares of all, and no texels.
std::vector<PartTexels> parts_of(const MeshFile& file, const std::vector<int>& part_of) {
  std::vector<PartTexels> parts;
  double area = 0;
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    const auto part = static_cast<size_t>(part_of[static_cast<size_t>(f)]);
    if (part == parts.size()) parts.push_back({.material = material_of(file, f)});
    parts[part].triangles += 1;
    parts[part].area += face_area(file.mesh, f);
    area += face_area(file.mesh, f);
  }
  for (PartTexels& part : parts) part.area = area > 0 ? part.area / area : 0;
  return parts;
}

}  // namespace

std::vector<PartTexels> texels_of_parts(const MappedMesh& mapped, BakeSettings settings) {
  const MeshFile& file = settings.from ? *settings.from : mapped.file();
  std::vector<PartTexels> parts = parts_of(file, parts_of_faces(file.mesh));
  if (parts.size() == 1) parts.front().texels = 1;
  if (parts.size() <= 1) return parts;
  settings.width = std::min(settings.width, widest);
  settings.samples = 1;
  const double share = 2.0 / settings.width / settings.width;
  bake_values(mapped, {"id:component"}, settings,
              [&](size_t, const BakedField& field, int, int rows, const float* values) {
                for (int i = 0; i < rows * settings.width; ++i)
                  parts[static_cast<size_t>(values[i * field.channels])].texels += share;
              });
  std::ranges::stable_sort(parts, std::greater{}, &PartTexels::texels);
  return parts;
}

}  // namespace sphparam
