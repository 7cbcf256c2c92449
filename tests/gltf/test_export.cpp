#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <tuple>

#include "../chart/maps.h"
#include "image/image_codec.h"
#include "io/attributes/corner_colours.h"
#include "sphparam/bake/bake.h"
#include "sphparam/bake/bake_errors.h"
#include "sphparam/errors.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/safe_file.h"
#include "support/bytes_of.h"
#include "support/folder.h"
#include "support/glb_json.h"
#include "support/test_meshes.h"

/// What a program gets that links the library: mapped meshes in, files out.
namespace sphparam::tests {

namespace {

using Names = std::vector<std::string>;

MappedMesh mapped_egg(int level) {
  MeshFile file;
  file.mesh = icosphere(level);
  SphereMap map{file.mesh.positions};
  file.mesh.positions.col(2) *= 1.3;
  return MappedMesh({.file = std::move(file), .map = std::move(map), .name = "egg.obj"});
}

const ExportOptions small{.look = {.image_width = 64}};

}  // namespace

TEST_CASE("export: a mesh made of another shows that one's colours where it carries its place") {
  const MappedMesh source = mapped_egg(3), made = mapped_egg(2);
  const Look own = make_look(made, small), look = make_look(made, source, small);
  REQUIRE(look.images.size() == own.images.size());
  CHECK(look.images[0].bytes == own.images[0].bytes);
  CHECK(look.materials[0].name == "checker");
}

TEST_CASE("export: far from the origin positions are as fine as near it, and a node moves them") {
  const Folder folder;
  const Eigen::RowVector3d far(391234.25, 5821456.5, 34.125);
  MeshFile file = mapped_egg(3).file();
  for (const bool quantise : {false, true}) {
    file.mesh.positions = mapped_egg(3).mesh().positions.rowwise() + far;
    const MappedMesh scan({.file = file, .map = mapped_egg(3).map(), .name = "scan.obj"});
    ExportOptions options = small;
    options.quantise = quantise;
    options.coarser.push_back(
        MappedMesh({.file = file, .map = mapped_egg(3).map(), .name = "scan.obj"}));
    write_asset(folder / "far.glb", make_asset(scan, options), {.quantise = quantise});
    const Points read = read_mesh(folder / "far.glb").mesh.positions;
    // z up becomes y up.
    const double half_step = quantise ? 2.61 / 65535 / 2 : std::ldexp(1, -23);
    for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) {
      const Vector3 p = file.mesh.position(v);
      CHECK((read.row(v).transpose() - Vector3(p.x(), p.z(), -p.y())).cwiseAbs().maxCoeff() <=
            half_step);
    }
    const auto nodes = json_of(bytes_of(folder / "far.glb"))["nodes"];
    CHECK(nodes[0]["translation"] == nodes[1]["translation"]);
    if (!quantise) CHECK(nodes[0]["translation"] == nlohmann::json({391234, 34, -5821456}));
  }
  file.mesh.positions = mapped_egg(3).mesh().positions.rowwise() + Eigen::RowVector3d(0, 20, 0);
  const MappedMesh near({.file = file, .map = mapped_egg(3).map(), .name = "near.obj"});
  write_asset(folder / "near.glb", make_asset(near, small));
  CHECK_FALSE(json_of(bytes_of(folder / "near.glb"))["nodes"][0].contains("translation"));
}

TEST_CASE("export: colours of vertices that have several are baked, others written as they are") {
  MeshFile file = mapped_egg(2).file();
  for (const char* name : {"red", "green", "blue"})
    file.set_vertex_property(
        {name, ScalarType::Uint8,
         std::vector<double>(static_cast<size_t>(file.mesh.vertex_count()), 255)});
  const auto look_of = [&] {
    return make_look(MappedMesh({.file = file, .map = mapped_egg(2).map()}), small);
  };
  CHECK(look_of().vertex_colours);
  set_corner_colours(file, CornerColours::Constant(file.mesh.triangles.size(), 4, 128));
  const Look baked = look_of();
  CHECK_FALSE(baked.vertex_colours);
  const std::string& png = baked.images.at(0).bytes;
  CHECK(decode_image({png.begin(), png.end()}, "baked").pixel(3, 9)[1] ==
        Approx(128 / 255.0).margin(0.01));
}

TEST_CASE("export: where the mesh's own colour is baked, what else its materials say is told") {
  MeshFile file = mapped_egg(2).file();
  file.materials = {"m"};
  file.base_colours.resize(1);
  file.channels.resize(1);
  file.channels[0].roughness.factor[0] = 0.5;
  file.channels[0].emission.factor[0] = 2;
  file.channels[0].alpha_mode = AlphaMode::Mask;
  file.channels[0].double_sided = true;
  file.set_face_property(
      {"material", ScalarType::Int32, std::vector<double>(file.mesh.face_count(), 0)});
  const auto look_of = [&](const ExportOptions& options) {
    return make_look(MappedMesh({.file = file, .map = mapped_egg(2).map(), .name = "egg.obj"}),
                     options);
  };
  const Look look = look_of(small);
  CHECK(look.materials[0].double_sided);
  CHECK(look.warnings == Names{"not carried: roughness, metallic, emission and alpha of its "
                               "materials: `bake --map channels` makes images of all"});
  const Folder folder;
  bake(mapped_egg(2), {{"normal-object", folder / "orm.png"}}, {.width = 64});
  ExportOptions by_folder = small;
  by_folder.look.folder = folder.path.string();
  CHECK(look_of(by_folder).warnings == Names{"not carried: emission and alpha of its materials: "
                                             "`bake --map channels` makes images of all"});
  file.channels[0].unlit = true;
  CHECK(look_of(small).warnings ==
        Names{"not carried: alpha of its materials: `bake --map channels` makes images of all"});
}

TEST_CASE(
    "export: finish and unlit of the source's materials are carried, also by way of an image") {
  const Folder folder;
  const auto egg_of = [](const MaterialChannels& said) {
    MeshFile file = mapped_egg(3).file();
    file.materials = {"m"};
    file.base_colours = {MaterialTexture{.factor = {1, 0.5, 0.25, 1}}};
    file.channels = {said};
    file.set_face_property(
        {"material", ScalarType::Int32, std::vector<double>(file.mesh.face_count(), 0)});
    return MappedMesh({.file = std::move(file), .map = mapped_egg(3).map(), .name = "egg.obj"});
  };
  MaterialFinish glass;
  glass.transmission = 1;
  glass.thickness = 0.5;
  glass.attenuation_distance = 2;
  glass.attenuation_colour = {1, 0.5, 0};
  glass.sheen = {0.25, 0, 0};
  for (const bool unlit : {false, true}) {
    const MappedMesh egg = egg_of({.metallic = {.factor = {0, 1, 1, 1}},
                                   .double_sided = true,
                                   .unlit = unlit,
                                   .finish = glass});
    const MaterialFinish seen = unlit ? MaterialFinish() : glass;
    bake(egg, {{"basecolor", folder / "a.png"}}, {.width = 64});
    ExportOptions by_image = small;
    by_image.look.texture = folder / "a.png";
    for (const Look& look : {make_look(egg, small), make_look(mapped_egg(3), by_image)}) {
      CHECK(look.materials[0].finish == seen);
      CHECK(look.materials[0].unlit == unlit);
      CHECK(look.warnings.empty());
      write_asset(folder / "a.glb", make_asset(egg, look, small));
      const MaterialChannels back = read_mesh(folder / "a.glb").channels.at(0);
      CHECK(back.finish == seen);
      CHECK(back.unlit == unlit);
    }
    // Who names an image that light falls on wants light.
    const auto is_unlit = [&](const ExportOptions& options) {
      return make_look(mapped_egg(3), options).materials[0].unlit;
    };
    for (std::string LookOptions::*image :
         {&LookOptions::occlusion, &LookOptions::orm, &LookOptions::emissive}) {
      ExportOptions lit = by_image;
      lit.look.*image = folder / "a.png";
      CHECK_FALSE(is_unlit(lit));
    }
    by_image.look.tangents = true;
    CHECK_FALSE(is_unlit(by_image));
  }
}

TEST_CASE("export: each image that is not twice as wide as high is told, whatever it shows") {
  const Folder folder;
  write_image(folder / "square.png", Image(16, 16, 3));
  write_image(folder / "wide.png", Image(32, 16, 3));
  using Member = std::string LookOptions::*;
  for (const Member member : {&LookOptions::texture, &LookOptions::normal, &LookOptions::occlusion,
                              &LookOptions::orm, &LookOptions::emissive}) {
    ExportOptions options = small;
    options.look.*member = folder / "wide.png";
    CHECK(make_look(mapped_egg(2), options).warnings.empty());
    options.look.*member = folder / "square.png";
    CHECK(make_look(mapped_egg(2), options).warnings ==
          Names{"square.png: 16 × 16: an equirectangular image of the whole sphere is twice as "
                "wide as high"});
  }
}

TEST_CASE("export: an asset has a look, a proof of its coordinates and the mesh's name") {
  const Asset asset = make_asset(mapped_egg(2), small);
  CHECK(asset.name == "egg");
  REQUIRE(asset.charts.size() == 1);
  CHECK(asset.charts[0].stored.one_to_one());
  CHECK(asset.charts[0].vertices == static_cast<long>(asset.levels[0].vertex_count()));
  CHECK(asset.materials.front().name == "checker");
  CHECK(asset.extras.front() == std::pair<std::string, std::string>("source", "egg.obj"));
  CHECK(asset.warnings.empty());
}

TEST_CASE("export: a mesh that lies on its side stands up, and the file says what was up") {
  const MappedMesh egg = mapped_egg(2);
  const Asset upright = make_asset(egg, small);
  for (const char* extra : {"up", "front"})
    for (const auto& [key, value] : upright.extras) CHECK(key != extra);
  MeshFile lying = egg.file();  // z goes to −x, −y to z
  const Points p = lying.mesh.positions;
  lying.mesh.positions << -p.col(2), p.col(0), -p.col(1);
  ExportOptions options = small;
  options.up = {.direction = -Vector3::UnitX(), .front = Vector3::UnitZ()};
  const MappedMesh turned({.file = lying, .map = egg.map(), .name = "egg.obj"});
  const Asset made = make_asset(turned, options);
  CHECK(made.levels[0].positions == upright.levels[0].positions);
  CHECK(made.levels[0].indices == upright.levels[0].indices);
  CHECK(made.levels[0].normals.isApprox(upright.levels[0].normals, 1e-6F));
  using Extra = std::pair<std::string, std::string>;
  CHECK(std::ranges::count(made.extras, Extra("up", "-x")) == 1);
  CHECK(std::ranges::count(made.extras, Extra("front", "z")) == 1);
  CHECK(make_asset(turned, small).levels[0].positions != upright.levels[0].positions);
  note_up(lying, options.up);  // now its file says so
  CHECK(make_asset(MappedMesh({.file = lying, .map = egg.map()}), small).levels[0].positions ==
        upright.levels[0].positions);
}

TEST_CASE("export: the sphere of a map that stands as the mesh has its front in front") {
  for (const Convention convention : {Convention::Sphparam, Convention::Gis}) {
    const MeshFile file = mapped_egg(2).file();
    Provenance lines;
    ExportOptions options = small;
    options.shape = ShapeKind::Sphere;
    options.convention = convention;
    const SphereMap map{icosphere(2).positions};
    const auto front_of = [&] {  // where the vertex nearest to θ = 0 on the equator is
      const Asset asset =
          make_asset(MappedMesh({.file = file, .map = map, .provenance = lines}), options);
      Eigen::Index v = 0;
      map.points.col(0).maxCoeff(&v);
      return Vector3(asset.levels[0].positions.row(v).cast<double>());
    };
    const Vector3 unasked = front_of();
    lines = {{"upright", "z, front -y"}};
    CHECK(front_of().z() > 0.99);
    CHECK(unasked.z() < 0.9);
  }
}

TEST_CASE("export: an .obj and a .ply stay in their axes and say which are asked for") {
  const Folder folder;
  ExportOptions options = small;
  options.up = {.direction = Vector3::UnitX(), .front = -Vector3::UnitZ()};
  for (const char* name : {"a.obj", "a.ply"}) {
    write_textured_mesh(folder / name, mapped_egg(2), options);
    const MeshFile file = read_mesh(folder / name);
    CHECK(noted_up(file) == options.up);
    CHECK(file.mesh.positions.col(2).maxCoeff() > 1.29);
  }
}

TEST_CASE("export: the path decides what is written, and names of files are known before") {
  const Folder folder;
  const Asset asset = make_asset(mapped_egg(2), small);
  write_asset(folder / "a.glb", asset);
  CHECK(json_of(bytes_of(folder / "a.glb"))["nodes"].size() == 1);
  write_asset(folder / "b.gltf", asset);
  write_asset(folder / "c.gltf", asset, {.container = GltfContainer::Embedded});
  CHECK(folder.names() == Names{"a.glb", "b.bin", "b.gltf", "b_checker.png", "c.gltf"});
  CHECK(asset_files(folder / "b.gltf", asset) ==
        Names{folder / "b.gltf", folder / "b.bin", folder / "b_checker.png"});
  CHECK_THROWS_AS(write_asset(folder / "d.obj", asset), std::invalid_argument);
}

TEST_CASE("export: files that are not published leave nothing behind") {
  const Folder folder;
  {
    PendingFiles files;
    const WrittenFiles written =
        add_asset(files, folder / "a.gltf", make_asset(mapped_egg(1), small));
    CHECK(written.size() == 3);
  }
  CHECK(folder.names().empty());
}

TEST_CASE("export: coarser meshes on the same sphere are levels of the one file") {
  ExportOptions options = small;
  options.coarser = {mapped_egg(1)};
  const Asset asset = make_asset(mapped_egg(2), options);
  REQUIRE(asset.levels.size() == 2);
  CHECK(asset.charts[1].triangles < asset.charts[0].triangles);
  CHECK(json_of(glb_bytes(asset))["extensionsUsed"][0] == "MSFT_lod");
}

TEST_CASE("export: what is certified as 16-bit numbers is written so") {
  const Folder folder;
  ExportOptions options = small;
  options.quantise = true;
  write_asset(folder / "q.glb", make_asset(mapped_egg(2), options));
  CHECK(json_of(bytes_of(folder / "q.glb"))["extensionsUsed"][0] == "KHR_mesh_quantization");
}

TEST_CASE("export: faces smaller than a step of 16-bit numbers keep their corners") {
  const Folder folder;
  MeshFile file = mapped_egg(3).file();
  SphereMap map = mapped_egg(3).map();
  // The ring of a vertex comes within a hundred thousandth of it.
  const Vertex centre = file.mesh.triangles(0, 0);
  const auto near = file.mesh.positions.row(centre).eval();
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    if ((file.mesh.triangles.row(f).array() != centre).all()) continue;
    for (int k = 0; k < 3; ++k) {
      auto corner = file.mesh.positions.row(file.mesh.triangles(f, k));
      if ((corner - near).norm() > 1e-3) corner = near + 1e-5 * (corner - near).eval();
    }
  }
  const MappedMesh tiny({.file = std::move(file), .map = std::move(map), .name = "tiny.obj"});
  const auto places_of = [&](bool quantise, bool compress) {
    ExportOptions options = small;
    options.quantise = quantise;
    write_asset(folder / "q.glb", make_asset(tiny, options), {.compress = compress});
    const MeshFile read = read_mesh(folder / "q.glb");
    std::set<std::array<double, 3>> places;
    for (Vertex v = 0; v < read.mesh.vertex_count(); ++v)
      places.insert(
          {read.mesh.positions(v, 0), read.mesh.positions(v, 1), read.mesh.positions(v, 2)});
    return std::ssize(places);
  };
  const auto apart = places_of(false, false);
  CHECK(apart >= tiny.mesh().vertex_count());
  CHECK(places_of(true, false) == apart);
  CHECK(places_of(true, true) == apart);
}

/// (u, v) of a triangle that floats tell apart and 16-bit numbers do not.
Asset with_a_tiny_triangle(Asset asset) {
  Surface& surface = asset.levels.front();
  FloatRows& uv = surface.texcoords.front();
  const auto row = [&](std::size_t k) { return static_cast<Eigen::Index>(surface.indices[k]); };
  constexpr float near = 0.250002F;
  uv.row(row(0)) << 0.25F, 0.25F;
  uv.row(row(1)) << 0.25F, near;
  uv.row(row(2)) << near, 0.25F;
  return asset;
}

TEST_CASE("export: 16-bit numbers that nobody certified are refused where they fold") {
  const Folder folder;
  const Asset asset = make_asset(mapped_egg(2), small);
  write_asset(folder / "fits.glb", asset, {.quantise = true});
  const Asset tiny = with_a_tiny_triangle(asset);
  CHECK_THROWS_AS(write_asset(folder / "tiny.glb", tiny, {.quantise = true}), NotCertifiedError);
  CHECK_THROWS_WITH(write_asset(folder / "tiny.glb", tiny, {.quantise = true}),
                    Catch::Contains("would fold in (u, v) as 16-bit numbers"));
  write_asset(folder / "floats.glb", tiny);
  Asset told = tiny;
  told.quantised = true;  // by whoever made it so, with a warning
  write_asset(folder / "told.glb", told);
  CHECK(folder.names() == Names{"fits.glb", "floats.glb", "told.glb"});
}

TEST_CASE("export: a coarser mesh that seems to be on another sphere is told, others are not") {
  const auto needle = [](int level) {
    MeshFile file = mapped_egg(level).file();
    file.mesh.positions.col(2) *= 6;
    return MappedMesh({.file = file, .map = mapped_egg(level).map(), .name = "needle.obj"});
  };
  ExportOptions options = small;
  options.coarser = {needle(2), needle(1), needle(0)};
  CHECK(make_asset(needle(4), options).warnings.empty());
  std::mt19937 random(4);
  const MappedMesh low = needle(3);
  options.coarser = {low.with_map(rotated(low.map(), random_rotation(random)), {})};
  CHECK_THAT(make_asset(needle(4), options).warnings.back(),
             Catch::Contains("the level of 1,280 triangles may be on another sphere") ||
                 Catch::Contains("the level of 1280 triangles may be on another sphere"));
}

TEST_CASE("export: an image that is made can be cancelled between its rows") {
  ExportOptions options{.look = {.image_width = 1024}};
  bool within = false;
  options.progress = [&](std::string_view stage, double done) {
    within = within || (stage == "image checker" && done > 0 && done < 1);
    return !within;
  };
  CHECK_THROWS_AS(make_look(mapped_egg(1), options), Cancelled);
  CHECK(within);
}

TEST_CASE("export: a compressed file is read back as the asset, in an order that is smaller") {
  const Folder folder;
  ExportOptions options = small;
  options.quantise = true;
  const Asset asset = make_asset(mapped_egg(4), options);
  const GltfOptions compressed{.quantise = true, .compress = true};
  write_asset(folder / "c.glb", asset, compressed);
  CHECK(bytes_of(folder / "c.glb").size() < glb_bytes(asset, compressed).size());
  const MeshFile read = read_mesh(folder / "c.glb");
  CHECK(read.mesh.face_count() == static_cast<Face>(asset.levels[0].indices.size() / 3));
}

TEST_CASE("export: glass is as thick in a file of 16-bit numbers, whose node scales them") {
  Asset asset = make_asset(mapped_egg(2), small);
  asset.materials.front().finish.transmission = 1;
  asset.materials.front().finish.thickness = 0.25;
  const Folder folder;
  for (const bool quantise : {false, true}) {
    write_asset(folder / "a.glb", asset, {.quantise = quantise});
    const MeshFile read = read_mesh(folder / "a.glb");
    REQUIRE(read.channels.size() == 1);
    CHECK(read.channels.front().finish.thickness == Approx(0.25));
  }
}

TEST_CASE("export: a kept topology is told, with the triangles that fold") {
  ExportOptions options = small;
  options.keep_topology = true;
  MappedMesh turned = mapped_egg(2);
  std::mt19937 random(4);
  turned = turned.with_map(rotated(turned.map(), random_rotation(random)), {});
  const Asset asset = make_asset(turned, options);
  REQUIRE(asset.warnings.size() == 1);
  CHECK_THAT(asset.warnings[0], Catch::StartsWith("egg.obj: "));
  CHECK_THAT(asset.warnings[0], Catch::Contains("fold in (u, v), as no vertex may be added"));
}

TEST_CASE("export: textured meshes are certified as read back, with the files they name") {
  const Folder folder;
  const TexturedFiles obj = write_textured_mesh(folder / "a.obj", mapped_egg(2), small);
  CHECK(obj.chart.stored.one_to_one());
  CHECK(obj.files.size() == 3);
  write_textured_mesh(folder / "b.ply", mapped_egg(2), small);
  CHECK(folder.names() == Names{"a.mtl", "a.obj", "a_checker.png", "b.ply", "b_checker.png"});
  CHECK(read_mesh(folder / "b.ply").corner_texcoords.has_value());
  CHECK_THROWS_AS(write_textured_mesh(folder / "c.stl", mapped_egg(1), small),
                  std::invalid_argument);
}

TEST_CASE("export: an .obj has normals, roughness, metallic and emission too, read back as given") {
  const Folder folder;
  const MappedMesh egg = mapped_egg(2);
  ExportOptions options = small;
  Image orm(4, 2, 3), lamp(4, 2, 3), bumps(4, 2, 3);
  for (std::size_t i = 0; i < orm.pixels.size(); ++i) orm.pixels[i] = static_cast<float>(i) / 255;
  lamp.pixels[0] = bumps.pixels[2] = 1;
  options.look.orm = folder / "given_orm.png";
  options.look.emissive = folder / "given_emissive.png";
  options.look.normal = folder / "given_normal-tangent.png";
  write_image(options.look.orm, orm);
  write_image(options.look.emissive, lamp, {.metadata = {{"sphparam:strength", "2.5"}}});
  write_image(options.look.normal, bumps);
  const TexturedFiles written = write_textured_mesh(folder / "a.obj", egg, options);
  CHECK(written.warnings ==
        Names{"not carried: occlusion of the image orm: .glb and .gltf have room "
              "for that"});
  CHECK(written.files.size() == 7);
  CHECK_NOTHROW(write_textured_mesh(folder / "a.obj", egg, options));  // all of these are its own
  const std::string library = bytes_of(folder / "a.mtl");
  CHECK(
      library.ends_with("map_Kd a_white.png\nPr 1\nPm 1\nKe 2.5 2.5 2.5\n"
                        "map_Pr a_roughness.png\nmap_Pm a_metallic.png\n"
                        "map_Ke a_emissive.png\nnorm a_normal.png\n"));
  const MaterialChannels said = read_mesh(folder / "a.obj").channels.at(0);
  CHECK(said.roughness.factor[0] == 1);
  CHECK(said.metallic.factor[0] == 1);
  CHECK(said.emission.factor == std::array<double, 4>{2.5, 2.5, 2.5, 1});
  const auto pixels = [](const MaterialTexture& texture) {
    return read_image(texture.folder + "/" + texture.path).pixels;
  };
  CHECK(pixels(said.emission) == read_image(options.look.emissive).pixels);
  CHECK(pixels(said.normal) == read_image(options.look.normal).pixels);
  const std::vector<float> roughness = pixels(said.roughness), metallic = pixels(said.metallic);
  REQUIRE(roughness.size() == 8);
  REQUIRE(metallic.size() == 8);
  const std::vector<float> given = read_image(options.look.orm).pixels;
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(roughness[i] == given[3 * i + 1]);
    CHECK(metallic[i] == given[3 * i + 2]);
  }
  write_textured_mesh(folder / "b.ply", egg, options);
  CHECK_FALSE(std::filesystem::exists(folder / "b_roughness.png"));
}

TEST_CASE("export: of an .obj roughness and metallic that are one number stand in its library") {
  const Folder folder;
  const MappedMesh egg = mapped_egg(2);
  Look look = make_look(egg, small);
  look.materials.front().roughness = 0.25;
  look.materials.front().metallic = 1;
  PendingFiles files;
  CHECK(add_textured_mesh(files, folder / "a.obj", egg, look, small).warnings.empty());
  files.publish();
  const MaterialChannels said = read_mesh(folder / "a.obj").channels.at(0);
  CHECK(said.roughness.factor[0] == 0.25);
  CHECK(said.metallic.factor[0] == 1);
  CHECK(said.roughness.image.empty());
}

TEST_CASE("export: u and v by place, on the sphere of a glTF file, are those of the docs") {
  const auto turns_apart = [](double a, double b) { return std::abs(a - b - std::round(a - b)); };
  for (const bool upright : {false, true}) {
    MappedMesh ball = mapped_egg(2);
    if (upright) ball = ball.with_map(ball.map(), {{"upright", "z, front -y"}});
    for (const auto& [convention, turns, offset] : {std::tuple(Convention::Sphparam, 1, 0.0),
                                                    {Convention::Three, 1, 0.5},
                                                    {Convention::Gis, 1, 0.5},
                                                    {Convention::Envmap, -1, 0.25},
                                                    {Convention::Blender, -1, 0.5}}) {
      ExportOptions options = small;
      options.shape = ShapeKind::Sphere;
      options.convention = convention;
      const Asset asset = make_asset(ball, options);
      const Surface& sphere = asset.levels.front();
      for (Eigen::Index i = 0; i < sphere.positions.rows(); ++i) {
        const Vector3 p = sphere.positions.row(i).cast<double>();
        if (std::hypot(p.x(), p.z()) < 1e-3) continue;
        const double theta = upright ? std::atan2(p.x(), p.z()) : std::atan2(-p.z(), p.x());
        const double u = turns * theta / (2 * std::numbers::pi) + (upright ? offset : 0);
        const FloatRows& uv = sphere.texcoords.front();
        CHECK(turns_apart(u, static_cast<double>(uv(i, 0))) < 1e-5);
        CHECK(static_cast<double>(uv(i, 1)) ==
              Approx(std::acos(p.y()) / std::numbers::pi).margin(1e-5));
      }
    }
  }
}

TEST_CASE("export: what of a look an .obj has no words for is told") {
  const Folder folder;
  const MappedMesh egg = mapped_egg(2);
  CHECK(write_textured_mesh(folder / "plain.obj", egg, small).warnings.empty());
  Look look = make_look(egg, small);
  look.warnings = {"said before"};
  look.images.push_back({"occlusion", look.images.front().bytes});
  look.materials.front().occlusion = 1;
  look.materials.front().alpha_mode = AlphaMode::Mask;
  look.materials.front().finish.clearcoat = 1;
  PendingFiles files;
  CHECK(
      add_textured_mesh(files, folder / "a.obj", egg, look, small).warnings ==
      Names{
          "said before",
          "not carried: the image occlusion, how alpha is meant and KHR_materials_clearcoat: .glb "
          "and .gltf have room for that"});
}

TEST_CASE("export: what an image says of its light is taken if it is a number of glTF's") {
  const Folder folder;
  const auto strength = [&](const std::string& said) {
    ExportOptions options = small;
    options.look.emissive = folder / "emissive.png";
    Image lamp(4, 2, 3);
    lamp.pixels[0] = 1;
    write_image(options.look.emissive, lamp, {.metadata = {{"sphparam:strength", said}}});
    return make_look(mapped_egg(1), options).materials.front().emissive_strength;
  };
  CHECK(strength("2.5") == 2.5);
  for (const char* said : {"nan", "inf", "-1", "1e999", "bright", ""}) CHECK(strength(said) == 1);
}

TEST_CASE("export: a look that cannot be is an error that says why") {
  ExportOptions options = small;
  options.look.variants = {"chekcer"};
  CHECK_THROWS_AS(make_look(mapped_egg(1), options), LookError);
  const Folder folder;
  options = small;
  options.look.texture = folder / "map.png";
  write_image(options.look.texture, Image(4, 2, 3), {.metadata = {{"sphparam:convention", "gis"}}});
  CHECK_THROWS_WITH(make_look(mapped_egg(1), options),
                    Catch::EndsWith("--convention gis shows it as it is"));
  options = small;
  options.look.folder = folder.path.string();
  for (const char* name : {"a_ao.png", "b_ao.png"}) write_image(folder / name, Image(4, 2, 1));
  CHECK_THROWS_WITH(make_look(mapped_egg(1), options),
                    Catch::EndsWith("a_ao.png, b_ao.png: leave one of them there"));
}

namespace {

/// With what people said of it, what we say of files, a number a vertex and a label a face.
MappedMesh scanned_egg() {
  MeshFile file = mapped_egg(2).file();
  file.comments = {"Inv. 12", "sphparam verdict certified", "TextureFile old.png",
                   "unit: m", "source_vertices 9",          "copyright The Museum"};
  const auto count = static_cast<std::size_t>(file.mesh.vertex_count());
  file.set_vertex_property({"confidence", ScalarType::Float32, std::vector<double>(count, 0.5)});
  for (const char* name : {"nx", "ny", "nz"})
    file.set_vertex_property({name, ScalarType::Float32, std::vector<double>(count, 0.5)});
  file.set_face_property(
      {"patch", ScalarType::Int32,
       std::vector<double>(static_cast<std::size_t>(file.mesh.face_count()), 3)});
  return MappedMesh({.file = std::move(file), .map = mapped_egg(2).map(), .name = "egg.ply"});
}

const std::string scalars_left_out =
    "not carried: confidence of vertices and patch of faces: .ply has room for that";

}  // namespace

TEST_CASE("export: what comments say of the object goes into the extras, numbers are told") {
  const Asset asset = make_asset(scanned_egg(), small);
  using Extra = std::pair<std::string, std::string>;
  CHECK(std::ranges::count(asset.extras, Extra("comments", "Inv. 12\nunit: m")) == 1);
  CHECK(asset.copyright == "The Museum");
  CHECK(asset.warnings == Names{scalars_left_out});
}

TEST_CASE("export: vertices that lie on others, which readers of glTF weld, are told") {
  const MappedMesh egg = mapped_egg(2);
  MeshFile file = egg.file();
  const auto told = [&] {
    return make_asset(MappedMesh({.file = file, .map = egg.map(), .name = "egg.ply"}), small)
        .warnings;
  };
  CHECK(told().empty());
  Eigen::Index top = 0, bottom = 0;
  file.mesh.positions.col(2).maxCoeff(&top);
  file.mesh.positions.col(2).minCoeff(&bottom);
  file.mesh.positions.row(top) = file.mesh.positions.row(bottom);
  CHECK(told() ==
        Names{"1 vertex lies exactly on another: who reads glTF as a closed surface welds them, we "
              "too (the surface touches itself then); .ply keeps them apart"});
}

TEST_CASE("export: .obj and .ply have the object's comments, and .ply its numbers") {
  const Folder folder;
  CHECK(write_textured_mesh(folder / "a.ply", scanned_egg(), small).warnings.empty());
  const MeshFile ply = read_mesh(folder / "a.ply");
  CHECK(ply.comments ==
        Names{"Inv. 12", "unit: m", "copyright The Museum", "TextureFile a_checker.png"});
  CHECK(ply.find_vertex_property("confidence"));
  CHECK(ply.base_colours.at(0).image == "a_checker.png");
  CHECK(write_textured_mesh(folder / "a.obj", scanned_egg(), small).warnings ==
        Names{scalars_left_out});
  const MeshFile obj = read_mesh(folder / "a.obj");
  CHECK(obj.comments == Names{"Inv. 12", "unit: m", "copyright The Museum",
                              "base colour of sphparam: texture a_checker.png"});
}

TEST_CASE("export: the image of an .obj or .ply has the colours of the vertices") {
  const Folder folder;
  MeshFile file = mapped_egg(2).file();
  const auto count = static_cast<std::size_t>(file.mesh.vertex_count());
  for (const auto& [name, value] : {std::pair("red", 200), {"green", 30}, {"blue", 0}})
    file.set_vertex_property({name, ScalarType::Uint8, std::vector<double>(count, value)});
  write_textured_mesh(folder / "a.ply",
                      MappedMesh({.file = std::move(file), .map = mapped_egg(2).map()}), small);
  CHECK(folder.names() == Names{"a.ply", "a_baked.png"});
  const Image image = read_image(folder / "a_baked.png");
  for (int c = 0; c < 3; ++c)
    CHECK(std::lround(255 * image.pixel(9, 9)[c]) == std::array{200, 30, 0}[c]);
}

TEST_CASE("export: a texture that is not with its mesh is told where something else is shown") {
  MeshFile file = mapped_egg(2).file();
  file.corner_texcoords.emplace(CornerTexcoords::Zero(file.mesh.triangles.size(), 2));
  file.comments = {"base colour of wood: texture w.png"};
  const MappedMesh egg({.file = std::move(file), .map = mapped_egg(2).map(), .name = "egg.ply"});
  CHECK(make_look(egg, small).warnings ==
        Names{"egg.ply: shown without its texture, which is not in this file (base colour of wood: "
              "texture w.png)"});
}

TEST_CASE("export: the library of another mesh stays, one of an export is replaced") {
  const Folder folder;
  std::ofstream(folder / "a.mtl") << "newmtl wood\n";
  try {
    write_textured_mesh(folder / "a.obj", mapped_egg(2), small);
    FAIL("replaced");
  } catch (const WriteError& error) {
    CHECK(std::string(error.what()) == (folder / "a.mtl") +
                                           ": is there, and is no library of an export: -o " +
                                           (folder / "a_sphparam.obj") + " leaves it as it is");
  }
  CHECK(bytes_of(folder / "a.mtl") == "newmtl wood\n");
  CHECK_THROWS_AS(require_export_place(folder / "a.obj"), WriteError);
  CHECK_NOTHROW(require_export_place(folder / "a.ply"));
  std::filesystem::remove(folder / "a.mtl");
  for (int i = 0; i < 2; ++i)
    CHECK(write_textured_mesh(folder / "a.obj", mapped_egg(2), small).files.size() == 3);
}

}  // namespace sphparam::tests
