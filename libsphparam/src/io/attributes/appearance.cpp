#include "io/attributes/appearance.h"

#include <array>

namespace sphparam {
namespace {

/// The columns of some properties of vertices; nothing where one is missing.
template <size_t count>
std::optional<std::array<const Property*, count>> columns(
    const MeshFile& file, const std::array<const char*, count>& names) {
  std::array<const Property*, count> found;
  for (size_t i = 0; i < count; ++i) {
    found[i] = file.find_vertex_property(names[i]);
    if (!found[i]) return std::nullopt;
  }
  return found;
}

}  // namespace

bool has_texcoords(const MeshFile& file) {
  return file.corner_texcoords || columns<2>(file, {"s", "t"});
}

std::optional<CornerTexcoords> texcoords_of(const MeshFile& file) {
  if (file.corner_texcoords) return file.corner_texcoords;
  const auto st = columns<2>(file, {"s", "t"});
  if (!st) return std::nullopt;
  CornerTexcoords corners(file.mesh.triangles.size(), 2);
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<size_t>(file.mesh.triangles(f, k));
      corners.row(3 * f + k) << (*st)[0]->values[v], (*st)[1]->values[v];
    }
  }
  return corners;
}

double brightest(ScalarType type) {
  return is_floating(type) ? 1 : type == ScalarType::Uint16 ? 65535 : 255;
}

std::optional<Points> vertex_colours(const MeshFile& file) {
  const auto rgb = columns<3>(file, {"red", "green", "blue"});
  if (!rgb) return std::nullopt;
  Points colours(file.mesh.vertex_count(), 3);
  for (int c = 0; c < 3; ++c) {
    const Property& property = *(*rgb)[static_cast<size_t>(c)];
    for (Eigen::Index v = 0; v < colours.rows(); ++v) {
      colours(v, c) = property.values[static_cast<size_t>(v)] / brightest(property.type);
    }
  }
  return colours;
}

}  // namespace sphparam
