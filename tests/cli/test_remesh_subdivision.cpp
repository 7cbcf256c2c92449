#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "mapped.h"
#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "support/test_meshes.h"

/// `sphparam remesh --subdiv-fit`.
namespace sphparam::tests {

namespace {

using Json = nlohmann::json;
using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("remesh --subdiv-fit: control mesh and limit mesh are written certified, and reported") {
  const Mapped mapped(300);
  const std::string out = mapped.folder / "base.ply", limit = mapped.folder / "limit.ply",
                    json = mapped.folder / "fit.json";
  for (const Names& asked :
       {Names{"ico:2", "loop"}, Names{"octa:9", "loop"}, Names{"like:" + mapped.path, "loop"},
        Names{"cube:6", "catmark"}, Names{"uv:12x8", "catmark"}, Names{"healpix:4", "catmark"}}) {
    INFO(asked[0]);
    const Ended ended = mapped.remesh({"--grid", asked[0], "--subdiv-fit", asked[1], "-o", out,
                                       "--limit-mesh", limit, "--json", json});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    for (const std::string& file : {out, limit}) {
      CHECK(sphparam_program({"verify", file}).code == 0);
      const sphparam::MeshFile read = sphparam::read_mesh(std::filesystem::path(file));
      for (const char* name : {"nx", "ny", "nz", "mean_curvature", "gauss_curvature"}) {
        CHECK(read.find_vertex_property(name));
      }
    }
    CHECK(sphparam::read_mesh(std::filesystem::path(out)).mesh.positions !=
          sphparam::read_mesh(std::filesystem::path(limit)).mesh.positions);
    const Json fit = Json::parse(bytes_of(json))["subdivision"];
    CHECK(fit["scheme"] == asked[1]);
    CHECK(fit["rms"] <= fit["max"]);
    CHECK(fit["solver_steps"].size() == 4);
  }
}

TEST_CASE(
    "What has no sensible size is mapped, but neither fitted nor expanded, nor is what has no "
    "area") {
  const Folder folder;
  TriangleMesh flat = icosphere(2), huge = icosphere(2);
  flat.positions.rightCols(2).setZero();
  huge.positions *= 1e300;
  const TriangleMesh meshes[] = {flat, huge};
  for (const TriangleMesh& mesh : meshes) {
    const bool scaling_helps = &mesh != meshes;
    CHECK(sphparam_program({"map", "-", "-o", folder / "map.ply"}, obj_text(mesh)).code ==
          (scaling_helps ? 0 : 4));
    for (const Names& asked : {Names{"remesh", "-", "--grid", "ico:2", "--subdiv-fit", "loop"},
                               Names{"remesh", "-", "--grid", "ico:2", "--lods", "1"},
                               Names{"spharm", "-", "--degree", "4"}}) {
      Names arguments = asked;
      const bool expands = asked[0] == "spharm";
      arguments.insert(arguments.end(), {expands ? "--csv" : "-o", folder / "out.obj"});
      const Ended ended = sphparam_program(arguments, obj_text(mesh));
      INFO(asked[0] << ended.err);
      CHECK(ended.code == 4);
      CHECK_THAT(ended.err, Catch::Contains(scaling_helps ? "can be mapped but not fitted"
                                                          : "the surface has no area") &&
                                !Catch::Contains("closed genus-0"));
      CHECK((ended.err.find("scale it") != std::string::npos) == scaling_helps);
      CHECK(folder.names() == (scaling_helps ? Names{"map.ply"} : Names{}));
    }
  }
}

TEST_CASE("remesh --subdiv-fit: a grid too coarse for a smooth surface is told") {
  const Folder folder;
  const std::string json = folder / "fit.json";
  const auto fit = [&](const TriangleMesh& mesh) {
    const Ended ended = sphparam_program({"remesh", "-", "--grid", "ico:1", "--subdiv-fit", "loop",
                                          "-o", folder / "base.ply", "--json", json},
                                         obj_text(mesh));
    REQUIRE(ended.code == 0);
    const Json report = Json::parse(bytes_of(json))["subdivision"];
    const bool worse = report["two_sided_rms"] >= report["flat_rms"];
    CHECK((ended.err.find("too coarse for a smooth surface") != std::string::npos) == worse);
    return worse;
  };
  CHECK_FALSE(fit(icosphere(3)));
  TriangleMesh spike = icosphere(3);
  spike.positions.row(100) *= 1000;
  CHECK(fit(spike));
}

TEST_CASE("remesh --subdiv-fit: .obj and .glb too, the same bytes for one thread and three") {
  const Mapped mapped(300);
  for (const std::string& kind : Names{".ply", ".obj", ".glb"}) {
    INFO(kind);
    for (const std::string& threads : Names{"1", "3"}) {
      const std::string out = mapped.folder / (threads + kind);
      CHECK(mapped
                .remesh({"--grid", "cube:8", "--subdiv-fit", "catmark", "-o", out, "--threads",
                         threads})
                .code == 0);
    }
    CHECK(bytes_of(mapped.folder / ("1" + kind)) == bytes_of(mapped.folder / ("3" + kind)));
  }
  const std::filesystem::path obj = mapped.folder / "1.obj", ply = mapped.folder / "1.ply";
  CHECK(sphparam::read_mesh(obj).polygons == 384);
  CHECK(sphparam::read_mesh(obj).mesh.triangles == sphparam::read_mesh(ply).mesh.triangles);
  std::vector<std::string> words = sphparam::read_mesh(ply).comments;
  CHECK(words.back() == "sphparam verdict one-to-one");
  words.pop_back();  // on rays, which an .obj has not
  CHECK(sphparam::read_mesh(obj).comments == words);
}

TEST_CASE("remesh --subdiv-fit: as USD a control mesh keeps its quads and the layout of its grid") {
  const Mapped mapped(300);
  const std::string usd = mapped.folder / "a.usda", obj = mapped.folder / "a.obj";
  for (const std::string& out : {usd, obj})
    REQUIRE(mapped
                .remesh({"--grid", "cube:4", "--subdiv-fit", "catmark", "--displace",
                         mapped.folder / "d.exr", "--displace-size", "64x32", "-o", out})
                .code == 0);
  const std::string layer = bytes_of(usd), text = bytes_of(obj);
  CHECK_THAT(layer, Catch::Contains("subdivisionScheme = \"catmullClark\"") &&
                        Catch::Contains("faceVertexCounts = [4, 4, ") &&
                        Catch::Contains("displacement: d.exr: subdivide by Catmull-Clark"));
  // The first face of the .obj: vertices and texture coordinates from 1.
  const std::size_t face = text.find("\nf ") + 3;
  const int vertex = std::stoi(text.substr(face)),
            texture = std::stoi(text.substr(text.find('/', face) + 1));
  CHECK_THAT(layer, Catch::Contains("faceVertexIndices = [" + std::to_string(vertex - 1) + ", "));
  std::size_t at = 0;
  for (int i = 0; i < texture; ++i) at = text.find("\nvt ", at) + 4;
  const float u = std::stof(text.substr(at));
  const std::size_t st = layer.find("primvars:st = [(") + 16;
  CHECK(std::stof(layer.substr(st)) == u);
}

TEST_CASE("remesh --subdiv-fit: an .obj of the limit surface has quads too, the RMS is one way") {
  const Mapped mapped(300);
  const Ended ended =
      mapped.remesh({"--grid", "cube:4", "--subdiv-fit", "catmark", "-o", mapped.folder / "a.obj",
                     "--limit-mesh", mapped.folder / "b.obj"});
  REQUIRE(ended.code == 0);
  CHECK(sphparam::read_mesh(mapped.folder / "b.obj").polygons == 96);
  CHECK_THAT(ended.err, Catch::Contains("of the diagonal, one way, from"));
}

TEST_CASE("remesh --subdiv-fit: what makes no sense is refused, and nothing is written") {
  const Mapped mapped(300);
  const std::string out = mapped.folder / "base.ply";
  const auto refused = [&](const Names& more, const std::string& words) {
    Names arguments = {"-o", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = mapped.remesh(arguments);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Catch::Contains(words));
    CHECK(sphparam_program({"verify", out}).code == 3);
  };
  refused({"--grid", "cube:8", "--subdiv-fit", "loop"}, "use catmark");
  refused({"--grid", "ico:2", "--subdiv-fit", "catmark"}, "use loop");
  refused({"--grid", "like:" + mapped.path, "--subdiv-fit", "catmark"}, "use loop");
  refused({"--grid", "uv:513x4", "--subdiv-fit", "catmark"}, "128");
  refused({"--grid", "ico:2", "--subdiv-fit", "lop"}, "did you mean loop?");
  refused({"--grid", "ico:2", "--limit-mesh", mapped.folder / "l.ply"}, "--subdiv-fit");
  refused({"--grid", "ico:2", "--subdiv-fit", "loop", "--limit-mesh", mapped.path}, "--limit-mesh");
  refused({"--grid", "ico:2", "--subdiv-fit", "loop", "--limit-mesh", mapped.folder / "l.glb"},
          ".obj");
}

}  // namespace sphparam::tests
