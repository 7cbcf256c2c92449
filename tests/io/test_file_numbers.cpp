#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "number_text.h"
#include "reading.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/vertex_data.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Vertex v has the number v + 100 in its file; the last two were one.
MeshFile renumbered() {
  MeshFile file;
  file.mesh = icosphere(0);
  Property source{"source_vertex", ScalarType::Int32, {}};
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) source.values.push_back(v + 100);
  source.values.back() = source.values[source.values.size() - 2];
  file.set_vertex_property(source);
  return file;
}

}  // namespace

TEST_CASE("file numbers: poles and meridian are found by their numbers in the file") {
  const MeshFile file = renumbered();
  const FileNumbers numbers(file);
  ParameterizeOptions options;
  options.poles = Poles{103, 100};
  options.meridian = 105;
  const ParameterizeOptions settled = with_vertices_of_mesh(options, numbers);
  CHECK(settled.poles->north == 3);
  CHECK(settled.poles->south == 0);
  CHECK(settled.meridian == 5);
}

TEST_CASE("file numbers: a number of no vertex says whose it was") {
  const MeshFile file = renumbered();
  const FileNumbers numbers(file);
  ParameterizeOptions options;
  options.meridian = 3;
  try {
    with_vertices_of_mesh(options, numbers);
    FAIL("3 is no number in the file");
  } catch (const NoSuchVertex& error) {
    CHECK(error.whose() == "meridian");
    CHECK(error.what() == numbers.absence(3));
  }
  CHECK(numbers.absence(3) ==
        "the mesh has no vertex 3 (it was merged with another, or no face used it)");
  MeshFile plain;
  plain.mesh = icosphere(0);
  CHECK(FileNumbers(plain).absence(12) == "the mesh has no vertex 12; they are 0 to 11");
  options.meridian = {};
  options.poles = Poles{104, 104};
  CHECK_THROWS_WITH(with_vertices_of_mesh(options, numbers), Catch::Contains("one vertex"));
}

namespace {

/// A tetrahedron whose file has two vertices that no face uses, the first and the last.
const std::string with_unused =
    "v 9 9 9\nv 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nv 8 8 8\n"
    "f 2 4 3\nf 2 3 5\nf 2 5 4\nf 3 4 5\n";

VertexData values(std::size_t count) {
  VertexData data;
  data.name = "depth";
  data.columns.push_back({"depth", ScalarType::Float64, std::vector<double>(count, 1)});
  return data;
}

MeshSource read_text(const Folder& folder, const std::string& text) {
  write_file(folder / "x.obj", text);
  return read_source(folder / "x.obj");
}

}  // namespace

TEST_CASE("file numbers: defects name places as the file does, and count what it does not have") {
  MeshFile file = renumbered();
  file.vertex_properties.back().values[3] = -1;
  Property polygons{"source_face", ScalarType::Int32, {}};
  for (Face f = 0; f < file.mesh.face_count(); ++f) polygons.values.push_back(f / 2);
  polygons.values[9] = -1;
  file.set_face_property(polygons);
  const FileNumbers numbers(file);
  const auto named = [&](const MeshDefect& defect) {
    return by_file_numbers({defect}, numbers)[0];
  };

  const MeshDefect edges = named({DefectKind::BoundaryEdge,
                                  true,
                                  3,
                                  {0, 1, 2, 3, 4, 5},
                                  "3 edges: between vertices 0-1, 2-3, 4-5",
                                  "close them"});
  CHECK(edges.elements == std::vector<int>{100, 101, 104, 105});
  CHECK(edges.message ==
        "3 edges: between vertices 100-101, 104-105 and 1 that the file does not have");
  CHECK(edges.count == 3);
  CHECK(edges.hint == "close them");
  const MeshDefect vertices =
      named({DefectKind::NonManifoldVertex, true, 12, {1, 2}, "12: vertices 1, 2, …", ""});
  CHECK(vertices.elements == std::vector<int>{101, 102});
  CHECK(vertices.message == "12: vertices 101, 102, …");
  const MeshDefect none =
      named({DefectKind::CoincidentVertices, false, 1, {3}, "1: vertices 3", ""});
  CHECK(none.elements.empty());
  CHECK(none.message == "1: 1 that the file does not have");
  // Two triangles of one polygon are one place.
  const MeshDefect faces =
      named({DefectKind::ZeroAreaFace, false, 4, {4, 5, 7, 9}, "4: faces 4, 5, 7, 9", ""});
  CHECK(faces.elements == std::vector<int>{2, 3});
  CHECK(faces.message == "4: faces 2, 3 and 1 that the file does not have");
  const MeshDefect genus = named({DefectKind::WrongGenus, true, 1, {}, "genus 1: no", ""});
  CHECK(genus.message == "genus 1: no");
}

TEST_CASE("file numbers: what is wrong with a welded mesh has the numbers of the file") {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  const Eigen::RowVector3i missing = icosphere(1).triangles.bottomRows<1>();
  // Every triangle with vertices of its own.
  std::string places, faces;
  std::vector<Vertex> of_file;
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vector3 p = mesh.position(mesh.triangles(f, k));
      places += "v " + shortest(p.x()) + " " + shortest(p.y()) + " " + shortest(p.z()) + "\n";
      of_file.push_back(mesh.triangles(f, k));
      faces += (k == 0 ? "f " : " ") + std::to_string(of_file.size()) + (k == 2 ? "\n" : "");
    }
  const Folder folder;
  const MeshSource source = read_text(folder, places + faces);
  REQUIRE(source.welded);
  const std::vector<MeshDefect>& defects = source.inspection.defects;
  REQUIRE(defects.front().kind == DefectKind::BoundaryEdge);
  std::set<Vertex> named;
  for (const int number : defects.front().elements) named.insert(of_file.at(number));
  CHECK(named == std::set<Vertex>{missing[0], missing[1], missing[2]});
}

TEST_CASE("file numbers: faces that were cut into triangles are named as polygons") {
  const Folder folder;  // a square, and a triangle without area
  const MeshSource source =
      read_text(folder, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0.5 0\nf 1 2 3 4\nf 2 5 3\n");
  REQUIRE(source.file.mesh.face_count() == 3);
  const auto flat =
      std::ranges::find(source.inspection.defects, DefectKind::ZeroAreaFace, &MeshDefect::kind);
  REQUIRE(flat != source.inspection.defects.end());
  CHECK(flat->elements == std::vector<int>{1});
  CHECK(flat->message == "1 face has no area: faces 1");
}

TEST_CASE("file numbers: a mesh knows how many vertices its file had, after dropping and repair") {
  const Folder folder;
  MeshSource source = read_text(folder, with_unused);
  REQUIRE(source.file.mesh.vertex_count() == 4);
  CHECK(vertices_of_file(source.file) == 6);
  // One face gone: repair puts it back, and numbers anew.
  source = repaired(read_text(folder, with_unused.substr(0, with_unused.rfind("f "))), {});
  CHECK(source.file.mesh.vertex_count() == 4);
  CHECK(vertices_of_file(source.file) == 6);
  MeshFile whole;
  whole.mesh = tetrahedron();
  CHECK(vertices_of_file(whole) == 4);
}

TEST_CASE("file numbers: the count passes through the formats that keep the numbers") {
  const Folder folder;
  const MeshSource source = read_text(folder, with_unused);
  for (const char* name : {"x.ply", "x.vtk", "x.vtp"}) {
    write_mesh(folder / name, source.file);
    const MeshSource back = read_source(folder / name);
    CHECK(vertices_of_file(back.file) == 6);
    MeshFile file = back.file;
    attach_data(file, values(6));
    CHECK_THROWS_WITH(attach_data(file, values(5)),
                      Catch::Contains("values of 5 vertices") && Catch::Contains("file has 6"));
    CHECK_THROWS_WITH(attach_data(file, values(7)), Catch::Contains("file has 6"));
  }
}

TEST_CASE("file numbers: a file whose numbers are another's says so, one that is dropped anew no") {
  const Folder folder;
  const auto says_so = [](const MeshSource& source) {
    return std::ranges::count(source.notes, std::string(other_numbers_note)) == 1;
  };
  const MeshSource source = read_text(folder, with_unused);
  CHECK_FALSE(says_so(source));  // the numbers are those of its own rows
  for (const char* name : {"x.ply", "x.vtk", "x.vtp"}) {
    write_mesh(folder / name, source.file);
    CHECK(says_so(read_source(folder / name)));
  }
  MeshFile whole;
  whole.mesh = tetrahedron();
  whole.set_vertex_property({"source_vertex", ScalarType::Int32, {0, 1, 2, 3}});
  write_mesh(folder / "whole.ply", whole);
  CHECK_FALSE(says_so(read_source(folder / "whole.ply")));
}

TEST_CASE("file numbers: what cannot be the number of vertices is none") {
  MeshFile file = renumbered();
  CHECK(vertices_of_file(file) == 0);
  keep_vertices_of_file(file, 111);
  CHECK(vertices_of_file(file) == 111);
  for (const char* text : {"110", "-1", "x", "1e3", "99999999999"}) {
    file.comments = {std::string("source_vertices ") + text};
    CHECK(vertices_of_file(file) == 0);
  }
  keep_vertices_of_file(file, 200);
  CHECK(file.comments == std::vector<std::string>{"source_vertices 200"});
}
