#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "image/image_codec.h"
#include "render/value_paint.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/render/coloured_values.h"
#include "sphparam/render/picture.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace {

MeshFile file_of(const TriangleMesh& mesh) {
  MeshFile file;
  file.mesh = mesh;
  return file;
}

}  // namespace

TEST_CASE("picture: what is drawn has the map of its file, or of a sphere of any radius") {
  const Folder folder;
  TriangleMesh egg = icosphere(1);
  const Points rays = egg.positions;
  egg.positions.col(2) *= 2;
  write_mesh(folder / "egg.ply", file_of(egg));
  write_mesh(folder / "egg.sph.ply", attach_map(file_of(egg), {rays}, {}));
  write_mesh(folder / "ball.ply", file_of({8 * rays, egg.triangles}));
  CHECK_FALSE(load_drawn(folder / "egg.ply").map);
  CHECK(load_drawn(folder / "egg.sph.ply").map->points == rays);
  const DrawnMesh drawn = load_drawn(folder / "egg.ply", folder / "ball.ply");
  REQUIRE(drawn.map);
  CHECK((drawn.map->points - rays).norm() < 1e-12);
  CHECK(draw_png(drawn.file, drawn.map, {.size = 32}).starts_with("\x89PNG"));
}

TEST_CASE("picture: nothing to draw, and a vertex in no direction, are refused with the file") {
  const Folder folder;
  write_mesh(folder / "none.ply", file_of({Points::Zero(3, 3), Triangles(0, 3)}));
  CHECK_THROWS_WITH(load_drawn(folder / "none.ply"), "none.ply: there are no triangles to draw");
  TriangleMesh ball = icosphere(1);
  write_mesh(folder / "ball.ply", file_of(ball));
  ball.positions.row(4).setZero();
  write_mesh(folder / "flat.ply", file_of(ball));
  CHECK_THROWS_WITH(load_drawn(folder / "ball.ply", folder / "flat.ply"),
                    "flat.ply: vertex 4 is at the centre, in no direction");
}

TEST_CASE("picture: any axis may be up, any in front, as is asked for or as the file says") {
  TriangleMesh egg = icosphere(2);
  egg.positions.col(2) *= 2;
  egg.positions.col(0).array() *= 1 + 0.3 * egg.positions.col(2).array();
  const DrawingOptions look{.view = View::Mesh, .colouring = Colouring::Plain, .size = 48};
  const std::string upright = draw_png(file_of(egg), std::nullopt, look);
  const Points p = egg.positions;
  egg.positions << p.col(1), p.col(0), -p.col(2);  // z goes to −z, −y to −x
  MeshFile lying = file_of(egg);
  CHECK(draw_png(lying, std::nullopt, look) != upright);
  DrawingOptions turned = look;
  turned.up = {.direction = -Vector3::UnitZ(), .front = -Vector3::UnitX()};
  CHECK(draw_png(lying, std::nullopt, turned) == upright);
  note_up(lying, turned.up);
  CHECK(draw_png(lying, std::nullopt, look) == upright);
}

TEST_CASE(
    "picture: where the map stands as the mesh, its sphere shows the front as the mesh does") {
  const TriangleMesh ball = icosphere(2);
  const SphereMap map{ball.positions};
  const auto sphere_from = [&](const MeshFile& file, const Vector3& eye) {
    return draw_png(
        file, map,
        {.view = View::Sphere, .colouring = Colouring::Checker, .from = eye, .size = 48});
  };
  MeshFile file = file_of(ball);
  const std::string prime = sphere_from(file, Vector3(1, 0, 0.3));  // z is up, −y in front
  CHECK(sphere_from(file, Vector3(0, -1, 0.3)) != prime);
  file.comments = {"sphparam upright z, front -y"};
  CHECK(sphere_from(file, Vector3(0, -1, 0.3)) == prime);
  file.comments = {"sphparam upright y, front z"};  // not as the file stands
  CHECK(sphere_from(file, Vector3(0, -1, 0.3)) != prime);
}

TEST_CASE("picture: at one height of the world a mesh of half the size is drawn half as large") {
  MeshFile large = file_of(icosphere(3)), small = large;
  small.mesh.positions *= 0.5;
  small.mesh.positions.array() += 7;  // it is looked at wherever it is
  const auto covered = [](const MeshFile& file, double height) {
    const std::string png = draw_png(
        file, std::nullopt, {.colouring = Colouring::Plain, .size = 100, .height = height});
    const Image image = decode_image({png.begin(), png.end()}, "picture");
    long count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) count += image.pixel(x, y)[0] < 0.99F;
    return static_cast<double>(count);
  };
  const double height = height_to_see(large);
  CHECK(height == Catch::Detail::Approx(2.12).epsilon(0.01));
  CHECK(height_to_see(small) == Catch::Detail::Approx(height / 2));
  CHECK(covered(large, 0) == covered(large, height));
  CHECK(covered(small, 0) == Catch::Detail::Approx(covered(large, 0)).epsilon(0.01));
  CHECK(covered(small, height) == Catch::Detail::Approx(covered(large, 0) / 4).epsilon(0.05));
  CHECK(height_to_see(large, {.from = Vector3(1, 0, 0)}) > 2);
  CHECK_THROWS_AS(height_to_see(large, {.from = Vector3(0, 0, 1)}), std::invalid_argument);
}

TEST_CASE("picture: a number a face is drawn, that of vertices of the same name before it") {
  MeshFile file = file_of(icosphere(1));
  const auto drawn = [&] {
    return draw_png(file, std::nullopt, {.scalar = "part", .legend = false, .size = 32});
  };
  Property part{"part", ScalarType::Int32, std::vector<double>(80, 0)};
  file.set_face_property(part);
  const std::string plain = drawn();
  for (size_t f = 0; f < 80; ++f) part.values[f] = static_cast<double>(f % 2);
  file.set_face_property(part);
  CHECK(drawn() != plain);
  file.set_vertex_property({"part", ScalarType::Int32, std::vector<double>(42, 0)});
  CHECK(drawn() == plain);
}

TEST_CASE("picture: the mark of what closes holes is drawn as 0, for nothing else is to be seen") {
  MeshFile file = file_of(icosphere(2));
  const SphereMap map{file.mesh.positions};
  file.set_face_property({"zero", ScalarType::Uint8, std::vector<double>(320, 0)});
  FillerMarks fillers(320, 0);
  fillers[7] = 1;
  mark_fillers(file, fillers);
  for (const std::optional<SphereMap>& shown : {std::optional(map), std::optional<SphereMap>()}) {
    const auto drawn = [&](const char* name) {
      return draw_png(file, shown, {.scalar = name, .legend = false, .size = 64});
    };
    CHECK(drawn("filler") == drawn("zero"));
  }
}

TEST_CASE("picture: options outside of their domains are refused") {
  const MeshFile file = file_of(icosphere(1));
  const auto refused = [&](const DrawingOptions& options) {
    CHECK_THROWS_AS(draw_png(file, std::nullopt, options), std::invalid_argument);
  };
  for (const int bad : {8, 0, -1, 16385}) refused({.size = bad});
  for (const double bad : {-1.0, std::nan("")}) refused({.size = 16, .height = bad});
  for (const Vector3& bad : {Vector3(0, 0, 0), Vector3(std::nan(""), 0, 1)})
    refused({.from = bad, .size = 16});
  refused({.range = std::pair(1.0, 1.0), .size = 16});
  refused({.range = std::pair(std::nan(""), 1.0), .size = 16});
  refused({.view = static_cast<View>(3), .size = 16});
  refused({.colouring = static_cast<Colouring>(6), .size = 16});
}

TEST_CASE("coloured values: a property, colours, and a comment where one says what they are") {
  const MeshFile ball = file_of(icosphere(0));
  const VectorX values = VectorX::LinSpaced(ball.mesh.vertex_count(), 0, 2.5);
  CHECK(with_coloured_values(ball, "error", values).comments.empty());
  const MeshFile told = with_coloured_values(ball, "error", values, "distance to\nb.ply");
  REQUIRE(told.comments.size() == 1);
  CHECK(told.comments[0] == "error: distance to b.ply, colours from 0 to 2.5");
  CHECK(told.find_vertex_property("error")->values[11] == 2.5);
  CHECK(told.find_vertex_property("red"));
}

TEST_CASE("coloured values: a texture, which would be seen instead of the colours, is left out") {
  MeshFile skinned = file_of(icosphere(0));
  skinned.comments = {"TextureFile skin.png", "scanned"};
  skinned.materials = {"skin.png"};
  skinned.base_colours = {MaterialTexture{.image = "skin.png"}};
  skinned.channels.resize(1);
  const MeshFile told = with_coloured_values(skinned, "error", VectorX::Zero(12));
  CHECK(told.comments == std::vector<std::string>{"scanned"});
  CHECK(told.base_colours.empty());
  CHECK(told.channels.empty());
  CHECK(told.materials == skinned.materials);
}

TEST_CASE("scalar colours: those that a picture has, alone, with their range in a comment") {
  MeshFile ball = file_of(icosphere(0));
  Property height{"height", ScalarType::Float64, {}};
  for (const double z : ball.mesh.positions.col(2)) height.values.push_back(z);
  ball.set_vertex_property(height);
  ball.set_vertex_property({"alpha", ScalarType::Uint8, std::vector<double>(12, 128)});
  ball.comments = {"TextureFile skin.png", "scanned"};
  ball.base_colours = {MaterialTexture{.image = "skin.png"}};
  const auto told = [&](const std::string& name, std::optional<std::pair<double, double>> range) {
    const MeshFile seen = with_scalar_colours(ball, name, range);
    CHECK(seen.base_colours.empty());
    CHECK_FALSE(seen.find_vertex_property("alpha"));
    CHECK(seen.find_vertex_property("height")->values == height.values);
    const std::vector<Rgb> colours = value_paint(ball, name, range).paint.colours;
    for (size_t v = 0; v < 12; ++v)
      CHECK(seen.find_vertex_property("green")->values[v] ==
            std::round(255 * static_cast<double>(colours[v][1])));
    REQUIRE(seen.comments.size() == ball.comments.size());
    return seen.comments.back();
  };
  CHECK(told("height", {{-2, 2}}) == "colours of height: from -2 (blue) by 0 (white) to 2 (red)");
  CHECK(told("height", {{0, 1}}) == "colours of height: from 0 (dark) to 1 (yellow)");
  CHECK(told("height", {{101324.5, 101325.5}}) ==
        "colours of height: from 101324.5 (dark) to 101325.5 (yellow)");
  ball.set_vertex_property({"part", ScalarType::Int32, std::vector<double>(12, 1)});
  ball.comments = {"gifti label 1 0 1 0 1 green", "TextureFile skin.png"};
  CHECK(told("part", {}) == "colours of part: of its table");
}

TEST_CASE("coloured values: of both signs, blue to red as far both ways") {
  const MeshFile ball = file_of(icosphere(0));
  VectorX values = VectorX::Zero(ball.mesh.vertex_count());
  values[0] = -2, values[1] = 1, values[2] = 2;
  const MeshFile told = with_coloured_values(ball, "deviation", values, "distance");
  CHECK(told.comments[0] == "deviation: distance, colours from -2 to 2");
  const auto channel = [&](const char* name, size_t v) {
    return told.find_vertex_property(name)->values[v];
  };
  CHECK(channel("blue", 0) > channel("red", 0));
  CHECK(channel("red", 2) > channel("blue", 2));
  CHECK(channel("red", 3) == channel("red", 4));
  CHECK(channel("red", 3) > 200);
  CHECK(channel("green", 1) > channel("green", 2));
}

TEST_CASE("coloured values: blue to red about 0 where all are on one side, and over a range") {
  const MeshFile ball = file_of(icosphere(0));
  const VectorX values = VectorX::LinSpaced(12, 0, 2.75);
  const MeshFile outside = with_coloured_values(ball, "deviation", values, "d", {.diverges = true});
  CHECK(outside.comments[0] == "deviation: d, colours from -2.75 to 2.75");
  const auto bytes = [](const MeshFile& file, size_t v) {
    std::vector<double> channels;
    for (const char* name : {"red", "green", "blue"})
      channels.push_back(file.find_vertex_property(name)->values[v]);
    return channels;
  };
  const auto bytes_of = [](const Rgb& colour) {
    std::vector<double> channels;
    for (const float channel : colour) channels.push_back(std::round(255 * double{channel}));
    return channels;
  };
  CHECK(bytes(outside, 0) == bytes_of(diverging(0)));
  CHECK(bytes(outside, 11) == bytes_of(diverging(1)));
  const MeshFile ranged = with_coloured_values(ball, "deviation", values, "d",
                                               {.diverges = true, .range = std::pair(-0.5, 0.5)});
  CHECK(ranged.comments[0] == "deviation: d, colours from -0.5 to 0.5");
  CHECK(bytes(ranged, 1) == bytes_of(diverging(0.5)));
  CHECK(bytes(ranged, 11) == bytes_of(diverging(1)));
  CHECK(bytes(with_coloured_values(ball, "error", values, "", {.range = std::pair(0.0, 0.5)}), 1) ==
        bytes_of(viridis(0.5)));
}
