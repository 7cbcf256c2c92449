#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>

#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/mesh/self_crossings.h"
#include "support/test_meshes.h"

/// `sphparam match`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// A ball with a long nose and a short one: no two sides of it are alike.
TriangleMesh creature(int level, double nose) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    const double one = std::exp(-8 * (x - Vector3(0.8, 0.6, 0)).squaredNorm());
    const double two = std::exp(-8 * (x - Vector3(0, -0.6, 0.8)).squaredNorm());
    const double three = std::exp(-8 * (x - Vector3(-1, 0, 0)).squaredNorm());
    mesh.positions.row(v) = (1 + nose * one + 0.5 * two + 0.25 * three) * x;
  }
  return mesh;
}

/// Behind a triangle of its own, without the faces about some vertices.
TriangleMesh with_splinter_and_holes(const TriangleMesh& mesh) {
  const auto is_gone = [](Vertex v) { return v >= 500 && v < 2500 && v % 40 == 0; };
  TriangleMesh result = mesh;
  result.positions.conservativeResize(mesh.vertex_count() + 3, 3);
  result.positions.bottomRows(3) = 0.05 * Points::Identity(3, 3);
  Face faces = 0;
  result.triangles.row(faces++) << mesh.vertex_count(), mesh.vertex_count() + 1,
      mesh.vertex_count() + 2;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.triangles.row(f);
    if (is_gone(corners[0]) || is_gone(corners[1]) || is_gone(corners[2])) continue;
    result.triangles.row(faces++) = corners;
  }
  result.triangles.conservativeResize(faces, 3);
  return result;
}

/// Where the vertices of a match lie on the other mesh: nothing where that has no such face.
std::vector<std::optional<Vector3>> targets(const std::string& match, const std::string& other) {
  const MeshFile written = read_mesh(match), target = read_mesh(other);
  const Property* rows = written.find_vertex_property("target_face");
  std::vector<std::optional<Vector3>> places(rows->values.size());
  for (size_t v = 0; v < places.size(); ++v) {
    if (rows->values[v] < 0) continue;
    places[v] = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      *places[v] +=
          written.find_vertex_property("target_" + std::to_string(k))->values[v] *
          target.mesh.position(target.mesh.triangles(static_cast<Face>(rows->values[v]), k));
  }
  return places;
}

/// A ball with four arms.
TriangleMesh armed(int level, double longer) {
  TriangleMesh mesh = icosphere(level);
  const TriangleMesh ball = mesh;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    double length = 1.5;
    for (const Vertex tip : {0, 3, 5, 8}) {
      const Vector3 axis = ball.position(tip);
      mesh.positions.row(v) +=
          length * std::exp(-25 * (ball.position(v) - axis).squaredNorm()) * axis;
      length += longer;
    }
  }
  return mesh;
}

/// An ellipsoid with a swelling: it has no ends.
TriangleMesh pebble(int level) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    const double swell = 0.25 * std::exp(-4 * (x - Vector3(0.8, 0.6, 0)).squaredNorm()) +
                         0.15 * std::exp(-4 * (x - Vector3(0, -0.6, 0.8)).squaredNorm());
    mesh.positions.row(v) = (1 + swell) * Vector3(1.3, 1, 0.8).cwiseProduct(x);
  }
  return mesh;
}

/// Two creatures and their landmarks.
struct Creatures {
  Folder folder;
  std::string first = folder / "first.obj", second = folder / "second.obj";
  std::string pairs = folder / "pairs.txt", out = folder / "out.ply";

  Creatures() {
    write_bytes(first, obj_text(creature(3, 1)));
    write_bytes(second, obj_text(creature(4, 1.4)));
    write_bytes(pairs, "# of an icosahedron\n0 0\n3 3\n5 5\n8 8\n10 10\n");
  }
  Ended match_without_landmarks() const {
    const std::string ball = folder / "ball.obj";
    write_bytes(ball, obj_text(icosphere(3)));
    return sphparam_program({"match", ball, ball, "-o", out});
  }
  Ended match(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"match", first, second, "--landmarks", pairs, "-o", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sphparam_program(arguments);
  }
};

}  // namespace

TEST_CASE("match: the map is written, certified, with every vertex's point on the other") {
  const Creatures creatures;
  const Ended ended = creatures.match({"--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  CHECK(report["one_to_one"] == true);
  CHECK(report["first"]["certificate"]["one_to_one"] == true);
  CHECK(report["second"]["certificate"]["one_to_one"] == true);
  REQUIRE(report["landmarks"].size() == 5);
  for (const Json& landmark : report["landmarks"]) CHECK(landmark["residual"] == 0.0);
  CHECK(report["distortion"]["symmetric_dirichlet"] < 6);
  CHECK(sphparam_program({"verify", creatures.out}).code == 0);
  CHECK(report["first"]["mapped_now"] == true);
  const Ended again = sphparam_program(
      {"match", creatures.out, creatures.out, "-o", creatures.folder / "again.ply", "--json", "-"});
  for (const char* side : {"first", "second"})
    CHECK(Json::parse(again.out)[side]["mapped_now"] == false);
  const MeshFile written = read_mesh(creatures.out);
  const MeshFile other = read_mesh(creatures.second);
  const Property* face = written.find_vertex_property("target_face");
  REQUIRE(face);
  for (const Vertex landmark : {0, 3, 5, 8, 10}) {
    Vector3 place = Vector3::Zero();
    const auto f = static_cast<Face>(face->values[static_cast<size_t>(landmark)]);
    for (int k = 0; k < 3; ++k) {
      const Property* weight = written.find_vertex_property("target_" + std::to_string(k));
      REQUIRE(weight);
      place += weight->values[static_cast<size_t>(landmark)] *
               other.mesh.position(other.mesh.triangles(f, k));
    }
    CHECK((place - other.mesh.position(landmark)).norm() < 1e-12);
  }
}

TEST_CASE("match --repair: target_face are faces of B's file, -1 what closes a hole") {
  const Creatures creatures;
  write_bytes(creatures.second, obj_text(with_splinter_and_holes(creature(4, 1.4))));
  const std::string mended = creatures.folder / "mended.ply", out = creatures.folder / "m.ply";
  REQUIRE(sphparam_program({"repair", creatures.second, "-o", mended}).code == 0);
  REQUIRE(sphparam_program(
              {"match", creatures.first, mended, "--landmarks", creatures.pairs, "-o", out})
              .code == 0);
  const std::vector<std::optional<Vector3>> expected = targets(out, mended);
  const Ended ended = creatures.match({"--repair"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const std::vector<std::optional<Vector3>> found = targets(creatures.out, creatures.second);
  for (size_t v = 0; v < found.size(); ++v)
    if (found[v]) CHECK(*found[v] == *expected[v]);
  const auto unknown = std::count(found.begin(), found.end(), std::nullopt);
  CHECK(unknown > 0);
  CHECK_THAT(ended.err, Contains("target_face is -1 at " + std::to_string(unknown) + " vert"));
}

TEST_CASE("match --repair: where faces were turned it is told what writes those of target_face") {
  const Creatures creatures;
  TriangleMesh turned = creature(4, 1.4);
  std::swap(turned.triangles(9, 0), turned.triangles(9, 1));
  write_bytes(creatures.second, obj_text(turned));
  const Ended ended = creatures.match({"--repair"});
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("out.ply: target_face numbers the triangles of B as it was "
                                 "mapped, which `sphparam repair ") &&
                            Contains("second.obj --repair -o MENDED` writes"));
}

TEST_CASE(
    "match: points in space are landmarks at the vertices nearest to them, and told how far") {
  const Creatures creatures;
  REQUIRE(creatures.match().code == 0);
  const std::string by_numbers = bytes_of(creatures.out);
  const Points one = read_mesh(creatures.first).mesh.positions,
               other = read_mesh(creatures.second).mesh.positions;
  const auto write_points = [&](double off) {
    std::ostringstream text;
    text.precision(17);
    for (const int v : {0, 3, 5, 8, 10})
      text << one.row(v) << " " << other.row(v) + Eigen::RowVector3d(0, 0, off) << "\n";
    write_bytes(creatures.pairs, text.str());
  };
  write_points(0.0078125);
  const Ended ended = creatures.match();
  REQUIRE(ended.code == 0);
  CHECK(bytes_of(creatures.out) == by_numbers);
  CHECK_THAT(ended.err,
             Contains("pairs.txt: 10 points are taken for the vertices nearest to them, at most "
                      "0.00781 away (") &&
                 Contains(" of the diagonal; line ") && Contains(", second mesh)") &&
                 !Contains("in the coordinates of these meshes?"));
  write_points(0.25);
  CHECK_THAT(creatures.match().err, Contains("in the coordinates of these meshes?"));
}

TEST_CASE("match: shapes and values of the other are carried over") {
  const Creatures creatures;
  const std::string shape = creatures.folder / "shape.obj", back = creatures.folder / "back.obj";
  const Ended ended = creatures.match({"--write-shape", shape, "--write-back", back});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const MeshFile first = read_mesh(creatures.first), second = read_mesh(creatures.second);
  const MeshFile one = read_mesh(shape), other = read_mesh(back);
  const bool some_cross =
      find_self_crossings(one.mesh).pairs > 0 || find_self_crossings(other.mesh).pairs > 0;
  CHECK((ended.err.find("cross others") != std::string::npos) == some_cross);
  CHECK(one.mesh.triangles == first.mesh.triangles);
  CHECK(other.mesh.triangles == second.mesh.triangles);
  CHECK((one.mesh.position(3) - second.mesh.position(3)).norm() < 1e-12);
  CHECK((other.mesh.position(3) - first.mesh.position(3)).norm() < 1e-12);
  const Ended distance = sphparam_program(
      {"measure", creatures.second, shape, "--samples", "20000", "--max-rms", "2%"});
  INFO(distance.out);
  CHECK(distance.code == 0);
}

TEST_CASE("match: numbers of vertices that are another file's are told where they are asked for") {
  const Creatures creatures;
  MeshFile file = read_mesh(creatures.first);
  std::vector<double> numbers(static_cast<size_t>(file.mesh.vertex_count()));
  std::iota(numbers.begin(), numbers.end(), 100);
  file.set_vertex_property({"source_vertex", ScalarType::Int32, numbers});
  const std::string mended = creatures.folder / "mended.ply";
  write_mesh(mended, file);
  const std::string told = "mended.ply: vertices are called by source_vertex";
  const std::string out = creatures.folder / "m.ply";
  write_bytes(creatures.pairs, "100 0\n103 3\n105 5\n108 8\n110 10\n");
  const Ended matched = sphparam_program(
      {"match", mended, creatures.second, "--landmarks", creatures.pairs, "-o", out});
  CHECK(matched.code == 0);
  CHECK_THAT(matched.err, Contains(told));
  CHECK_THAT(sphparam_program({"map", mended, "-o", out, "--poles", "100,103"}).err,
             Contains(told));
  CHECK_THAT(sphparam_program({"map", mended, "-o", out}).err, !Contains(told));
}

TEST_CASE("match: a morph is written, what its triangles miss is told, and only .glb will do") {
  const Creatures creatures;
  const std::string morph = creatures.folder / "morph.glb";
  const Ended ended = creatures.match({"--morph", morph, "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("in the shape of") && Contains("of its diagonal"));
  const Json report = Json::parse(ended.out);
  CHECK(report["carried"]["area_share"] > 0.9);
  CHECK(report["carried"]["farthest"] < 0.1);
  CHECK(report["outputs"].contains("morph"));
  CHECK(read_mesh(morph).mesh.face_count() >= read_mesh(creatures.first).mesh.face_count());
  const Ended wrong = creatures.match({"--morph", creatures.folder / "morph.obj"});
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Contains("--morph") && Contains(".glb"));
}

TEST_CASE("match: a page shows the match, without folders in its command line") {
  const Creatures creatures;
  const std::string page = creatures.folder / "page.html";
  const Ended ended = creatures.match({"--page", page, "--no-viewer", "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const std::string html = bytes_of(page);
  CHECK_THAT(html, Contains("first → second") && Contains("What corresponds") &&
                       Contains("sphparam match first.obj second.obj --landmarks pairs.txt") &&
                       !Contains("<model-viewer"));
  CHECK(html.find(creatures.folder / "") == std::string::npos);
  const Ended wrong = creatures.match({"--page", creatures.folder / "page.png"});
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Contains("--page") && Contains(".html"));
}

TEST_CASE("match: values that are asked for and are not there are told") {
  const Creatures creatures;
  const Ended ended = creatures.match({"--write-values", creatures.folder / "values.ply"});
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("carries a value or a colour") && Contains("second.obj"));
}

TEST_CASE("match: without landmarks the ends are paired, told, and listed") {
  const Creatures creatures;
  const std::string arms = creatures.folder / "arms.obj", other = creatures.folder / "other.obj";
  write_bytes(arms, obj_text(armed(4, 0.5)));
  write_bytes(other, obj_text(armed(4, 0.6)));
  const Ended ended = sphparam_program({"match", arms, other, "-o", creatures.out, "--json", "-"});
  REQUIRE(ended.code == 0);
  const Json search = Json::parse(ended.out)["search"];
  CHECK(search["confidence"] > 0);
  REQUIRE(search["suggestions"].size() >= 1);
  for (const Json& pair : search["suggestions"][0]["landmarks"])
    CHECK(pair["first"] == pair["second"]);
}

TEST_CASE("match: surfaces that lie alike in space are matched so, and the record says it") {
  const Creatures creatures;
  const std::string arms = creatures.folder / "arms.obj", other = creatures.folder / "other.obj";
  write_bytes(arms, obj_text(armed(4, 0)));
  write_bytes(other, obj_text(armed(3, 0.001)));
  const Ended anyhow = sphparam_program({"match", arms, other, "-o", creatures.out});
  CHECK_THAT(anyhow.err,
             Contains("about as well") && Contains("say --alike if both lie alike in space"));
  const Ended alike =
      sphparam_program({"match", arms, other, "--alike", "-o", creatures.out, "--json", "-"});
  REQUIRE(alike.code == 0);
  CHECK_THAT(alike.err, !Contains("about as well"));
  const Json search = Json::parse(alike.out)["search"];
  CHECK(search["alike"] == true);
  CHECK(search["suggestions"][0]["place_agreement"] > 0.95);
}

TEST_CASE("match: where there are no ends a turn is found, with a confidence") {
  const Creatures creatures;
  write_bytes(creatures.first, obj_text(pebble(4)));
  write_bytes(creatures.second, obj_text(pebble(3)));
  const Ended ended = sphparam_program(
      {"match", creatures.first, creatures.second, "-o", creatures.out, "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json search = Json::parse(ended.out)["search"];
  CHECK(search["suggestions"].empty());
  CHECK(search["confidence"] > 0);
  CHECK_THAT(ended.err, Contains("from a turn with confidence"));
  const Ended ball = creatures.match_without_landmarks();
  INFO(ball.err);
  CHECK(ball.code == 0);
  CHECK_THAT(ball.err, Contains("after another turn") && Contains("or give --landmarks"));
}

TEST_CASE("match: features come to lie on each other, from files and from properties") {
  const Creatures creatures;
  const std::string one = creatures.folder / "one.shape.gii", two = creatures.folder / "lh.two";
  const auto write_heights = [](const std::string& path, const TriangleMesh& mesh) {
    VertexData data;
    data.columns.push_back({.name = "height", .values = {}});
    for (Vertex v = 0; v < mesh.vertex_count(); ++v)
      data.columns[0].values.push_back(mesh.position(v).norm());
    write_vertex_data(path, data);
  };
  write_heights(one, creature(3, 1));
  write_heights(two, creature(4, 1.4));
  const std::string sphere = creatures.folder / "first.sphere.reg.surf.gii";
  const auto match = [&](const std::string& features, const std::string& second) {
    return sphparam_program(
        {"match", creatures.first, second, "--features", features, "-o", sphere, "--json", "-"});
  };
  const Ended ended = match(one + "," + two, creatures.second);
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  CHECK(report["made_by"] == "features");
  CHECK(report["features"]["columns"] == 1);
  CHECK(report["features"]["weight"] == 2);
  CHECK(report["features"]["correlation"] > 0.9);
  CHECK_THAT(ended.err, Contains("correlation of features") && Contains("turn with confidence"));
  CHECK(sphparam_program({"verify", creatures.first, sphere}).code == 0);

  const std::string carried = creatures.folder / "second.ply";
  REQUIRE(sphparam_program({"repair", creatures.second, "--data", two, "-o", carried}).code == 0);
  const Ended by_property = match(one + ",two", carried);
  INFO(by_property.err);
  CHECK(by_property.code == 0);
  CHECK(Json::parse(by_property.out)["features"] == report["features"]);

  const Ended alike = sphparam_program({"match", creatures.first, creatures.second, "--features",
                                        one + "," + two, "--alike", "-o", sphere, "--json", "-"});
  INFO(alike.err);
  REQUIRE(alike.code == 0);
  CHECK(Json::parse(alike.out)["features"]["correlation"] > 0.9);
  CHECK(Json::parse(alike.out)["features"]["place_agreement"] > 0.9);
  CHECK_FALSE(report["features"].contains("place_agreement"));

  const Ended nothing = match(one + ",tow", carried);
  CHECK(nothing.code == 3);
  CHECK_THAT(nothing.err,
             Contains("tow: is no file, and no property of the mesh's vertices, which have two"));

  const Ended odd = match(one, creatures.second);
  CHECK(odd.code == 2);
  CHECK_THAT(odd.err, Contains("--features") && Contains("pairs"));
  const Ended swapped = match(two + "," + one, creatures.second);
  CHECK(swapped.code == 3);
  CHECK_THAT(swapped.err, Contains("lh.two"));
}

TEST_CASE("match: what makes no sense is refused, and nothing is written") {
  const Creatures creatures;
  write_bytes(creatures.pairs, "0 0\n0 1\n");
  const Ended twice = creatures.match();
  CHECK(twice.code == 3);
  CHECK_THAT(twice.err, Contains("pairs.txt:2:") && Contains("first in line 1"));
  write_bytes(creatures.pairs, "0 0\n3 99999\n");
  const Ended beyond = creatures.match();
  CHECK(beyond.code == 3);
  CHECK_THAT(beyond.err,
             Contains("pairs.txt:2:") && Contains("no vertex 99999") && !Contains("mapped now"));
  CHECK_FALSE(std::filesystem::exists(creatures.out));
  const Ended name = sphparam_program({"match", creatures.first, creatures.second, "--landmarks",
                                       creatures.pairs, "-o", creatures.folder / "out.obj"});
  CHECK(name.code == 2);
  CHECK_THAT(name.err, Contains(".ply"));
  const Ended alike = sphparam_program({"match", creatures.first, creatures.second, "--alike",
                                        "--landmarks", creatures.pairs, "-o", creatures.out});
  CHECK(alike.code == 2);
  CHECK_THAT(alike.err, Contains("--alike: --landmarks say already"));
  // Before the meshes are read, which may take minutes to map.
  const Ended nowhere = sphparam_program(
      {"match", creatures.first, creatures.folder / "nowhere.obj", "-o", creatures.out});
  CHECK(nowhere.code == 3);
  CHECK_THAT(nowhere.err, Contains("nowhere.obj: No such file") && !Contains("mapped now"));
  write_bytes(creatures.pairs, "0 x\n");
  write_bytes(creatures.first, "no mesh");
  CHECK_THAT(creatures.match().err, Contains("pairs.txt:1:"));
}

TEST_CASE(
    "match: a mesh that cannot be mapped is told with its side, one without area with its name") {
  const Creatures creatures;
  write_bytes(creatures.second, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const Ended open = creatures.match();
  CHECK(open.code == 4);
  CHECK_THAT(open.err, Contains("B (second.obj) cannot be mapped") && Contains("not closed"));
  write_bytes(creatures.second,
              "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n");
  write_bytes(creatures.pairs, "0 0\n3 3\n");
  const Ended flat = creatures.match();
  CHECK(flat.code == 4);
  CHECK_THAT(flat.err, Contains("second.obj: the surface has no area"));
}

TEST_CASE("match: a mirrored shape is told, and --mirror matches it") {
  const Creatures creatures;
  TriangleMesh mirrored = creature(3, 1.4);
  mirrored.positions.col(0) *= -1;
  mirrored.triangles.col(1).swap(mirrored.triangles.col(2));
  write_bytes(creatures.first, obj_text(mirrored));
  const Ended refused = creatures.match();
  CHECK(refused.code == 5);
  CHECK_THAT(refused.err, Contains("look mirrored") && Contains("--mirror"));
  CHECK_FALSE(std::filesystem::exists(creatures.out));
  const Ended matched = creatures.match({"--mirror", "--json", "-"});
  INFO(matched.err);
  REQUIRE(matched.code == 0);
  const Json report = Json::parse(matched.out);
  CHECK(report["mirrored"] == true);
  CHECK(report["distortion"]["symmetric_dirichlet"] < 4.3);
}

TEST_CASE("match: --mirror is named where names or metadata say left and right") {
  const Creatures creatures;
  const auto named = [&](const std::string& name, double length) {
    write_bytes(creatures.folder / name, obj_text(creature(3, length)));
    return creatures.folder / name;
  };
  const std::string left = named("lh.white.obj", 1), right = named("S.R.white.native.obj", 1.4),
                    other_left = named("sub-1_hemi-L_white.obj", 1.4);
  const auto told = [&](const std::string& first, const std::string& second,
                        std::vector<std::string> more) {
    more.insert(more.begin(), {"match", first, second, "-o", creatures.out});
    const Ended ended = sphparam_program(more);
    INFO(ended.err);
    CHECK(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(told(left, right, {}), Contains("A is CortexLeft and B is CortexRight: --mirror"));
  CHECK_THAT(told(left, right, {"--mirror"}), !Contains("Cortex"));
  CHECK_THAT(told(left, other_left, {}), !Contains("Cortex"));
  CHECK_THAT(told(left, other_left, {"--mirror"}), Contains("both CortexLeft"));
  const std::string gifti = creatures.folder / "x.surf.gii";  // the structure is in the file
  REQUIRE(sphparam_program({"repair", creatures.folder / "S.R.white.native.obj", "-o",
                            creatures.folder / "S.R.white.native.surf.gii"})
              .code == 0);
  std::filesystem::rename(creatures.folder / "S.R.white.native.surf.gii", gifti);
  CHECK_THAT(told(gifti, left, {}), Contains("A is CortexRight and B is CortexLeft: --mirror"));
}

TEST_CASE("map --like gives a low mesh the sphere of the one that it lies about") {
  const Folder folder;
  const std::string low = folder / "low.obj", fine = folder / "fine.obj",
                    high = folder / "high.sph.ply", out = folder / "low.sph.ply";
  write_bytes(low, obj_text(creature(3, 1)));
  write_bytes(fine, obj_text(creature(4, 1)));
  REQUIRE(sphparam_program({"map", fine, "-o", high}).code == 0);
  const std::vector<std::string> like{"map", low, "--like", high, "-o", out};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = like;
    all.insert(all.end(), more.begin(), more.end());
    return sphparam_program(all);
  };
  const Ended ended = with({"--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("of the area goes to where it is nearest"));
  const Json record = Json::parse(ended.out);
  CHECK(record["like"]["other"] == "high.sph.ply");
  CHECK(record["like"]["in_place"].get<double>() > 0.95);
  CHECK(record["like"]["farthest"].get<double>() < 0.05);
  CHECK(record["options"]["method"] == "like");
  CHECK(sphparam_program({"verify", out}).code == 0);
  CHECK_THAT(bytes_of(out), Contains("like high.sph.ply"));

  const Ended both = with({"--poles", "1,2"});
  CHECK(both.code == 2);
  CHECK_THAT(both.err, Contains("--poles and --like contradict each other"));
  TriangleMesh away = creature(3, 1);
  away.positions.array() += 9;
  write_bytes(low, obj_text(away));
  const Ended elsewhere = with({});
  CHECK(elsewhere.code == 2);
  CHECK_THAT(elsewhere.err, Contains("has one been moved or scaled?"));
}

TEST_CASE("map --like doubts that two meshes are of one thing where they lie far apart") {
  const Folder folder;
  const std::string inner = folder / "inner.obj", outer = folder / "outer.obj";
  write_bytes(outer, obj_text(icosphere(3)));
  for (const double size : {0.7, 0.95}) {
    TriangleMesh ball = icosphere(2);
    ball.positions *= size;
    write_bytes(inner, obj_text(ball));
    const Ended ended =
        sphparam_program({"map", inner, "--like", outer, "-o", folder / "inner.sph.ply"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const bool doubts = ended.err.find("outer.obj: are they of one thing") != std::string::npos;
    CHECK(doubts == (size < 0.9));
  }
}

}  // namespace sphparam::tests
