#include <catch2/catch.hpp>
#include <cmath>

#include "image/image_codec.h"
#include "program.h"
#include "sphparam/io/vertex_data.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Catch::StartsWith;

const std::string png_signature = "\x89PNG\r\n";

}  // namespace

TEST_CASE("render: draws a mesh, and a map with its sphere beside it") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply", picture = folder / "map.png";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(icosphere(2))).code == 0);
  const Ended drawn = sphparam_program({"render", map, "-o", picture, "--size", "64"});
  INFO(drawn.err);
  REQUIRE(drawn.code == 0);
  const std::string bytes = bytes_of(picture);
  CHECK_THAT(bytes, StartsWith(png_signature));
  // The header holds width and height, big-endian: two pictures of 64 × 64.
  CHECK(bytes.substr(16, 8) == std::string("\0\0\0\x80\0\0\0\x40", 8));

  const Ended piped =
      sphparam_program({"render", "-", "-o", "-", "--size", "64"}, obj_text(icosphere(1)));
  CHECK(piped.code == 0);
  CHECK(piped.out.substr(16, 8) == std::string("\0\0\0\x40\0\0\0\x40", 8));
}

TEST_CASE("render: what reading lost is told, also where that number is asked for") {
  const std::string mesh =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty float quality\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 1\n1 0 0 nan\n0 1 0 3\n0 0 1 4\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  const std::string loss =
      ": not carried: property 'quality' of element 'vertex': 1 of its 4 numbers (25 %) are not "
      "finite, and a mesh keeps none of these\n";
  const Folder folder;
  const std::string picture = folder / "a.png";
  const Ended drawn = sphparam_program({"render", "-", "-o", picture, "--size", "64"}, mesh);
  CHECK(drawn.code == 0);
  CHECK_THAT(drawn.err, Contains(loss));
  const Ended asked = sphparam_program({"render", "-", "-o", picture, "--scalar", "quality"}, mesh);
  CHECK(asked.code == 2);
  CHECK_THAT(asked.err, Contains("--scalar: standard input" + loss) && !Contains("no numbers"));
}

TEST_CASE("render: colours of faces are told wherever they are in no image") {
  const Folder folder;
  const std::string mesh = folder / "faces.off";
  std::string off = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  for (const char* face : {"0 2 1 255 0 0", "0 1 3 255 0 0", "1 2 3 0 0 255", "0 3 2 0 255 0"})
    off += std::string("3 ") + face + "\n";
  write_bytes(mesh, off);
  const auto lost = Contains("not carried: 3 colours of faces into images");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"render", mesh, "-o", folder / "a.png", "--size", "64"},
        {"export", mesh, "-o", folder / "a.glb", "--image-size", "64"},
        {"remesh", mesh, "-o", folder / "b.glb", "--grid", "ico:1"},
        {"asset", mesh, "-o", folder / "made", "--size", "64", "--no-page"}}) {
    const Ended ended = sphparam_program(command);
    INFO(command.front() << ": " << ended.err);
    CHECK(ended.code == 0);
    CHECK_THAT(ended.err, lost);
    CHECK(ended.err.find("not carried") == ended.err.rfind("not carried"));
  }
  const Ended plain = sphparam_program(
      {"render", mesh, "-o", folder / "a.png", "--size", "64", "--colour", "plain"});
  CHECK(plain.code == 0);
  CHECK_THAT(plain.err, !Contains("not carried"));
}

TEST_CASE("render: every colouring and overlay draws") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(tube(6, 8))).code == 0);
  for (const char* colouring : {"own", "plain", "normals", "checker", "area", "angle"}) {
    const Ended ended = sphparam_program(
        {"render", map, "-o", "-", "--size", "32", "--colour", colouring, "--wire", "--graticule"});
    CHECK(ended.code == 0);
    CHECK_THAT(ended.out, StartsWith(png_signature));
  }
}

TEST_CASE("render: a name that promises another format is refused before any work") {
  const Folder folder;
  for (const char* name : {"ball.jpg", "ball.exr", "ball.svg"}) {
    const Ended ended =
        sphparam_program({"render", "-", "-o", folder / name}, obj_text(icosphere(1)));
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains("must end in .png"));
  }
  CHECK(folder.names().empty());
}

TEST_CASE("render: the legend of a distortion can be left out") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(tube(6, 8))).code == 0);
  const auto picture = [&](const std::string& option) {
    std::vector<std::string> arguments = {"render", map,      "-o",  "-",        "--view",
                                          "sphere", "--size", "200", "--colour", "angle"};
    if (!option.empty()) arguments.push_back(option);
    return sphparam_program(arguments).out;
  };
  CHECK(picture("") != picture("--no-legend"));
}

TEST_CASE("render: without a background there is alpha, and no scale") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(tube(6, 8))).code == 0);
  const std::string png = sphparam_program({"render", map, "-o", "-", "--view", "mesh", "--size",
                                            "64", "--colour", "area", "--transparent"})
                              .out;
  const Image image = decode_image({png.begin(), png.end()}, "picture");
  REQUIRE(image.channels == 4);
  CHECK(image.height == 64);
  CHECK(image.pixel(0, 0)[3] == 0);
  CHECK(image.pixel(32, 32)[3] == 1);
}

TEST_CASE("render: numbers a vertex are shown as colours, of their own files or of the mesh") {
  const Folder folder;
  const std::string ball = folder / "lh.obj", up = folder / "lh.up.mgh";
  const TriangleMesh mesh = icosphere(2);
  write_bytes(ball, obj_text(mesh));
  VertexData data;
  data.columns.resize(2);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    data.columns[0].values.push_back(mesh.positions(v, 2));
    data.columns[1].values.push_back(v == 0 ? std::nan("") : mesh.positions(v, 1));
  }
  write_vertex_data(up, data);
  const auto picture = [&](std::vector<std::string> words) {
    std::vector<std::string> all = {"render", ball, "-o", "-", "--size", "200"};
    all.insert(all.end(), words.begin(), words.end());
    const Ended ended = sphparam_program(all);
    INFO(ended.err);
    CHECK(ended.code == 0);
    CHECK_THAT(ended.out, StartsWith(png_signature));
    return ended.out;
  };
  const std::string first = picture({"--data", up});
  CHECK(first != picture({}));
  CHECK(first == picture({"--data", up, "--scalar", "up_1"}));
  CHECK(first != picture({"--data", up, "--scalar", "up_2"}));
  CHECK(first != picture({"--data", up, "--no-legend"}));
  const Ended wrong =
      sphparam_program({"render", ball, "-o", "-", "--data", up, "--scalar", "depth"});
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Contains("no 'depth'; there are up_1 and up_2"));
  const Ended both =
      sphparam_program({"render", ball, "-o", "-", "--data", up, "--colour", "normals"});
  CHECK(both.code == 2);
  CHECK_THAT(both.err, Contains("without --colour"));
}

TEST_CASE("render: what needs a map says so") {
  const std::string ball = obj_text(icosphere(1));
  for (const std::vector<std::string>& look :
       {std::vector<std::string>{"--view", "sphere"}, {"--colour", "area"}, {"--graticule"}}) {
    std::vector<std::string> arguments = {"render", "-", "-o", "-"};
    arguments.insert(arguments.end(), look.begin(), look.end());
    const Ended ended = sphparam_program(arguments, ball);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains("sphparam map"));
    CHECK(ended.out.empty());
  }
}

TEST_CASE("up: y where a mesh comes from glTF, also by way of a map or a new mesh, else z") {
  const Folder folder;
  TriangleMesh egg = icosphere(2);
  egg.positions.col(2) *= 1.5;
  write_bytes(folder / "egg.obj", obj_text(egg));
  const auto make = [&](std::vector<std::string> arguments) {
    const Ended ended = sphparam_program(arguments);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return ended.out;
  };
  make({"export", folder / "egg.obj", "-o", folder / "egg.glb", "--image-size", "16"});
  make({"map", folder / "egg.glb", "-o", folder / "map.sph.ply"});
  make({"remesh", folder / "egg.glb", "--grid", "ico:3", "-o", folder / "low.sph.ply"});
  make({"export", folder / "egg.glb", "-o", folder / "chart.ply", "--image-size", "16"});
  for (const char* name : {"egg.obj", "egg.glb", "map.sph.ply", "low.sph.ply", "chart.ply"}) {
    INFO(name);
    const auto drawn = [&](const std::string& up) {
      return make({"render", folder / name, "-o", "-", "--size", "40", "--view", "mesh", "--colour",
                   "plain", "--up", up});
    };
    const bool stands_on_y = std::string(name) != "egg.obj";
    CHECK(drawn("auto") == drawn(stands_on_y ? "y" : "z"));
    CHECK(drawn("y") != drawn("z"));
  }
  const auto exported = [&](const std::string& up) {
    return make({"export", folder / "map.sph.ply", "-o", "-", "--image-size", "16", "--up", up});
  };
  CHECK(exported("auto") == exported("y"));
  const auto compared = [&](const std::string& up) {
    make({"compare", folder / "map.sph.ply", "-o", folder / up, "--methods", "progressive",
          "--size", "40", "--up", up});
    return bytes_of(folder / (up + "/mesh.png"));
  };
  CHECK(compared("auto") == compared("y"));
  CHECK(compared("y") != compared("z"));
}

TEST_CASE("up and front: by name or by numbers, what is none, and a front that is up, is refused") {
  const Folder folder;
  const std::string egg = folder / "egg.obj", map = folder / "map.sph.ply";
  write_bytes(egg, obj_text(icosphere(2)));
  REQUIRE(sphparam_program({"map", egg, "-o", map}).code == 0);
  const auto drawn = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", map, "-o", "-", "--size", "32"};
    words.insert(words.end(), more.begin(), more.end());
    return sphparam_program(words);
  };
  CHECK(drawn({"--up", "-x", "--front", "-z"}).out ==
        drawn({"--front", "0,0,-3", "--up", "-2,0,0"}).out);
  CHECK(drawn({"--up", "-x"}).out != drawn({"--up", "x"}).out);
  CHECK(drawn({"--up", "x", "--front", "z"}).out != drawn({"--up", "x", "--front", "-z"}).out);
  for (const char* option : {"--up", "--front"}) {
    const Ended ended = drawn({option, "w"});
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err,
               Contains(std::string(option) + ": expected x, -x, y, -y, z, -z, auto or"));
  }
  for (const auto& clash : {std::vector<std::string>{"--up", "y", "--front", "-y"},
                            std::vector<std::string>{"--front", "-y", "--up", "y"},
                            std::vector<std::string>{"--front", "z"}}) {
    const Ended ended = drawn(clash);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err,
               Contains("--front: the front, " + std::string(clash[1] == "y"     ? "-y"
                                                             : clash.size() == 2 ? "z"
                                                                                 : "-y")));
    CHECK_THAT(ended.err, Contains("lies along what points up"));
  }
  const Ended page = sphparam_program(
      {"report", map, "-o", "-", "--no-viewer", "--size", "64", "--up", "-x", "--front", "z"});
  CHECK_THAT(page.out, Contains("--up -x --front z"));
}

TEST_CASE("render: north is up on the sphere, whatever axis of the mesh is") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(tube(6, 8))).code == 0);
  const auto sphere = [&](const std::string& up) {
    return sphparam_program({"render", map, "-o", "-", "--size", "40", "--view", "sphere",
                             "--colour", "checker", "--up", up})
        .out;
  };
  CHECK_FALSE(sphere("z").empty());
  CHECK(sphere("y") == sphere("z"));
}

TEST_CASE(
    "render, report: the texture in a glTF file is shown, a map of it says that it has none") {
  const Folder folder;
  TriangleMesh egg = icosphere(2);
  egg.positions.col(2) *= 1.5;
  write_bytes(folder / "egg.obj", obj_text(egg));
  const auto run = [&](std::vector<std::string> arguments) {
    const Ended ended = sphparam_program(arguments);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return ended;
  };
  // One colour everywhere: how the image goes on beyond its borders makes no difference.
  const std::string image = folder / "skin_flat_normals.png";
  run({"export", folder / "egg.obj", "-o", folder / "skin.gltf", "--tangents"});
  for (const char* name : {"egg.glb", "egg.gltf"}) {
    run({"export", folder / "egg.obj", "-o", folder / name, "--image", image});
  }
  const std::string glb = folder / "egg.glb", map = folder / "map.sph.ply";
  const std::string page = folder / "page.html";
  run({"map", glb, "-o", map});
  const auto drawn = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"-o", "-", "--size", "40"});
    return run(arguments);
  };
  const Ended own = drawn({glb});
  CHECK(own.out == drawn({folder / "egg.gltf"}).out);
  CHECK(own.out == drawn({glb, "--texture", image}).out);
  CHECK(own.out != drawn({glb, "--colour", "normals"}).out);
  CHECK_THAT(own.err, !Contains("warning"));

  const Ended bare = drawn({map});
  CHECK_THAT(bare.err, Contains("shown without its texture") &&
                           Contains("--texture IMAGE names it, or the file that was mapped, with "
                                    "--sphere "));
  CHECK(bare.out == drawn({map, "--colour", "normals"}).out);
  const Ended both = drawn({glb, "--sphere", map});
  CHECK_THAT(both.err, !Contains("warning"));
  CHECK(both.out == drawn({map, "--texture", image}).out);

  const std::vector<std::string> on_page = {"-o", page, "--no-viewer", "--size", "64"};
  const auto reported = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "report");
    arguments.insert(arguments.end(), on_page.begin(), on_page.end());
    const Ended ended = run(arguments);
    const std::string html = bytes_of(page);
    return std::pair{ended.err, html.substr(0, html.find("<h2>"))};
  };
  CHECK_THAT(reported({map}).first, Contains("shown without its texture"));
  const auto textured = reported({glb, "--sphere", map});
  CHECK_THAT(textured.first, !Contains("warning"));
  const auto from_first_picture = [&](const std::string& html) {
    return html.substr(html.find("<img"), html.find("<figcaption>") - html.find("<img"));
  };
  CHECK(from_first_picture(textured.second) != from_first_picture(reported({map}).second));
}

TEST_CASE("render: a sphere in a file of its own is that of the mesh, or refused") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(1)));
  write_bytes(folder / "other.obj", obj_text(icosphere(2)));
  const auto drawn = [&](const std::string& sphere) {
    return sphparam_program(
        {"render", folder / "ball.obj", "--sphere", sphere, "-o", "-", "--size", "32"});
  };
  CHECK(drawn(folder / "ball.obj").out.substr(16, 4) == std::string("\0\0\0\x40", 4));
  const Ended other = drawn(folder / "other.obj");
  CHECK(other.code == 3);
  CHECK_THAT(other.err, Contains("not a sphere of ball.obj") && !Contains("give it alone"));
  CHECK(sphparam_program({"map", folder / "other.obj", "-o", folder / "other.sph.ply"}).code == 0);
  CHECK_THAT(drawn(folder / "other.sph.ply").err,
             Contains("the map holds the surface that it is of: give it alone"));
  TriangleMesh bad = icosphere(1);
  bad.positions.row(5).setZero();
  write_bytes(folder / "bad.obj", obj_text(bad));
  const Ended centre = drawn(folder / "bad.obj");
  CHECK(centre.code == 3);
  CHECK_THAT(centre.err, Contains("is at the centre"));
}

TEST_CASE("render: heat does not depend on the radius of a sphere in a file of its own") {
  const Folder folder;
  TriangleMesh sphere = icosphere(1);
  write_bytes(folder / "unit.obj", obj_text(sphere));
  sphere.positions *= 128;
  write_bytes(folder / "large.obj", obj_text(sphere));
  const auto drawn = [&](const char* name) {
    return sphparam_program({"render", folder / "unit.obj", "--sphere", folder / name, "-o", "-",
                             "--view", "mesh", "--colour", "area", "--size", "32"});
  };
  CHECK(drawn("unit.obj").code == 0);
  CHECK(drawn("large.obj").out == drawn("unit.obj").out);
}

}  // namespace sphparam::tests
