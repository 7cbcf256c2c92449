#include <catch2/catch.hpp>

#include "render/geodesic.h"
#include "render/own_paint.h"
#include "support/test_meshes.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;

namespace {

SourceTexture coloured(float red, float green, float blue) {
  return {.factor = {red, green, blue, 1}};
}

SourceTexture with_image() {
  return {.image = std::make_shared<const TexturePyramid>(Image(1, 1, 3))};
}

/// Two materials, of every other face; one face has none.
MeshFile two_materials() {
  MeshFile file;
  file.mesh = tests::icosphere(1);
  Property material{"material", ScalarType::Int32, {}};
  for (Face f = 0; f < file.mesh.face_count(); ++f) material.values.push_back(f % 2);
  material.values[7] = -1;
  file.set_face_property(material);
  file.corner_texcoords = CornerTexcoords::Constant(file.mesh.triangles.size(), 2, 0.5);
  return file;
}

void add_colours(MeshFile& file, ScalarType type, double value) {
  for (const char* name : {"red", "green", "blue"}) {
    file.set_vertex_property(
        {name, type, std::vector<double>(static_cast<size_t>(file.mesh.vertex_count()), value)});
  }
}

/// The colour of a ball of that paint where it faces the eye.
Rgb seen(const TriangleMesh& mesh, const Paint& paint) {
  RenderScene scene;
  scene.width = scene.height = 9;
  scene.objects.push_back({.mesh = mesh, .paint = paint});
  return Rgb(render(scene).pixel(4, 4));
}

}  // namespace

TEST_CASE(
    "own_paint: an image, else colours of vertices, else those of materials, else directions") {
  MeshFile file = two_materials();
  CHECK(std::holds_alternative<VertexPaint>(own_paint(file)));
  CHECK(std::get<VertexPaint>(own_paint(file)).colours == direction_paint(file).colours);
  const MeshTextures plain{.of_materials = {coloured(1, 0, 0), coloured(0, 1, 0)}};
  CHECK(std::get<TexturePaint>(own_paint(file, plain)).texture_of[1] == 1);
  add_colours(file, ScalarType::Uint8, 51);
  CHECK(std::get<VertexPaint>(own_paint(file, plain)).colours[3] == Rgb::Constant(0.2F));
  const MeshTextures painted{.of_materials = {coloured(1, 0, 0), with_image()}};
  CHECK(std::holds_alternative<TexturePaint>(own_paint(file, painted)));
}

TEST_CASE("own_paint: in glTF colours of vertices multiply the texture, on the sphere too") {
  MeshFile file = two_materials();
  add_colours(file, ScalarType::Uint8, 51);
  const MeshTextures painted{.of_materials = {coloured(1, 0, 0), with_image()}};
  CHECK(std::get<TexturePaint>(own_paint(file, painted)).tints.empty());
  file.format = "glTF binary";
  const auto paint = std::get<TexturePaint>(own_paint(file, painted));
  REQUIRE(std::ssize(paint.tints) == file.mesh.triangles.size());
  const MeshTextures plain{.of_materials = {coloured(1, 0, 0), coloured(0, 1, 0)}};
  CHECK(std::get<TexturePaint>(own_paint(file, plain)).tints == paint.tints);
  for (const Rgb& tint : paint.tints) CHECK((tint - Rgb::Constant(0.2F)).norm() < 1e-6F);
  const RenderObject sphere = on_sphere({.mesh = file.mesh, .paint = paint}, file.mesh.positions);
  CHECK(std::ssize(std::get<TexturePaint>(sphere.paint).tints) == sphere.mesh.triangles.size());

  TexturePaint white{.texcoords = {}, .textures = {coloured(1, 1, 1)}};
  white.tints.assign(static_cast<size_t>(file.mesh.triangles.size()), Rgb(0.5F, 0.25F, 0));
  const VertexPaint same{.colours = std::vector<Rgb>(static_cast<size_t>(file.mesh.vertex_count()),
                                                     Rgb(0.5F, 0.25F, 0))};
  CHECK((seen(file.mesh, white) - seen(file.mesh, same)).norm() < 1e-6F);
}

TEST_CASE(
    "own_paint: directions have hard edges where normals of corners say so, also on the sphere") {
  MeshFile file;
  file.mesh = tests::octahedron();
  CHECK(direction_paint(file).of_corners.empty());
  file.corner_normals = CornerNormals(24, 3);
  for (Face f = 0; f < 8; ++f)
    for (int k = 0; k < 3; ++k)
      file.corner_normals->row(3 * f + k) = file.mesh.position(file.mesh.triangles(f, 0)) +
                                            file.mesh.position(file.mesh.triangles(f, 1)) +
                                            file.mesh.position(file.mesh.triangles(f, 2));
  const VertexPaint paint = direction_paint(file);
  REQUIRE(paint.of_corners.size() == 24);
  const auto colour_of = [&](Eigen::Index corner) -> Rgb {
    return (0.6 + 0.35 * file.corner_normals->row(corner).normalized().array())
        .cast<float>()
        .matrix()
        .transpose();
  };
  for (Eigen::Index corner = 0; corner < 24; ++corner)
    CHECK((paint.of_corners[static_cast<size_t>(corner)] - colour_of(corner)).norm() < 1e-6F);
  const RenderObject sphere = on_sphere({.mesh = file.mesh, .paint = paint}, file.mesh.positions);
  const auto& refined = std::get<VertexPaint>(sphere.paint).of_corners;
  REQUIRE(std::ssize(refined) == sphere.mesh.triangles.size());
  for (Eigen::Index corner = 0; corner < sphere.mesh.triangles.size(); ++corner) {
    Vector3 middle = Vector3::Zero();  // in whose octant a piece lies
    for (int k = 0; k < 3; ++k)
      middle += sphere.mesh.position(sphere.mesh.triangles(corner / 3, k));
    const Vector3 normal = middle.cwiseSign().normalized();
    const Rgb wanted = (0.6 + 0.35 * normal.array()).cast<float>().matrix();
    CHECK((refined[static_cast<size_t>(corner)] - wanted).norm() < 1e-6F);
  }
}

TEST_CASE("own_paint: colours of every type of number are the same colours") {
  for (const auto& [type, full] : {std::pair{ScalarType::Uint8, 255.0},
                                   {ScalarType::Uint16, 65535.0},
                                   {ScalarType::Float32, 1.0}}) {
    MeshFile file = two_materials();
    add_colours(file, type, full);
    CHECK(std::get<VertexPaint>(own_paint(file)).colours[0] == Rgb::Ones());
  }
}

TEST_CASE("own_paint: each face has its material's texture, on the sphere too, or one has all") {
  const MeshFile file = two_materials();
  const MeshTextures textures{.of_materials = {coloured(1, 0, 0), coloured(0, 1, 0)}};
  const auto paint = std::get<TexturePaint>(own_paint(file, textures));
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    CHECK(paint.texture_of[static_cast<size_t>(f)] == (f == 7 ? -1 : f % 2));
  }
  const RenderObject sphere = on_sphere({.mesh = file.mesh, .paint = paint}, file.mesh.positions);
  CHECK(std::ssize(std::get<TexturePaint>(sphere.paint).texture_of) == sphere.mesh.face_count());

  MeshTextures one = textures;
  one.one_for_all = true;
  const Rgb red = seen(file.mesh, own_paint(file, one));
  CHECK(red[0] > 2 * red[1]);
  one.of_materials = {coloured(0, 1, 0)};
  const Rgb green = seen(file.mesh, own_paint(file, one));
  CHECK(green[1] > 2 * green[0]);
}
