#include "io/formats/stl_writer.h"

#include <algorithm>
#include <cstdint>

#include "io/files/byte_reader.h"
#include "io/formats/float32_points.h"

// Normals are those of the corners as they are written; of triangles without area 0. The header
// must not begin with "solid", by which ASCII is known, nor hold "COLOR=".

namespace sphparam {
namespace {

constexpr std::size_t header_bytes = 80;

void append_vector(std::string& bytes, const Vector3& vector) {
  for (int axis = 0; axis < 3; ++axis)
    append_number(bytes, static_cast<float>(vector[axis]), std::endian::little);
}

/// Of any size.
Vector3 normal_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a;
  const double size = std::max(ab.cwiseAbs().maxCoeff(), ac.cwiseAbs().maxCoeff());
  if (!(size > 0)) return Vector3::Zero();
  return (ab / size).cross(ac / size).stableNormalized();
}

}  // namespace

std::string serialise_stl(const MeshFile& file) {
  const TriangleMesh& mesh = file.mesh;
  require_float32(mesh.positions, "an STL file");
  std::string bytes = "binary STL by sphparam";
  bytes.resize(header_bytes, ' ');
  append_number(bytes, static_cast<std::uint32_t>(mesh.face_count()), std::endian::little);
  for (Face f = 0; f < mesh.face_count(); ++f) {
    Vector3 corners[3];
    for (int k = 0; k < 3; ++k)
      corners[k] = mesh.position(mesh.triangles(f, k)).cast<float>().cast<double>();
    append_vector(bytes, normal_of(corners[0], corners[1], corners[2]));
    for (const Vector3& corner : corners) append_vector(bytes, corner);
    append_number(bytes, std::uint16_t{0}, std::endian::little);
  }
  return bytes;
}

}  // namespace sphparam
