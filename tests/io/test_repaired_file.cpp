#include <catch2/catch.hpp>

#include "io/repaired_file.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A mesh file whose attributes say where they are: heights of vertices, numbers of faces, corners
/// with their vertex and their face.
MeshFile labelled(const TriangleMesh& mesh) {
  MeshFile file;
  file.mesh = mesh;
  Property height{"height", ScalarType::Float64, {}}, part{"part", ScalarType::Uint8, {}};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) height.values.push_back(mesh.positions(v, 2));
  for (Face f = 0; f < mesh.face_count(); ++f) part.values.push_back(f % 200);
  file.set_vertex_property(height);
  file.set_face_property(part);
  file.corner_texcoords.emplace(mesh.triangles.size(), 2);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    const Vertex v = mesh.triangles.data()[i];
    file.corner_texcoords->row(i) << mesh.positions(v, 0), mesh.positions(v, 1);
  }
  return file;
}

void check_labels(const MeshFile& before, const MeshFile& after) {
  const auto& height = after.find_vertex_property("height")->values;
  const auto& source = after.find_vertex_property("source_vertex")->values;
  REQUIRE(height.size() == static_cast<size_t>(after.mesh.vertex_count()));
  for (Vertex v = 0; v < after.mesh.vertex_count(); ++v) {
    CHECK(height[v] == Approx(after.mesh.positions(v, 2)));
    if (source[v] >= 0) {
      CHECK(after.mesh.position(v) == before.mesh.position(static_cast<Vertex>(source[v])));
    }
  }
  const auto& part = after.find_face_property("part")->values;
  const auto& source_face = after.find_face_property("source_face")->values;
  REQUIRE(part.size() == static_cast<size_t>(after.mesh.face_count()));
  REQUIRE(after.corner_texcoords->rows() == after.mesh.triangles.size());
  for (Face f = 0; f < after.mesh.face_count(); ++f) {
    if (source_face[f] >= 0) CHECK(part[f] == static_cast<int>(source_face[f]) % 200);
    for (int k = 0; k < 3; ++k) {
      const Vertex v = after.mesh.triangles(f, k);
      if (source[v] < 0) continue;
      CHECK(after.corner_texcoords->row(3 * f + k) == after.mesh.positions.row(v).head<2>());
    }
  }
}

}  // namespace

TEST_CASE("repaired_file: attributes go where their vertices, faces and corners go") {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.conservativeResize(mesh.face_count() - 3, 3);
  std::swap(mesh.triangles(7, 0), mesh.triangles(7, 1));
  mesh.triangles.row(20) = mesh.triangles.row(21).eval();
  const MeshFile file = labelled(mesh);
  const RepairedMesh repaired = repair_mesh(mesh);
  REQUIRE(repaired.inspection.is_sphere());
  check_labels(file, repaired_file(file, repaired));
}

TEST_CASE("repaired_file: a created vertex has the mean of its neighbours and no source") {
  TriangleMesh mesh = octahedron();
  mesh.triangles.conservativeResize(1, 3);
  const MeshFile file = labelled(mesh);
  const RepairedMesh repaired = repair_mesh(mesh);
  REQUIRE(repaired.created.size() == 1);
  const MeshFile result = repaired_file(file, repaired);
  check_labels(file, result);
  CHECK(result.find_vertex_property("source_vertex")->values.back() == -1);
  CHECK(result.find_face_property("source_face")->values == std::vector<double>{0, -1, -1, -1});
}

TEST_CASE("repaired_file: ids of the file survive a repair of a mesh that was renumbered before") {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  MeshFile file = labelled(mesh);
  Property source{"source_vertex", ScalarType::Uint16, {}};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) source.values.push_back(2 * v + 1);
  file.set_vertex_property(source);
  const MeshFile result = repaired_file(file, repair_mesh(mesh));
  CHECK(result.find_vertex_property("source_vertex")->values == source.values);
}

TEST_CASE("repaired_file: nothing done, nothing added") {
  const MeshFile file = labelled(icosphere(1));
  const MeshFile result = repaired_file(file, repair_mesh(file.mesh));
  CHECK_FALSE(result.find_vertex_property("source_vertex"));
  CHECK_FALSE(result.find_face_property("source_face"));
}
