#include <catch2/catch.hpp>

#include "io/attributes/corner_colours.h"
#include "io/polygons/welding.h"
#include "reading.h"
#include "sphparam/io/losses.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

/// Every triangle with three vertices of its own; `id` is the vertex it came from.
MeshFile soup(const TriangleMesh& mesh) {
  MeshFile file;
  const Eigen::Index corners = mesh.triangles.size();
  file.mesh.positions.resize(corners, 3);
  file.mesh.triangles.resize(mesh.face_count(), 3);
  Property id{"id", ScalarType::Int32, {}};
  for (Eigen::Index i = 0; i < corners; ++i) {
    const int v = mesh.triangles.data()[i];
    file.mesh.positions.row(i) = mesh.positions.row(v);
    file.mesh.triangles.data()[i] = static_cast<int>(i);
    id.values.push_back(v);
  }
  file.vertex_properties = {id};
  return file;
}

}  // namespace

TEST_CASE("welding: a welded soup is the surface it was made from") {
  const TriangleMesh sphere = icosphere(2);
  const MeshFile source = soup(sphere);
  const WeldResult welded = weld_exact(source);
  CHECK(welded.merged == source.mesh.vertex_count() - sphere.vertex_count());
  CHECK(inspect_mesh(welded.file.mesh).is_sphere());
  const auto& ids = values_of(welded.file.find_vertex_property("id"));
  for (Eigen::Index i = 0; i < sphere.triangles.size(); ++i)
    CHECK(ids[welded.file.mesh.triangles.data()[i]] == sphere.triangles.data()[i]);
  for (std::size_t v = 0; v < welded.new_vertex.size(); ++v)
    CHECK(welded.file.mesh.positions.row(welded.new_vertex[v]) ==
          source.mesh.positions.row(static_cast<Eigen::Index>(v)));
}

TEST_CASE("welding: zero has no sign, other numbers are compared bit for bit") {
  const WeldResult welded =
      weld_exact(read("v 0 0 0\nv -0 0 -0\nv 1 0 0\nv 1.0000000000000002 0 0\nf 1 3 4\n", "a.obj"));
  CHECK(welded.new_vertex == std::vector<int>{0, 0, 1, 2});
  CHECK(values_of(welded.file.find_vertex_property("source_vertex")) ==
        std::vector<double>{0, 2, 3});
}

TEST_CASE("welding: attributes that differ between copies move to the corners") {
  MeshFile file = soup(octahedron());
  const auto count = static_cast<std::size_t>(file.mesh.vertex_count());
  Property s{"s", ScalarType::Float32, std::vector<double>(count)};
  Property t{"t", s.type, s.values}, nx{"nx", s.type, s.values}, ny{"ny", s.type, s.values};
  Property nz{"nz", s.type, s.values};
  for (std::size_t i = 0; i < count; ++i) s.values[i] = static_cast<double>(i);
  for (const Property& property : {s, t, nx, ny, nz}) file.vertex_properties.push_back(property);
  const MeshFile welded = weld_exact(file).file;
  REQUIRE(welded.corner_texcoords);
  CHECK(welded.corner_texcoord_type == ScalarType::Float32);
  for (Eigen::Index i = 0; i < welded.corner_texcoords->rows(); ++i)
    CHECK((*welded.corner_texcoords)(i, 0) == static_cast<double>(i));
  CHECK_FALSE(welded.find_vertex_property("s"));
  CHECK_FALSE(welded.find_vertex_property("t"));
  // The normals agree: they stay where they are.
  CHECK_FALSE(welded.corner_normals);
  CHECK(values_of(welded.find_vertex_property("nx")).size() == 6);
}

TEST_CASE("welding: faces that collapse stay, for the gate to report") {
  const MeshFile welded = weld_exact(read("v 0 0 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", "a.obj")).file;
  CHECK(welded.mesh.triangles.row(0) == Eigen::RowVector3i(0, 0, 1));
}

TEST_CASE("welding: unused vertices are dropped and ids of the file kept") {
  const MeshFile file =
      drop_unused_vertices(read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 8 8 8\nv 0 1 0\nf 2 3 5\n", "a.obj"));
  CHECK(file.mesh.vertex_count() == 3);
  CHECK(file.mesh.triangles.row(0) == Eigen::RowVector3i(0, 1, 2));
  CHECK(values_of(file.find_vertex_property("source_vertex")) == std::vector<double>{1, 2, 4});
  CHECK(file.mesh.position(2) == Vector3(0, 1, 0));
  CHECK_FALSE(drop_unused_vertices(read(tetrahedron_obj)).find_vertex_property("source_vertex"));
}

TEST_CASE("welding: a closed mesh is never welded, an open one is, both are noted") {
  // Two vertices of a closed mesh at one place: welding would pinch it.
  MeshFile touching;
  touching.mesh = icosphere(2);
  touching.mesh.positions.row(100) = touching.mesh.positions.row(3);
  std::vector<std::string> notes;
  CHECK(prepare_for_mapping(touching, &notes).mesh.vertex_count() == 162);
  CHECK(notes.empty());

  const MeshFile prepared = prepare_for_mapping(soup(icosphere(1)), &notes);
  CHECK(inspect_mesh(prepared.mesh).is_sphere());
  CHECK(notes.size() == 1);

  // A flap on a closed mesh, which only the edges of the very first vertex leave open.
  notes.clear();
  const MeshFile flap =
      prepare_for_mapping(read("v -1 -1 1\nv 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\n"
                               "f 2 4 3\nf 2 3 5\nf 2 5 4\nf 3 4 5\nf 1 4 2\n",
                               "a.obj"),
                          &notes);
  CHECK(values_of(flap.find_vertex_property("source_vertex")) == std::vector<double>{0, 1, 3, 4});
  CHECK(notes.size() == 1);

  // Welding and dropping together still name the ids of the file.
  const MeshFile both = prepare_for_mapping(
      read("v 7 7 7\nv 0 0 0\nv 1 0 0\nv 0 0 0\nv 0 1 0\nf 2 3 5\nf 4 5 3\n", "a.obj"), &notes);
  CHECK(values_of(both.find_vertex_property("source_vertex")) == std::vector<double>{1, 2, 4});
  REQUIRE(notes.size() == 3);
  CHECK(notes[1] ==
        "welded 1 vertex onto others of the same position: the faces as indexed are not closed");
  CHECK(notes[2] == "dropped 1 vertex that no face uses: vertices 0");
  CHECK(renumberings_among({"a reader's", notes[1], notes[2]}) ==
        std::vector<std::string>{notes[1], notes[2]});
}

TEST_CASE("welding: where copies have several colours, corners keep their own") {
  MeshFile file = soup(octahedron());
  const auto count = static_cast<std::size_t>(file.mesh.vertex_count());
  for (const char* name : {"red", "green", "blue"}) {
    Property channel{name, ScalarType::Uint8, std::vector<double>(count, 255)};
    file.vertex_properties.push_back(channel);
  }
  CHECK_FALSE(corner_colours(weld_exact(file).file));  // all alike
  Property green = *file.find_vertex_property("green");
  for (std::size_t i = 0; i < count; ++i) green.values[i] = static_cast<double>(i / 3 * 10);
  file.set_vertex_property(green);
  const MeshFile welded = weld_exact(file).file;
  const auto colours = corner_colours(welded);
  REQUIRE(colours);
  for (Eigen::Index i = 0; i < colours->rows(); ++i)
    CHECK(colours->row(i) == Eigen::RowVector4d(255, static_cast<double>(i / 3 * 10), 255, 0));
  CHECK(values_of(welded.find_vertex_property("green")).size() == 6);
  CHECK(welded.find_face_property("corner_green_2")->type == ScalarType::Uint8);
  CHECK_FALSE(welded.find_face_property("corner_alpha_0"));
  std::vector<std::string> losses;
  add_sampling_losses(losses, welded);
  CHECK(losses == std::vector<std::string>{"not carried: more than one colour of a vertex"});
  MeshFile painted = welded;
  painted.set_vertex_property(*welded.find_vertex_property("green"));
  CHECK_FALSE(corner_colours(painted));
  painted = welded;
  painted.set_vertex_property(
      {"alpha", ScalarType::Uint8,
       std::vector<double>(static_cast<std::size_t>(welded.mesh.vertex_count()), 128)});
  CHECK_FALSE(corner_colours(painted));
}

TEST_CASE("welding: a copy that no face uses wins nothing") {
  // Two halves that both list all vertices.
  const TriangleMesh mesh = octahedron();
  const auto count = static_cast<int>(mesh.vertex_count());
  MeshFile file;
  file.mesh.positions.resize(Eigen::Index{2} * count, 3);
  file.mesh.positions << mesh.positions, mesh.positions;
  file.mesh.triangles = mesh.triangles;
  file.mesh.triangles.bottomRows(mesh.face_count() / 2).array() += count;
  std::vector<bool> in_first(static_cast<std::size_t>(count), false);
  for (const Vertex v : mesh.triangles.topRows(mesh.face_count() / 2).reshaped())
    in_first[static_cast<std::size_t>(v)] = true;
  Property half{"half", ScalarType::Float32, std::vector<double>(2 * in_first.size(), 0)};
  std::fill(half.values.begin() + count, half.values.end(), 1);
  file.vertex_properties = {half};
  const MeshFile welded = weld_exact(file).file;
  REQUIRE(welded.mesh.vertex_count() == count);
  for (std::size_t v = 0; v < in_first.size(); ++v) {
    CHECK(values_of(welded.find_vertex_property("half"))[v] == (in_first[v] ? 0 : 1));
    CHECK(values_of(welded.find_vertex_property("source_vertex"))[v] ==
          static_cast<double>(v) + (in_first[v] ? 0 : count));
  }
}

TEST_CASE("welding: a vertex of large valence costs no more than others") {
  const MeshFile fan = soup(uv_sphere(20000, 1));
  CHECK(inspect_mesh(prepare_for_mapping(fan).mesh).is_sphere());
}
