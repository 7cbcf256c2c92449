#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>

#include "image/image_codec.h"
#include "remesh/image_values.h"
#include "sphparam/remesh/geometry_image.h"
#include "support/folder.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

std::vector<double> random_values(std::int64_t count, double scale) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, scale);
  std::vector<double> values(static_cast<size_t>(count));
  std::generate(values.begin(), values.end(), [&] { return normal(random); });
  return values;
}

struct Made {
  GridSpec spec;
  SphereGrid grid;
  std::vector<double> values;
  explicit Made(const std::string& name, double scale = 1)
      : spec(parse_grid(name)),
        grid(make_grid(spec)),
        values(random_values(3 * grid.directions.rows(), scale)) {}
  GeometryImage image(ImageDepth depth) const {
    return make_geometry_image(spec, grid.directions, values, 3, depth);
  }
};

/// Through the bytes of a file and back.
ImageContents through_file(const GeometryImage& made, ImageDepth depth) {
  const SampleType type = depth == ImageDepth::Uint16 ? SampleType::Uint16
                          : depth == ImageDepth::Half ? SampleType::Half
                                                      : SampleType::Float;
  const ImageFormat format = depth == ImageDepth::Uint16 ? ImageFormat::Png : ImageFormat::Exr;
  const std::vector<char> bytes =
      encode_image(made.image, format, {.sample_type = type, .metadata = made.texts});
  ImageTexts texts;
  const Image image = decode_image(bytes, "an image", {}, &texts);
  return read_geometry_image(image, texts);
}

const std::vector<std::string> layouts = {"octa:3", "octa:5", "octa:7", "octa:33", "octa:35",
                                          "cube:1", "cube:2", "cube:3", "cube:16", "cube:21"};

}  // namespace

TEST_CASE("geometry images: every sample has a vertex, every vertex a sample") {
  for (const std::string& name : layouts) {
    INFO(name);
    const Made made(name);
    const ImageLayout layout = image_layout(made.spec, made.grid.directions);
    std::vector<int> seen(static_cast<size_t>(made.grid.directions.rows()), 0);
    for (const int vertex : layout.vertex) {
      REQUIRE(vertex >= 0);
      ++seen[static_cast<size_t>(vertex)];
    }
    CHECK(*std::min_element(seen.begin(), seen.end()) == (name == "cube:1" ? 3 : 1));
    CHECK(*std::max_element(seen.begin(), seen.end()) == (name[0] == 'o' ? 4 : 3));
  }
}

TEST_CASE("geometry images: neighbours in the image are neighbours in the grid") {
  for (const std::string name : {"octa:33", "octa:35", "cube:16"}) {
    INFO(name);
    const Made made(name);
    const ImageLayout layout = image_layout(made.spec, made.grid.directions);
    const int side = name[0] == 'c' ? layout.width : layout.height;
    for (int row = 0; row < layout.height; ++row) {
      for (int column = 0; column < layout.width; ++column) {
        const auto at = [&](int r, int c) -> Vector3 {
          return made.grid.directions.row(
              layout.vertex[static_cast<size_t>(r) * static_cast<size_t>(layout.width) +
                            static_cast<size_t>(c)]);
        };
        if (column + 1 < layout.width) CHECK((at(row, column) - at(row, column + 1)).norm() < 0.26);
        const bool same_side = (row + 1) % side != 0;
        if (same_side) CHECK((at(row, column) - at(row + 1, column)).norm() < 0.26);
        // Seen from outside: right and up turn counter-clockwise.
        if (column + 1 < layout.width && same_side) {
          const Vector3 here = at(row, column), right = at(row, column + 1),
                        down = at(row + 1, column);
          // Zero at the middles of the square's edges and at its corners, where it folds.
          CHECK((down - here).cross(right - here).dot(here) > -1e-12);
        }
      }
    }
  }
}

TEST_CASE("geometry images: in float, what comes back is what went in, rounded") {
  for (const std::string& name : layouts) {
    INFO(name);
    const Made made(name);
    const ImageContents back = through_file(made.image(ImageDepth::Float), ImageDepth::Float);
    CHECK(back.spec == made.spec);
    CHECK(back.grid.directions == made.grid.directions);
    CHECK(back.grid.faces.corners == made.grid.faces.corners);
    REQUIRE(back.values.size() == made.values.size());
    for (size_t i = 0; i < back.values.size(); ++i) {
      CHECK(back.values[i] == static_cast<double>(static_cast<float>(made.values[i])));
    }
  }
}

TEST_CASE(
    "geometry images: floats far from 0 for their extent are less an offset, which comes back") {
  Made made("octa:17");
  for (size_t i = 0; i < made.values.size(); ++i) made.values[i] += i % 3 == 1 ? 5.2e6 : 0;
  const GeometryImage image = made.image(ImageDepth::Float);
  CHECK(image.texts.back().first == "sphparam:offset");
  const std::vector<double> back = through_file(image, ImageDepth::Float).values;
  REQUIRE(back.size() == made.values.size());
  // Half a step of float32 below 8, the extent, and what the sum in double loses.
  for (size_t i = 0; i < back.size(); ++i)
    CHECK(std::abs(back[i] - made.values[i]) <= 0x1p-22 + 0x1p-30);

  // What floats hold as it is stays as it is.
  for (double& value : made.values) value = static_cast<double>(static_cast<float>(value));
  const GeometryImage held = made.image(ImageDepth::Float);
  CHECK(held.texts.back().first == "sphparam:depth");
  CHECK(through_file(held, ImageDepth::Float).values == made.values);

  // Halves hold none so large: they are counted from the least, and have 11 bits of the extent.
  const GeometryImage half = made.image(ImageDepth::Half);
  CHECK(half.texts.back().first == "sphparam:offset");
  const std::vector<double> rough = through_file(half, ImageDepth::Half).values;
  for (size_t i = 0; i < rough.size(); ++i)
    CHECK(std::abs(rough[i] - made.values[i]) <= 8 * 0x1p-12);
}

TEST_CASE("geometry images: half and 16 bits are within half a quantum") {
  for (const double scale : {1e-6, 1.0, 3000.0}) {
    const Made made("octa:17", scale);
    const auto half = through_file(made.image(ImageDepth::Half), ImageDepth::Half).values;
    const GeometryImage image = made.image(ImageDepth::Uint16);
    for (const float sample : image.image.pixels) {  // 0 to 65535, so that PNG rounds nothing
      const double step = static_cast<double>(sample) * 65535;
      CHECK(std::abs(step - std::round(step)) < 0.01);
    }
    const auto u16 = through_file(image, ImageDepth::Uint16).values;
    for (size_t i = 0; i < made.values.size(); ++i) {
      const double x = made.values[i];
      const double quantum = std::ldexp(1, std::max(std::ilogb(x), -14) - 10);
      CHECK(std::abs(half[i] - x) <= quantum / 2);
    }
    for (size_t k = 0; k < 3; ++k) {
      double least = 1e9, greatest = -1e9;
      for (size_t i = k; i < made.values.size(); i += 3) {
        least = std::min(least, made.values[i]);
        greatest = std::max(greatest, made.values[i]);
      }
      for (size_t i = k; i < made.values.size(); i += 3) {
        CHECK(std::abs(u16[i] - made.values[i]) <= (greatest - least) / 65535 / 2 * (1 + 1e-9));
      }
    }
  }
}

TEST_CASE("geometry images: what is broken is refused, saying what") {
  const Made made("octa:9");
  const GeometryImage good = made.image(ImageDepth::Float);
  CHECK_THROWS_WITH(read_geometry_image(good.image, {}), Catch::Contains("names no grid"));
  CHECK_THROWS_WITH(read_geometry_image(good.image, {{"sphparam:grid", "octa:11"}}),
                    Catch::Contains("9 x 9"));
  CHECK_THROWS_WITH(read_geometry_image(good.image, {{"sphparam:grid", "ico:2"}}),
                    Catch::Contains("ico:2"));
  for (const auto& [width, height] : {std::pair(8, 9), std::pair(9, 8), std::pair(10, 9)}) {
    CHECK_THROWS_WITH(read_geometry_image(Image(width, height, 3), good.texts),
                      Catch::Contains("which is not octa:9"));
  }
  GeometryImage torn = good;
  torn.image.pixels[0] += 1;  // one of the four corners, which are all −z
  CHECK_THROWS_WITH(read_geometry_image(torn.image, torn.texts), Catch::Contains("differ"));
  GeometryImage broken = good;
  broken.image.pixels[30] = std::nanf("");
  CHECK_THROWS_WITH(read_geometry_image(broken.image, broken.texts), Catch::Contains("not finite"));
  const GeometryImage whole = made.image(ImageDepth::Uint16);
  CHECK_THROWS_WITH(
      read_geometry_image(whole.image, {whole.texts[0], whole.texts[1], {"sphparam:min", "1 2"}}),
      Catch::Contains("sphparam:min"));
  CHECK_THROWS_WITH(
      read_geometry_image(whole.image, {whole.texts[0],
                                        whole.texts[1],
                                        {"sphparam:min", "-1.7e308 -1.7e308 -1.7e308"},
                                        {"sphparam:max", "1.7e308 1.7e308 1.7e308"}}),
      Catch::Contains("not finite"));
  CHECK_THROWS_AS(Made("octa:9", 1e5).image(ImageDepth::Half), std::range_error);
}

TEST_CASE("geometry images: a mesh comes back from its files, normals and colours too") {
  MeshFile file;
  file.mesh = tests::icosphere(3);
  const SphereMap map{file.mesh.positions};
  file.mesh.positions.col(0) *= 2;
  for (const char* name : {"red", "green", "blue"}) {
    Property channel{name, ScalarType::Uint8, {}};
    for (size_t v = 0; v < 642; ++v)
      channel.values.push_back(static_cast<double>((v * (name[0] == 'r' ? 7 : 13)) % 256));
    file.set_vertex_property(std::move(channel));
  }
  const Remeshed made = remesh(tests::mapped(file, map), parse_grid("octa:9"));
  const tests::Folder folder;
  PendingFiles files;
  for (const char* what : {"position", "normal", "color"})
    add_geometry_image(files, folder / (what + std::string(".exr")), made, what);
  add_geometry_image(files, folder / "small.png", made, "position");
  files.publish();
  const Remeshed back = load_geometry_image({.positions = folder / "position.exr",
                                             .normals = folder / "normal.exr",
                                             .attributes = {{"color", folder / "color.exr"}}});
  CHECK(back.map().points == made.map().points);
  CHECK(back.mesh().triangles == made.mesh().triangles);
  CHECK(back.mesh().positions == made.mesh().positions.cast<float>().cast<double>());
  for (const char* name : {"red", "green", "blue"}) {
    const Property* channel = back.file().find_vertex_property(name);
    REQUIRE(channel);
    CHECK(channel->type == ScalarType::Uint8);
    CHECK(channel->values == made.file().find_vertex_property(name)->values);
  }
  for (Vertex v = 0; v < back.mesh().vertex_count(); ++v) {
    const auto at = static_cast<size_t>(v);
    const Vector3 normal(back.file().find_vertex_property("nx")->values[at],
                         back.file().find_vertex_property("ny")->values[at],
                         back.file().find_vertex_property("nz")->values[at]);
    CHECK(normal.norm() == Approx(1));
    const Vector3 p = back.mesh().position(v);  // of x²/4 + y² + z² = 1
    CHECK(normal.dot(Vector3(p[0] / 4, p[1], p[2]).normalized()) > 0.9);
  }
  const Remeshed small = load_geometry_image({.positions = folder / "small.png"});
  CHECK((small.mesh().positions - made.mesh().positions).cwiseAbs().maxCoeff() <= 4.0 / 65535);
  CHECK_THROWS_AS(load_geometry_image({.positions = folder / "position.exr",
                                       .attributes = {{"thickness", folder / "color.exr"}}}),
                  ImageError);
  const auto refused = [&](const GeometryImageFiles& images, const char* words) {
    CHECK_THROWS_WITH(load_geometry_image(images), Catch::Contains(words));
  };
  refused({.positions = folder / "normal.exr"},
          "normal.exr: the image of 'normal', not of 'position'; give it as --normals");
  refused({.positions = folder / "position.exr", .normals = folder / "position.exr"},
          "position.exr: the image of 'position', not of 'normal'; give it as IMAGE");
  refused({.positions = folder / "position.exr", .attributes = {{"colour", folder / "normal.exr"}}},
          "the image of 'normal', not of 'colour'");
  refused({.positions = folder / "position.exr", .normals = folder / "color.exr"},
          "the image of 'color', not of 'normal'; give it as --attribute NAME=FILE");
  CHECK(load_geometry_image({.positions = folder / "position.exr",
                             .attributes = {{"colour", folder / "color.exr"}}})
            .file()
            .find_vertex_property("red"));
}

TEST_CASE("geometry images: labels are labels again, of their type") {
  MeshFile file;
  file.mesh = tests::icosphere(3);
  const SphereMap map{file.mesh.positions};
  Property labels{"region", ScalarType::Int16, {}}, heights{"height", ScalarType::Float64, {}};
  for (int v = 0; v < 642; ++v) labels.values.push_back(v % 35 - 1);
  heights.values = labels.values;
  file.vertex_properties = {labels, heights};
  const Remeshed made = remesh(tests::mapped(file, map), parse_grid("octa:9"));
  const tests::Folder folder;
  PendingFiles files;
  add_geometry_image(files, folder / "position.exr", made, "position");
  for (const char* name : {"region.exr", "region.png"})
    add_geometry_image(files, folder / name, made, "region");
  add_geometry_image(files, folder / "half.exr", made, "region", ImageDepth::Half);
  add_geometry_image(files, folder / "height.exr", made, "height");
  files.publish();
  const auto back = [&](const std::string& property, const std::string& image) {
    std::vector<std::string> warnings{"none"};
    const Remeshed mesh = load_geometry_image(
        {.positions = folder / "position.exr", .attributes = {{property, folder / image}}}, 1, {},
        &warnings);
    CHECK(warnings.empty());
    return *mesh.file().find_vertex_property(property);
  };
  for (const char* image : {"region.exr", "region.png", "half.exr"}) {
    const Property region = back("region", image);
    CHECK(region.type == ScalarType::Int16);
    CHECK(region.values == made.file().find_vertex_property("region")->values);
  }
  CHECK(back("height", "height.exr").type == ScalarType::Float32);
}

TEST_CASE("geometry images: whole numbers of which no type is said are floats, which is told") {
  const Made made("octa:9");
  const std::vector<double> labels(made.values.size() / 3, 4);
  GeometryImage image =
      make_geometry_image(made.spec, made.grid.directions, labels, 1, ImageDepth::Float);
  const tests::Folder folder;
  write_image(folder / "region.exr", image.image,
              {.sample_type = SampleType::Float, .metadata = image.texts});
  image = make_geometry_image(
      made.spec, made.grid.directions,
      {made.grid.directions.data(), made.grid.directions.data() + made.grid.directions.size()}, 3,
      ImageDepth::Float);
  write_image(folder / "position.exr", image.image,
              {.sample_type = SampleType::Float, .metadata = image.texts});
  std::vector<std::string> warnings;
  const Remeshed mesh = load_geometry_image(
      {.positions = folder / "position.exr", .attributes = {{"region", folder / "region.exr"}}}, 1,
      {}, &warnings);
  CHECK(mesh.file().find_vertex_property("region")->type == ScalarType::Float32);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("does not say whether they are labels"));
}

TEST_CASE("geometry images: labels that a depth does not tell apart are refused") {
  MeshFile file;
  file.mesh = tests::icosphere(2);
  const SphereMap map{file.mesh.positions};
  Property labels{"region", ScalarType::Int32, std::vector<double>(162, 0)};
  const auto add = [&](double greatest, const std::string& name, ImageDepth depth) {
    for (Vertex v = 0; v < 162; ++v)
      labels.values[static_cast<size_t>(v)] = file.mesh.position(v).z() > 0 ? greatest : 0;
    file.vertex_properties = {labels};
    PendingFiles files;
    add_geometry_image(files, name, remesh(tests::mapped(file, map), parse_grid("octa:5")),
                       "region", depth);
  };
  const tests::Folder folder;
  CHECK_NOTHROW(add(2048, folder / "h.exr", ImageDepth::Half));
  CHECK_THROWS_AS(add(2049, folder / "h.exr", ImageDepth::Half), std::range_error);
  CHECK_NOTHROW(add(65535, folder / "u.png", ImageDepth::Uint16));
  CHECK_THROWS_AS(add(65536, folder / "u.png", ImageDepth::Uint16), std::range_error);
  CHECK_THROWS_AS(add(16777217, folder / "f.exr", ImageDepth::Float), std::range_error);
}

TEST_CASE("geometry images: other grids, and names that say another format, are refused") {
  const TriangleMesh ball = tests::icosphere(2);
  const MappedMesh source = tests::mapped(ball, {ball.positions});
  const Remeshed made = remesh(source, parse_grid("octa:5"));
  PendingFiles files;
  const auto refused = [&](const Remeshed& mesh, const std::string& path,
                           std::optional<ImageDepth> depth = {}) {
    INFO(path);
    CHECK_THROWS_AS(add_geometry_image(files, path, mesh, "position", depth),
                    std::invalid_argument);
  };
  refused(made, "g.jpg");
  refused(made, "g");
  refused(made, "g.exr", ImageDepth::Uint16);
  for (const ImageDepth depth : {ImageDepth::Half, ImageDepth::Float})
    refused(made, "g.png", depth);
  refused(remesh(source, parse_grid("ico:1")), "g.exr");
  refused(remesh(source, grid_of(source)), "g.exr");
}
