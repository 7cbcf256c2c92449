#include "sphparam/io/fillers.h"

#include <algorithm>

#include "io/repair/mesh_part.h"

namespace sphparam {

namespace {

std::vector<int> surface_faces(const FillerMarks& fillers) {
  std::vector<int> faces;
  for (int f = 0; f < static_cast<int>(fillers.size()); ++f) {
    if (!fillers[f]) faces.push_back(f);
  }
  return faces;
}

}  // namespace

FillerMarks fillers_of(const MeshFile& file) {
  const Property* const marks = file.find_face_property(filler_property);
  if (!marks) return {};
  FillerMarks fillers;
  fillers.reserve(marks->values.size());
  for (const double value : marks->values) fillers.push_back(value == 1 ? 1 : 0);
  const auto marked = std::count(fillers.begin(), fillers.end(), 1);
  return marked > 0 && marked < std::ssize(fillers) ? fillers : FillerMarks{};
}

void mark_fillers(MeshFile& file, const FillerMarks& fillers) {
  if (fillers.empty()) return remove_properties(file.face_properties, {filler_property});
  file.set_face_property(
      {filler_property, ScalarType::Uint8, std::vector<double>(fillers.begin(), fillers.end())});
}

MeshFile without_fillers(const MeshFile& file) {
  const FillerMarks fillers = fillers_of(file);
  if (fillers.empty()) return file;
  MeshFile surface = part_of(file, surface_faces(fillers));
  mark_fillers(surface, {});
  return surface;
}

}  // namespace sphparam
