#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/sphere_file.h"
#include "support/glb_json.h"
#include "support/test_meshes.h"

/// `sphparam remesh --displace`, `--rebuild` and `--lods`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// A ball with waves that a few control points cannot follow.
std::string wavy_ball() {
  TriangleMesh mesh = icosphere(5);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 q = mesh.positions.row(v);
    mesh.positions.row(v) *= 1 + 0.02 * std::sin(20 * q.x() + 15 * q.z());
  }
  return obj_text(mesh);
}

std::vector<std::string> displacing(const Folder& folder) {
  return {"remesh",         folder / "m.obj", "--grid",
          "ico:3",          "--subdiv-fit",   "loop",
          "--displace",     folder / "d.exr", "--displace-size",
          "1024x512",       "--rebuild",      folder / "r.ply",
          "--uv",           "mesh",           "-o",
          folder / "b.ply", "--json",         folder / "j.json"};
}

}  // namespace

TEST_CASE("remesh --displace: surface and image rebuild the mesh, and the report says how well") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  const Ended ended = sphparam_program(displacing(folder));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json displacement = Json::parse(bytes_of(folder / "j.json"))["displacement"];
  CHECK(displacement["width"] == 1024);
  CHECK(displacement["min"] < 0);
  CHECK(displacement["max"] > 0);
  const Json& texels = displacement["texels"];
  CHECK(texels["walked"].get<long>() + texels["cast"].get<long>() + texels["missed"].get<long>() ==
        1024 * 512);
  const Json& rebuilt = displacement["rebuilt"];
  CHECK(rebuilt["error"]["rms"].get<double>() < rebuilt["base_error"]["rms"].get<double>() / 10);
  CHECK(rebuilt["certified"] == true);
  const Ended verified = sphparam_program({"verify", folder / "r.ply"});
  CHECK(verified.code == 0);
  CHECK(rebuilt["warnings"].empty());
  CHECK_THAT(ended.err, Contains("rebuilt: RMS") && Contains("of the diagonal, both ways") &&
                            Contains("of the diagonal, one way") && !Contains("makes it worse"));
  const Json outputs = Json::parse(bytes_of(folder / "j.json"))["outputs"];
  CHECK(outputs["displacement"] == folder / "d.exr");
  CHECK(outputs["rebuilt"] == folder / "r.ply");
}

TEST_CASE(
    "remesh --displace: a control mesh of quads has the texture coordinates that the image is in") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  const Ended ended =
      sphparam_program({"remesh", folder / "m.obj", "--grid", "cube:8", "--subdiv-fit", "catmark",
                        "--displace", folder / "d.png", "--displace-size", "512x256", "--rebuild",
                        folder / "r.ply", "-o", folder / "b.obj", "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  const Json& texture = report["texture"];
  CHECK(texture["tiles"] == Json({3, 2}));
  CHECK(texture["levels"] == 4);
  const Json& displacement = report["displacement"];
  CHECK(displacement["layout"] == "grid");
  CHECK(displacement["width"] == 3 * (8 * 16 + 9));
  CHECK(displacement["width"] == texture["width"]);
  CHECK(displacement["height"] == texture["height"]);
  CHECK(displacement["rebuilt"]["error"]["rms"].get<double>() <
        displacement["rebuilt"]["base_error"]["rms"].get<double>() / 10);
  CHECK_THAT(ended.err, Contains("texture coordinates in the layout of cube:8: 3 × 2 tiles, 411 × "
                                 "274 texels, one a vertex of 4 levels of subdivision"));
  const std::string control = bytes_of(folder / "b.obj");
  CHECK_THAT(control,
             Contains("# texture coordinates: the layout of cube:8, 3x2 tiles in 411x274"));
  const std::string recipe =
      "# displacement: d.png: subdivide by Catmull-Clark, 4 levels, to the "
      "limit surface; along normals by (value - ";
  REQUIRE_THAT(control, Contains(recipe));
  const double midlevel = std::stod(control.substr(control.find(recipe) + recipe.size()));
  CHECK(midlevel == displacement["midlevel"].get<double>());
  const sphparam::MeshFile mesh = sphparam::read_mesh(folder / "b.obj");
  CHECK(mesh.polygons == 6 * 64);
  REQUIRE(mesh.corner_texcoords);
  CHECK(mesh.corner_texcoords->minCoeff() > 0);
  CHECK(mesh.corner_texcoords->maxCoeff() < 1);
}

TEST_CASE("remesh --uv: the grid's layout or what the mesh has, and never both") {
  const Folder folder;
  write_bytes(folder / "m.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0.25 0.25\nvt 0.75 0.25\nvt 0.25 0.75\n"
              "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n");
  const auto range = [&](std::vector<std::string> more, const char* told) {
    std::vector<std::string> arguments = {"remesh", folder / "m.obj", "--grid", "octa:9",
                                          "-o",     folder / "x.ply"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(arguments);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK_THAT(ended.err, Contains(told));
    const sphparam::MeshFile mesh = sphparam::read_mesh(folder / "x.ply");
    REQUIRE(mesh.corner_texcoords);
    return mesh.corner_texcoords->maxCoeff();
  };
  const char* const left_out = "texture coordinates of the mesh are left out; --uv mesh";
  CHECK(range({}, "certified") <= 0.75);
  CHECK(range({"--uv", "grid"}, left_out) > 0.9);
  CHECK(range({"--subdiv-fit", "loop"}, left_out) > 0.9);
  CHECK(range({"--subdiv-fit", "loop", "--uv", "mesh"}, "certified") <= 0.75);
  CHECK(range({"--subdiv-fit", "loop", "--transfer", "uv"}, "certified") <= 0.75);
  const auto refused = [&](std::vector<std::string> more, const char* why) {
    std::vector<std::string> arguments = {"remesh", folder / "m.obj", "--uv", "grid"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(arguments);
    INFO(ended.err);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains(why));
  };
  refused({"--grid", "healpix:4", "-o", folder / "y.ply"}, "no layout of its own");
  refused({"--grid", "like:" + (folder / "m.obj"), "-o", folder / "y.ply"}, "no layout of its own");
  refused({"--grid", "octa:9", "-o", folder / "y.glb"}, "keep quads");
  refused({"--grid", "octa:9", "-o", folder / "y.ply", "--transfer", "uv"}, "makes others");
}

TEST_CASE(
    "remesh --lods: with a fit each level has the coordinates of its own grid, all in one layout") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  const Ended ended = sphparam_program({"remesh", folder / "m.obj", "--grid", "cube:8", "--lods",
                                        "1", "--subdiv-fit", "catmark", "-o", folder / "x.ply"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const auto last = [&](const char* name) {
    return sphparam::read_mesh(folder / name).corner_texcoords.value().maxCoeff();
  };
  CHECK(last("x.ply") == last("x_lod1.ply"));
}

TEST_CASE("remesh --displace: an image so coarse that it does harm is told") {
  const Folder folder;
  TriangleMesh spike = icosphere(4);
  spike.positions.row(100) *= 3;
  write_bytes(folder / "m.obj", obj_text(spike));
  const Ended ended = sphparam_program(
      {"remesh", folder / "m.obj", "--grid", "cube:8", "--subdiv-fit", "catmark", "--displace",
       folder / "d.exr", "--displace-size", "8x4", "--rebuild", folder / "r.obj", "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json rebuilt = Json::parse(ended.out)["displacement"]["rebuilt"];
  CHECK(rebuilt["error"]["rms"] > rebuilt["base_error"]["rms"]);
  CHECK(rebuilt["warnings"].size() == 1);
  CHECK_THAT(ended.err, Contains("warning: --displace makes it worse"));
  CHECK_THAT(bytes_of(folder / "r.obj"), Contains("# sphparam method rebuild"));
  CHECK(rebuilt["certified"] == true);
  const sphparam::MeshFile written = sphparam::read_mesh(folder / "r.obj");
  CHECK(written.polygons > 0);
  CHECK(2 * written.polygons == rebuilt["triangles"].get<long>());
}

TEST_CASE("remesh --displace: the same bytes for any number of threads") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  std::vector<std::string> first = displacing(folder), second = first;
  first.insert(first.end(), {"--threads", "1"});
  second.insert(second.end(), {"--threads", "3"});
  REQUIRE(sphparam_program(first).code == 0);
  const std::string image = bytes_of(folder / "d.exr"), mesh = bytes_of(folder / "r.ply");
  REQUIRE(sphparam_program(second).code == 0);
  CHECK(bytes_of(folder / "d.exr") == image);
  CHECK(bytes_of(folder / "r.ply") == mesh);
}

TEST_CASE("remesh --displace: in 16 bits and half precision too") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  for (const auto& [file, depth] : {std::pair("d.png", "u16"), {"h.exr", "half"}}) {
    const Ended ended =
        sphparam_program({"remesh", folder / "m.obj", "--grid", "cube:8", "--subdiv-fit", "catmark",
                          "--displace", folder / file, "--depth", depth, "--displace-size",
                          "256x128", "--rebuild", folder / "r.obj", "--json", "-"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const Json rebuilt = Json::parse(ended.out)["displacement"]["rebuilt"];
    CHECK(rebuilt["error"]["rms"].get<double>() < rebuilt["base_error"]["rms"].get<double>() / 5);
  }
}

TEST_CASE("remesh --displace: what makes no sense is refused before any work") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  const auto refused = [&](std::vector<std::string> more, const char* why) {
    std::vector<std::string> arguments = {"remesh", folder / "m.obj", "--grid", "ico:2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(arguments);
    INFO(ended.err);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains(why));
  };
  const std::string image = folder / "d.exr";
  refused({"--displace", image}, "give --subdiv-fit");
  refused({"--rebuild", folder / "r.ply", "-o", folder / "b.ply"}, "--displace, which is missing");
  refused({"--displace-size", "512x256", "-o", folder / "b.ply"},
          "--displace-size is of the image of --displace, which is missing");
  refused({"--subdiv-fit", "loop", "--displace", folder / "d.jpg"}, ".exr or .png");
  refused({"--subdiv-fit", "loop", "--displace", "-"}, ".exr or .png");
  refused({"--subdiv-fit", "loop", "--displace", image, "--depth", "u16"}, "u16 into .png");
  for (const char* size : {"512", "511x256", "0x0", "512x", "x", "-4x4", "99999998x99999999"})
    refused({"--subdiv-fit", "loop", "--displace", image, "--displace-size", size},
            "--displace-size");
  refused({"--subdiv-fit", "loop", "--displace", image, "--rebuild", folder / "r.glb"},
          ".ply or .obj");
  refused({"--subdiv-fit", "loop", "--displace", image, "--rebuild", folder / "m.obj"},
          "--rebuild");
  CHECK(folder.names() == std::vector<std::string>{"m.obj"});
}

TEST_CASE("remesh --displace: all outputs get their names or none does") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  std::vector<std::string> arguments = displacing(folder);
  arguments.back() = folder / "no such folder/j.json";
  CHECK(sphparam_program(arguments).code == 3);
  CHECK(folder.names() == std::vector<std::string>{"m.obj"});
}

TEST_CASE("remesh --displace: an interruption leaves nothing") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  std::vector<std::string> arguments = displacing(folder);
  *std::find(arguments.begin(), arguments.end(), "1024x512") = "16384x8192";
  arguments.insert(arguments.end(), {"--progress", "json"});
  Running running(arguments, "");
  while (running.err_so_far().find("displacement") == std::string::npos) {
  }
  running.signal(SIGINT);
  CHECK(running.wait().code == 130);
  CHECK(folder.names() == std::vector<std::string>{"m.obj"});
}

TEST_CASE("remesh --lods: nested meshes, each certified, with errors that grow") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  const Ended ended = sphparam_program({"remesh", folder / "m.obj", "--grid", "ico:4", "--lods",
                                        "2", "-o", folder / "x.ply", "--json", folder / "j.json"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json levels = Json::parse(bytes_of(folder / "j.json"))["lods"];
  REQUIRE(levels.size() == 3);
  sphparam::MeshFile finer = sphparam::read_mesh(folder / "x.ply");
  for (size_t level = 1; level < 3; ++level) {
    const std::string path = folder / ("x_lod" + std::to_string(level) + ".ply");
    CHECK(levels[level]["file"] == path);
    CHECK(levels[level]["rms"].get<double>() > levels[level - 1]["rms"].get<double>());
    CHECK(sphparam_program({"verify", path}).code == 0);
    const sphparam::MeshFile coarse = sphparam::read_mesh(path);
    const Eigen::Index count = coarse.mesh.vertex_count();
    CHECK(coarse.mesh.face_count() * 4 == finer.mesh.face_count());
    CHECK(coarse.mesh.positions == finer.mesh.positions.topRows(count));
    CHECK(sphparam::read_sphere(coarse)->points ==
          sphparam::read_sphere(finer)->points.topRows(count));
    finer = coarse;
  }
}

TEST_CASE("remesh --lods: levels of one .glb, the finest shown by who knows no levels") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  const Ended ended = sphparam_program(
      {"remesh", folder / "m.obj", "--grid", "cube:8", "--lods", "3", "-o", folder / "x.glb"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json gltf = json_of(bytes_of(folder / "x.glb"));
  CHECK(gltf["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == Json{1, 2, 3});
  CHECK(gltf["scenes"][0]["nodes"] == Json{0});
  CHECK(folder.names() == std::vector<std::string>{"m.obj", "x.glb"});
}

TEST_CASE("remesh --lods: coarser levels of a .sph.ply are called .sph.ply too") {
  const Folder folder;
  write_bytes(folder / "m.obj", obj_text(icosphere(2)));
  for (const char* name : {"a.sph.ply", "b.c.ply"}) {
    CHECK(sphparam_program(
              {"remesh", folder / "m.obj", "--grid", "ico:2", "--lods", "1", "-o", folder / name})
              .code == 0);
  }
  CHECK(folder.names() == std::vector<std::string>{"a.sph.ply", "a_lod1.sph.ply", "b.c.ply",
                                                   "b.c_lod1.ply", "m.obj"});
}

TEST_CASE("remesh --lods: with a fit each level is a surface of its own, {n} is the number") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  const Ended ended = sphparam_program({"remesh", folder / "m.obj", "--grid", "octa:17", "--lods",
                                        "2", "--subdiv-fit", "loop", "-o", folder / "x{n}.obj"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(folder.names() == std::vector<std::string>{"m.obj", "x0.obj", "x1.obj", "x2.obj"});
}

TEST_CASE("remesh --lods: grids without levels and files without names are refused") {
  const Folder folder;
  write_bytes(folder / "m.obj", wavy_ball());
  const auto refused = [&](const char* grid, const char* lods, const std::string& output,
                           const char* why) {
    const Ended ended = sphparam_program({"remesh", folder / "m.obj", "--grid", grid, "--lods",
                                          lods, output.empty() ? "--csv" : "-o",
                                          output.empty() ? folder / "x.csv" : output});
    INFO(ended.err);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains(why));
  };
  refused("uv:16x8", "1", folder / "x.ply", "no coarser grids");
  refused("octa:7", "1", folder / "x.ply", "no coarser grids");
  refused("cube:6", "1", folder / "x.ply", "N a power of two");
  refused("ico:2", "3", folder / "x.ply", "only 2 coarser");
  refused("ico:2", "13", folder / "x.ply", "0 to 12");
  refused("ico:2", "1", "-", "give -o a name");
  refused("ico:2", "1", "", "give -o");
  write_bytes(folder / "m_lod1.ply", "mine");
  const Ended ended = sphparam_program(
      {"remesh", folder / "m_lod1.ply", "--grid", "ico:2", "--lods", "1", "-o", folder / "m.ply"});
  CHECK(ended.code == 2);
  CHECK(bytes_of(folder / "m_lod1.ply") == "mine");
}

TEST_CASE("remesh: no level is written over the mesh, and nothing over the grid it is like") {
  const Folder folder;
  const std::string mesh = folder / "m0.obj", grid = folder / "grid.obj";
  for (const std::string& path : {mesh, grid}) write_bytes(path, obj_text(icosphere(2)));
  const std::string before = bytes_of(mesh);
  const Ended levels = sphparam_program(
      {"remesh", mesh, "--grid", "ico:1", "--lods", "1", "-o", folder / "m{n}.obj"});
  CHECK(levels.code == 2);
  CHECK_THAT(levels.err, Contains("is the input"));
  CHECK(sphparam_program({"remesh", mesh, "--grid", "like:" + grid, "-o", grid}).code == 2);
  CHECK(bytes_of(mesh) == before);
  CHECK(bytes_of(grid) == before);
}

}  // namespace sphparam::tests
