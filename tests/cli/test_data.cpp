#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "mapped.h"
#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/vertex_data.h"

/// --data of all that take it, and what lies beside surfaces.
namespace sphparam::tests {

namespace {

using Catch::Contains;

/// A left hemisphere with a measure and labels, in the folder of `mapped`.
struct Brain {
  Mapped mapped;
  std::string white = mapped.folder / "lh.white", sphere = mapped.folder / "lh.sphere";
  std::string thickness = mapped.folder / "lh.thickness",
              parcels = mapped.folder / "lh.parcels.annot";
  Eigen::Index vertices = 0;

  Brain() {
    REQUIRE(sphparam_program({"remesh", mapped.path, "--grid", "ico:2", "-o", white}).code == 0);
    REQUIRE(sphparam_program({"map", white, "--write-sphere", sphere}).code == 0);
    vertices = read_mesh(white).mesh.vertex_count();
    VertexData measure, labels;
    measure.columns.resize(1);
    labels.columns.resize(1);
    labels.kind = DataKind::Labels;
    labels.labels = {{0, {{0, 0, 0, 0}}, "???"}, {1, {{1, 0, 0, 1}}, "red"}};
    for (Eigen::Index v = 0; v < vertices; ++v) {
      measure.columns[0].values.push_back(static_cast<double>(v));
      labels.columns[0].values.push_back(static_cast<double>(v % 2));
    }
    write_vertex_data(thickness, measure);
    write_vertex_data(parcels, labels);
  }
};

/// The mesh behind two vertices that no face uses: 0 and 1.
TriangleMesh behind_two_unused(const TriangleMesh& mesh) {
  TriangleMesh result{Points::Constant(mesh.vertex_count() + 2, 3, 9), mesh.triangles};
  result.positions.bottomRows(mesh.vertex_count()) = mesh.positions;
  result.triangles.array() += 2;
  return result;
}

}  // namespace

TEST_CASE("data: a map carries it as properties, and a remesh of that writes it beside a surface") {
  const Brain brain;
  const std::string map = brain.mapped.folder / "lh.sph.ply",
                    out = brain.mapped.folder / "x.surf.gii";
  REQUIRE(sphparam_program(
              {"map", brain.white, "--data", brain.thickness + "," + brain.parcels, "-o", map})
              .code == 0);
  CHECK(read_mesh(map).find_vertex_property("thickness")->values.at(5) == 5);
  const Ended ended = sphparam_program({"remesh", map, "--grid", "like:" + map, "-o", out});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err + ended.out, Contains("thickness beside it: x.thickness.shape.gii"));
  const VertexData back = read_vertex_data(brain.mapped.folder / "x.thickness.shape.gii");
  CHECK(back.columns[0].values.at(7) == 7);
  CHECK(read_vertex_data(brain.mapped.folder / "x.parcels.label.gii").labels.at(1).name == "red");
}

TEST_CASE("data: files have the names that are given, or those of a field") {
  const Brain brain;
  const std::string metric = brain.mapped.folder / "m.shape.gii",
                    label = brain.mapped.folder / "l.annot";
  REQUIRE(sphparam_program({"remesh", brain.sphere, "--sphere", brain.sphere, "--grid",
                            "like:" + brain.sphere, "--sample", "barycentric", "--data",
                            brain.thickness, "--data", brain.parcels, "--write-data",
                            metric + "," + label})
              .code == 0);
  CHECK(read_vertex_data(metric).columns[0].values ==
        read_vertex_data(brain.thickness).columns[0].values);
  CHECK(read_vertex_data(label).labels.size() == 2);
  const std::string folder = (brain.mapped.folder / "").substr(0);
  REQUIRE(sphparam_program({"remesh", brain.white, "--sphere", brain.sphere, "--grid", "ico:1",
                            "--data", brain.thickness, "--names", "hcp", "--subject", "S", "-o",
                            folder})
              .code == 0);
  CHECK(read_mesh(brain.mapped.folder / "S.L.white.ico1.surf.gii").mesh.vertex_count() == 42);
  CHECK(read_vertex_data(brain.mapped.folder / "S.L.thickness.ico1.shape.gii").structure ==
        "CortexLeft");
  // Another mesh's vertices are not its own, whatever that one's name says; its own sphere's are.
  const auto made = [&](const std::string& like, const std::string& space) {
    if (like != brain.sphere)
      std::filesystem::copy_file(brain.sphere, brain.mapped.folder / like,
                                 std::filesystem::copy_options::overwrite_existing);
    const std::string grid = like == brain.sphere ? like : brain.mapped.folder / like;
    const Ended ended = sphparam_program({"remesh", brain.white, "--sphere", brain.sphere, "--grid",
                                          "like:" + grid, "--data", brain.thickness, "--names",
                                          "hcp", "--subject", "S", "-o", folder});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(std::filesystem::exists(brain.mapped.folder / ("S.L.white." + space + ".surf.gii")));
    CHECK(std::filesystem::exists(brain.mapped.folder / ("S.L.thickness." + space + ".shape.gii")));
  };
  made("lh.sphere.reg", "spherereg");
  std::filesystem::create_directories(brain.mapped.folder / "fsaverage/surf");
  made("fsaverage/surf/lh.sphere", "fsaverage");
  CHECK_FALSE(std::filesystem::exists(brain.mapped.folder / "S.L.white.native.surf.gii"));
  made(brain.sphere, "native");
  REQUIRE(
      sphparam_program({"map", brain.white, "--write-sphere", folder, "--names", "bids"}).code ==
      0);
  CHECK(read_mesh(brain.mapped.folder / "hemi-L_sphere.surf.gii").mesh.vertex_count() ==
        brain.vertices);
}

TEST_CASE("data: no file that nobody named is replaced by what lies beside a surface") {
  const Brain brain;
  const std::string theta = brain.mapped.folder / "lh.theta",
                    map = brain.mapped.folder / "t.sph.ply",
                    out = brain.mapped.folder / "lh.mended.white";
  std::filesystem::copy_file(brain.thickness, theta);
  REQUIRE(sphparam_program({"map", brain.sphere, "--data", theta, "-o", map}).code == 0);
  CHECK(read_mesh(map).find_vertex_property("theta_2")->values.at(5) == 5);
  const Ended ended = sphparam_program({"remesh", map, "--grid", "ico:1", "-o", out});
  CHECK(ended.code == 3);
  CHECK_THAT(ended.err, Contains("lh.theta") && Contains("is there already"));
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(read_vertex_data(theta).vertex_count() == brain.vertices);
  CHECK(sphparam_program({"repair", map, "-o", out}).code == 3);
}

TEST_CASE("data: a file that is written has the data of its --data, or there is none") {
  const Brain brain;
  const std::string metric = brain.mapped.folder / "m.shape.gii",
                    label = brain.mapped.folder / "l.label.gii",
                    map = brain.mapped.folder / "lh.sph.ply";
  REQUIRE(sphparam_program({"map", brain.white, "--data", brain.parcels, "-o", map}).code == 0);
  const auto remeshed = [&](const std::string& transfer) {
    return sphparam_program({"remesh", map, "--grid", "ico:1", "--data", brain.thickness,
                             "--write-data", metric, "--transfer", transfer});
  };
  for (const char* transfer : {"none", "parcels"}) {
    const Ended ended = remeshed(transfer);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains("m.shape.gii") && Contains("--transfer all carries it"));
    CHECK_FALSE(std::filesystem::exists(metric));
  }
  CHECK(remeshed("thickness").code == 0);
  CHECK(read_vertex_data(metric).kind == DataKind::Metric);
}

TEST_CASE("data: missing values stay missing in files beside, and no mesh file loses them unsaid") {
  const Brain brain;
  VertexData measure = read_vertex_data(brain.thickness);
  measure.columns[0].values[3] = std::numeric_limits<double>::quiet_NaN();
  write_vertex_data(brain.mapped.folder / "lh.depth", measure);
  const std::string depth = brain.mapped.folder / "lh.depth",
                    out = brain.mapped.folder / "S.L.white.surf.gii",
                    ply = brain.mapped.folder / "out.ply",
                    metric = brain.mapped.folder / "m.shape.gii";
  REQUIRE(sphparam_program({"repair", brain.white, "--data", depth, "-o", out}).code == 0);
  CHECK(std::isnan(
      read_vertex_data(brain.mapped.folder / "S.L.depth.shape.gii").columns[0].values.at(3)));
  const Ended left = sphparam_program({"repair", brain.white, "--data", depth, "-o", ply});
  CHECK(left.code == 0);
  CHECK_THAT(left.err + left.out, Contains("are no finite numbers"));
  const Ended refused =
      sphparam_program({"remesh", brain.white, "--sphere", brain.sphere, "--grid", "ico:1",
                        "--data", depth, "--write-data", metric, "-o", ply});
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("lh.depth has values that are no finite numbers"));
  CHECK_FALSE(std::filesystem::exists(metric));
}

TEST_CASE("data: the vertices of the file count, also where some were dropped and in a map of it") {
  const Mapped mapped;
  const std::string mesh = mapped.folder / "lh.obj", map = mapped.folder / "lh.sph.ply",
                    label = mapped.folder / "lh.piece.label", few = mapped.folder / "lh.few.mgh",
                    all = mapped.folder / "lh.all.mgh", out = mapped.folder / "out.ply";
  std::ofstream(mesh) << "v 9 9 9\nv 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\n"
                         "f 2 4 3\nf 2 3 5\nf 2 5 4\nf 3 4 5\n";
  std::ofstream(label) << "#!ascii label\n2\n0 0 0 0 0\n4 0 0 0 0\n";
  VertexData data;
  data.columns.resize(1);
  data.columns[0].values = {1, 2, 3, 4};
  write_vertex_data(few, data);
  data.columns[0].values.push_back(5);
  write_vertex_data(all, data);
  REQUIRE(sphparam_program({"map", mesh, "--data", all, "-o", map}).code == 0);
  for (const std::string& input : {mesh, map}) {
    const Ended refused = sphparam_program({"repair", input, "--data", few, "-o", out});
    CHECK(refused.code == 3);
    CHECK_THAT(refused.err, Contains("values of 4 vertices") && Contains("has 5"));
    REQUIRE(sphparam_program({"repair", input, "--data", label, "-o", out}).code == 0);
    CHECK(read_mesh(out).find_vertex_property("piece")->values == std::vector<double>{0, 0, 0, 1});
  }
}

TEST_CASE("data: info says what a file of numbers holds, and that --data takes it") {
  const Brain brain;
  const Ended measured = sphparam_program({"info", brain.thickness});
  CHECK(measured.code == 4);
  CHECK_THAT(measured.out, Contains("FreeSurfer curv") && Contains("thickness: 0 to 161") &&
                               Contains("CortexLeft") && Contains("--data lh.thickness"));
  const Ended labels = sphparam_program({"info", brain.parcels, "--json", "-"});
  CHECK(labels.code == 4);
  const auto data = nlohmann::json::parse(labels.out)["data"];
  CHECK(data["kind"] == "labels");
  CHECK(data["vertices"] == brain.vertices);
  CHECK(data["columns"][0]["name"] == "parcels");
  CHECK(data["labels"][1]["name"] == "red");
  CHECK_THAT(sphparam_program({"info", brain.parcels}).out, Contains("parcels: 2 of 2 labels"));
  const std::string label = brain.mapped.folder / "lh.piece.label";
  std::ofstream(label) << "#!ascii label\n2\n0 0 0 0 0\n999999999 0 0 0 0\n";
  CHECK_THAT(sphparam_program({"info", label}).out, Contains("FreeSurfer label"));
  const std::string cut = brain.mapped.folder / "lh.cut";
  std::ofstream(cut) << bytes_of(brain.thickness).substr(0, 30);
  const Ended broken = sphparam_program({"info", cut});
  CHECK(broken.code == 3);
  CHECK(broken.out.empty());
}

TEST_CASE("data: columns without a name are called after their file where programs show names") {
  const Brain brain;
  const std::string shape = brain.mapped.folder / "x.shape.gii";
  REQUIRE(sphparam_program({"remesh", brain.white, "--sphere", brain.sphere, "--grid", "ico:1",
                            "--data", brain.thickness, "--write-data", shape})
              .code == 0);
  CHECK(read_vertex_data(shape).columns[0].name == "thickness");
}

TEST_CASE("data: the other hemisphere's is told in a line") {
  const Brain brain;
  const std::string other = brain.mapped.folder / "rh.thickness",
                    gii = brain.mapped.folder / "a.gii", out = brain.mapped.folder / "out.ply";
  std::filesystem::copy_file(brain.thickness, other);
  const auto told = [&](const std::string& surface, const std::string& data) {
    const Ended ended = sphparam_program({"repair", surface, "--data", data, "-o", out});
    CHECK(ended.code == 0);
    return ended.err + ended.out;
  };
  const std::string line = "rh.thickness is of CortexRight, and ";
  CHECK_THAT(told(brain.white, other), Contains(line) && Contains("lh.white is of CortexLeft"));
  CHECK_THAT(told(brain.white, brain.thickness), !Contains("is of Cortex"));
  REQUIRE(sphparam_program({"repair", brain.white, "-o", gii}).code == 0);
  CHECK_THAT(told(gii, other), Contains(line) && Contains("a.gii is of CortexLeft"));
  const std::string nobodys = brain.mapped.folder / "x.gii";  // written as "Other"
  std::filesystem::copy_file(brain.white, brain.mapped.folder / "x.white");
  REQUIRE(sphparam_program({"repair", brain.mapped.folder / "x.white", "-o", nobodys}).code == 0);
  CHECK_THAT(told(nobodys, other), !Contains("is of Cortex"));
}

TEST_CASE("data: a sphere of a mended mesh is told, and what writes that mesh") {
  const Folder folder;
  const std::string mesh = folder / "a.obj", sphere = folder / "lh.sphere",
                    mended = folder / "m.obj";
  TriangleMesh open = icosphere(1);
  open.triangles.conservativeResize(79, 3);
  write_bytes(mesh, obj_text(open));
  const Ended map = sphparam_program({"map", mesh, "--repair=holes", "--write-sphere", sphere});
  REQUIRE(map.code == 0);
  const std::string command = "sphparam repair " + mesh + " --repair=holes -o MENDED";
  CHECK_THAT(map.err, Contains("lh.sphere: is of the mended mesh, which no file holds: `" +
                               command + "` writes it"));
  const Ended other = sphparam_program({"verify", mesh, sphere});
  CHECK(other.code == 3);
  CHECK_THAT(other.err, Contains("`sphparam repair` with the same options writes"));
  REQUIRE(sphparam_program({"repair", mesh, "--repair=holes", "-o", mended}).code == 0);
  CHECK(sphparam_program({"verify", mended, sphere}).code == 0);
  CHECK_THAT(sphparam_program({"map", mesh, "--repair=holes", "--write-sphere", sphere, "-o",
                               folder / "a.sph.ply"})
                 .err,
             !Contains("no file holds"));
}

TEST_CASE(
    "data: a sphere without the vertices that no face uses is told, and what writes its mesh") {
  const Folder folder;
  const std::string mesh = folder / "a.obj", sphere = folder / "s.obj", written = folder / "m.obj";
  write_bytes(mesh, obj_text(behind_two_unused(icosphere(1))));
  const Ended map = sphparam_program({"map", mesh, "--write-sphere", sphere});
  REQUIRE(map.code == 0);
  const std::string dropped = "dropped 2 vertices that no face uses: vertices 0, 1\n";
  CHECK_THAT(map.err, Contains("s.obj: its vertices are not the rows of a.obj: " + dropped) &&
                          Contains("s.obj: is of the mesh as it was mapped, which no file holds: `"
                                   "sphparam repair " +
                                   mesh + " --repair=unused -o MENDED` writes it"));
  const Ended beside =
      sphparam_program({"map", mesh, "--write-sphere", sphere, "-o", folder / "a.sph.ply"});
  CHECK_THAT(beside.err, Contains("rows of a.obj: " + dropped) && !Contains("no file holds"));
  const Ended repair = sphparam_program({"repair", mesh, "--repair=unused", "-o", written});
  CHECK_THAT(repair.err, Contains("  " + dropped));
  CHECK(read_mesh(written).mesh.positions == icosphere(1).positions);
  CHECK(read_mesh(sphere).mesh.triangles == read_mesh(written).mesh.triangles);
}

TEST_CASE("data: a sphere off the origin is told wherever one is taken") {
  const Brain brain;
  MeshFile moved = read_mesh(brain.sphere);
  moved.mesh.positions.col(0).array() += 25;
  const std::string off = brain.mapped.folder / "off.lh.sphere",
                    out = brain.mapped.folder / "o.ply";
  write_mesh(off, moved, {.is_sphere = true});
  const std::string told = "off.lh.sphere: these points are not on a sphere about the origin";
  CHECK_THAT(
      sphparam_program({"remesh", brain.white, "--sphere", off, "--grid", "ico:1", "-o", out}).err,
      Contains("warning: " + told));
  CHECK_THAT(sphparam_program({"match", brain.white, brain.white, "--sphere", brain.sphere,
                               "--sphere-b", off, "-o", out})
                 .err,
             Contains("warning: " + told));
  CHECK_THAT(sphparam_program({"render", brain.white, "--sphere", off, "--size", "16", "-o",
                               brain.mapped.folder / "o.png"})
                 .err,
             Contains("warning: " + told));
  CHECK_THAT(sphparam_program({"map", brain.white, "--align", off, "-o", out}).err,
             Contains("warning: " + told));
  const Ended like = sphparam_program(
      {"remesh", brain.white, "--sphere", brain.sphere, "--grid", "like:" + off, "-o", out});
  CHECK_THAT(like.err, Contains("warning: " + told));
  CHECK_THAT(sphparam_program({"remesh", brain.white, "--sphere", brain.sphere, "--grid",
                               "like:" + brain.sphere, "-o", out})
                 .err,
             !Contains("about the origin"));
  CHECK_THAT(sphparam_program({"map", brain.white, "--align", brain.sphere, "-o", out}).err,
             !Contains("about the origin"));
}

TEST_CASE("data: a report names the files of data that were written") {
  const Brain brain;
  const std::string out = brain.mapped.folder / "o.surf.gii",
                    metric = brain.mapped.folder / "m.shape.gii";
  const auto data_of = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"remesh", brain.white, "--sphere", brain.sphere,
                                   "--grid", "ico:1",     "--json",   "-"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(words);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return nlohmann::json::parse(ended.out)["outputs"]["data"];
  };
  using Names = std::vector<std::string>;
  CHECK(data_of({"--data", brain.thickness + "," + brain.parcels, "-o", out}) ==
        Names{brain.mapped.folder / "o.thickness.shape.gii",
              brain.mapped.folder / "o.parcels.label.gii"});
  CHECK(data_of({"--data", brain.thickness, "--write-data", metric}) == Names{metric});
  CHECK(data_of({"--data", brain.thickness, "-o", brain.mapped.folder / "o.ply"}).empty());
}

TEST_CASE("data: a measure and a time series of one name lie beside a FreeSurfer surface apart") {
  const Brain brain;
  VertexData series = read_vertex_data(brain.thickness);
  series.kind = DataKind::TimeSeries;
  const std::string func = brain.mapped.folder / "lh.thickness.func.gii",
                    folder = brain.mapped.folder / "out";
  write_vertex_data(func, series);
  std::filesystem::create_directories(folder);
  const Ended ended =
      sphparam_program({"remesh", brain.white, "--sphere", brain.sphere, "--grid", "ico:1",
                        "--data", brain.thickness + "," + func, "-o", folder + "/lh.white"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(read_vertex_data(folder + "/lh.thickness").columns[0].values ==
        read_vertex_data(folder + "/lh.thickness_2").columns[0].values);
}

TEST_CASE("data: areas of a sphere are told where those of surfaces are meant") {
  const Brain brain;
  const std::string told = "warning: the areas of --sample adap-bary-area are those of lh.sphere";
  const auto said = [&](const std::string& mesh, std::vector<std::string> more) {
    std::vector<std::string> words{"remesh",       mesh,
                                   "--sphere",     brain.sphere,
                                   "--grid",       "like:" + brain.sphere,
                                   "--sample",     "adap-bary-area",
                                   "--data",       brain.thickness,
                                   "--write-data", brain.mapped.folder / "m.shape.gii"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(words);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(said(brain.sphere, {}), Contains(told));
  CHECK_THAT(said(brain.white, {}), !Contains("which is a sphere"));
  CHECK_THAT(said(brain.sphere, {"--areas", brain.white + "," + brain.white}),
             !Contains("which is a sphere"));
}

TEST_CASE("data: values that B lacks are told by its mesh, not its sphere") {
  const Brain brain;
  CHECK_THAT(sphparam_program({"match", brain.white, brain.white, "--sphere", brain.sphere,
                               "--sphere-b", brain.sphere, "-o", brain.mapped.folder / "m.ply",
                               "--write-values", brain.mapped.folder / "v.ply"})
                 .err,
             Contains("--write-values: no vertex of lh.white carries"));
}

TEST_CASE("data: what makes no sense is refused before any work") {
  const Brain brain;
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& message) {
    const Ended ended = sphparam_program(words);
    CHECK(ended.code == code);
    CHECK_THAT(ended.err, Contains(message));
  };
  const std::string out = brain.mapped.folder / "x.surf.gii", grid = "like:" + brain.sphere;
  refused({"map", brain.white}, 2, "nothing to write");
  refused({"map", brain.white, "--write-sphere", out, "--subject", "S"}, 2, "--names only");
  refused({"map", brain.mapped.path, "--write-sphere", brain.mapped.folder / "", "--names", "hcp"},
          2, "which hemisphere");
  refused({"map", brain.white, "--write-sphere", out, "--names", "hcp"}, 2, "names a folder");
  refused({"remesh", brain.white, "--grid", grid, "--data", brain.thickness, "--write-data",
           out + "," + out},
          2, "2 files, for 1 of --data");
  refused({"remesh", brain.white, "--grid", grid, "--data", brain.thickness, "--write-data",
           brain.mapped.folder / "a.txt"},
          2, "values are written as");
  refused({"remesh", brain.white, "--grid", grid, "-o", out, "--areas", "a,b"}, 2,
          "--sample adap-bary-area only");
  refused({"remesh", brain.mapped.path, "--grid", "ico:1", "-o", out, "--data", brain.thickness}, 3,
          "lh.thickness");
  refused({"repair", brain.white, "--data", brain.white, "-o", out}, 3, "file of values");
  for (const std::string& values : {brain.thickness, brain.parcels}) {
    refused({"map", values, "--write-sphere", out}, 3, "and no mesh");
    refused({"verify", values}, 3, "as --data " + values);
  }
}

}  // namespace sphparam::tests
