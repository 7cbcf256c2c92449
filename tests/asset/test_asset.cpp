#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "image/image_codec.h"
#include "io/files/base64.h"
#include "report/viewer.h"
#include "sphparam/asset/remake_asset.h"
#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/sphere/sphere_locator.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/bytes_of.h"
#include "support/folder.h"
#include "support/glb_json.h"
#include "support/joined.h"
#include "support/leaks_of_others.h"
#include "support/shaken.h"
#include "support/test_meshes.h"
#include "support/torus.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace fs = std::filesystem;

namespace {

MeshSource source_of(TriangleMesh mesh, const std::string& path = "shape.obj") {
  MeshSource source;
  source.path = path;
  source.inspection = inspect_mesh(mesh);
  if (source.inspection.is_sphere()) source.topology.emplace(mesh);
  source.file.mesh = std::move(mesh);
  return source;
}

/// All but every n-th face.
TriangleMesh with_holes(TriangleMesh mesh, int n) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    if (f % n != 0) kept.push_back(f);
  mesh.triangles = Triangles(mesh.triangles(kept, Eigen::all));
  return mesh;
}

/// Two balls that pass through one another.
TriangleMesh two_balls() { return joined(icosphere(3), icosphere(3), {1, 0, 0}); }

/// Red, metallic and glowing.
MeshSource painted(MeshSource source) {
  MeshFile& file = source.file;
  file.materials = {"paint"};
  file.base_colours = {{.factor = {1, 0, 0, 1}}};
  MaterialChannels said;
  said.roughness.factor[0] = 0.25;
  said.metallic.factor[0] = 1;
  said.emission.factor = {0, 0.5, 0, 1};
  file.channels = {said};
  file.set_face_property(
      {.name = "material",
       .type = ScalarType::Int32,
       .values = std::vector<double>(static_cast<size_t>(file.mesh.face_count()))});
  return source;
}

WholeOptions coarse() { return {.resolution = 32, .faces = 2000, .threads = 1}; }

/// What becomes of a ball from a file of this format, in a folder.
RemadeAsset remade_ball(const char* format, const std::string& folder) {
  MeshSource asset = source_of(icosphere(1));
  asset.file.format = format;
  RemakeOptions options{.whole = coarse(), .width = 32};
  options.page = false;
  PendingFiles files;
  RemadeAsset made = remake_asset(asset, folder, options, files);
  files.publish();
  return made;
}

}  // namespace

TEST_CASE("whole surface: a sphere is itself, one with holes is mended, a soup is wrapped") {
  const WholeSurface itself = whole_surface(source_of(icosphere(3)), coarse());
  CHECK(itself.by == WholeBy::Itself);
  CHECK(itself.mapped.mesh().triangles == icosphere(3).triangles);
  CHECK(itself.found.empty());

  const WholeSurface mended = whole_surface(source_of(with_holes(icosphere(3), 100)), coarse());
  CHECK(mended.by == WholeBy::Repair);
  CHECK(mended.area_kept == 1);
  CHECK(mended.found == std::vector<std::string>{"it is open: 13 holes or borders"});
  CHECK(mended.done == std::vector<std::string>{"13 holes filled"});
  REQUIRE(mended.details.size() == 2);
  CHECK_THAT(mended.details[0], Catch::Contains("boundary edges"));

  const WholeSurface wrapped = whole_surface(source_of(two_balls()), coarse());
  CHECK(wrapped.by == WholeBy::Wrap);
  CHECK(wrapped.found.front() == "it is in 2 parts");
  CHECK(
      wrapped.done.front() ==
      "a skin is drawn around it, 0.313 % of its size away; gaps narrower than 6.25 % are closed");
  CHECK(wrapped.details.size() > wrapped.done.size() + wrapped.found.size());
  CHECK_THAT(wrapped.details.back(), Catch::Contains(" others of the wrap"));
  CHECK(wrapped.mapped.mesh().face_count() <= 2000);
  CHECK(wrapped.mapped.certificate().bijective());
  CHECK(wrapped.mapped.mesh().positions.col(0).maxCoeff() > 2);
}

TEST_CASE("whole surface: options outside their domains, and no mesh at all, are refused") {
  const MeshSource ball = source_of(icosphere(1));
  for (const double share : {5.0, -1.0, std::nan("")})
    CHECK_THROWS_WITH(whole_surface(ball, {.least_kept = share}),
                      Catch::StartsWith("least_kept is "));
  CHECK_THROWS_AS(whole_surface(MeshSource{}), MeshError);
  MeshSource file_alone;
  file_alone.file.mesh = icosphere(1);
  CHECK(whole_surface(file_alone).by == WholeBy::Itself);
}

TEST_CASE("remake asset: one that is inside out stays so, which is told with what turns it") {
  TriangleMesh turned = icosphere(1);
  turned.triangles.col(0).swap(turned.triangles.col(1));
  RemakeOptions options{.whole = coarse(), .width = 32};
  options.page = false;
  PendingFiles files;
  const RemadeAsset made = remake_asset(source_of(std::move(turned)), "", options, files);
  REQUIRE(made.warnings.size() == 1);
  CHECK_THAT(made.warnings[0], Catch::StartsWith("the mesh is inside out: ") &&
                                   Catch::EndsWith("; `sphparam repair` turns it over"));
}

TEST_CASE("remake asset: what is done last is judged first") {
  const auto complaint = [](RemakeOptions options) -> std::string {
    bool worked = false;
    options.whole.progress = [&](std::string_view, double) { return worked = true; };
    PendingFiles files;
    try {
      remake_asset(source_of(icosphere(1)), ".", options, files);
      return "";
    } catch (const std::invalid_argument& error) {
      CHECK_FALSE(worked);
      return error.what();
    }
  };
  CHECK_THAT(complaint({.webp_quality = 900}), Catch::StartsWith("webp_quality is 900"));
  CHECK_THAT(complaint({.textures = TextureFormat(7)}), Catch::StartsWith("textures is 7"));
  CHECK_FALSE(complaint({.width = 7}).empty());
  CHECK_FALSE(complaint({.samples = 0}).empty());
}

TEST_CASE("remake asset: the chart is made once, for all stages") {
  RemakeOptions options{.whole = coarse(), .width = 32};
  options.page = false;
  int charts = 0;
  std::string before;
  options.whole.progress = [&](std::string_view stage, double) {
    charts += stage == "chart" && before != "chart" ? 1 : 0;
    before = stage;
    return true;
  };
  PendingFiles files;
  CHECK(remake_asset(source_of(icosphere(2)), "", options, files).whole.mapped.chart() != nullptr);
  CHECK(charts == 1);
}

TEST_CASE("whole surface: a repair that keeps too little is not taken") {
  WholeOptions options = coarse();
  options.least_kept = 0.4;  // one of two balls is half
  TriangleMesh apart = two_balls();
  apart.positions.bottomRows(icosphere(3).vertex_count()).col(0).array() += 5;
  CHECK(whole_surface(source_of(apart), options).by == WholeBy::Wrap);
}

TEST_CASE(
    "whole surface: vertices without a place are left out of a wrap, no triangles, no surface") {
  TriangleMesh balls = two_balls();
  balls.positions(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(whole_surface(source_of(balls), coarse()).by == WholeBy::Wrap);
  CHECK_THROWS_AS(whole_surface(source_of({Points(0, 3), Triangles(0, 3)}), coarse()), MeshError);
  WholeOptions wrong = coarse();
  wrong.resolution = 1;
  CHECK_THROWS_AS(whole_surface(source_of(icosphere(1)), wrong), std::invalid_argument);
}

TEST_CASE("whole surface: vertices of no triangle do not make a wrap coarser") {
  const WholeSurface plain = whole_surface(source_of(two_balls()), coarse());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // Of a triangle without a place, and of none at all.
  for (const double place : {nan, 0.0}) {
    TriangleMesh balls = two_balls();
    const Eigen::Index count = balls.vertex_count(), faces = balls.face_count();
    balls.positions.conservativeResize(count + 3, 3);
    balls.positions.bottomRows(3) << 0, 0, 0, 1000, 0, 0, place, 0, 0;
    if (std::isnan(place)) {
      balls.triangles.conservativeResize(faces + 1, 3);
      balls.triangles.row(faces) << static_cast<Vertex>(count), static_cast<Vertex>(count + 1),
          static_cast<Vertex>(count + 2);
    }
    const WholeSurface wrapped = whole_surface(source_of(balls), coarse());
    CHECK(wrapped.by == WholeBy::Wrap);
    CHECK(wrapped.done == plain.done);
    CHECK(wrapped.mapped.mesh().positions == plain.mapped.mesh().positions);
  }
}

TEST_CASE(
    "remake asset: a wrap shows what the materials of the asset say, and all files are there") {
  const Folder folder;
  RemakeOptions options{.whole = coarse(), .width = 64};
  const MeshSource asset = painted(source_of(two_balls(), "two.obj"));
  options.page = false;
  PendingFiles files;
  const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
  CHECK(fs::is_empty(folder.path.string()) == false);  // temporaries
  files.publish();
  for (const char* name : {"two.glb", "two.sph.ply", "two_basecolor.png", "two_orm.png",
                           "two_emissive.png", "two_normal-tangent.png"})
    CHECK(fs::exists(fs::path(folder.path.string()) / name));
  const Image colour = read_image(folder.path.string() + "/two_basecolor.png");
  for (int x = 0; x < 64; x += 7) {
    CHECK(colour.pixel(x, 16)[0] == Approx(1).margin(0.01));
    CHECK(colour.pixel(x, 16)[1] == Approx(0).margin(0.01));
  }
  const Image orm = read_image(folder.path.string() + "/two_orm.png");
  CHECK(orm.pixel(5, 9)[1] == Approx(0.25).margin(0.01));
  CHECK(orm.pixel(5, 9)[2] == Approx(1).margin(0.01));
  const auto json = nlohmann::json::parse(to_json(asset, made));
  CHECK(json["surface"] == "wrap");
  CHECK(json["from"]["nearest"].get<double>() < 0.1);
  CHECK(json["images"].size() == 4);
  CHECK(verdict_of(made) == "Wrapped in one closed surface, certified one-to-one with the sphere");
}

TEST_CASE("remake asset: a wall across a hole shows what stands about it, smoothly") {
  // Twelve beads in a ring, red and blue in turn: the wall across it is neither.
  const TriangleMesh bead = icosphere(2);
  TriangleMesh ring{Points(12 * bead.vertex_count(), 3), Triangles(12 * bead.face_count(), 3)};
  MeshSource asset = painted(source_of(bead, "ring.obj"));
  Property material{"material", ScalarType::Int32, {}};
  for (int i = 0; i < 12; ++i) {
    const double angle = i * 3.14159265358979 / 6;
    ring.positions.middleRows(i * bead.vertex_count(), bead.vertex_count()) =
        bead.positions.rowwise() + Eigen::RowVector3d(3 * std::cos(angle), 3 * std::sin(angle), 0);
    ring.triangles.middleRows(i * bead.face_count(), bead.face_count()) =
        bead.triangles.array() + i * static_cast<int>(bead.vertex_count());
    material.values.insert(material.values.end(), static_cast<size_t>(bead.face_count()), i % 2);
  }
  asset.file.materials.emplace_back("blue");
  asset.file.base_colours.push_back({.factor = {0, 0, 1, 1}});
  asset.file.channels.push_back(asset.file.channels[0]);
  asset.file.mesh = ring;
  asset.file.set_face_property(material);
  asset.inspection = inspect_mesh(ring);
  asset.topology.reset();
  const Folder folder;
  RemakeOptions options{.whole = coarse(), .width = 128};
  options.page = false;
  PendingFiles files;
  const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
  files.publish();
  const Image colour = read_image(folder.path.string() + "/ring_basecolor.png");
  const SphereLocator& map = made.whole.mapped.locator();
  int on_wall = 0;
  for (int y = 2; y < 62; ++y)
    for (int x = 0; x < 128; ++x) {
      const double theta = 2 * 3.14159265358979 * (x + 0.5) / 128,
                   phi = 3.14159265358979 * (y + 0.5) / 64;
      const SurfacePoint at = map.locate(to_cartesian({theta, phi}));
      Vector3 place = Vector3::Zero();
      for (int k = 0; k < 3; ++k)
        place += at.barycentric[k] *
                 made.whole.mapped.mesh().position(made.whole.mapped.mesh().triangles(at.face, k));
      if (place.norm() > 0.5) continue;
      ++on_wall;
      CHECK(colour.pixel(x, y)[0] == Approx(0.73).margin(0.1));  // half, in sRGB
      CHECK(colour.pixel(x, y)[2] == Approx(0.73).margin(0.1));
    }
  CHECK(on_wall > 10);
}

TEST_CASE("remake asset: the same bytes for any number of threads") {
  std::vector<std::string> made;
  for (const int threads : {1, 3}) {
    const Folder folder;
    RemakeOptions options{.whole = coarse(), .width = 64};
    options.whole.threads = threads;
    options.page = false;
    PendingFiles files;
    remake_asset(painted(source_of(two_balls(), "two.obj")), folder.path.string(), options, files);
    files.publish();
    std::string all;
    for (const char* name : {"two.glb", "two.sph.ply", "two_normal-tangent.png"})
      all += bytes_of(folder.path.string() + "/" + name);
    made.push_back(std::move(all));
  }
  CHECK(made[0] == made[1]);
}

TEST_CASE("remake asset: a channel whose image cannot be read is told, the others are carried") {
  const Folder folder;
  MeshSource asset = painted(source_of(icosphere(3), "ball.obj"));
  asset.file.corner_texcoords = CornerTexcoords::Zero(3 * asset.file.mesh.face_count(), 2);
  asset.file.channels[0].emission.image = "glow.ktx2";
  asset.file.channels[0].emission.bytes =
      std::make_shared<const std::vector<char>>(std::vector<char>{'?', '?', '?', '?'});
  std::vector<char> half = encode_image(Image(8, 8, 3), ImageFormat::Png);
  half.resize(half.size() / 2);
  asset.file.channels[0].normal.image = "half.png";
  asset.file.channels[0].normal.bytes = std::make_shared<const std::vector<char>>(half);
  RemakeOptions options{.whole = coarse(), .width = 64};
  options.page = false;
  PendingFiles files;
  const LeaksOfOthers broken_png;
  const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
  CHECK(made.warnings.empty());
  REQUIRE(made.losses.size() == 2);
  CHECK_THAT(made.losses[0], Catch::StartsWith("not carried: glow.ktx2 of material paint: "));
  CHECK_THAT(made.losses[1],
             Catch::StartsWith("not carried: half.png of material paint: broken: "));
  // Normals are the mesh's own, and without its image the light is dark.
  CHECK(made.baked.images.size() == 2);
}

TEST_CASE("remake asset: of images of one name each is judged by itself") {
  const Folder folder;
  MeshSource asset = painted(source_of(icosphere(3), "ball.obj"));
  asset.file.corner_texcoords = CornerTexcoords::Zero(3 * asset.file.mesh.face_count(), 2);
  const auto sound =
      std::make_shared<const std::vector<char>>(encode_image(Image(8, 8, 3), ImageFormat::Png));
  MaterialChannels& said = asset.file.channels[0];
  said.emission = {.image = "tex.png", .bytes = sound, .problem = "it is moved too far"};
  said.roughness = {.image = "tex.png", .bytes = std::make_shared<const std::vector<char>>(4, '?')};
  said.metallic = {.image = "tex.png", .bytes = sound};
  RemakeOptions options{.whole = coarse(), .width = 64};
  options.page = false;
  PendingFiles files;
  const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
  CHECK(made.losses ==
        std::vector<std::string>{"not carried: tex.png of material paint: it is moved too far",
                                 "not carried: tex.png of material paint: its format is not read"});
  files.publish();
  const Image orm = read_image(folder.path.string() + "/ball_orm.png");
  CHECK(orm.pixel(5, 9)[1] == 1);  // of the factor
  CHECK(orm.pixel(5, 9)[2] == 0);  // of the image
}

TEST_CASE("remake asset: an image that is left out needs no channels beside base colours") {
  const Folder folder;
  MeshSource asset = painted(source_of(icosphere(3), "ball.obj"));
  asset.file.channels.clear();
  asset.file.base_colours[0].image = "skin.png";
  RemakeOptions options{.whole = coarse(), .width = 64};
  options.page = false;
  PendingFiles files;
  CHECK(remake_asset(asset, folder.path.string(), options, files).losses.size() == 1);
}

TEST_CASE("remake asset: images without texture coordinates are told, factors are kept") {
  const Folder folder;
  MeshSource asset = painted(source_of(icosphere(3), "ball.obj"));
  asset.file.base_colours[0].image = "skin.png";
  asset.file.base_colours[0].factor = {1, 1, 1, 1};
  asset.file.comments = {"base colour of paint: texture skin.png, Kd 0 0 1"};
  RemakeOptions options{.whole = coarse(), .width = 64};
  options.page = false;
  PendingFiles files;
  const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
  CHECK(made.losses ==
        std::vector<std::string>{"not carried: skin.png of material paint: the mesh has no "
                                 "texture coordinates"});
  files.publish();
  // What an .mtl says beside its image shows without it.
  const Image colour = read_image(folder.path.string() + "/ball_basecolor.png");
  CHECK(colour.pixel(5, 9)[0] == 0);
  CHECK(colour.pixel(5, 9)[2] == 1);
}

TEST_CASE("remake asset: an image on second texture coordinates is carried, not on missing ones") {
  const Folder folder;
  MeshSource asset = painted(source_of(icosphere(3), "ball.obj"));
  asset.file.second_texcoords = CornerTexcoords::Constant(3 * asset.file.mesh.face_count(), 2, 0.5);
  const auto black =
      std::make_shared<const std::vector<char>>(encode_image(Image(8, 8, 3), ImageFormat::Png));
  MaterialChannels& said = asset.file.channels[0];
  for (MaterialTexture* texture : {&asset.file.base_colours[0], &said.roughness, &said.metallic}) {
    texture->image = "skin.png";
    texture->bytes = black;
  }
  said.roughness.second = true;
  RemakeOptions options{.whole = coarse(), .width = 64};
  options.page = false;
  PendingFiles files;
  const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
  CHECK(std::ranges::count(made.losses,
                           "not carried: skin.png of material paint: the mesh has "
                           "no texture coordinates") == 1);
  files.publish();
  const Image orm = read_image(folder.path.string() + "/ball_orm.png");
  CHECK(orm.pixel(5, 9)[1] == 0);  // of the image
  CHECK(orm.pixel(5, 9)[2] == 1);  // of the factor
}

TEST_CASE("whole surface: a sheet, whose two sides would lie in one another, is wrapped") {
  TriangleMesh sheet{Points(4, 3), Triangles(2, 3)};
  sheet.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  sheet.triangles << 0, 1, 2, 0, 2, 3;
  const WholeSurface whole = whole_surface(source_of(sheet), coarse());
  CHECK(whole.by == WholeBy::Wrap);
  CHECK_THAT(whole.found.back(), Catch::Contains("enclose nothing"));
}

TEST_CASE("remake asset: a glTF mesh without normals is flat, others are smooth") {
  for (const char* format : {"glTF binary", "OBJ"}) {
    const Folder folder;
    const RemadeAsset made = remade_ball(format, folder.path.string());
    CHECK((made.chart.vertices >= 3 * 80) == (std::string(format) != "OBJ"));
  }
}

TEST_CASE("remake asset: a glTF mesh without materials looks as glTF has it, others are shaded") {
  for (const char* format : {"glTF binary", "OBJ"}) {
    const Folder folder;
    const RemadeAsset made = remade_ball(format, folder.path.string());
    std::vector<std::string> fields;
    for (const BakedImage& image : made.baked.images) fields.push_back(image.field);
    const bool is_gltf = std::string(format) != "OBJ";
    CHECK(fields == (is_gltf ? std::vector<std::string>{"basecolor", "orm"}
                             : std::vector<std::string>{"ao"}));
    CHECK(made.baked.images[0].sample_type == SampleType::Uint8);
    if (!is_gltf) continue;
    const std::string stem = folder.path.string() + "/shape_";
    for (int x = 0; x < 32; ++x) {
      CHECK(read_image(stem + "basecolor.png").pixel(x, 5)[1] == 1);
      CHECK(read_image(stem + "orm.png").pixel(x, 5)[0] == 1);
      CHECK(read_image(stem + "orm.png").pixel(x, 5)[2] == 1);
    }
  }
}

TEST_CASE("remake asset: which part has how much of the texels is told, one that is hidden none") {
  const Folder folder;
  TriangleMesh small = icosphere(1);
  small.positions *= 0.2;
  MeshSource asset = source_of(joined(small, icosphere(3), {0, 0, 0}));
  std::vector<double> material(1360, 1);
  std::fill_n(material.begin(), 80, 0);
  asset.file.materials = {"core", "shell"};
  asset.file.set_face_property({"material", ScalarType::Int32, material});
  RemakeOptions options{.whole = coarse(), .width = 32};
  options.page = false;
  PendingFiles files;
  const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
  REQUIRE(made.parts.size() == 2);
  CHECK(made.parts[0].material == "shell");
  CHECK(made.parts[0].triangles == 1280);
  CHECK(made.parts[0].area == Approx(1 / 1.04).epsilon(0.01));
  CHECK(made.parts[0].texels == 1);
  CHECK(made.parts[1].triangles == 80);
  CHECK(made.parts[1].texels == 0);
  CHECK(line_of(made.parts) == "texels of its 2 parts: 100 %, 0 %; 1 has none");
  const auto told = nlohmann::json::parse(to_json(asset, made))["parts"];
  CHECK(told["count"] == 2);
  CHECK(told["largest"][1]["material"] == "core");
  CHECK(told["largest"][1]["texels"] == 0);
}

TEST_CASE("remake asset: vertices of a wrap have the numbers of the asset's nearest points") {
  const Folder folder;
  MeshSource asset = source_of(two_balls(), "two.ply");
  MeshFile& file = asset.file;
  const auto count = static_cast<size_t>(file.mesh.vertex_count());
  Property height{"height", ScalarType::Float64, {}}, part{"part", ScalarType::Int32, {}};
  for (const double z : file.mesh.positions.col(2)) height.values.push_back(z);
  for (size_t v = 0; v < count; ++v) part.values.push_back(2 * v < count ? 1 : 2);
  file.set_vertex_property(height);
  file.set_vertex_property(part);
  file.set_vertex_property({"source_vertex", ScalarType::Int32, part.values});
  file.set_face_property({"age", ScalarType::Float64,
                          std::vector<double>(static_cast<size_t>(file.mesh.face_count()), 3)});
  file.comments = {"gifti label 1 1 0 0 1 red"};
  RemakeOptions options{.whole = coarse(), .width = 32};
  options.page = false;
  PendingFiles files;
  const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
  REQUIRE(made.whole.by == WholeBy::Wrap);
  CHECK(made.whole.done.back() ==
        "its vertices have height and part of the asset's nearest points");
  const MeshFile& wrap = made.whole.mapped.file();
  REQUIRE(wrap.find_vertex_property("height"));
  REQUIRE(wrap.find_vertex_property("part"));
  CHECK_FALSE(wrap.find_vertex_property("source_vertex"));
  CHECK(std::ranges::count(wrap.comments, "gifti label 1 1 0 0 1 red") == 1);
  const auto& heights = wrap.find_vertex_property("height")->values;
  const auto& parts = wrap.find_vertex_property("part")->values;
  for (Vertex v = 0; v < wrap.mesh.vertex_count(); ++v) {
    const Vector3 at = wrap.mesh.position(v);
    REQUIRE(std::abs(heights[static_cast<size_t>(v)] - at.z()) < 0.2);  // a voxel away or two
    if (std::abs(at.x() - 0.5) > 0.2)
      REQUIRE(parts[static_cast<size_t>(v)] == (at.x() < 0.5 ? 1 : 2));
  }
  const std::string loss = "not carried: age of faces: a wrap has faces of its own";
  const std::string not_in_glb =
      "not carried: height and part of vertices, by the .glb: two.sph.ply has that";
  CHECK(made.losses == std::vector<std::string>{loss, not_in_glb});
  const auto told = nlohmann::json::parse(to_json(asset, made));
  CHECK(told["losses"] == nlohmann::json::array({loss, not_in_glb}));
  CHECK(told["warnings"].dump().find(loss) == std::string::npos);
}

TEST_CASE("remake asset: a window does not make all of it glass, which is told with its share") {
  MeshSource asset = painted(source_of(icosphere(2)));
  asset.file.materials.emplace_back("glass");
  asset.file.base_colours.push_back({.factor = {0, 0, 1, 0.25}});
  asset.file.channels.push_back(asset.file.channels[0]);
  asset.file.channels[1].alpha_mode = AlphaMode::Blend;
  Property material = *asset.file.find_face_property("material");
  const auto remade = [&](size_t glass) {
    std::fill_n(material.values.begin(), glass, 1);
    asset.file.set_face_property(material);
    const Folder folder;
    RemakeOptions options{.whole = coarse(), .width = 32};
    options.page = false;
    PendingFiles files;
    const RemadeAsset made = remake_asset(asset, folder.path.string(), options, files);
    files.publish();
    const MeshFile written = read_mesh(folder.path.string() + "/shape.glb");
    return std::tuple(written.channels.at(0).alpha_mode, made.baked.images.at(0).channels,
                      made.warnings);
  };
  const auto [mode, channels, warnings] = remade(80);  // a quarter of 320
  CHECK(mode == AlphaMode::Opaque);
  CHECK(channels == 3);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Matches("materials become one, which is not blended: "
                                         "2[456](\\.[0-9]+)? % of the area is, .*"));
  const auto [all, seen_through, nothing] = remade(320);
  CHECK(all == AlphaMode::Blend);
  CHECK(seen_through == 4);
  CHECK(nothing.empty());
}

TEST_CASE("remake asset: the page has the pictures, the words and the channels") {
  const Folder folder;
  PendingFiles files;
  const MeshSource asset = painted(source_of(two_balls(), "-"));
  remake_asset(asset, folder.path.string(), {.whole = coarse(), .width = 64}, files);
  files.publish();
  const std::string page = bytes_of(folder.path.string() + "/mesh.html");
  for (const char* text :
       {"Wrapped in one closed surface", "What stood in the way", "2 separate components",
        "Before and after", "mesh_orm.png", "All figures"})
    CHECK_THAT(page, Catch::Contains(text));
}

TEST_CASE("remake asset: the page's test images lie on paper, whatever the asset is of") {
  if (!installed_viewer()) return;
  const Folder folder;
  PendingFiles files;
  remake_asset(painted(source_of(icosphere(2), "-")), folder.path.string(),
               {.whole = coarse(), .width = 32}, files);
  files.publish();
  const std::string page = bytes_of(folder.path.string() + "/mesh.html");
  const std::string head = "data:model/gltf-binary;base64,", magic = "Z2xURg";
  const size_t first = page.find(head + magic) + head.size();
  const std::string text = page.substr(first, page.find('<', first) - first);
  std::string glb;
  const auto filling = static_cast<size_t>(std::ranges::count(text, '='));
  REQUIRE(Base64Reader(text).read(text.size() / 4 * 3 - filling, glb));
  const nlohmann::json made = json_of(glb);
  int checkers = 0;
  for (const auto& material : made["materials"]) {
    const auto& pbr = material["pbrMetallicRoughness"];
    const bool is_checker = material["name"] == "checker";
    checkers += is_checker;
    if (is_checker || material["name"] == "baked") {
      CHECK(pbr["metallicFactor"] == (is_checker ? 0 : 1));
      CHECK_THAT(pbr["roughnessFactor"].get<double>(),
                 Catch::WithinAbs(is_checker ? 1 : 0.25, 0.002));
    }
  }
  CHECK(checkers == 1);
}

TEST_CASE("whole surface: pieces that rounding keeps apart are welded, not wrapped") {
  const WholeSurface welded = whole_surface(source_of(shaken_apart(icosphere(3), 1e-6)), coarse());
  CHECK(welded.by == WholeBy::Repair);
  CHECK(welded.area_kept == 1);
  CHECK(welded.mapped.mesh().vertex_count() == icosphere(3).vertex_count());
  CHECK_THAT(welded.done.front(), Catch::Contains(" welded onto others nearby"));
}

TEST_CASE("remake asset: who made it is said by the .glb, also where it is wrapped") {
  for (const TriangleMesh& mesh : {icosphere(2), two_balls()}) {
    const Folder folder;
    MeshSource asset = source_of(mesh);
    asset.file.comments = {"copyright (c) Me", R"(asset extras {"license":"CC-BY"})"};
    RemakeOptions options{.whole = coarse(), .width = 32};
    options.page = false;
    PendingFiles files;
    remake_asset(asset, folder.path.string(), options, files);
    files.publish();
    const auto said = json_of(bytes_of(folder.path.string() + "/shape.glb"))["asset"];
    CHECK(said["copyright"] == "(c) Me");
    CHECK(said["extras"]["license"] == "CC-BY");
    CHECK(said["extras"]["sphparam"]["source"] == "shape.obj");
  }
}

TEST_CASE("remake asset: that the occlusion of rays is shown instead of the asset's own is told") {
  const Folder folder;
  MeshSource asset = painted(source_of(icosphere(2), "ball.obj"));
  asset.file.corner_texcoords = CornerTexcoords::Zero(3 * asset.file.mesh.face_count(), 2);
  asset.file.channels[0].occlusion = {.image = "dirt.png",
                                      .bytes = std::make_shared<const std::vector<char>>(
                                          encode_image(Image(8, 8, 3), ImageFormat::Png))};
  RemakeOptions options{.whole = coarse(), .width = 32};
  options.page = false;
  PendingFiles files, more;
  CHECK(remake_asset(asset, folder.path.string(), options, files).warnings.empty());
  options.occlusion = true;
  CHECK(remake_asset(asset, folder.path.string(), options, more).warnings ==
        std::vector<std::string>{"the occlusion of rays is shown instead of the materials' own, "
                                 "which is in red of ball_orm.png: without --occlusion that is "
                                 "shown"});
}

TEST_CASE("remake asset: one looks through where a wrap's walls are clear") {
  const Folder folder;
  TriangleMesh ball = icosphere(2);  // a ring alone would be cut open
  ball.positions *= 0.3;
  ball.positions.col(0).array() += 2;
  const MeshSource asset = painted(source_of(joined(torus(24, 12, 1, 0.3), ball), "ring.obj"));
  RemakeOptions options{.whole = coarse(), .width = 128};
  options.page = false;
  PendingFiles closed, files;
  const RemadeAsset plain = remake_asset(asset, folder.path.string(), options, closed);
  REQUIRE(plain.whole.by == WholeBy::Wrap);
  CHECK((plain.baked.wall_share > 0.01 && plain.baked.wall_share < 0.3));
  CHECK(plain.baked.images.front().channels == 3);
  options.clear_walls = true;
  const RemadeAsset clear = remake_asset(asset, folder.path.string(), options, files);
  CHECK(clear.baked.wall_share == plain.baked.wall_share);
  CHECK(clear.baked.images.front().channels == 4);
  files.publish();
  const auto material = json_of(bytes_of(folder.path.string() + "/ring.glb"))["materials"][0];
  CHECK(material["alphaMode"] == "MASK");
  CHECK(material["alphaCutoff"] == 0.5);
  CHECK(material["doubleSided"] == true);
}
