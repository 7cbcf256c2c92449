#include <algorithm>
#include <catch2/catch.hpp>

#include "sphparam/correspondence/matched_files.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/io/vertex_data.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

MappedMesh ball(int level) {
  MeshFile file;
  file.mesh = icosphere(level);
  SphereMap map{file.mesh.positions};
  return MappedMesh({.file = std::move(file), .map = std::move(map)});
}

MappedMesh with_file(const MappedMesh& mapped, MeshFile file) {
  return MappedMesh({.file = std::move(file), .map = mapped.map()});
}

bool has(const MeshFile& file, const std::string& name) {
  return file.find_vertex_property(name) != nullptr;
}

}  // namespace

TEST_CASE("matched files: what another match says is neither kept nor carried over") {
  const MappedMesh a = ball(2), b = ball(3);
  const MappedMesh once = with_targets(SurfaceMap(a, b));
  REQUIRE(has(once.file(), "target_face"));
  CHECK_FALSE(has(in_other_shape(SurfaceMap(once, b)), "target_face"));
  CHECK_FALSE(has(with_other_values(SurfaceMap(once, b)), "target_0"));
  CHECK_FALSE(has(with_other_values(SurfaceMap(b, once)), "target_face"));
  CHECK(names_of_values(once.file()).empty());
}

TEST_CASE("matched files: colours are rounded means, labels those of the nearest corner") {
  const MappedMesh a = ball(3), b = ball(1);
  MeshFile file = b.file();
  std::vector<double> grey, label;
  for (Vertex v = 0; v < b.mesh().vertex_count(); ++v) {
    grey.push_back(v % 2 == 0 ? 0 : 201);
    label.push_back(v % 2 == 0 ? 7 : 1000);
  }
  file.set_vertex_property({"red", ScalarType::Uint8, grey});
  file.set_vertex_property({"region", ScalarType::Int32, label});
  const MeshFile carried = with_other_values(SurfaceMap(a, with_file(b, file)));
  bool mixed = false;
  for (const double red : carried.find_vertex_property("red")->values) {
    CHECK(red == std::round(red));
    mixed |= red > 0 && red < 201;
  }
  CHECK(mixed);
  for (const double region : carried.find_vertex_property("region")->values)
    CHECK((region == 7 || region == 1000));
}

TEST_CASE("matched files: what both have under one name is there of both") {
  const auto with = [](const MappedMesh& mapped, std::vector<std::string> names, double value) {
    MeshFile file = mapped.file();
    for (const std::string& name : names)
      file.set_vertex_property({name, ScalarType::Float32,
                                std::vector<double>(size_t(mapped.mesh().vertex_count()), value)});
    return with_file(mapped, std::move(file));
  };
  const MappedMesh a = with(ball(2), {"I", "own", "flow_0", "flow_1", "x", "x_a", "red"}, 1),
                   b = with(ball(3), {"I", "flow_0", "flow_1", "x", "red"}, 2);
  const MeshFile carried = with_other_values(SurfaceMap(a, b));
  std::vector<std::string> names;
  for (const Property& property : carried.vertex_properties) {
    names.push_back(property.name);
    const bool is_own = property.name == "own" || property.name.find("_a") != std::string::npos;
    CHECK(property.values == std::vector<double>(162, is_own ? 1 : 2));
  }
  CHECK(names == std::vector<std::string>{"I_a", "own", "flow_a_0", "flow_a_1", "x_a_a", "x_a",
                                          "red", "I", "flow_0", "flow_1", "x"});
}

TEST_CASE("matched files: label tables follow the labels of both surfaces") {
  const auto with_labels = [](const MappedMesh& mapped, double key, const std::string& name) {
    MeshFile file = mapped.file();
    const std::vector<double> keys(static_cast<size_t>(mapped.mesh().vertex_count()), key);
    attach_data(file, {.name = "lobes",
                       .kind = DataKind::Labels,
                       .columns = {{.name = "lobes", .type = ScalarType::Int32, .values = keys}},
                       .labels = {{static_cast<int>(key), std::nullopt, name}},
                       .triangles = mapped.mesh().face_count()});
    return with_file(mapped, std::move(file));
  };
  const MappedMesh a = with_labels(ball(2), 3, "frontal lobe"),
                   b = with_labels(ball(1), 7, "parietal");
  const MeshFile carried = with_other_values(SurfaceMap(a, b));
  const std::vector<VertexData> data = attached_data(carried);
  REQUIRE(data.size() == 2);
  CHECK(data[0].name == "lobes");
  CHECK(data[0].properties == std::vector<std::string>{"lobes_a"});
  CHECK(data[0].columns[0].values == std::vector<double>(162, 3));
  REQUIRE(data[0].labels.size() == 1);
  CHECK(data[0].labels[0].key == 3);
  CHECK(data[0].labels[0].name == "frontal lobe");
  CHECK(data[0].triangles == 320);
  CHECK(data[1].name == "lobes_2");
  CHECK(data[1].kind == DataKind::Labels);
  CHECK(data[1].properties == std::vector<std::string>{"lobes"});
  CHECK(data[1].columns[0].values == std::vector<double>(162, 7));
  REQUIRE(data[1].labels.size() == 1);
  CHECK(data[1].labels[0].key == 7);
  CHECK(data[1].labels[0].name == "parietal");
  CHECK(data[1].triangles == 0);  // which would be those of B
}

TEST_CASE("matched files: colours are mixed as light") {
  const MappedMesh coarse = ball(0), fine = ball(1);
  MeshFile file = coarse.file();
  for (const char* name : {"red", "alpha"}) {
    std::vector<double> values(12, 0);
    values[0] = 255;
    file.set_vertex_property({name, ScalarType::Uint8, values});
  }
  const MeshFile carried = with_other_values(SurfaceMap(fine, with_file(coarse, file)));
  const auto count = [&](const char* name, double value) {
    return std::ranges::count(carried.find_vertex_property(name)->values, value);
  };
  CHECK(count("red", 255) == 1);
  CHECK(count("red", 188) == 5);  // the middles of its edges
  CHECK(count("alpha", 128) == 5);
}

TEST_CASE("matched files: a texture goes where colours come, which it would hide") {
  const MappedMesh a = ball(2), b = ball(1);
  MeshFile skinned = a.file(), coloured = b.file();
  skinned.comments = {"TextureFile skin.png"};
  coloured.set_vertex_property({"red", ScalarType::Uint8, std::vector<double>(42, 9)});
  const MappedMesh from = with_file(a, skinned);
  CHECK(with_other_values(SurfaceMap(from, with_file(b, coloured))).comments.empty());
  CHECK(with_other_values(SurfaceMap(from, b)).comments == skinned.comments);
}

TEST_CASE("matched files: in the other shape, up is what the other file says") {
  const MappedMesh plain = ball(2);
  MeshFile file = plain.file();
  note_up(file, {.direction = Vector3::UnitY()});
  const MappedMesh upright = with_file(plain, file);
  CHECK(noted_up(in_other_shape(SurfaceMap(upright, plain))) == Up{});
  CHECK(noted_up(in_other_shape(SurfaceMap(plain, upright))).direction == Vector3::UnitY());
  CHECK(in_other_shape(SurfaceMap(upright, upright)).comments == file.comments);
}

TEST_CASE("matched files: in the other shape, the volume is that of the other file, or none") {
  const MappedMesh plain = ball(2);
  const auto at = [&](const std::string& centre) {
    MeshFile file = plain.file();
    file.comments = {"of its own", "freesurfer real_ras 1", "freesurfer geometry cras = " + centre};
    return with_file(plain, file);
  };
  const MappedMesh here = at("1 2 3"), there = at("-40 -50 -60");
  CHECK(in_other_shape(SurfaceMap(here, there)).comments == there.file().comments);
  CHECK(in_other_shape(SurfaceMap(here, plain)).comments == std::vector<std::string>{"of its own"});
  CHECK(mirror_image(here).file().comments == std::vector<std::string>{"of its own"});
}

TEST_CASE("matched files: in the other shape, normals and tangents of the old one go") {
  MeshFile file = ball(2).file();
  const Eigen::Index corners = file.mesh.triangles.size();
  file.set_vertex_property(
      {"nx", ScalarType::Float64, std::vector<double>(size_t(file.mesh.vertex_count()))});
  file.corner_normals = CornerNormals::Zero(corners, 3);
  file.corner_tangents = CornerTangents::Zero(corners, 4);
  const MeshFile shown = in_other_shape(SurfaceMap(with_file(ball(2), file), ball(3)));
  CHECK_FALSE(has(shown, "nx"));
  CHECK_FALSE(shown.corner_normals);
  CHECK_FALSE(shown.corner_tangents);
}

TEST_CASE(
    "matched files: a mirror image twice is the surface itself, its normals looking outward") {
  MeshFile file = ball(2).file();
  std::vector<double> nx;
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) nx.push_back(file.mesh.positions(v, 0));
  file.set_vertex_property({"nx", ScalarType::Float64, nx});
  const MappedMesh shape = with_file(ball(2), file), image = mirror_image(shape);
  CHECK(image.mesh().positions.col(0) == -shape.mesh().positions.col(0));
  CHECK(image.file().find_vertex_property("nx")->values[5] == -nx[5]);
  CHECK(image.certificate().bijective());
  const MappedMesh again = mirror_image(image);
  CHECK(again.mesh().positions == shape.mesh().positions);
  CHECK(again.mesh().triangles == shape.mesh().triangles);
  CHECK(again.map().points == shape.map().points);
}

}  // namespace sphparam::tests
