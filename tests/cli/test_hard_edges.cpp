#include <catch2/catch.hpp>
#include <cmath>

#include "image/image_codec.h"
#include "program.h"
#include "sphparam/io/creases.h"
#include "sphparam/io/mesh_writer.h"
#include "support/creased.h"
#include "support/test_meshes.h"

// Hard edges as one sees them: pictures of a mesh and of what the program makes of it, from several
// sides in the same light.

namespace sphparam::tests {

namespace {

const std::vector<std::string> sides = {"1,0.5,0.6", "-1,0.7,0.3", "0.2,-0.6,1", "-0.3,-0.9,-1"};

MeshFile can_without_normals() {
  MeshFile file;
  file.mesh = tube(5, 14);
  file.mesh.positions.col(0) *= 1.4;
  return file;
}

/// A can with a smooth side and hard rims, no two axes alike.
MeshFile can(bool creased) {
  MeshFile file = can_without_normals();
  if (creased) file.corner_normals = creased_normals(file.mesh, 40);
  return file;
}

Image picture(const std::string& path, const std::string& from,
              const std::vector<std::string>& more = {}) {
  std::vector<std::string> command = {"render", path,       "-o",     "-",    "--view",
                                      "mesh",   "--colour", "plain",  "--up", "y",
                                      "--size", "120",      "--from", from,   "-q"};
  command.insert(command.end(), more.begin(), more.end());
  const Ended ended = sphparam_program(command);
  INFO(path << ": " << ended.err);
  REQUIRE(ended.code == 0);
  return decode_image({ended.out.begin(), ended.out.end()}, "picture");
}

double decibels(const Image& a, const Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::pow(static_cast<double>(a.pixels[i] - b.pixels[i]), 2);
  return -10 * std::log10(std::max(sum / static_cast<double>(a.pixels.size()), 1e-9));
}

/// The least of all sides.
double likeness(const std::string& a, const std::string& b) {
  double least = 1000;
  for (const std::string& from : sides)
    least = std::min(least, decibels(picture(a, from), picture(b, from)));
  return least;
}

struct Can {
  Folder folder;
  std::string path = folder / "can.obj", smooth = folder / "smooth.obj";

  Can() {
    write_mesh(path, can(true));
    write_mesh(smooth, can(false));
  }

  /// The path of what is made of a file.
  std::string make(std::vector<std::string> command, const std::string& name) const {
    const std::string output = folder / name;
    command.insert(command.end(), {"-o", output, "-q"});
    const Ended ended = sphparam_program(command);
    INFO(command.front() << " " << name << ": " << ended.err);
    REQUIRE(ended.code == 0);
    return output;
  }
};

}  // namespace

TEST_CASE("hard edges: map, repair and every export look as the mesh does") {
  const Can can;
  REQUIRE(likeness(can.path, can.smooth) < 30);  // or else nothing would be seen here
  const std::string map = can.make({"map", can.path}, "map.sph.ply");
  const auto exported = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), {"export", map, "--up", "y", "--image-size", "64"});
    return can.make(more, name);
  };
  const std::string glb = exported("x.glb", {});
  for (const std::string& made :
       {map, glb, exported("x.obj", {}), exported("x.ply", {}), exported("q.glb", {"--quantize"}),
        exported("r.glb", {"--refine-poles", "8"}), exported("t.glb", {"--tangents"}),
        can.make({"export", glb, "--image-size", "64"}, "again.glb"),
        can.make({"map", glb}, "again.sph.ply"), can.make({"repair", can.path}, "mended.ply")}) {
    INFO(made);
    CHECK(likeness(can.path, made) > 45);
  }
  CHECK(likeness(can.path, exported("c.glb", {"--compress"})) > 38);  // normals to a degree
}

TEST_CASE("hard edges: --crease makes them where a mesh has no normals, also of a written map") {
  const Can can;  // turns by 35° at most about its side, by 90° at the rims
  const std::string map = can.make({"map", can.smooth}, "smooth.sph.ply");
  MeshFile creased = can_without_normals();
  REQUIRE(add_creases(creased, 40));
  const std::string wanted = can.folder / "wanted.obj";
  write_mesh(wanted, creased);
  REQUIRE(likeness(wanted, can.smooth) < 30);
  for (const std::string& mesh : {can.smooth, map}) {
    for (const char* name : {"c.glb", "c.obj", "c.ply"}) {
      const std::string made =
          can.make({"export", mesh, "--crease", "40", "--up", "y", "--image-size", "64"}, name);
      INFO(mesh << " " << name);
      CHECK(likeness(wanted, made) > 45);
    }
    CHECK(picture(mesh, sides[0], {"--crease", "40"}).pixels == picture(wanted, sides[0]).pixels);
  }
  const std::string folder =
      can.make({"asset", can.smooth, "--crease", "40", "--up", "y", "--size", "128", "--no-page"},
               "creased");
  CHECK(likeness(wanted, folder + "/smooth.glb") > 45);
}

TEST_CASE("hard edges: --crease leaves normals and what is smooth as they are") {
  const Can can;
  const auto baked = [&](const std::string& mesh, std::vector<std::string> more) {
    more.insert(more.begin(), {"bake", mesh, "--map", "normal-object", "--size", "64", "--depth",
                               "float", "-o", can.folder / "n.tif"});
    const Ended ended = sphparam_program(more);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return std::pair(bytes_of(can.folder / "n.tif"), ended.err);
  };
  const auto [own, nothing_told] = baked(can.path, {});
  const auto [kept, told] = baked(can.path, {"--crease", "5"});
  CHECK(kept == own);
  CHECK_THAT(told, Catch::Contains("  can.obj: has normals of its own, which say what is hard: "
                                   "--crease is for others\n"));
  CHECK_THAT(nothing_told, !Catch::Contains("--crease"));
  CHECK(baked(can.smooth, {"--crease", "100"}).first == baked(can.smooth, {}).first);
  CHECK(baked(can.smooth, {"--crease", "40"}).first != baked(can.smooth, {}).first);
  CHECK_THAT(baked(can.smooth, {"--crease", "40", "-v"}).second,
             Catch::Contains("smooth.obj: 28 edges are hard"));
}

TEST_CASE("hard edges: the whole asset, and a fine grid, look as the mesh does") {
  const Can can;
  const std::string folder =
      can.make({"asset", can.path, "--up", "y", "--size", "128", "--no-page"}, "whole");
  CHECK(likeness(can.path, folder + "/can.glb") > 45);
  // A grid has no vertices on the edge: what remains is a bevel a triangle wide.
  const std::string fine = can.make({"remesh", can.path, "--grid", "ico:6"}, "fine.sph.ply");
  const double seen = likeness(can.path, fine);
  CHECK(seen > likeness(can.path, can.smooth) + 3);
  CHECK(seen > 28);
}

}  // namespace sphparam::tests
