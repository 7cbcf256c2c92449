#include <catch2/catch.hpp>

#include "program.h"
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

}  // namespace sphparam::tests
