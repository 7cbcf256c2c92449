#include <array>
#include <catch2/catch.hpp>
#include <memory>

#include "bake/field_registry.h"
#include "bake/fields/base_colour.h"
#include "bake/fields/material_fields.h"
#include "bake/fields/normal_fields.h"
#include "image/image_codec.h"
#include "io/attributes/corner_colours.h"
#include "scenes.h"
#include "sphparam/chart/tangent_frame.h"
#include "sphparam/io/normal_maps.h"
#include "srgb_curves.h"
#include "support/cube.h"
#include "support/test_meshes.h"
#include "texture/read_textures.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// An image of one texel, inside the file.
MaterialTexture texel(const std::string& name, std::array<float, 3> rgb) {
  Image image(1, 1, 3);
  image.pixels.assign(rgb.begin(), rgb.end());
  const std::vector<char> png = encode_image(image, ImageFormat::Png);
  return {.image = name,
          .bytes = std::make_shared<const std::vector<char>>(png.begin(), png.end())};
}

/// A cube whose faces have normals of their own, and (s, t) that lie on each in another way: turned
/// by quarters, mirrored on every other face. Faces 2i and 2i + 1 are side i, of material i % 2.
struct Cube {
  MeshFile file;
  std::array<Vector3, 6> normals, along_s, along_t;  // of the sides

  Cube() {
    file.mesh = cube();
    const Eigen::Index faces = file.mesh.face_count();
    file.corner_texcoords = CornerTexcoords(3 * faces, 2);
    file.corner_normals = CornerNormals(3 * faces, 3);
    file.materials = {"even", "odd"};
    file.base_colours.resize(2);
    file.channels.resize(2);
    Property material{"material", ScalarType::Int32, {}};
    for (Face f = 0; f < faces; ++f) {
      material.values.push_back(f / 2 % 2);
      lay(f);
    }
    file.set_face_property(std::move(material));
  }

  void lay(Face f) {
    const auto side = static_cast<size_t>(f / 2);
    const auto at = [&](int k) { return file.mesh.position(file.mesh.triangles(f, k)); };
    if (f % 2 == 0) {
      normals[side] = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      along_s[side] = (at(1) - at(0)).normalized();
      along_t[side] = normals[side].cross(along_s[side]);
      if (side % 2 == 1) along_t[side] *= -1;
    }
    for (int k = 0; k < 3; ++k) {
      file.corner_normals->row(3 * f + k) = normals[side];
      file.corner_texcoords->row(3 * f + k) << 0.25 * at(k).dot(along_s[side]),
          0.5 * at(k).dot(along_t[side]);
    }
  }

  std::unique_ptr<BakeScene> scene() const {
    return scene_of(file, normalised(file.mesh.positions));
  }
};

/// Values of a field inside a face.
std::vector<float> inside(const SurfaceField& field, Face f) {
  std::vector<float> values(static_cast<size_t>(field.channels));
  const SurfaceRun run{f, 1, {0.5, 0.3, 0.2}, Vector3::Zero(), Vector3::Zero()};
  field.evaluate_runs(std::span(&run, 1), values.data());
  return values;
}

Vector3 as_vector(const std::vector<float>& values) {
  return {static_cast<double>(values[0]), static_cast<double>(values[1]),
          static_cast<double>(values[2])};
}

}  // namespace

TEST_CASE("material fields: seams are looked for once for all fields, and where images want them") {
  Cube cube;
  const auto bare = cube.scene();
  const auto unused = bare->source.coordinates->of(bare->source.file(), false, true);
  const long known = unused.use_count();
  const SurfaceField numbers = make_orm(*bare, "");
  CHECK(unused.use_count() == known);
  cube.file.channels[1].roughness = texel("r.png", {1, 1, 1});
  cube.file.channels[1].emission = texel("e.png", {1, 1, 1});
  cube.file.base_colours[0] = texel("c.png", {1, 1, 1});
  const auto scene = cube.scene();
  scene->source.textures = read_textures(scene->source.file(), 1);
  const auto seams = scene->source.coordinates->of(scene->source.file(), false, true);
  CHECK(seams->seams.size() == 12);
  const std::array fields = {make_orm(*scene, ""), make_emissive(*scene, ""),
                             make_base_colour(*scene, "")};
  CHECK(seams.use_count() == known + 3);
}

TEST_CASE("material fields: the constants of two materials are baked as they are") {
  Cube cube;
  cube.file.channels[0].roughness.factor[0] = 0.25;
  cube.file.channels[0].metallic.factor[0] = 0.75;
  cube.file.channels[1].roughness.factor[0] = 0.5;
  cube.file.channels[1].metallic.factor[0] = 0;
  cube.file.channels[1].emission.factor = {4, 2, 0, 1};
  const auto scene = cube.scene();
  const SurfaceField orm = make_orm(*scene, ""), emissive = make_emissive(*scene, "");
  CHECK(inside(orm, 0) == std::vector<float>{1, 0.25F, 0.75F});
  CHECK(inside(orm, 3) == std::vector<float>{1, 0.5F, 0});
  CHECK(inside(make_roughness(*scene, ""), 3) == std::vector<float>{0.5F});
  CHECK(inside(make_metallic(*scene, ""), 1) == std::vector<float>{0.75F});
  CHECK(inside(emissive, 0) == std::vector<float>{0, 0, 0});
  CHECK(inside(emissive, 2) == std::vector<float>{1, 0.5F, 0});
  CHECK(emissive.texts ==
        std::vector<std::pair<std::string, std::string>>{{"sphparam:strength", "4"}});
  CHECK(emissive.kind == FieldKind::Colour);
  CHECK(orm.kind == FieldKind::Data);
}

TEST_CASE("material fields: many runs at once are as one by one") {
  Cube cube;
  cube.file.channels[0].roughness = texel("r", {0.25F, 0.5F, 0.75F});
  cube.file.channels[0].emission.factor = {0.5, 0.25, 0.125, 1};
  cube.file.channels[1].emission.factor = {1, 0.75, 0.5, 1};
  const auto scene = cube.scene();
  const Vector3 first(0.5, 0.3, 0.2), step(0.01, -0.02, 0.01);
  const std::vector<SurfaceRun> runs = {{3, 2, first, step, Vector3::Zero()},
                                        {0, 3, first, step, Vector3::Zero()},
                                        {5, 1, first, step, Vector3::Zero()}};
  for (const char* name : {"orm", "roughness", "metallic", "emissive"}) {
    INFO(name);
    const SurfaceField field = make_field(name, *scene);
    const auto values_of = [&](std::span<const SurfaceRun> some) {
      size_t count = 0;
      for (const SurfaceRun& run : some) count += static_cast<size_t>(run.count * field.channels);
      std::vector<float> values(count);
      field.evaluate_runs(some, values.data());
      return values;
    };
    std::vector<float> one_by_one;
    for (const SurfaceRun& run : runs) {
      const std::vector<float> values = values_of(std::span(&run, 1));
      one_by_one.insert(one_by_one.end(), values.begin(), values.end());
    }
    CHECK(values_of(runs) == one_by_one);
  }
}

TEST_CASE("material fields: a face without a material has what glTF says of it") {
  Cube cube;
  cube.file.channels[0].roughness.factor[0] = 0.25;
  Property none{"material", ScalarType::Int32, std::vector<double>(12, -1)};
  cube.file.set_face_property(none);
  const auto scene = cube.scene();
  CHECK(inside(make_orm(*scene, ""), 0) == std::vector<float>{1, 1, 1});
  CHECK(inside(make_emissive(*scene, ""), 0) == std::vector<float>{0, 0, 0});
}

TEST_CASE("material fields: images of numbers are linear, of light sRGB, and factors multiply") {
  Cube cube;
  MaterialChannels& said = cube.file.channels[0];
  said.roughness = texel("a", {0.2F, 0.4F, 0.6F});
  said.roughness.channel = 1;
  said.roughness.factor[0] = 0.5;
  said.metallic = texel("a", {0.2F, 0.4F, 0.6F});
  said.metallic.channel = 2;
  said.occlusion = texel("a", {0.2F, 0.4F, 0.6F});
  said.occlusion.factor[0] = 0.5;
  said.emission = texel("a", {0.2F, 0.4F, 0.6F});
  const auto scene = cube.scene();
  const std::vector<float> orm = inside(make_orm(*scene, ""), 0);
  CHECK(orm[0] == Approx(1 + 0.5 * (0.2 - 1)));
  CHECK(orm[1] == Approx(0.5 * 0.4));
  CHECK(orm[2] == Approx(0.6));
  const std::vector<float> light = inside(make_emissive(*scene, ""), 0);
  CHECK(light[1] == Approx(SrgbCurves::get().to_linear(0.4F)).margin(1e-5));
  CHECK(inside(make_material_occlusion(*scene, ""), 2) == std::vector<float>{1});
}

TEST_CASE("material fields: each image is looked up where its placement puts it") {
  Cube cube;
  Image image(4, 4, 3);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) image.pixel(x, y)[1] = static_cast<float>(16 * y + x) / 255;
  const std::vector<char> png = encode_image(image, ImageFormat::Png);
  MaterialTexture& rough = cube.file.channels[0].roughness;
  rough = {.image = "grid", .bytes = std::make_shared<const std::vector<char>>(png), .channel = 1};
  // (s, t) of a corner → the middle of a texel; every side is one place of the image then.
  rough.placement = {{{0, 0, 2.5 / 4}, {0, 0, 1 - 1.5 / 4}}};
  const auto scene = cube.scene();
  CHECK(inside(make_roughness(*scene, ""), 0)[0] == Approx((16 + 2) / 255.0));
  rough.placement = {{{0, 1, 0}, {1, 0, 0}}};  // s and t change places
  const auto turned = cube.scene();
  rough.placement = {{{1, 0, 0}, {0, 1, 0}}};
  for (Eigen::Index c = 0; c < cube.file.corner_texcoords->rows(); ++c)
    cube.file.corner_texcoords->row(c) = cube.file.corner_texcoords->row(c).reverse().eval();
  CHECK(inside(make_roughness(*turned, ""), 0)[0] ==
        Approx(inside(make_roughness(*cube.scene(), ""), 0)[0]));
}

TEST_CASE("material fields: a normal map is turned from the source's own frame, on every side") {
  Cube cube;
  const Vector3 written(2 * 200 / 255.0 - 1, 2 * 90 / 255.0 - 1, 2 * 220 / 255.0 - 1);
  for (MaterialChannels& said : cube.file.channels)
    said.normal = texel("n", {200 / 255.F, 90 / 255.F, 220 / 255.F});
  cube.file.channels[1].normal.factor[0] = 0.5;
  const auto scene = cube.scene();
  const SurfaceField object = make_object_normal(*scene, "");
  for (Face f = 0; f < 12; ++f) {
    const auto side = static_cast<size_t>(f / 2);
    const double scale = side % 2 == 1 ? 0.5 : 1;
    const Vector3 expected =
        (scale * written[0] * cube.along_s[side] + scale * written[1] * cube.along_t[side] +
         written[2] * cube.normals[side])
            .normalized();
    INFO("side " << side);
    CHECK((as_vector(inside(object, f)) - expected).norm() < 1e-6);
  }
}

TEST_CASE("material fields: normal maps whose green points down are turned over, heights are not") {
  Cube cube;
  cube.file.channels[0].normal = texel("n", {200 / 255.F, 90 / 255.F, 220 / 255.F});
  CHECK(turn_normal_maps_over(cube.file) == 1);
  const Vector3 expected =
      ((2 * 200 / 255.0 - 1) * cube.along_s[0] - (2 * 90 / 255.0 - 1) * cube.along_t[0] +
       (2 * 220 / 255.0 - 1) * cube.normals[0])
          .normalized();
  const auto scene = cube.scene();
  CHECK((as_vector(inside(make_object_normal(*scene, ""), 0)) - expected).norm() < 1e-6);
  Image heights(8, 8, 3);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 3; ++c) heights.pixel(x, y)[c] = static_cast<float>(8 * (7 - y)) / 255;
  const std::vector<char> png = encode_image(heights, ImageFormat::Png);
  MaterialTexture& bump = cube.file.channels[0].normal;
  bump = {.image = "heights", .bytes = std::make_shared<const std::vector<char>>(png)};
  bump.placement = {{{0.01, 0, 0.45}, {0, 0.01, 0.45}}};
  bump.bump = 255.0 / 16 / 2;
  const auto seen = [&] {
    const auto bumped = cube.scene();
    return inside(make_object_normal(*bumped, ""), 0);
  };
  const std::vector<float> before = seen();
  CHECK(turn_normal_maps_over(cube.file) == 1);
  CHECK(seen() == before);
  cube.file.channels[0].normal = {};
  CHECK(turn_normal_maps_over(cube.file) == 0);
}

TEST_CASE("material fields: what a viewer makes of normal-tangent is the turned normal") {
  Cube cube;
  cube.file.channels[0].normal = texel("n", {200 / 255.F, 90 / 255.F, 220 / 255.F});
  const auto scene = cube.scene();
  const SurfaceField object = make_object_normal(*scene, ""),
                     tangent = make_tangent_normal(*scene, "");
  const BakeTarget& target = scene->target;
  const ShadingFrame frame = tangent_frame(target.chart, target.positions, *target.wedge_normals);
  const Vector3 weights(0.5, 0.3, 0.2);
  int turned = 0;
  for (Face f = 0; f < target.chart.triangles.rows(); ++f) {
    // Refined faces lie in those of the source: their middle is a point of it.
    const SurfacePoint place{f, weights};
    Vector3 at = Vector3::Zero(), n = Vector3::Zero(), t = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      const int wedge = target.chart.wedges(f, k);
      at += weights[k] * target.positions.row(target.chart.triangles(f, k));
      n += weights[k] * frame.normals.row(wedge);
      t += weights[k] * frame.tangents.row(wedge).head<3>();
    }
    for (Face source = 0; source < 12; ++source) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k)
        corners.col(k) = cube.file.mesh.position(cube.file.mesh.triangles(source, k));
      const Vector3 inside_it = corners.inverse() * at;
      if ((inside_it.array() < 1e-9).any() || std::abs(inside_it.sum() - 1) > 1e-9) continue;
      const SurfaceSample sample{.point = {source, inside_it}, .seed = 0, .place = place};
      std::array<float, 3> local;
      tangent.evaluate(std::span(&sample, 1), local.data());
      const Vector3 seen = static_cast<double>(local[0]) * t +
                           static_cast<double>(local[1]) * n.cross(t) +
                           static_cast<double>(local[2]) * n;
      CHECK((seen.normalized() - as_vector(inside(object, source))).norm() < 1e-5);
      turned += std::abs(local[2]) < 0.99F;
    }
  }
  CHECK(turned >= 6);
}

TEST_CASE("material fields: where the file says its tangents, normal maps are turned from these") {
  Cube cube;
  const Vector3 written(2 * 200 / 255.0 - 1, 2 * 90 / 255.0 - 1, 2 * 220 / 255.0 - 1);
  for (MaterialChannels& said : cube.file.channels)
    said.normal = texel("n", {200 / 255.F, 90 / 255.F, 220 / 255.F});
  cube.file.corner_tangents = CornerTangents::Zero(36, 4);
  // Of the first three sides; half turned, and of the other hand than (s, t) are.
  for (Eigen::Index corner = 0; corner < 18; ++corner) {
    const auto side = static_cast<size_t>(corner / 6);
    const Vector3 tangent = (cube.along_s[side] + cube.along_t[side]).normalized();
    cube.file.corner_tangents->row(corner) << tangent.transpose(), side == 1 ? 1 : -1;
  }
  const auto scene = cube.scene();
  const SurfaceField object = make_object_normal(*scene, "");
  for (Face f = 0; f < 12; ++f) {
    const auto side = static_cast<size_t>(f / 2);
    const Vector3& n = cube.normals[side];
    Vector3 t = cube.along_s[side], b = cube.along_t[side];
    if (side < 3) {
      t = (t + b).normalized();
      b = (side == 1 ? 1 : -1) * n.cross(t);
    }
    const Vector3 expected = (written[0] * t + written[1] * b + written[2] * n).normalized();
    CHECK((as_vector(inside(object, f)) - expected).norm() < 1e-6);
  }
}

TEST_CASE("material fields: an image on the second coordinates is looked up there") {
  Cube cube;
  Image image(4, 4, 3);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) image.pixel(x, y)[0] = static_cast<float>(16 * y + x) / 255;
  const std::vector<char> png = encode_image(image, ImageFormat::Png);
  MaterialTexture& occlusion = cube.file.channels[0].occlusion;
  occlusion = {
      .image = "lightmap", .bytes = std::make_shared<const std::vector<char>>(png), .second = true};
  cube.file.second_texcoords = CornerTexcoords(36, 2);
  for (Eigen::Index corner = 0; corner < 36; ++corner)
    cube.file.second_texcoords->row(corner) << 2.5 / 4, 1 - 1.5 / 4;
  const auto scene = cube.scene();
  CHECK(inside(make_material_occlusion(*scene, ""), 0)[0] == Approx((16 + 2) / 255.0));
  CHECK(inside(make_orm(*scene, ""), 0)[0] == Approx((16 + 2) / 255.0));
}

TEST_CASE("material fields: where texture coordinates stand still, a normal map turns no normal") {
  Cube cube;
  cube.file.channels[0].normal = texel("n", {1, 0.5F, 0.6F});
  cube.file.corner_texcoords->topRows(6).setConstant(0.25);
  const auto scene = cube.scene();
  const SurfaceField object = make_object_normal(*scene, "");
  for (const Face f : {0, 1}) CHECK((as_vector(inside(object, f)) - cube.normals[0]).norm() < 1e-6);
  CHECK((as_vector(inside(object, 4)) - cube.normals[2]).norm() > 0.5);
}

TEST_CASE("material fields: bumps are slopes of their heights, unless they are normals already") {
  Cube cube;
  Image heights(8, 8, 3);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 3; ++c)
        heights.pixel(x, y)[c] = static_cast<float>(16 * x + 8 * (7 - y)) / 255;
  const std::vector<char> png = encode_image(heights, ImageFormat::Png);
  MaterialTexture& bump = cube.file.channels[0].normal;
  bump = {.image = "heights", .bytes = std::make_shared<const std::vector<char>>(png)};
  bump.placement = {{{0.01, 0, 0.45}, {0, 0.01, 0.45}}};  // inside the image, as small as can be
  bump.bump = 255.0 / 16 / 2;  // half a texel higher a texel, and a quarter
  const auto scene = cube.scene();
  const SurfaceField object = make_object_normal(*scene, "");
  for (const Face f : {0, 4, 8}) {
    const auto side = static_cast<size_t>(f / 2);
    const Vector3 expected =
        (cube.normals[side] - 0.5 * cube.along_s[side] - 0.25 * cube.along_t[side]).normalized();
    CHECK((as_vector(inside(object, f)) - expected).norm() < 1e-3);
  }

  // What is coloured is a normal map, whose x and y are so many times as large.
  cube.file.channels[0].normal = texel("n", {200 / 255.F, 90 / 255.F, 220 / 255.F});
  cube.file.channels[0].normal.bump = 0.5;
  const auto coloured = cube.scene();
  const Vector3 expected =
      (0.5 * (2 * 200 / 255.0 - 1) * cube.along_s[0] +
       0.5 * (2 * 90 / 255.0 - 1) * cube.along_t[0] + (2 * 220 / 255.0 - 1) * cube.normals[0])
          .normalized();
  CHECK((as_vector(inside(make_object_normal(*coloured, ""), 0)) - expected).norm() < 1e-6);
}

TEST_CASE("material fields: an image of alpha is times that of the base colour") {
  Cube cube;
  cube.file.base_colours[0].factor = {1, 1, 1, 0.5};
  cube.file.channels[0].opacity = texel("a", {51 / 255.F, 51 / 255.F, 51 / 255.F});
  for (MaterialChannels& channels : cube.file.channels) channels.alpha_mode = AlphaMode::Blend;
  auto scene = cube.scene();
  scene->source.textures = read_textures(cube.file, 1);
  const SurfaceField field = make_field("basecolor", *scene);
  CHECK(inside(field, 0).at(3) == Approx(0.5 * 0.2).margin(1e-4));
  CHECK(inside(field, 2).at(3) == 1);
}

TEST_CASE("material fields: alpha counts only where a material says so") {
  Cube cube;
  for (MaterialTexture& colour : cube.file.base_colours) colour.factor = {1, 1, 1, 0.5};
  const auto alpha_of = [&](Face f) {
    auto scene = cube.scene();
    scene->source.textures = read_textures(cube.file, 1);
    const std::vector<float> values = inside(make_field("basecolor", *scene), f);
    return values.size() == 4 ? values[3] : -1;
  };
  CHECK(alpha_of(0) == -1);
  cube.file.channels[1].alpha_mode = AlphaMode::Blend;
  CHECK(alpha_of(2) == -1);  // beside what is opaque
  CHECK(texts_of_material(cube.file).empty());
  cube.file.channels[0].alpha_mode = AlphaMode::Blend;
  CHECK(alpha_of(0) == 0.5F);
  CHECK(alpha_of(2) == 0.5F);
  CHECK(texts_of_material(cube.file).at(0) ==
        std::pair<std::string, std::string>{alpha_text, "blend"});
  cube.file.channels[1].alpha_mode = AlphaMode::Mask;
  CHECK(alpha_of(0) == 1);
  CHECK(alpha_of(2) == 0.5F);
  cube.file.channels[1].alpha_cutoff = 0.25;
  CHECK(alpha_of(2) == 0.5F);
  cube.file.channels[0].alpha_mode = AlphaMode::Mask;  // by 0.5, where its alpha is
  CHECK(alpha_of(0) == 0.25F);
  cube.file.channels[0].alpha_cutoff = 0;
  CHECK(alpha_of(0) == 1);
  cube.file.channels[0].double_sided = true;
  CHECK(texts_of_material(cube.file) == std::vector<std::pair<std::string, std::string>>{
                                            {alpha_text, "mask 0.25"}, {sides_text, "1"}});
}

TEST_CASE("material fields: alpha of vertices is times that of a glTF's base colour") {
  Cube cube;
  for (const char* name : {"red", "green", "blue"})
    cube.file.set_vertex_property({name, ScalarType::Float32, std::vector<double>(8, 1)});
  cube.file.set_vertex_property({"alpha", ScalarType::Uint8, std::vector<double>(8, 51)});
  for (MaterialTexture& colour : cube.file.base_colours) colour.factor = {1, 1, 1, 0.5};
  const auto colour_of = [&](const char* field, Face f) {
    auto scene = cube.scene();
    scene->source.textures = read_textures(cube.file, 1);
    return inside(make_field(field, *scene), f);
  };
  CHECK(colour_of("vcolor", 0).at(3) == Approx(0.2));
  CHECK(colour_of("basecolor", 0).size() == 3);  // a format that gives alpha no meaning
  cube.file.format = "glTF binary";
  CHECK(colour_of("basecolor", 0).size() == 3);  // opaque
  for (MaterialChannels& channels : cube.file.channels) channels.alpha_mode = AlphaMode::Blend;
  CHECK(colour_of("basecolor", 0).at(3) == Approx(0.1));
  cube.file.channels[1].alpha_mode = AlphaMode::Mask;
  CHECK(colour_of("basecolor", 2).at(3) == Approx(0.1));
  CHECK(colour_of("basecolor", 0).at(3) == 1);
  cube.file.set_vertex_property({"alpha", ScalarType::Uint8, std::vector<double>(8, 255)});
  CHECK(colour_of("vcolor", 0).size() == 3);
}

TEST_CASE("material fields: corners have their own colours where vertices have several") {
  Cube cube;
  for (const char* name : {"red", "green", "blue"})
    cube.file.set_vertex_property({name, ScalarType::Uint8, std::vector<double>(8, 255)});
  CornerColours colours = CornerColours::Constant(36, 4, 255);
  colours.topRows(3).col(1).setZero();  // face 0 is magenta
  set_corner_colours(cube.file, colours);
  for (const bool is_gltf : {false, true}) {
    if (is_gltf) cube.file.format = "glTF";
    auto scene = cube.scene();
    if (is_gltf) scene->source.textures = read_textures(cube.file, 1);
    for (const char* field : {"vcolor", "basecolor"}) {
      const SurfaceField made = make_field(field, *scene);
      CHECK(inside(made, 0) == std::vector<float>{1, 0, 1});
      CHECK(inside(made, 1) == std::vector<float>{1, 1, 1});
    }
  }
}

TEST_CASE("material fields: what is blended beside what is not is drawn over what lies behind") {
  // Of the cube's sides 1, 3 and 5 are half of red glass; opposite ones are green.
  Cube cube;
  cube.file.base_colours[0].factor = {0, 1, 0, 1};
  cube.file.base_colours[1].factor = {1, 0, 0, 0.5};
  cube.file.channels[1].alpha_mode = AlphaMode::Blend;
  const auto colour_of = [&](Face f) {
    auto scene = cube.scene();
    scene->source.textures = read_textures(cube.file, 1);
    return inside(make_field("basecolor", *scene), f);
  };
  CHECK(colour_of(0) == std::vector<float>{0, 1, 0});
  CHECK(colour_of(2) == std::vector<float>{1, 0, 0});  // nobody draws the back of the other side
  cube.file.channels[0].double_sided = true;
  CHECK(colour_of(2) == std::vector<float>{0.5F, 0.5F, 0});
  cube.file.channels[0].alpha_mode = AlphaMode::Mask;  // it is there
  CHECK(colour_of(2) == std::vector<float>{0.5F, 0.5F, 0});
  cube.file.base_colours[0].factor[3] = 0.25;  // it is not
  CHECK(colour_of(2) == std::vector<float>{1, 0, 0, 1});
}

TEST_CASE("material fields: colours of vertices multiply a glTF's texture, and stand for others'") {
  Cube cube;
  cube.file.base_colours[0].factor = {0.5, 1, 1, 1};
  for (const char* name : {"red", "green", "blue"})
    cube.file.set_vertex_property({name, ScalarType::Float32, std::vector<double>(8, 0.5)});
  const auto red = [&] {
    auto scene = cube.scene();
    scene->source.textures = {{.factor = {0.5F, 1, 1, 1}}, {}};
    scene->source.textures[1].image = std::make_shared<const TexturePyramid>([] {
      Image white(1, 1, 3);
      white.pixels.assign(3, 1.0F);
      return white;
    }());
    return inside(make_field("basecolor", *scene), 0)[0];
  };
  CHECK(red() == Approx(0.5));
  cube.file.format = "glTF binary";
  CHECK(red() == Approx(0.5 * SrgbCurves::get().to_linear(0.5F)));
}

TEST_CASE("material fields: colours of vertices multiply a glTF's factors where no image is") {
  Cube cube;
  for (const char* name : {"red", "green", "blue"})
    cube.file.set_vertex_property({name, ScalarType::Float32, std::vector<double>(8, 1)});
  const auto blue = [&] {
    auto scene = cube.scene();
    scene->source.textures = {{.factor = {1, 1, 0.25F, 1}}, {}};
    return inside(make_field("basecolor", *scene), 0)[2];
  };
  CHECK(blue() == Approx(1));
  cube.file.format = "glTF";
  CHECK(blue() == Approx(0.25));
}

TEST_CASE("material fields: a mesh without materials, or without coordinates for them, is told") {
  Cube cube;
  cube.file.channels[0].roughness = texel("r", {1, 1, 1});
  cube.file.corner_texcoords.reset();
  const auto bare = cube.scene();
  CHECK_THROWS_WITH(make_orm(*bare, ""), Catch::Contains("no texture coordinates") &&
                                             Catch::Contains("`sphparam asset` leaves"));
  cube.file.channels.clear();
  const auto none = cube.scene();
  for (const char* name : {"emissive", "orm", "roughness", "metallic"})
    CHECK_THROWS_WITH(make_field(name, *none), Catch::Contains("nothing of materials"));
}

TEST_CASE("channels_of: those that a mesh has something to say of") {
  MeshFile plain;
  plain.mesh = icosphere(1);
  CHECK(channels_of(plain).empty());
  Cube cube;
  CHECK(channels_of(cube.file) == std::vector<std::string>{"basecolor", "orm"});
  cube.file.channels[1].emission.factor[2] = 0.5;
  cube.file.channels[1].normal = texel("n", {0.5F, 0.5F, 1});
  CHECK(channels_of(cube.file) == all_channels());
}
