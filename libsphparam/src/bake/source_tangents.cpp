#include "bake/source_tangents.h"

#include <vector>

#include "io/polygons/distinct_rows.h"
#include "mesh/triangle_geometry.h"

// On a triangle with edges e₁, e₂ and their (s₁, t₁), (s₂, t₂) the surface grows with s along
//   ∂p/∂s = (t₂ e₁ − t₁ e₂) / (s₁ t₂ − s₂ t₁),
// whose sign is that of the triangle's area in (s, t), and so is the handedness.

namespace sphparam {
namespace {

Vector3 unit_or_zero(const Vector3& v) { return v.stableNormalized(); }

struct FaceFrame {
  Vector3 along = Vector3::Zero();  // of no length where (s, t) have no area
  double sign = 1;
};

FaceFrame frame_of(const MeshFile& file, const CornerTexcoords& texcoords, Face f) {
  const auto corner = [&](int k) { return file.mesh.position(file.mesh.triangles(f, k)); };
  const auto st = [&](int k) { return Eigen::Vector2d(texcoords.row(3 * f + k)); };
  const Vector3 first = corner(1) - corner(0), second = corner(2) - corner(0);
  const Eigen::Vector2d a = st(1) - st(0), b = st(2) - st(0);
  const double area = a[0] * b[1] - b[0] * a[1];
  if (area == 0 || !std::isfinite(area)) return {};
  const double sign = area > 0 ? 1 : -1;
  return {sign * (b[1] * first - a[1] * second), sign};
}

Vector3 flattened(const Vector3& v, const Vector3& normal) {
  return unit_or_zero(v - v.dot(normal) * normal);
}

class TangentSums {
 public:
  TangentSums(const MeshFile& file, const Points& vertex_normals, const CornerTexcoords& texcoords)
      : file_(file), vertex_normals_(vertex_normals), texcoords_(texcoords) {}

  SourceTangents make() {
    const Eigen::Index faces = file_.mesh.face_count();
    SourceTangents result{Points(3 * faces, 3), RowTable<double, 4>(3 * faces, 4)};
    std::vector<int> sum_of;
    for (Face f = 0; f < faces; ++f) {
      const FaceFrame frame = frame_of(file_, texcoords_, f);
      for (int k = 0; k < 3; ++k) {
        const Vector3 normal = normal_of(f, k);
        result.normals.row(3 * f + k) = normal;
        result.tangents(3 * f + k, 3) = frame.sign;
        sum_of.push_back(add(f, k, normal, frame));
      }
    }
    for (size_t i = 0; i < sum_of.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const Vector3 normal = result.normals.row(row);
      const Vector3 sum = flattened(sums_[static_cast<size_t>(sum_of[i])], normal);
      result.tangents.row(row).head<3>() = sum;
    }
    return result;
  }

 private:
  Vector3 normal_of(Face f, int k) const {
    const Vertex v = file_.mesh.triangles(f, k);
    if (!file_.corner_normals) return vertex_normals_.row(v);
    const Vector3 own = unit_or_zero(file_.corner_normals->row(3 * f + k));
    return own.isZero(0) || !own.allFinite() ? Vector3(vertex_normals_.row(v)) : own;
  }

  int add(Face f, int k, const Vector3& normal, const FaceFrame& frame) {
    const Vertex v = file_.mesh.triangles(f, k);
    const int id =
        distinct_.insert({static_cast<double>(v), normal[0], normal[1], normal[2],
                          texcoords_(3 * f + k, 0), texcoords_(3 * f + k, 1), frame.sign});
    if (id == static_cast<int>(sums_.size())) sums_.emplace_back(Vector3::Zero());
    const auto edge = [&](int to) {
      return flattened(file_.mesh.position(file_.mesh.triangles(f, to)) - file_.mesh.position(v),
                       normal);
    };
    const double angle = angle_between(edge((k + 1) % 3), edge((k + 2) % 3));
    sums_[static_cast<size_t>(id)] += angle * flattened(frame.along, normal);
    return id;
  }

  const MeshFile& file_;
  const Points& vertex_normals_;
  const CornerTexcoords& texcoords_;
  DistinctRows<double, 7> distinct_;
  std::vector<Vector3> sums_;
};

}  // namespace

SourceTangents source_tangents(const MeshFile& file, const Points& vertex_normals,
                               const CornerTexcoords& texcoords) {
  return TangentSums(file, vertex_normals, texcoords).make();
}

}  // namespace sphparam
