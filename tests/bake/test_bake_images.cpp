#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bake/field_registry.h"
#include "image/image_codec.h"
#include "render/value_paint.h"
#include "scenes.h"
#include "sphparam/bake/bake.h"
#include "sphparam/io/fillers.h"
#include "support/bytes_of.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

namespace fs = std::filesystem;

/// An egg on the sphere of its directions, moved aside.
MappedMesh egg(int level, double aside = 0) {
  MeshFile file;
  file.mesh = icosphere(level);
  SphereMap map{file.mesh.positions};
  file.mesh.positions.col(0) *= 1.5;
  file.mesh.positions.col(1).array() += aside;
  return MappedMesh({.file = std::move(file), .map = std::move(map), .name = "egg"});
}

/// Of it a cap about the north pole is what closes a hole.
MeshFile with_cap(MeshFile file) {
  FillerMarks fillers;
  for (Face f = 0; f < file.mesh.face_count(); ++f)
    fillers.push_back(file.mesh.position(file.mesh.triangles(f, 0)).z() > 0.5 ? 1 : 0);
  mark_fillers(file, fillers);
  return file;
}

/// A mesh that its directions map, as an egg's do.
MappedMesh on_ball(const MeshFile& file) {
  return MappedMesh(
      {.file = file, .map = {file.mesh.positions.rowwise().normalized()}, .name = "ball"});
}

const BakeSettings small{.width = 32, .fields = {.rays = 4}, .threads = 1};

/// The setting that is complained of.
std::string refused(const BakeRequest& image, const BakeSettings& settings) {
  try {
    require_bakeable({image}, settings);
    return "";
  } catch (const BakeSettingError& error) {
    CHECK(error.what() == error.setting() + ": " + error.reason());
    return error.setting();
  }
}

}  // namespace

TEST_CASE("bake images: all that are asked for are there, with what was baked") {
  const Folder folder;
  const BakeReport report = bake(egg(3),
                                 {{"normal-object", folder / "n.png"},
                                  {"ao", folder / "ao.exr"},
                                  {"axes", folder / "axes.png"},
                                  {"curvature", folder / "c.tif"}},
                                 small);
  CHECK(folder.names().size() == 4);
  REQUIRE(report.images.size() == 4);
  CHECK(report.images[0].channels == 3);
  CHECK(report.images[1].sample_type == SampleType::Float);
  CHECK(report.images[3].field == "curvature:mean");
  CHECK(report.images[3].sample_type == SampleType::Uint16);
  CHECK(report.images[3].range);
  CHECK_FALSE(report.target_distance);
  CHECK(report.warnings.empty());
}

TEST_CASE("bake images: a heat map has its scale beside it") {
  const Folder folder;
  BakeSettings settings = small;
  settings.fields.heat = true;
  const BakeReport report = bake(egg(3), {{"area", folder / "area.png"}}, settings);
  CHECK(report.images[0].range);
  CHECK(std::isnan(report.images[0].beyond));  // not counted
  CHECK(fs::exists(scale_path(folder / "area.png")));
  CHECK(folder.names().size() == 2);
}

TEST_CASE("bake images: a heat map of what heat has no colours for is numbers, which is told") {
  const Folder folder;
  BakeSettings settings = small;
  settings.fields.heat = true;
  const BakeReport report =
      bake(egg(2), {{"height", folder / "h.png"}, {"area", folder / "a.png"}}, settings);
  CHECK(report.warnings ==
        std::vector<std::string>{
            "height: numbers, not colours: heat is of distortion, curvature and scalar:NAME"});
}

TEST_CASE("bake images: heat of a scalar has the colours and the scale that pictures of it have") {
  MeshFile file = egg(3).file();
  Property tilt{"Tilt", ScalarType::Float64, {}};
  for (const double z : file.mesh.positions.col(2)) tilt.values.push_back(40 * z);
  file.set_vertex_property(tilt);
  const Folder folder;
  const auto heat = [&](std::optional<std::pair<double, double>> range) {
    BakeSettings settings = small;
    settings.fields.heat = true;
    settings.fields.scalar_range = range;
    return bake(on_ball(file), {{"scalar:Tilt", folder / "tilt.png"}}, settings).images[0];
  };
  const BakedImage image = heat({{-20, 20}});
  CHECK(image.sample_type == SampleType::Uint8);
  CHECK(image.channels == 3);
  CHECK(image.range == std::pair(-20.0, 20.0));
  CHECK(fs::exists(scale_path(folder / "tilt.png")));
  const Image seen = read_image(folder / "tilt.png");
  const auto pixel = [&](int y) { return Rgb(seen.pixel(0, y)); };
  CHECK((pixel(0) - diverging(1)).norm() < 0.005F);
  CHECK((pixel(seen.height - 1) - diverging(-1)).norm() < 0.005F);
  const HeatScale usual = *vertex_value_colours(file, "Tilt").scale;
  CHECK(heat(std::nullopt).range == std::pair(usual.low, usual.high));
}

TEST_CASE("bake images: heat of labels has the colours of their table, unmixed") {
  MeshFile file = egg(2).file();
  file.comments = {"gifti label 1 0 1 0 1 green", "gifti label 2 1 0 0.2 1 red"};
  Property lobe{"lobe", ScalarType::Int32, {}};
  for (const double z : file.mesh.positions.col(2)) lobe.values.push_back(z > 0 ? 1 : 2);
  file.set_vertex_property(lobe);
  const Folder folder;
  BakeSettings settings = small;
  settings.fields.heat = true;
  settings.samples = 4;
  const BakedImage image =
      bake(on_ball(file), {{"scalar:lobe", folder / "lobe.png"}}, settings).images[0];
  CHECK(image.sample_type == SampleType::Uint8);
  CHECK_FALSE(image.range);
  CHECK_FALSE(fs::exists(scale_path(folder / "lobe.png")));
  const Image seen = read_image(folder / "lobe.png");
  int green = 0, red = 0;
  for (int y = 0; y < seen.height; ++y)
    for (int x = 0; x < seen.width; ++x) {
      green += (Rgb(seen.pixel(x, y)) - Rgb(0, 1, 0)).norm() < 1e-3F;
      red += (Rgb(seen.pixel(x, y)) - Rgb(1, 0, 0.2F)).norm() < 1e-3F;
    }
  CHECK(green + red == seen.width * seen.height);
  CHECK(std::min(green, red) > 0);
  settings.fields.scalar_range = {{0, 4}};
  CHECK_THROWS_WITH(bake(on_ball(file), {{"scalar:lobe", folder / "lobe.png"}}, settings),
                    "scalar:lobe: its labels have the colours of their table, of no range");
  file.comments.clear();
  CHECK(bake(on_ball(file), {{"scalar:lobe", folder / "lobe.png"}}, settings).images[0].range ==
        std::pair(0.0, 4.0));
  CHECK((Rgb(read_image(folder / "lobe.png").pixel(0, 0)) - viridis(0.25)).norm() < 0.005F);
}

TEST_CASE("bake images: a mesh that is inside out is told, and rays that met nothing") {
  const Folder folder;
  MeshFile file;
  file.mesh = icosphere(2);
  SphereMap map{-file.mesh.positions};
  file.mesh.triangles.col(1).swap(file.mesh.triangles.col(2));
  const MappedMesh inverted({.file = std::move(file), .map = std::move(map), .name = "egg"});
  const BakeReport report = bake(inverted, {{"thickness", folder / "t.png"}}, small);
  REQUIRE(report.warnings.size() == 2);
  CHECK_THAT(report.warnings[0], Catch::StartsWith("the mesh is inside out: "));
  CHECK_THAT(report.warnings[1], Catch::StartsWith("thickness: 100 % of the rays met nothing"));
  CHECK(bake(egg(2), {{"thickness", folder / "t.png"}}, small).warnings.empty());
}

TEST_CASE("bake images: far from the origin integers keep the digits that float32 has not") {
  const Folder folder;
  const double far = 4194304;  // 2^22: float32 is 0.5 apart there
  const auto baked = [&](double aside, const std::string& map, const std::string& name) {
    return bake(egg(3, aside), {{map, folder / name}}, small);
  };
  baked(0, "position", "near.tif");
  const BakeReport position = baked(far, "position", "far.tif");
  CHECK(position.warnings.empty());
  CHECK(position.images[0].range == std::pair(0.0, 3.0));
  CHECK(position.images[0].beyond == 0);
  CHECK(position.images[0].about.ends_with("; less -1.5 4194303 -1"));
  ImageTexts texts;
  const Image near = read_image(folder / "near.tif"),
              moved = read_image(folder / "far.tif", {}, &texts);
  CHECK(std::ranges::any_of(texts, [](const auto& text) {
    return text.second.find("sphparam:offset=-1.5 4194303 -1") != std::string::npos;
  }));
  constexpr double origin[] = {-1.5, -1, -1}, step = 3.0 / 65535;
  for (size_t i = 0; i < near.pixels.size(); ++i) {
    const double meant = 3 * static_cast<double>(near.pixels[i]) - 1.5;
    CHECK(origin[i % 3] + 3 * static_cast<double>(moved.pixels[i]) ==
          Approx(meant).margin(1.01 * step));
  }

  const BakeReport height = baked(far, "height", "height.tif");
  const auto [low, high] = height.images[0].range.value();
  const Image heights = read_image(folder / "height.tif");
  for (size_t i = 0; i < heights.pixels.size(); ++i) {
    const double y = 3 * static_cast<double>(near.pixels[3 * i + 1]) - 1.5;
    CHECK(low - far + (high - low) * static_cast<double>(heights.pixels[i]) ==
          Approx(y).margin(2 * step));
  }

  for (const std::string map : {"radius", "height:radial"}) {
    const BakeReport report = baked(far, map, "length.exr");
    CHECK(report.warnings.back() ==
          map.substr(0, map.find(':')) +
              ": so far from the origin, numbers of 32 bits are 0.5 apart, 16.7 % of the mesh's "
              "length: depth u16 (.png, .tif) keeps more, or move the mesh nearer");
  }
  const auto [least, greatest] = baked(far, "radius", "radius.tif").images[0].range.value();
  const Image radii = read_image(folder / "radius.tif");
  for (size_t i = 0; i < radii.pixels.size(); ++i) {
    const double y = 3 * static_cast<double>(near.pixels[3 * i + 1]) - 1.5;
    CHECK(least - far + (greatest - least) * static_cast<double>(radii.pixels[i]) ==
          Approx(y).margin(2 * step));
  }

  const BakeReport floats = baked(far, "position", "far.exr");
  CHECK(floats.warnings ==
        std::vector<std::string>{"position: so far from the origin, numbers of 32 bits are 0.5 "
                                 "apart, 16.7 % of the mesh's length: depth u16 (.png, .tif) keeps "
                                 "more, or move the mesh nearer"});
  CHECK(read_image(folder / "far.exr").pixels[1] == static_cast<float>(far));
  CHECK(baked(300, "position", "some.exr").warnings.empty());
}

TEST_CASE("bake images: properties far from 0 keep the digits that float32 has not") {
  const Folder folder;
  // A value a vertex: origin + extent · (z + 1) / 2, from pole to pole.
  const auto baked = [&](double origin, double extent, const std::string& name) {
    MeshFile file;
    file.mesh = icosphere(3);
    SphereMap map{file.mesh.positions};
    Property scalar{"p", ScalarType::Float64, {}};
    const VectorX z = file.mesh.positions.col(2);
    for (const double height : z)
      scalar.values.push_back(origin +
                              extent * (height - z.minCoeff()) / (z.maxCoeff() - z.minCoeff()));
    file.set_vertex_property(std::move(scalar));
    const MappedMesh mapped({.file = std::move(file), .map = std::move(map), .name = "ball"});
    return bake(mapped, {{"scalar:p", folder / name}}, small);
  };
  baked(0, 1, "near.tif");
  const Image near = read_image(folder / "near.tif");
  for (const double origin : {101325.0, 1e8, -1e8}) {
    INFO(origin);
    const BakeReport report = baked(origin, 0.5, "far.tif");
    CHECK(report.warnings.empty());
    CHECK(report.images[0].range == std::pair(origin, origin + 0.5));
    CHECK(report.images[0].beyond == 0);
    const Image far = read_image(folder / "far.tif");
    for (size_t i = 0; i < near.pixels.size(); ++i)
      REQUIRE(far.pixels[i] == Approx(near.pixels[i]).margin(1.01 / 65535));
  }

  const BakeReport floats = baked(1e8, 100, "far.exr");
  CHECK(floats.warnings ==
        std::vector<std::string>{"scalar:p: so far from 0, numbers of 32 bits are 8 apart, 8 % of "
                                 "its range: depth u16 (.png, .tif) keeps more"});
  for (const float value : read_image(folder / "far.exr").pixels)
    REQUIRE((value >= 1e8F && value <= 1e8F + 104 && std::fmod(value, 8.0F) == 0));
  CHECK(baked(101325, 4000, "some.exr").warnings.empty());
}

TEST_CASE("bake images: a range that is given is that of integers, and what lies beyond is told") {
  const Folder folder;
  const auto baked = [&](double constant, std::pair<double, double> range, ScalarType type) {
    MappedMesh whole = egg(3);
    MeshFile file = whole.file();
    const auto count = static_cast<size_t>(file.mesh.vertex_count());
    file.set_vertex_property({"c", type, std::vector<double>(count, constant)});
    const MappedMesh source({.file = std::move(file), .map = whole.map(), .name = "egg"});
    BakeSettings settings = small;
    settings.depth = SampleType::Uint16;
    settings.fields.scalar_range = range;
    return bake(source, {{"scalar:c", folder / "c.png"}}, settings).images[0];
  };
  const auto sample = [&] { return read_image(folder / "c.png").pixels.front() * 65535; };
  const auto of_type = ScalarType::Float64;
  for (const double step : {0.0, 1.0, 1000.0, 65535.0}) {
    const BakedImage image = baked(step - 5, {-5, 65530}, of_type);
    CHECK(image.range == std::pair(-5.0, 65530.0));
    CHECK(image.beyond == 0);
    CHECK(sample() == Approx(step).margin(1e-3));
  }
  const BakedImage far = baked(101325.25, {101325, 101326}, of_type);
  CHECK(far.range == std::pair(101325.0, 101326.0));
  CHECK(sample() == Approx(16384).margin(1e-2));
  CHECK(baked(7, {0, 1}, of_type).beyond == 1);
  CHECK(sample() == 65535);
  CHECK(baked(-7, {0, 1}, of_type).beyond == 1);
  CHECK(sample() == 0);
  CHECK_THROWS_WITH(baked(3, {0, 1}, ScalarType::Int32),
                    Catch::StartsWith("scalar:c: its whole numbers are labels"));
  CHECK_THROWS_WITH(baked(3, {1, 1}, of_type), Catch::StartsWith("scalar_range: "));
  CHECK_THROWS_WITH(baked(3, {0, HUGE_VAL}, of_type), Catch::StartsWith("scalar_range: "));
}

TEST_CASE("bake images: labels farther apart than any integer are told with all their digits") {
  const Folder folder;
  MappedMesh whole = egg(2);
  MeshFile file = whole.file();
  std::vector<double> labels(static_cast<size_t>(file.mesh.vertex_count()), -0x1p63);
  labels.back() = 0x1p62;
  file.set_vertex_property({"id", ScalarType::Int64, labels});
  const MappedMesh source({.file = std::move(file), .map = whole.map(), .name = "egg"});
  BakeSettings settings = small;
  settings.depth = SampleType::Uint16;
  CHECK_THROWS_WITH(bake(source, {{"scalar:id", folder / "c.png"}}, settings),
                    Catch::Contains("scalar:id goes up to 13835058055282163712; no image holds"));
}

TEST_CASE("bake images: a property of one value is that value in floats, and lies in its range") {
  const Folder folder;
  for (const double constant : {101325.0, 0.1, -3e-7, 0.0}) {
    INFO(constant);
    MappedMesh whole = egg(3);
    MeshFile file = whole.file();
    const auto count = static_cast<size_t>(file.mesh.vertex_count());
    file.set_vertex_property({"c", ScalarType::Float64, std::vector<double>(count, constant)});
    const MappedMesh source({.file = std::move(file), .map = whole.map(), .name = "egg"});
    const BakeReport report =
        bake(source, {{"scalar:c", folder / "c.exr"}, {"scalar:c", folder / "c.tif"}}, small);
    CHECK(report.warnings.empty());
    CHECK(report.images[1].range == std::pair(constant, constant));
    CHECK(report.images[1].beyond == 0);
    for (const float value : read_image(folder / "c.exr").pixels)
      REQUIRE(value == static_cast<float>(constant));
  }
}

TEST_CASE("bake images: where one cannot be baked none is written") {
  const Folder folder;
  CHECK_THROWS_AS(
      bake(egg(2), {{"position", folder / "p.png"}, {"scalar:none", folder / "s.png"}}, small),
      FieldError);
  CHECK_THROWS_AS(bake(egg(2), {{"basecolor", folder / "b.png"}}, small), NoColoursError);
  BakeSettings cancelled = small;
  cancelled.progress = [](std::string_view stage, double) { return stage != "write"; };
  CHECK_THROWS_AS(bake(egg(2), {{"position", folder / "p.png"}}, cancelled), Cancelled);
  CHECK(folder.names().size() == 0);
}

TEST_CASE("bake images: files of the caller's get their names when he says so") {
  const Folder folder;
  bake(egg(2), {{"position", folder / "own.png"}}, small);
  PendingFiles files;
  bake(egg(2), {{"position", folder / "own.png"}}, small, files);
  bake(egg(2), {{"position", folder / "later.png"}}, small, files);
  CHECK(folder.names().size() == 3);  // one file, and two that have no names yet
  CHECK_FALSE(fs::exists(folder / "later.png"));
  files.publish();
  CHECK(folder.names().size() == 2);
  CHECK(bytes_of(folder / "later.png") == bytes_of(folder / "own.png"));
}

TEST_CASE("bake images: what is out of its domain is named, before any work") {
  const BakeRequest png{"position", "x.png"};
  CHECK(refused(png, {}).empty());
  CHECK(refused(png, {.width = 33}) == "width");
  CHECK(refused(png, {.width = 0}) == "width");
  CHECK(refused(png, {.width = 65536}).empty());
  CHECK(refused({"position", "x.jpg"}, {.width = 65500}).empty());
  CHECK(refused({"position", "x.jpg"}, {.width = 65502}) == "width");
  CHECK(refused(png, {.width = 34, .convention = Convention::Envmap}) == "convention");
  CHECK(refused(png, {.samples = 33}) == "samples");
  CHECK(refused(png, {.depth = SampleType::Half}) == "depth");
  CHECK(refused(png, {.mip = true}) == "mip");
  CHECK(refused(png, {.fields = {.rays = 0}}) == "rays");
  CHECK(refused(png, {.fields = {.max_ray_distance = 0}}) == "max_ray_distance");
  CHECK(refused(png, {.refine_poles = 0}) == "refine_poles");
  CHECK(refused(png, {.convention = Convention(99)}) == "convention");
  CHECK(refused(png, {.convention = Convention(-1)}) == "convention");
  CHECK(refused(png, {.interpolation = Interpolation(2)}) == "interpolation");
  CHECK(refused(png, {.wrap = TextureWrap(3)}) == "wrap");
  CHECK(refused(png, {.fields = {.filter = TextureFilter(3)}}) == "filter");
  CHECK(refused(png, {.calm_beyond = -1}) == "calm_beyond");
  CHECK(refused(png, {.calm_beyond = std::nan("")}) == "calm_beyond");
  CHECK(refused(png, {.calm_beyond = HUGE_VAL}) == "calm_beyond");
  CHECK(refused(png, {.fields = {.max_ray_distance = HUGE_VAL}}) == "max_ray_distance");
  CHECK(refused({"position", "x.gif"}, {}) == "path");
  CHECK_THROWS_AS(require_bakeable({png, png}, {}), BakeSettingError);
  CHECK_THROWS_AS(require_bakeable({{"ao", "a.png"}, {"ao", "./a.png"}}, {}), BakeSettingError);
  CHECK_THROWS_WITH(require_bakeable({png}, {.width = 70000}),
                    "width: is 70000: it must be from 2 to 65536");
  CHECK_THROWS_WITH(require_bakeable({png}, {.fields = {.max_ray_distance = -1}}),
                    "max_ray_distance: is -1: it must be a finite number above 0");
  CHECK_THROWS_AS(require_bakeable({{"postion", "x.png"}}, {}), FieldError);
  CHECK_THROWS_AS(require_bakeable({{"axes:x", "x.png"}}, {}), FieldError);
}

TEST_CASE(
    "bake images: a surface to bake from has its vertices, places and arrays, or is refused") {
  const Folder folder;
  const auto complaint = [&](auto&& change) -> std::string {
    BakeSettings settings = small;
    settings.from.emplace();
    settings.from->mesh = icosphere(1);
    change(*settings.from);
    PendingFiles files;
    try {
      bake(egg(1), {{"position", folder / "x.png"}}, settings, files);
      return "";
    } catch (const BakeSettingError& error) {
      return error.what();
    }
  };
  CHECK(complaint([](MeshFile&) {}).empty());
  CHECK_THAT(complaint([](MeshFile& file) { file.mesh.triangles(3, 0) = 1 << 30; }),
             Catch::StartsWith("from: a triangle names"));
  CHECK_THAT(complaint([](MeshFile& file) { file.mesh.triangles(3, 0) = -1; }),
             Catch::StartsWith("from: a triangle names"));
  CHECK_THAT(complaint([](MeshFile& file) { file.mesh.positions(3, 0) = HUGE_VAL; }),
             Catch::StartsWith("from: a coordinate"));
  CHECK_THAT(complaint([](MeshFile& file) {
               file.set_vertex_property({"q", {}, {1, 2}});
             }),
             Catch::StartsWith("from: vertex property 'q'"));
}

TEST_CASE("bake images: labels are whole in the samples that they get, or refused") {
  const Folder folder;
  const auto labelled = [](double most, double least = 0) {
    MeshFile file;
    file.mesh = icosphere(2);
    SphereMap map{file.mesh.positions};
    Property label{"label", ScalarType::Int32, std::vector<double>(320, least)};
    label.values.back() = most;
    file.set_face_property(std::move(label));
    return MappedMesh({.file = std::move(file), .map = std::move(map), .name = "labelled"});
  };
  const auto complaint = [&](double most, const char* name, SampleType type) -> std::string {
    BakeSettings settings = small;
    settings.depth = type;
    try {
      bake(labelled(most), {{"scalar:label", folder / name}}, settings);
      return "";
    } catch (const BakeSettingError& error) {
      return error.what();
    }
  };
  const auto holds = [&](double most, const char* name, SampleType type) {
    INFO(name << " " << name_of(type));
    CHECK(complaint(most, name, type).empty());
    CHECK_THAT(complaint(most + 1, name, type),
               Catch::StartsWith("depth: ") && Catch::Contains(std::to_string(std::lround(most))));
  };
  holds(255, "l.png", SampleType::Uint8);
  holds(65535, "l.png", SampleType::Uint16);
  holds(2048, "l.exr", SampleType::Half);
  holds(16777216, "l.exr", SampleType::Float);
  CHECK_THAT(complaint(70000, "l.png", SampleType::Uint16),
             Catch::EndsWith("goes up to 70000; float holds them, in a .tif or .exr"));
  CHECK_THAT(complaint(30000, "l.png", SampleType::Uint8),
             Catch::EndsWith("goes up to 30000; u16 holds them, in a .png or .tif"));
  CHECK_THAT(complaint(1e9, "l.png", SampleType::Uint16),
             Catch::EndsWith("goes up to 1000000000; no image holds these numbers: number them "
                             "anew"));

  // Beyond what float32 holds, and few steps apart.
  const auto image =
      bake(labelled(100000003, 100000001), {{"scalar:label", folder / "l.png"}}, small).images[0];
  CHECK(image.range->first == 100000001);
  std::set<double> labels;
  for (const float value : read_image(folder / "l.png").pixels)
    labels.insert(100000001 +
                  std::round(static_cast<double>(value) * (image.range->second - 100000001)));
  CHECK(labels == std::set<double>{100000001, 100000003});
}

TEST_CASE("bake images: labels are whole again by scale and offset, to the last bit") {
  const Folder folder;
  MeshFile file;
  file.mesh = icosphere(2);
  SphereMap map{file.mesh.positions};
  Property label{"label", ScalarType::Int32, std::vector<double>(320, 3.0)};
  label.values[17] = 7, label.values.back() = 12;
  file.set_face_property(std::move(label));
  const MappedMesh source({.file = std::move(file), .map = std::move(map), .name = "labelled"});
  const auto step = [&](SampleType type, double full) {
    BakeSettings settings = small;
    settings.depth = type;
    const auto range =
        bake(source, {{"scalar:label", folder / "l.png"}}, settings).images[0].range.value();
    CHECK(range.first == 3);
    return full / (range.second - range.first);
  };
  CHECK(step(SampleType::Uint8, 255) == 16);
  CHECK(step(SampleType::Uint16, 65535) == 4096);
}

TEST_CASE("bake images: labels are whole where holes were closed, too, or refused") {
  const Folder folder;
  MappedMesh whole = egg(3);
  MeshFile file = with_cap(whole.file());
  Property label{"label", ScalarType::Int32, {}};
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) label.values.push_back(v);
  file.set_vertex_property(std::move(label));
  const MappedMesh source({.file = std::move(file), .map = whole.map(), .name = "egg"});
  BakeSettings settings = small;
  settings.depth = SampleType::Uint8;
  CHECK_THROWS_WITH(bake(source, {{"scalar:label", folder / "l.png"}}, settings),
                    Catch::StartsWith("depth: uint8 holds whole numbers up to 255 exactly"));
  settings.depth = SampleType::Uint16;
  CHECK(bake(source, {{"scalar:label", folder / "l.png"}}, settings).images[0].channels == 2);
}

TEST_CASE("bake images: ranges that are measured are those of the surface, without fillers") {
  const Folder folder;
  MappedMesh whole = egg(3);
  MeshFile file = with_cap(whole.file());
  // What closes the hole lies far inside, but for its border.
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v)
    if (file.mesh.positions(v, 2) > 0.9) file.mesh.positions.row(v) *= 0.01;
  const MappedMesh source({.file = std::move(file), .map = whole.map(), .name = "egg"});
  const BakeReport report = bake(source, {{"radius", folder / "r.png"}}, small);
  REQUIRE(report.images[0].range);
  CHECK(report.images[0].range->first > 0.9);
  CHECK(report.images[0].range->second == Approx(1.5).margin(0.02));
  CHECK(report.images[0].beyond == 0);
}

TEST_CASE("bake images: numbers that float32 cannot hold are refused, what is none has no range") {
  const Folder folder;
  const auto with_scalars = [](double scale) {
    MappedMesh whole = egg(2);
    MeshFile file = whole.file();
    Property scalar{"q", ScalarType::Float64, {}};
    for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) scalar.values.push_back(v * scale);
    scalar.values[0] = std::nan("");
    scalar.values[1] = HUGE_VAL;
    file.set_vertex_property(std::move(scalar));
    return MappedMesh({.file = std::move(file), .map = whole.map(), .name = "egg"});
  };
  const auto range = [&](double scale) {
    return *bake(with_scalars(scale), {{"scalar:q", folder / "q.png"}}, small).images[0].range;
  };
  CHECK(range(1) == std::pair(2.0, 161.0));
  CHECK(range(2e36).second == 161 * 2e36);
  CHECK(range(1e-40).second == 161 * 1e-40);
  CHECK_THROWS_WITH(range(1e40),
                    Catch::StartsWith("scalar:q: its values are too large for numbers of 32 bits"));
  CHECK_THROWS_WITH(range(1e-50),
                    Catch::StartsWith("scalar:q: its values are too small for numbers of 32 bits"));
}

TEST_CASE("bake images: a target is on the same sphere, or the user is told") {
  const Folder folder;
  const MappedMesh source = egg(3);
  const std::vector<BakeRequest> images = {{"height", folder / "h.png"}};
  BakeSettings settings = small;
  settings.target = egg(2);
  CHECK(bake(source, images, settings).target_distance < 1e-9);
  // The diagonal of the egg's box is 4.12.
  settings.target = egg(2, 0.02 * 4.12);
  const BakeReport doubtful = bake(source, images, settings);
  REQUIRE(doubtful.warnings.size() == 1);
  CHECK(doubtful.warnings[0].find("% of the diagonal") != std::string::npos);
  settings.target = egg(2, 0.05 * 4.12);
  CHECK_THROWS_AS(bake(source, images, settings), OtherSphereError);
}

TEST_CASE("bake images: radial maps about two centres have not one sphere, which is told") {
  const Folder folder;
  const auto stone = [](double x) {
    MeshFile file;
    file.mesh = icosphere(3);
    Points rays = file.mesh.positions;
    rays.col(0).array() -= x;
    SphereMap map{rays.rowwise().normalized()};
    return MappedMesh(
        {.file = std::move(file),
         .map = std::move(map),
         .provenance = {{"radial-centre", std::to_string(x) + " 0 0"}, {"radial-movement", "0"}},
         .name = "stone"});
  };
  BakeSettings settings = small;
  settings.width = 128;  // texels smaller than triangles, in which heights are as they are
  settings.target = stone(0.02);
  const std::vector<BakeRequest> images = {{"height", folder / "h.png"}};
  const BakeReport told = bake(stone(0), images, settings);
  REQUIRE(told.warnings.size() == 1);
  CHECK_THAT(told.warnings[0], Catch::Contains("another centre than stone, 0.02 units of"));
  CHECK(bake(stone(0.02), images, settings).warnings.empty());
}

TEST_CASE("bake images: values are had without files, as the engine has them") {
  const MappedMesh source = egg(3);
  std::vector<float> values;
  const std::vector<BakedField> fields =
      bake_values(source, {"position"}, small,
                  [&](size_t, const BakedField& field, int, int rows, const float* row) {
                    values.insert(values.end(), row, row + field.channels * rows * small.width);
                  });
  REQUIRE(fields.size() == 1);
  CHECK(fields[0].name == "position");
  CHECK(fields[0].channels == 3);
  const auto scene = scene_of(source.file(), source.map());
  const std::vector<float> expected =
      baked(*scene, make_field("position", *scene), {.width = 32, .height = 16, .threads = 1});
  CHECK(values == expected);
}

TEST_CASE("bake: values have coverage where holes were closed, as images do") {
  MappedMesh whole = egg(3);
  const MappedMesh source({.file = with_cap(whole.file()), .map = whole.map(), .name = "egg"});
  float least = 1, greatest = 0;
  const std::vector<BakedField> fields =
      bake_values(source, {"position", "mask"}, small,
                  [&](size_t index, const BakedField& field, int, int rows, const float* row) {
                    for (int i = 0; index == 0 && i < rows * small.width; ++i) {
                      least = std::min(least, row[i * field.channels + 3]);
                      greatest = std::max(greatest, row[i * field.channels + 3]);
                    }
                  });
  CHECK(fields.at(0).channels == 4);
  CHECK(fields.at(1).channels == 1);
  CHECK(least == 0);
  CHECK(greatest == Approx(1));
}
