#include "io/attributes/turned_normals.h"

#include <algorithm>
#include <array>

#include "mesh/repair/repair_kinds.h"

// Whether a face of the input was turned over, its corners say: of what is left of it, in which
// order. Whether its normals go with it, all of them say together: single ones may lie nearly
// within their faces, or be odd.

namespace sphparam {
namespace {

using Flags = std::vector<char>;

bool has(const RepairedMesh& repaired, RepairKind kind) {
  return count_of(repaired.actions, kind) > 0;
}

/// Of every corner, its weights in the face of the input that it is of.
std::vector<Vector3> places_in_faces(const RepairedMesh& repaired) {
  std::vector<Vector3> places;
  places.reserve(repaired.corner_origin.size());
  for (const int origin : repaired.corner_origin) places.push_back(Vector3::Unit(origin % 3));
  for (const BlendedCorner& corner : repaired.blended)
    places[static_cast<std::size_t>(corner.corner)] = corner.between.barycentric;
  return places;
}

/// By corner: whether the face of the input that it is of was turned over. Faces that were turned
/// with a neighbour across their longest edge have corners of both: they count as most do.
Flags turned_corners(const RepairedMesh& repaired) {
  const std::vector<int>& origin = repaired.corner_origin;
  const std::vector<Vector3> places = places_in_faces(repaired);
  const int faces = origin.empty() ? 0 : *std::ranges::max_element(origin) / 3 + 1;
  Flags turned(static_cast<std::size_t>(faces), has(repaired, RepairKind::TurnedOutward));
  for (std::size_t f = 0; f < repaired.face_origin.size(); ++f) {
    const int face = origin[3 * f] / 3;
    const bool is_of_one = origin[3 * f + 1] / 3 == face && origin[3 * f + 2] / 3 == face;
    if (repaired.face_origin[f] < 0 || !is_of_one) continue;  // what fills a hole runs as it must
    const double order = places[3 * f].dot(places[3 * f + 1].cross(places[3 * f + 2]));
    if (order != 0) turned[static_cast<std::size_t>(face)] = order < 0;
  }
  Flags result;
  result.reserve(origin.size());
  for (const int corner : origin) result.push_back(turned[static_cast<std::size_t>(corner / 3)]);
  return result;
}

/// Along the normal of its face; the wider its angle, the longer.
Vector3 outward(const TriangleMesh& mesh, Eigen::Index corner) {
  const auto f = static_cast<Face>(corner / 3);
  const int k = static_cast<int>(corner % 3);
  const auto along = [&](int end) -> Vector3 {
    return (mesh.position(mesh.triangles(f, (k + end) % 3)) - mesh.position(mesh.triangles(f, k)))
        .stableNormalized();
  };
  return along(1).cross(along(2));
}

/// Three properties that are one vector each.
struct VectorProperty {
  std::array<Property*, 3> parts{};
  bool is_there() const { return parts[0] && parts[1] && parts[2]; }
  Vector3 at(std::size_t i) const {
    return {parts[0]->values[i], parts[1]->values[i], parts[2]->values[i]};
  }
  bool is_real() const {
    return std::ranges::all_of(parts, [](const Property* part) { return is_floating(part->type); });
  }
  void make_unit(std::size_t i) const {
    const double length = at(i).stableNorm();
    if (!(length > 0)) return;
    for (Property* part : parts) part->values[i] /= length;
  }
  void turn(std::size_t i) const {
    for (Property* part : parts) part->values[i] = 0.0 - part->values[i];  // no −0
  }
};

VectorProperty normals_among(std::vector<Property>& properties) {
  VectorProperty normals;
  constexpr std::array names = {"nx", "ny", "nz"};
  for (Property& property : properties)
    for (std::size_t k = 0; k < names.size(); ++k)
      if (property.name == names[k]) normals.parts[k] = &property;
  return normals;
}

/// Whether the normals at turned corners are, by and large, on the side that faces had before.
template <class NormalAt>
bool were_with_faces(const TriangleMesh& mesh, const Flags& turned, const NormalAt& normal_at) {
  double agreement = 0;
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
    if (turned[static_cast<std::size_t>(i)]) agreement += normal_at(i).dot(outward(mesh, i));
  return agreement < 0;
}

/// Returns the corners whose normals were turned.
Flags turn_corner_normals(CornerNormals& normals, const TriangleMesh& mesh, const Flags& turned) {
  const auto normal_at = [&](Eigen::Index i) -> Vector3 { return normals.row(i); };
  if (!were_with_faces(mesh, turned, normal_at)) return Flags(turned.size(), 0);
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (turned[static_cast<std::size_t>(i)]) normals.row(i).array() = 0.0 - normals.row(i).array();
  return turned;
}

void turn_face_normals(const VectorProperty& normals, const TriangleMesh& mesh,
                       const Flags& turned) {
  const auto normal_at = [&](Eigen::Index i) {
    return normals.at(static_cast<std::size_t>(i / 3));
  };
  if (!were_with_faces(mesh, turned, normal_at)) return;
  for (std::size_t f = 0; 3 * f < turned.size(); ++f)
    if (turned[3 * f]) normals.turn(f);
}

/// What the faces about a vertex say.
struct Surroundings {
  bool turned = false, stayed = false;  // any of them
  Vector3 outward = Vector3::Zero();
};

std::vector<Surroundings> surroundings(const TriangleMesh& mesh, const Flags& turned) {
  std::vector<Surroundings> result(static_cast<std::size_t>(mesh.vertex_count()));
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    const Vertex v = mesh.triangles.data()[i];
    if (v < 0 || v >= mesh.vertex_count()) continue;
    Surroundings& about = result[static_cast<std::size_t>(v)];
    bool& any = turned[static_cast<std::size_t>(i)] ? about.turned : about.stayed;
    any = true;
    about.outward += outward(mesh, i);
  }
  return result;
}

/// Returns the corners whose vertices' normals were turned.
Flags turn_vertex_normals(const VectorProperty& normals, const TriangleMesh& mesh,
                          const Flags& turned) {
  const int* const vertices = mesh.triangles.data();
  const auto normal_at = [&](Eigen::Index i) {
    return normals.at(static_cast<std::size_t>(vertices[i]));
  };
  const bool all_turn = were_with_faces(mesh, turned, normal_at);
  const std::vector<Surroundings> around = surroundings(mesh, turned);
  Flags turns(around.size(), 0);
  for (std::size_t v = 0; v < around.size(); ++v) {
    const bool has_both = around[v].turned && around[v].stayed;
    turns[v] = has_both ? normals.at(v).dot(around[v].outward) < 0 : around[v].turned && all_turn;
    if (turns[v]) normals.turn(v);
  }
  Flags result(turned.size(), 0);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = turns[static_cast<std::size_t>(vertices[i])];
  return result;
}

bool names_only_vertices_there(const TriangleMesh& mesh) {
  return mesh.triangles.size() == 0 ||
         (mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.vertex_count());
}

}  // namespace

void turn_normals(MeshFile& file, const RepairedMesh& repaired) {
  const bool turns =
      has(repaired, RepairKind::FaceTurned) || has(repaired, RepairKind::TurnedOutward);
  if (!turns || !names_only_vertices_there(file.mesh)) return;
  const TriangleMesh& mesh = file.mesh;
  const Flags turned = turned_corners(repaired);
  Flags frames = turned;  // whose bitangents turn
  if (const VectorProperty normals = normals_among(file.face_properties); normals.is_there())
    turn_face_normals(normals, mesh, turned);
  if (const VectorProperty normals = normals_among(file.vertex_properties); normals.is_there())
    frames = turn_vertex_normals(normals, mesh, turned);
  if (file.corner_normals) frames = turn_corner_normals(*file.corner_normals, mesh, turned);
  if (!file.corner_tangents) return;
  for (Eigen::Index i = 0; i < file.corner_tangents->rows(); ++i)
    if (frames[static_cast<std::size_t>(i)]) (*file.corner_tangents)(i, 3) *= -1;
}

void make_created_normals_unit(MeshFile& file, const RepairedMesh& repaired) {
  const VectorProperty normals = normals_among(file.vertex_properties);
  if (!normals.is_there() || !normals.is_real()) return;
  for (const CreatedVertex& created : repaired.created)
    normals.make_unit(static_cast<std::size_t>(created.vertex));
}

}  // namespace sphparam
