#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "image/image_codec.h"
#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/sphere_file.h"
#include "support/direction_image.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using namespace sphparam;

/// The mesh with a square of a grid for each of its faces.
std::string obj_with_atlas(const TriangleMesh& mesh, bool overlapping = false) {
  std::string text = obj_text(mesh);
  text.erase(text.find("\nf ") + 1);
  const int side = static_cast<int>(std::ceil(std::sqrt(mesh.face_count())));
  std::string faces;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::Index cell = overlapping ? 0 : f;
    const double s = static_cast<double>(cell % side), t = static_cast<double>(cell / side);
    faces += "f";
    for (int k = 0; k < 3; ++k) {
      text.append("vt ").append(std::to_string((s + (k == 1 ? 0.9 : 0.1)) / side));
      text.append(" ").append(std::to_string((t + (k == 2 ? 0.9 : 0.1)) / side)).append("\n");
      faces.append(" ").append(std::to_string(mesh.triangles(f, k) + 1));
      faces.append("/").append(std::to_string(3 * f + k + 1));
    }
    faces += "\n";
  }
  return text + faces;
}

}  // namespace

TEST_CASE(
    "paint: vertex colours are the image where the map takes the vertices, they stay mapped") {
  const Folder folder;
  const std::string image = folder / "directions.png", painted = folder / "painted.ply";
  write_image(image, direction_image(256));
  const Ended ended =
      sphparam_program({"paint", "-", "--image", image, "-o", painted}, obj_text(icosphere(3)));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("mapped now") && Contains("painted.ply"));
  const MeshFile file = read_mesh(painted);
  const std::optional<SphereMap> map = read_sphere(file);
  REQUIRE(map);
  const char* channels[3] = {"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    const Property* property = file.find_vertex_property(channels[c]);
    REQUIRE(property);
    for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) {
      const double value = property->values[static_cast<size_t>(v)] / 255;
      CHECK(value == Approx(0.5 + 0.5 * map->point(v)[c]).margin(0.02));
    }
  }
  // A map that is there is not made again, and another format is written as named.
  const Ended again = sphparam_program({"paint", painted, "--image", image, "-o",
                                        folder / "painted.obj", "--convention", "blender"});
  CHECK(again.code == 0);
  CHECK_THAT(again.err, !Contains("mapped now"));
  CHECK(read_mesh(folder / "painted.obj").find_vertex_property("red"));
}

TEST_CASE("paint: into the mesh's own atlas, all of it filled") {
  const Folder folder;
  const std::string image = folder / "red.png", skin = folder / "skin.png";
  Image red(8, 4, 3);
  for (size_t i = 0; i < red.pixels.size(); i += 3) red.pixels[i] = 1;
  write_image(image, red);
  const Ended ended = sphparam_program(
      {"paint", "-", "--image", image, "--atlas", "64", "-o", skin}, obj_with_atlas(icosphere(1)));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, !Contains("overlap"));
  const Image atlas = read_image(skin);
  CHECK(atlas.width == 64);
  CHECK(atlas.height == 64);
  for (size_t i = 0; i < atlas.pixels.size(); i += 3) {
    REQUIRE(atlas.pixels[i] == 1);
    REQUIRE(atlas.pixels[i + 1] == 0);
  }
  const Ended overlapping =
      sphparam_program({"paint", "-", "--image", image, "--atlas", "64", "-o", skin},
                       obj_with_atlas(icosphere(1), true));
  CHECK(overlapping.code == 0);
  CHECK_THAT(overlapping.err, Contains("overlap") && Contains("(0 and 1, for one)"));
}

TEST_CASE("paint: what cannot be done is said, with its exit code, and nothing is written") {
  const Folder folder;
  const std::string image = folder / "image.png", out = folder / "out.ply";
  write_image(image, direction_image(16));
  const std::string mesh = obj_text(icosphere(1));
  const auto paint = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"paint", "-"});
    return sphparam_program(arguments, mesh);
  };
  const Ended missing = paint({"--image", folder / "none.png", "-o", out});
  CHECK(missing.code == 3);
  CHECK_THAT(missing.err, Contains("none.png"));
  write_bytes(folder / "broken.png", "not an image");
  CHECK(paint({"--image", folder / "broken.png", "-o", out}).code == 3);
  const Ended no_uv = paint({"--image", image, "--atlas", "64", "-o", folder / "out.png"});
  CHECK(no_uv.code == 2);
  CHECK_THAT(no_uv.err, Contains("no texture coordinates"));
  const Ended zero = paint({"--image", image, "--atlas", "0", "-o", folder / "out.png"});
  CHECK(zero.code == 2);
  CHECK_THAT(zero.err, Contains("1 to 32768"));
  const Ended format = paint({"--image", image, "-o", folder / "out.png"});
  CHECK(format.code == 2);
  CHECK_THAT(format.err, Contains("--atlas"));
  CHECK(paint({"--image", image, "--atlas", "8", "-o", out}).code == 2);
  const Ended convention = paint({"--image", image, "-o", out, "--convention", "blendr"});
  CHECK(convention.code == 2);
  CHECK_THAT(convention.err, Contains("did you mean blender?"));
  const std::string gis = folder / "gis.png";
  write_image(gis, direction_image(16), {.metadata = {{"sphparam:convention", "gis"}}});
  const Ended other = paint({"--image", gis, "-o", out});
  CHECK(other.code == 2);
  CHECK_THAT(other.err,
             Contains("--convention: ") && Contains("gis.png is baked in the convention "
                                                    "gis, and would be read in sphparam: "
                                                    "convention gis reads it as it is"));
  CHECK(paint({"--image", gis, "-o", "-", "--convention", "gis"}).code == 0);
  CHECK(paint({"--image", image, "-o", image}).code == 2);
  CHECK(paint({"-o", out}).code == 2);
  CHECK(folder.names() == std::vector<std::string>{"broken.png", "gis.png", "image.png"});
}

TEST_CASE("paint: a picture that is not twice as wide as high is painted, with a warning") {
  const Folder folder;
  write_image(folder / "square.png", Image(16, 16, 3));
  const Ended ended =
      sphparam_program({"paint", "-", "--image", folder / "square.png", "-o", folder / "out.ply"},
                       obj_text(icosphere(1)));
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("twice as wide as high"));
}

TEST_CASE("paint: of a mesh with several images it is told that --atlas makes one of them") {
  const Folder folder;
  const std::string image = folder / "red.png", mesh = folder / "two.obj";
  write_image(image, Image(8, 4, 3));
  for (const char* skin : {"a.png", "b.png"}) write_image(folder / skin, Image(4, 4, 3));
  const auto told = [&](const std::string& second) {
    write_bytes(folder / "two.mtl", "newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd " + second + "\n");
    std::string text = "mtllib two.mtl\n" + obj_with_atlas(icosphere(1));
    text.insert(text.find("\nf ") + 1, "usemtl a\n");
    text.insert(text.rfind("f "), "usemtl b\n");
    write_bytes(mesh, text);
    const Ended ended = sphparam_program(
        {"paint", mesh, "--image", image, "--atlas", "64", "-o", folder / "skin.png"});
    CHECK(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(told("b.png"), Contains("warning: two.obj: its texture is of 2 images") &&
                                Contains("`sphparam export " + mesh + " --image " + image));
  CHECK_THAT(told("a.png"), !Contains("images"));
}

}  // namespace sphparam::tests
