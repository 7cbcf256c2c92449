#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "reading.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/polygons.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

/// A tetrahedron with attributes of every kind.
MeshFile everything() {
  MeshFile file = read(tetrahedron_obj);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& x : file.mesh.positions.reshaped()) x = uniform(random);
  file.comments = {"first", "  indented", "", "sphparam version 1"};
  file.materials = {"red paint", ""};
  const auto property = [&](const char* name, ScalarType type, double a, double b) {
    return Property{name, type, {a, b, a, b}};
  };
  file.vertex_properties = {property("nx", ScalarType::Float64, 0.1, 1e-300),
                            property("ny", ScalarType::Float32, 0.5, static_cast<double>(0.1f)),
                            property("nz", ScalarType::Float64, -0.0, 3),
                            property("red", ScalarType::Uint8, 255, 0),
                            property("green", ScalarType::Uint8, 1, 2),
                            property("blue", ScalarType::Uint8, 3, 128),
                            property("label", ScalarType::Int16, -32768, 32767),
                            property("id", ScalarType::Uint32, 4294967295.0, 0),
                            property("tiny", ScalarType::Int8, -128, 127)};
  file.face_properties = {property("material", ScalarType::Int32, 0, 1),
                          property("quality", ScalarType::Float64, 0.1, 0.2)};
  file.corner_texcoords = CornerTexcoords(12, 2);
  file.corner_normals = CornerNormals(12, 3);
  for (double& x : file.corner_texcoords->reshaped()) x = uniform(random);
  for (double& x : file.corner_normals->reshaped())
    x = static_cast<double>(static_cast<float>(uniform(random)));
  file.corner_normal_type = ScalarType::Float32;
  return file;
}

void check_same(const std::vector<Property>& a, const std::vector<Property>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].name == b[i].name);
    CHECK(a[i].type == b[i].type);
    CHECK(a[i].values == b[i].values);
  }
}

}  // namespace

TEST_CASE("mesh_writer: a PLY gives back all that a mesh file carries") {
  const MeshFile file = everything();
  const MeshFile back = read(serialise_ply(file));
  CHECK(back.mesh.positions == file.mesh.positions);
  CHECK(back.mesh.triangles == file.mesh.triangles);
  CHECK(back.position_type == ScalarType::Float64);
  check_same(back.vertex_properties, file.vertex_properties);
  check_same(back.face_properties, file.face_properties);
  CHECK(*back.corner_texcoords == *file.corner_texcoords);
  CHECK(*back.corner_normals == *file.corner_normals);
  CHECK(back.corner_normal_type == ScalarType::Float32);
  CHECK(back.comments == file.comments);
  CHECK(back.materials == file.materials);
  CHECK(back.notes.empty());
}

TEST_CASE("mesh_writer: float32 stays float32 while it is exact, and no longer") {
  MeshFile file = read(tetrahedron_ply);
  CHECK(contains(serialise_ply(file), "property float x"));
  file.mesh.positions(2, 1) = 0.1;
  CHECK(contains(serialise_ply(file), "property double x"));
  CHECK(read(serialise_ply(file)).mesh.position(2).y() == 0.1);

  file.vertex_properties = {{"a", ScalarType::Uint8, {0, 1, 2, 255}},
                            {"b", ScalarType::Uint8, {0, 1, 2, 256}},
                            {"c", ScalarType::Int32, {0, 1, 2, 0.5}}};
  const std::string bytes = serialise_ply(file);
  CHECK(contains(bytes, "property uchar a"));
  CHECK(contains(bytes, "property double b"));
  CHECK(values_of(read(bytes).find_vertex_property("c"))[3] == 0.5);
}

TEST_CASE("mesh_writer: fractions for colours that bytes round are told, with how many") {
  MeshFile file = read(tetrahedron_ply);
  // Steps of 255, as texts of four digits have them too, are what they were.
  for (const char* name : {"red", "green", "blue"})
    file.vertex_properties.push_back({name, ScalarType::Float32, {0, 0.6667, 51.0 / 255, 1}});
  CHECK(losses_of_writing(file, read(serialise_ply(file))).empty());
  file.vertex_properties.back().values[1] = 0.5;
  CHECK(losses_of_writing(file, read(serialise_ply(file))) ==
        std::vector<std::string>{"not carried: the last digits of 1 of 4 colours of vertices: they "
                                 "are bytes there, the nearest of 255 steps"});
  CHECK(losses_of_writing(file, read(serialise_obj(file), "a.obj")).empty());
}

TEST_CASE("mesh_writer: write, read, write gives the same bytes") {
  MeshFile per_vertex = everything();
  per_vertex.corner_normals.reset();
  per_vertex.corner_texcoords.reset();
  per_vertex.vertex_properties.push_back({"s", ScalarType::Float64, {0.1, 0.2, 0.3, 0.3}});
  per_vertex.vertex_properties.push_back({"t", ScalarType::Float64, {0, 0, 1, 1}});
  MeshFile coloured_faces = read(tetrahedron_off);
  for (const char* name : {"red", "green", "blue"}) {
    coloured_faces.face_properties.push_back({name, ScalarType::Float32, {0, 0.5, 1, 0.25}});
    coloured_faces.vertex_properties.push_back({name, ScalarType::Float32, {0, 0.5, 1, 0.25}});
  }
  for (const MeshFile& file : {everything(), per_vertex, coloured_faces, read(tetrahedron_ply)})
    for (const auto serialise : {serialise_ply, serialise_obj, serialise_off}) {
      const std::string once = serialise(file);
      CHECK(serialise(read(once, "a.obj")) == once);
      CHECK(read(once, "a.obj").mesh.positions == file.mesh.positions);
      CHECK(read(once, "a.obj").mesh.triangles == file.mesh.triangles);
    }
}

TEST_CASE("mesh_writer: text keeps every bit of a double") {
  MeshFile file = read(tetrahedron_obj);
  std::mt19937_64 random(3);
  for (int round = 0; round < 200; ++round) {
    for (double& x : file.mesh.positions.reshaped()) {
      do x = std::bit_cast<double>(random());
      while (!std::isfinite(x));
    }
    for (const auto serialise : {serialise_ply, serialise_obj, serialise_off})
      REQUIRE(read(serialise(file)).mesh.positions == file.mesh.positions);
  }
}

TEST_CASE("mesh_writer: OBJ carries colours, normals, texture coordinates and materials") {
  const MeshFile back = read(serialise_obj(everything()));
  CHECK(*back.corner_texcoords == *everything().corner_texcoords);
  CHECK(*back.corner_normals == *everything().corner_normals);
  CHECK(back.materials == everything().materials);
  CHECK(values_of(back.find_face_property("material")) == std::vector<double>{0, 1, 0, 1});
  CHECK(values_of(back.find_vertex_property("red"))[0] == 1);
  CHECK(values_of(back.find_vertex_property("blue"))[1] == Approx(128.0 / 255));
}

TEST_CASE("mesh_writer: OBJ has colours of whole numbers as fractions of their brightest") {
  const auto red = [](ScalarType type, double value) {
    MeshFile file = everything();
    for (const char* const name : {"red", "green", "blue"})
      file.set_vertex_property({name, type, std::vector<double>(4, value)});
    return values_of(read(serialise_obj(file)).find_vertex_property("red"))[0];
  };
  CHECK(red(ScalarType::Uint8, 51) == Approx(0.2));
  CHECK(red(ScalarType::Int32, 51) == Approx(0.2));
  CHECK(red(ScalarType::Uint16, 13107) == Approx(0.2));
  CHECK(red(ScalarType::Float32, 0.25) == 0.25);
}

TEST_CASE(
    "mesh_writer: polygons written as OBJ come back as they were, with all their corners have") {
  const std::string faces =
      "usemtl a\nf 1/1 4/2 3/3 2/4\nf 5/1 6/2 7/3 8/4\nusemtl b\nf 1/5 2/6 6/7 5/8\n"
      "f 2/5 3/6 7/7 6/8\nf 3/5 4/6 8/7 7/8\nusemtl a\nf 4/1 1/8 5/2\nf 4/1 5/2 8/9\n";
  std::string written = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  for (int i = 0; i < 9; ++i) written += "vt " + std::to_string(i) + " 0.5\n";
  MeshFile file = read(written + faces);
  Polygons polygons;
  const int quads[][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}};
  const int triangles[][3] = {{3, 0, 4}, {3, 4, 7}};
  for (const auto& quad : quads) {
    for (const int v : quad) polygons.add_corner(v);
    REQUIRE(polygons.close_polygon({}).empty());
  }
  for (const auto& triangle : triangles) {
    for (const int v : triangle) polygons.add_corner(v);
    REQUIRE(polygons.close_polygon({}).empty());
  }
  CHECK(serialise_polygon_obj(file, polygons) == written + faces);
  // Also where the diagonals of the quads are others than reading chooses.
  file.mesh.triangles.row(0) << 0, 3, 1;
  file.mesh.triangles.row(1) << 3, 2, 1;
  file.corner_texcoords.reset();
  const MeshFile back = read(serialise_polygon_obj(file, polygons));
  CHECK(back.polygons == 5);
  CHECK(back.mesh.triangles == read(written + faces).mesh.triangles);
  polygons.corners[0] = 6;
  CHECK_THROWS_AS(serialise_polygon_obj(file, polygons), std::logic_error);
}

TEST_CASE("mesh_writer: OFF carries normals, colours and texture coordinates of vertices") {
  MeshFile file = everything();
  file.vertex_properties.push_back({"s", ScalarType::Float64, {0.1, 0.2, 0.3, 0.4}});
  file.vertex_properties.push_back({"t", ScalarType::Float64, {0, 0, 1, 1}});
  const MeshFile back = read(serialise_off(file));
  CHECK(back.format == "STCNOFF");
  for (const char* name : {"nx", "ny", "nz", "red", "green", "blue", "s", "t"})
    CHECK(values_of(back.find_vertex_property(name)) == values_of(file.find_vertex_property(name)));
}

TEST_CASE("mesh_writer: OFF has its counts in the second line, and comments last") {
  MeshFile file = read(tetrahedron_off);
  file.comments = {"first", "sphparam version 1"};
  const std::string text = serialise_off(file);
  CHECK_THAT(text, Catch::StartsWith("OFF\n4 4 0\n1 1 1\n"));
  CHECK_THAT(text, Catch::EndsWith("\n3 1 2 3\n# first\n# sphparam version 1\n"));
  CHECK(read(text).comments == file.comments);
}

TEST_CASE("mesh_writer: OFF has colours as bytes where all are, else as fractions") {
  const auto coloured = [](ScalarType type, double value, ScalarType of_blue) {
    MeshFile file = read(tetrahedron_obj);
    for (const char* const name : {"red", "green", "blue"})
      file.set_vertex_property({name, type, std::vector<double>(4, value)});
    file.vertex_properties.back().type = of_blue;
    return serialise_off(file);
  };
  using enum ScalarType;
  CHECK(contains(coloured(Uint8, 51, Uint8), "\n1 1 1 51 51 51\n"));
  CHECK(contains(coloured(Int32, 51, Uint8), "\n1 1 1 51 51 51\n"));
  CHECK(contains(coloured(Uint16, 13107, Uint16), "\n1 1 1 0.2 0.2 0.2\n"));
  CHECK(contains(coloured(Int32, 510, Int32), "\n1 1 1 2.0 2.0 2.0\n"));
  CHECK(contains(coloured(Uint8, 127.5, Uint8), "\n1 1 1 0.5 0.5 0.5\n"));
  CHECK(contains(coloured(Uint8, 1, Float32), "\n1 1 1 0.003921569 0.003921569 1.0\n"));
  CHECK(contains(coloured(Float32, 1, Float32), "\n1 1 1 1.0 1.0 1.0\n"));
}

TEST_CASE("mesh_writer: in OBJ faces without a material do not get that of the faces before") {
  MeshFile file = read(tetrahedron_obj);
  file.materials = {"a", "b"};
  file.set_face_property({"material", ScalarType::Int32, {0, -1, -1, 1}});
  const std::string text = serialise_obj(file);
  CHECK(contains(text, "usemtl a\nf 1 3 2\nusemtl (null)\nf 1 2 4\nf 1 4 3\nusemtl b\nf 2 3 4\n"));
  const MeshFile back = read(text);
  CHECK(back.materials == file.materials);
  CHECK(values_of(back.find_face_property("material")) == std::vector<double>{0, -1, -1, 1});
  file.set_face_property({"material", ScalarType::Int32, {-1, -1, 0, 2}});
  CHECK(contains(serialise_obj(file),
                 "\nf 1 3 2\nf 1 2 4\nusemtl a\nf 1 4 3\nusemtl (null)\nf 2 3 4\n"));
}

TEST_CASE("mesh_writer: polygons of more corners than a byte can count come back from PLY") {
  constexpr int most = 300;
  const double turn = 2 * std::numbers::pi / most;
  std::string text;
  for (const int z : {0, 1})
    for (int i = 0; i < most; ++i)
      text += "v " + std::to_string(std::cos(turn * i)) + " " + std::to_string(std::sin(turn * i)) +
              " " + std::to_string(z) + "\n";
  text += "vt 0.5 0.25\n";
  Polygons prism;
  const auto add = [&](const std::vector<int>& corners) {
    text += "f";
    for (const int v : corners) {
      text += " " + std::to_string(v + 1) + "/1";
      prism.add_corner(v);
    }
    text += "\n";
    REQUIRE(prism.close_polygon({}).empty());
  };
  std::vector<int> below, above;
  for (int i = 0; i < most; ++i) {
    below.push_back(most - 1 - i);
    above.push_back(most + i);
  }
  add(below);
  add(above);
  for (int i = 0; i < most; ++i) add({i, (i + 1) % most, most + (i + 1) % most, most + i});
  const MeshFile file = read(text);
  const MeshFile back = read(serialise_mesh("a.ply", file, {.faces = &prism}));
  CHECK(back.polygons == most + 2);
  CHECK(back.mesh.positions == file.mesh.positions);
  CHECK(back.mesh.triangles == file.mesh.triangles);
  CHECK(*back.corner_texcoords == *file.corner_texcoords);
}

TEST_CASE("mesh_writer: line ends in comments and names cannot break a header") {
  MeshFile file = read(tetrahedron_ply);
  file.comments = {"a\nelement vertex 7", "b\rc"};
  file.materials = {"m\nf 9 9 9"};
  for (const auto serialise : {serialise_ply, serialise_obj, serialise_off})
    CHECK(read(serialise(file)).mesh.vertex_count() == 4);
}

TEST_CASE("mesh_writer: an empty mesh is written and read") {
  for (const auto serialise : {serialise_ply, serialise_off})
    CHECK(read(serialise(MeshFile{})).mesh.vertex_count() == 0);
}

TEST_CASE("mesh_writer: a comment that looks like a material stays a comment") {
  const MeshFile file = read("# sphparam material gold\n" + tetrahedron_obj, "a.obj");
  const MeshFile again = read(serialise_ply(file));
  CHECK(again.materials.empty());
  CHECK(again.comments.size() == 1);
  CHECK(serialise_ply(again) == serialise_ply(file));
}
