#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <sstream>

#include "image/image_codec.h"
#include "program.h"
#include "support/holed.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using namespace sphparam;

using Words = std::vector<std::string>;

/// A command line for each subcommand that takes a mesh, which is the second word.
std::vector<Words> uses(const Folder& folder, const std::string& mesh, const std::string& image) {
  return {{"bake", mesh, "--map", "position", "--size", "32", "-o", folder / "p.exr"},
          {"export", mesh, "--image-size", "64", "-o", folder / "e.glb"},
          {"remesh", mesh, "--grid", "ico:3", "-o", folder / "r.ply"},
          {"report", mesh, "--size", "64", "--no-viewer", "-o", folder / "r.html"},
          {"paint", mesh, "--image", image, "-o", folder / "painted.ply"},
          {"spharm", mesh, "--degree", "4", "--csv", folder / "s.csv"},
          {"compare", mesh, "--methods", "progressive", "--no-pictures", "-o", folder / "c/"},
          {"match", mesh, mesh, "--landmarks", folder / "pairs.txt", "-o", folder / "m.ply"},
          {"group", mesh, "--start", "maps", "--hold", "--size", "0", "-o", folder / "g/"}};
}

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Red, green: 0 to 1 from left to right, from the bottom to the top.
Image gradient(int size) {
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      image.pixel(x, y)[0] = (static_cast<float>(x) + 0.5F) / static_cast<float>(size);
      image.pixel(x, y)[1] = 1 - (static_cast<float>(y) + 0.5F) / static_cast<float>(size);
    }
  }
  return image;
}

/// An atlas of two pieces, the halves before and behind x = 0, that lie left and right.
Eigen::RowVector2d atlas_place(bool behind, const Vector3& p) {
  return {(behind ? 0.75 : 0.25) + 0.15 * p.y(), 0.5 + 0.3 * p.z()};
}

std::string textured(const TriangleMesh& mesh) {
  std::ostringstream text;
  text << "mtllib a.mtl\nusemtl skin\n";
  text.precision(17);
  for (const auto& p : mesh.positions.rowwise())
    text << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
  int corner = 0;
  for (const auto& f : mesh.triangles.rowwise()) {
    const Vector3 middle = mesh.position(f[0]) + mesh.position(f[1]) + mesh.position(f[2]);
    for (const int v : f) {
      const Eigen::RowVector2d st = atlas_place(middle.x() < 0, mesh.position(v));
      text << "vt " << st[0] << " " << st[1] << "\n";
    }
    text << "f";
    for (const int v : f) text << " " << v + 1 << "/" << ++corner;
    text << "\n";
  }
  return text.str();
}

/// Hurt in five ways: a copy of a face, a T-junction, holes within a piece of the atlas and across
/// its seam, a vertex where two sheets touch.
TriangleMesh hurt(TriangleMesh mesh) {
  const Vertex a = mesh.triangles(40, 0), b = mesh.triangles(40, 1), c = mesh.triangles(40, 2);
  const auto middle = static_cast<Vertex>(mesh.vertex_count());
  mesh.positions.conservativeResize(middle + 1, 3);
  mesh.positions.row(middle) = 0.6 * mesh.positions.row(a) + 0.4 * mesh.positions.row(b);
  std::vector<std::array<int, 3>> faces = {{middle, b, c}};
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const std::array<int, 3> face = {mesh.triangles(f, 0), mesh.triangles(f, 1),
                                     mesh.triangles(f, 2)};
    if (f == 40) {
      faces.push_back({a, middle, c});
    } else if (f != 100 && f != 101 && f != 300) {
      faces.push_back(face);
    }
    if (f == 200) faces.push_back(face);
  }
  mesh.triangles.resize(std::ssize(faces), 3);
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) mesh.triangles(f, k) = faces[static_cast<size_t>(f)][k];
  return mesh;
}

/// Texels whose colour is not that of either piece of the atlas at the point that they show.
double share_of_strays(const Image& colour, const Image& position) {
  long strays = 0, all = 0;
  for (int y = 0; y < colour.height; ++y) {
    for (int x = 0; x < colour.width; ++x) {
      const float* p = position.pixel(x, y);
      double off = 1;
      for (const bool behind : {false, true}) {
        const Eigen::RowVector2d st = atlas_place(behind, Vector3(p[0], p[1], p[2]));
        const float* seen = colour.pixel(x, y);
        off = std::min(off, std::hypot(seen[0] - st[0], seen[1] - st[1]));
      }
      strays += off > 0.02;
      ++all;
    }
  }
  return static_cast<double>(strays) / static_cast<double>(all);
}

}  // namespace

TEST_CASE("repair: every subcommand that takes a mesh mends it with --repair") {
  const Folder folder;
  const std::string mesh = folder / "open.obj", image = folder / "image.png";
  write_bytes(mesh, obj_text(with_a_hole()));
  const std::vector<char> png = encode_image(gradient(64), ImageFormat::Png);
  write_bytes(image, {png.begin(), png.end()});
  write_bytes(folder / "pairs.txt", "0 0\n1 1\n2 2\n5 5\n");
  for (const Words& words : uses(folder, mesh, image)) {
    INFO(words.front());
    const Ended refused = sphparam_program(words);
    CHECK(refused.code == 4);
    CHECK_THAT(refused.err,
               Contains("sphparam " + words.front() + " ") && Contains("--repair would mend it"));
    const Ended mended = sphparam_program(with(words, {"--repair"}));
    INFO(mended.err);
    CHECK(mended.code == 0);
    CHECK_THAT(mended.err, Contains("1 hole filled") && Contains("what was put in is 0.3"));
    CHECK(sphparam_program(with(words, {"--repair=unused"})).code == 4);
    CHECK(sphparam_program(with(words, {"--repair", "--component", "7"})).code == 2);
  }
}

TEST_CASE("repair: render and measure take any triangles, and mended ones with --repair") {
  const Folder folder;
  const std::string mesh = folder / "open.obj", whole = folder / "whole.obj";
  write_bytes(mesh, obj_text(with_a_hole()));
  write_bytes(whole, obj_text(icosphere(2)));
  for (const bool repair : {false, true}) {
    const Words more = repair ? Words{"--repair"} : Words{};
    const Ended drawn =
        sphparam_program(with({"render", mesh, "--size", "64", "-o", folder / "p.png"}, more));
    CHECK(drawn.code == 0);
    const Ended measured =
        sphparam_program(with({"measure", mesh, whole, "--max-distance", "1e-12"}, more));
    CHECK(measured.code == (repair ? 0 : 6));
    for (const Ended& ended : {drawn, measured})
      CHECK((ended.err.find("1 hole filled") != std::string::npos) == repair);
  }
}

TEST_CASE("repair: --keep-holes in other subcommands leaves out what closes holes") {
  const Folder folder;
  const std::string mesh = folder / "open.obj";
  write_bytes(mesh, obj_text(with_a_hole()));
  const Ended baked = sphparam_program(
      {"bake", mesh, "--map", "mask", "--size", "256", "-o", folder / "mask.png", "--keep-holes"});
  INFO(baked.err);
  REQUIRE(baked.code == 0);
  const Image mask = read_image(folder / "mask.png");
  CHECK(*std::ranges::min_element(mask.pixels) == 0);
  CHECK(*std::ranges::max_element(mask.pixels) == 1);
}

TEST_CASE("repair: a map in the mesh's file is not that of the mended mesh") {
  const Folder folder;
  const std::string map = folder / "a.sph.ply", more = folder / "more.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(icosphere(2))).code == 0);
  REQUIRE(sphparam_program({"repair", map, "-o", more}).code == 0);
  const Words words = {"bake", more, "--map", "area", "--size", "16", "-o", folder / "a.exr"};
  CHECK_THAT(sphparam_program(with(words, {"--repair"})).err, !Contains("mapped now"));
}

TEST_CASE("bake: an atlas texture survives --repair, and what is put in has its neighbours'") {
  const Folder folder;
  const std::vector<char> png = encode_image(gradient(512), ImageFormat::Png);
  write_bytes(folder / "skin.png", {png.begin(), png.end()});
  write_bytes(folder / "a.mtl", "newmtl skin\nmap_Kd skin.png\n");
  const std::string mesh = folder / "a.obj";
  TriangleMesh ring = bumped_torus(16, 40, 0.3, 0, 1);
  struct Case {
    TriangleMesh mesh;
    double strays;
    std::string told;
  };
  // Of the ring, the caps show what is along their rims.
  for (const auto& [shape, strays, told] :
       {Case{icosphere(3), 0.001, ""}, Case{hurt(icosphere(3)), 0.001, "2 holes filled"},
        Case{ring, 0.03, "1 handle cut"}}) {
    write_bytes(mesh, textured(shape));
    for (const char* out : {"basecolor.png", "position.exr"}) {
      const Ended baked = sphparam_program(
          {"bake", mesh, "--map", std::string(out, std::strchr(out, '.')), "--size", "256", "-o",
           folder / out, "--repair", "--max-handle", "90%"});
      INFO(baked.err);
      REQUIRE(baked.code == 0);
      CHECK_THAT(baked.err, Contains(told));
    }
    CHECK(share_of_strays(read_image(folder / "basecolor.png"),
                          read_image(folder / "position.exr")) <= strays);
  }
}

}  // namespace sphparam::tests
