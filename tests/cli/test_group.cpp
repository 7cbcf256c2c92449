#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "mesh/vertex_normals.h"
#include "program.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_reader.h"
#include "support/test_meshes.h"

/// `sphparam group`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Catch::Detail::Approx;
using Json = nlohmann::json;
namespace fs = std::filesystem;

/// Ellipsoids with a bump, of three lengths, each lying elsewhere.
struct Eggs {
  Folder folder;
  std::vector<std::string> paths;
  std::string out = folder / "out/";

  Eggs() {
    for (const double length : {2.6, 3.0, 3.4}) {
      TriangleMesh mesh = icosphere(3);
      const double turn = length * 2;
      Eigen::Matrix3d rotation;
      rotation << std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1;
      for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
        const Vector3 x = mesh.position(v);
        const double bump = std::exp(-4 * (x - Vector3(1, 1, 1).normalized()).squaredNorm());
        mesh.positions.row(v) =
            rotation * ((1 + 0.5 * bump) * x.cwiseProduct(Vector3(length, 2, 1.2)));
      }
      mesh.positions.array() += length;
      paths.push_back(folder / ("egg" + std::to_string(paths.size()) + ".obj"));
      write_bytes(paths.back(), obj_text(mesh));
    }
  }
  Ended group(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"group"};
    arguments.insert(arguments.end(), paths.begin(), paths.end());
    arguments.insert(arguments.end(), {"-o", out});
    if (std::ranges::find(more, "--grid") == more.end())
      more.insert(more.end(), {"--grid", "ico:3"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sphparam_program(arguments);
  }
  std::string in_out(const std::string& name) const { return (fs::path(out) / name).string(); }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream in(row);
  for (std::string cell; std::getline(in, cell, '\t');) cells.push_back(cell);
  return cells;
}

long columns(const std::string& line) { return 1 + std::ranges::count(line, '\t'); }

/// The RMS distance of a surface from its centroid: of |x|² a triangle of area A has the integral
/// A/12 (|a|² + |b|² + |c|² + |a + b + c|²).
double size_of(const TriangleMesh& mesh) {
  double area = 0, squares = 0;
  Vector3 first = Vector3::Zero();
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) -> Vector3 { return mesh.position(mesh.triangles(f, k)); };
    const Vector3 a = corner(0), b = corner(1), c = corner(2), sum = a + b + c;
    const double of_face = (b - a).cross(c - a).norm() / 2;
    area += of_face;
    first += of_face / 3 * sum;
    squares +=
        of_face / 12 * (a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + sum.squaredNorm());
  }
  return std::sqrt(squares / area - (first / area).squaredNorm());
}

}  // namespace

TEST_CASE(
    "group: what thousands of shapes are read and written as costs no more than their number") {
  const Folder folder;
  std::vector<std::string> words = {"group", "-o", folder / "out"};
  for (int i = 0; i < 5000; ++i) words.push_back("nowhere" + std::to_string(i) + ".obj");
  const Ended ended = sphparam_program(words);  // pair by pair, as it was, a quarter of an hour
  CHECK(ended.code == 3);
  CHECK_THAT(ended.err, Contains("nowhere0.obj: No such file"));
}

TEST_CASE("group: everything is written, every map proved, and the length is the first mode") {
  const Eggs eggs;
  write_bytes(eggs.folder / "marks.txt", "# on the template\n0 tip\n17\n");
  const Ended ended =
      eggs.group({"--landmarks", eggs.folder / "marks.txt", "--modes", "2", "--size", "64"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  for (const char* file :
       {"mean.sph.ply", "map_egg0.sph.ply", "map_egg2.sph.ply", "shape_egg1.sph.ply"}) {
    INFO(file);
    CHECK(sphparam_program({"verify", eggs.in_out(file)}).code == 0);
  }
  for (const char* file :
       {"mean.glb", "mode1.glb", "mode1_minus.glb", "mode1_plus.glb", "mode2.glb"})
    CHECK(fs::exists(eggs.in_out(file)));
  CHECK_FALSE(fs::exists(eggs.in_out("mode3.glb")));
  const Json report = Json::parse(bytes_of(eggs.in_out("group.json")));
  CHECK(report["command"] == "group");
  CHECK(report["modes"][0]["share"] > 0.98);
  REQUIRE(report["shapes"].size() == 3);
  CHECK(report["shapes"][0]["start"] == "template");
  CHECK(report["shapes"][1]["start"] == "turn");  // one bump is no three ends
  for (const Json& shape : report["shapes"]) {
    CHECK(shape["certificate"]["one_to_one"] == true);
    CHECK(shape["resampled_certificate"]["one_to_one"] == true);
    CHECK(shape["scores"].size() == 2);
  }
  const double first = report["shapes"][0]["scores"][0], middle = report["shapes"][1]["scores"][0],
               last = report["shapes"][2]["scores"][0];
  CHECK(std::abs(middle) < 0.2);
  CHECK(first * last < -0.5);
  for (const std::string name : report["outputs"]) CHECK(fs::exists(eggs.in_out(name)));
  CHECK_THAT(bytes_of(eggs.in_out("index.html")), Contains("egg1") && Contains("image/png"));
}

TEST_CASE(
    "group: --mirror takes a mirror image as such, and tells it, and a landmark may be a point") {
  const Eggs eggs;
  MeshFile second = read_mesh(eggs.paths[1]);
  second.mesh.positions.col(2) *= -1;
  second.mesh.triangles.col(1).swap(second.mesh.triangles.col(2));
  write_bytes(eggs.paths[1], obj_text(second.mesh));
  const Vector3 tip = read_mesh(eggs.paths[0]).mesh.position(17) + Vector3(0, 0, 0.015625);
  std::ostringstream marks;
  marks.precision(17);
  marks << tip.transpose() << " tip\n";
  write_bytes(eggs.folder / "marks.txt", marks.str());
  const Ended ended = eggs.group(
      {"--mirror", "--size", "0", "--rounds", "0", "--landmarks", eggs.folder / "marks.txt"});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err,
             Contains("3 shapes on ico:3, of egg1 the mirror image, all maps certified") &&
                 Contains("marks.txt: 1 point is taken for the vertex nearest to it, "
                          "0.0156 away ("));
  const Json report = Json::parse(bytes_of(eggs.in_out("group.json")));
  CHECK(report["mirror"] == true);
  CHECK(report["landmarks"][0] == Json{{"name", "tip"}, {"vertex", 17}, {"distance", 0.015625}});
  const auto rows = lines_of(bytes_of(eggs.in_out("shapes.tsv")));
  for (size_t i = 0; i < 3; ++i) {
    CHECK(report["shapes"][i]["mirrored"] == (i == 1));
    CHECK(cells_of(rows[i + 1]).rbegin()[3] == (i == 1 ? "1" : "0"));
  }
  CHECK_THAT(bytes_of(eggs.in_out("index.html")), Contains(", mirrored"));
}

TEST_CASE("group: tables have a row a shape, a vertex, a landmark, and a header") {
  const Eggs eggs;
  write_bytes(eggs.folder / "marks.txt", "0 tip of it\n17\n");
  const Ended ended =
      eggs.group({"--landmarks", eggs.folder / "marks.txt", "--size", "0", "--rounds", "0"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const auto table = [&](const char* name) { return lines_of(bytes_of(eggs.in_out(name))); };
  const auto distances = table("distances.tsv");
  REQUIRE(distances.size() == 4);
  CHECK(distances[0] == "shape\tegg0\tegg1\tegg2");
  for (const std::string& line : distances) CHECK(columns(line) == 4);
  CHECK(table("shapes.tsv").size() == 4);
  CHECK(table("vertices.tsv").size() == 643);
  const auto landmarks = table("landmarks.tsv");
  REQUIRE(landmarks.size() == 7);
  CHECK_THAT(landmarks[1], Catch::StartsWith("egg0\ttip of it\t"));
  CHECK_THAT(landmarks[1], Catch::EndsWith("\t0"));  // the template's own vertex 0
  CHECK_THAT(landmarks[2], Catch::StartsWith("egg0\t17\t") && Catch::EndsWith("\t17"));
  // The eggs' vertices are one another's: so are their landmarks, nearly.
  const TriangleMesh last = read_mesh(fs::path(eggs.paths[2])).mesh;
  std::istringstream row(landmarks[5]);
  std::string shape, name;
  Vector3 found;
  std::getline(row, shape, '\t');
  std::getline(row, name, '\t');
  row >> found.x() >> found.y() >> found.z();
  CHECK((found - last.position(0)).norm() < 0.8);  // of a length of 6.8
  CHECK_THAT(bytes_of(eggs.in_out("index.html")), !Contains("image/png"));
}

TEST_CASE(
    "group: size is that of the written shape, mean_size their mean, to which --scale brings") {
  const Eggs eggs;
  for (const bool scale : {false, true}) {
    std::vector<std::string> more{"--size", "0", "--rounds", "0", "--start", "rotation"};
    if (scale) more.emplace_back("--scale");
    const Ended ended = eggs.group(more);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const Json report = Json::parse(bytes_of(eggs.in_out("group.json")));
    const auto rows = lines_of(bytes_of(eggs.in_out("shapes.tsv")));
    const auto written_size = [&](const std::string& name) {
      return size_of(read_mesh(fs::path(eggs.in_out(name))).mesh);
    };
    double sum = 0;
    for (size_t i = 0; i < 3; ++i) {
      const Json& shape = report["shapes"][i];
      const double size = shape["size"];
      const std::string name = shape["name"];
      CHECK(written_size("shape_" + name + ".sph.ply") ==
            Approx(scale ? double(report["mean_size"]) : size).epsilon(1e-12));
      CHECK(double(shape["scale"]) * size ==
            Approx(scale ? double(report["mean_size"]) : size).epsilon(1e-12));
      CHECK(std::stod(cells_of(rows[i + 1])[3]) == size);
      CHECK(std::stod(cells_of(rows[i + 1]).rbegin()[2]) == shape["confidence"]);
      sum += size;
    }
    CHECK(double(report["mean_size"]) == Approx(sum / 3).epsilon(1e-12));
    CHECK(double(report["size_of_mean"]) == Approx(written_size("mean.sph.ply")).epsilon(1e-12));
  }
}

TEST_CASE(
    "group: what was mended of a shape is in the record as map has it, the table and the page") {
  const Eggs eggs;
  // A hole in one of them, and a speck beside it.
  TriangleMesh holed = read_mesh(fs::path(eggs.paths[1])).mesh;
  holed.triangles.conservativeResize(holed.triangles.rows() - 1, 3);
  const auto vertex = [&](int k) { return " " + std::to_string(holed.vertex_count() + k); };
  write_bytes(eggs.paths[1], obj_text(holed) + "v 9 9 9\nv 9.1 9 9\nv 9 9.1 9\nv 9 9 9.1\nf" +
                                 vertex(1) + vertex(3) + vertex(2) + "\nf" + vertex(1) + vertex(2) +
                                 vertex(4) + "\nf" + vertex(2) + vertex(3) + vertex(4) + "\nf" +
                                 vertex(1) + vertex(4) + vertex(3) + "\n");
  const std::string record = eggs.folder / "map.json";
  REQUIRE(sphparam_program(
              {"map", eggs.paths[1], "--repair", "-o", eggs.folder / "m.sph.ply", "--json", record})
              .code == 0);
  const Ended ended = eggs.group({"--repair", "--size", "0", "--rounds", "0", "--hold"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(bytes_of(eggs.in_out("group.json"))),
             map = Json::parse(bytes_of(record));
  for (const char* key : {"repairs", "handles", "added", "components"}) {
    INFO(key);
    CHECK(report["shapes"][1][key] == map[key]);
  }
  CHECK(report["shapes"][1]["repairs"].size() >= 2);
  CHECK(report["shapes"][0]["repairs"].empty());
  CHECK(report["shapes"][0]["components"].is_null());
  CHECK(report["template_mended"].is_null());
  const auto rows = lines_of(bytes_of(eggs.in_out("shapes.tsv")));
  CHECK_THAT(rows[0], Catch::EndsWith("\tconfidence\trepairs\tfile"));
  CHECK_THAT(rows[1], Catch::EndsWith("\t\t" + eggs.paths[0]));
  CHECK_THAT(rows[2], Contains("hole-filled 1") && Contains("; "));
  CHECK_THAT(bytes_of(eggs.in_out("index.html")), Contains("Mended before they were mapped") &&
                                                      Contains("egg1: 1 ") && Contains("kept 9"));

  // A template that counts for nothing else is told of, too.
  const Ended other =
      sphparam_program({"group", eggs.paths[0], "--template", eggs.paths[1], "--repair", "--hold",
                        "--grid", "ico:2", "--size", "0", "-o", eggs.out});
  INFO(other.err);
  REQUIRE(other.code == 0);
  CHECK(Json::parse(bytes_of(eggs.in_out("group.json")))["template_mended"]["repairs"] ==
        map["repairs"]);
  CHECK_THAT(bytes_of(eggs.in_out("index.html")), Contains("template egg1.obj: "));
}

TEST_CASE("group: means of what shapes have, and how areas grow, are in the files") {
  const Folder folder;
  std::vector<std::string> words{"group"};
  for (int i = 0; i < 3; ++i) {
    MeshFile file;
    file.mesh = icosphere(2);
    file.mesh.positions *= i + 1;
    const auto count = size_t(file.mesh.vertex_count());
    if (i > 0) file.set_vertex_property({"sulc", ScalarType::Float64, std::vector(count, 2.0 * i)});
    const std::string path = folder / ("ball" + std::to_string(i) + ".ply");
    save_mapped(path, MappedMesh({.file = file, .map = {icosphere(2).positions}}));
    words.push_back(path);
  }
  const std::string out = folder / "out";
  words.insert(words.end(),
               {"--start", "maps", "--hold", "--grid", "ico:2", "--size", "0", "-o", out});
  const Ended ended = sphparam_program(words);
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("sulc: its mean is of 2 of 3 shapes: ball0 has none"));
  const Json report = Json::parse(bytes_of(out + "/group.json"));
  CHECK(report["scalars"] == Json::array({{{"name", "sulc"}, {"shapes", 2}}}));
  const MeshFile mean = read_mesh(out + "/mean.sph.ply");
  CHECK(mean.find_vertex_property("sulc_mean")->values == std::vector(162, 3.0));
  CHECK(mean.find_vertex_property("sulc_deviation")->values == std::vector(162, std::sqrt(2.0)));
  const auto rows = lines_of(bytes_of(out + "/vertices.tsv"));
  CHECK_THAT(rows[0], Catch::EndsWith("\tsulc_mean\tsulc_deviation"));
  CHECK_THAT(rows[162], Catch::EndsWith("\t3\t1.4142135623730951"));
  // The mean of balls of radius 1, 2 and 3 has radius 2.
  for (const auto& [name, growth] : {std::pair("ball0", 0.25), {"ball1", 1.0}, {"ball2", 2.25}}) {
    const MeshFile shape = read_mesh(out + "/shape_" + name + ".sph.ply");
    for (const Property* property :
         {shape.find_vertex_property("growth"), shape.find_face_property("growth")}) {
      REQUIRE(property);
      for (const double value : property->values) CHECK(value == Approx(growth).epsilon(1e-12));
    }
  }
}

TEST_CASE("group: numbers called as columns of its own get another name, and nothing is replaced") {
  const Folder folder;
  std::vector<std::string> words{"group"};
  for (int i = 1; i < 3; ++i) {
    MeshFile file;
    file.mesh = icosphere(2);
    file.mesh.positions *= i;
    const auto count = size_t(file.mesh.vertex_count());
    double value = i;
    for (const char* name : {"normal", "growth", "growth_carried", "normal_displacement", "weight"})
      file.set_vertex_property({name, ScalarType::Float64, std::vector(count, value *= 10)});
    const std::string path = folder / ("ball" + std::to_string(i) + ".ply");
    save_mapped(path, MappedMesh({.file = file, .map = {icosphere(2).positions}}));
    words.push_back(path);
  }
  const std::string out = folder / "out";
  words.insert(words.end(),
               {"--start", "maps", "--hold", "--grid", "ico:2", "--size", "0", "-o", out});
  const Ended ended = sphparam_program(words);
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("of what shapes carry normal is normal_carried, "
                                 "normal_displacement is normal_displacement_carried and growth "
                                 "is growth_carried_carried on the grid: "));
  const std::vector<std::pair<std::string, double>> names = {{"normal_carried", 10},
                                                             {"growth_carried_carried", 100},
                                                             {"growth_carried", 1e3},
                                                             {"normal_displacement_carried", 1e4},
                                                             {"weight", 1e5}};
  const MeshFile mean = read_mesh(out + "/mean.sph.ply");
  const MeshFile shape = read_mesh(out + "/shape_ball2.sph.ply");
  std::string header;
  for (const auto& [name, value] : names) {
    INFO(name);
    CHECK(mean.find_vertex_property(name + "_mean")->values == std::vector(162, 1.5 * value));
    CHECK(mean.find_vertex_property(name + "_deviation")->values ==
          std::vector(162, std::sqrt(value * value / 2)));
    CHECK(shape.find_vertex_property(name)->values == std::vector(162, 2 * value));
    header += "\t" + name + "_mean\t" + name + "_deviation";
  }
  CHECK_THAT(lines_of(bytes_of(out + "/vertices.tsv"))[0], Catch::EndsWith(header));
  // Balls of radius 1 and 2: the mean has 1.5.
  const Points normals = vertex_normals(mean.mesh);
  for (Vertex v = 0; v < mean.mesh.vertex_count(); ++v) {
    const double along = normals.row(v).dot(mean.mesh.positions.row(v)) / 1.5;
    CHECK(mean.find_vertex_property("normal_deviation")->values[size_t(v)] ==
          Approx(along * std::sqrt(0.5)).epsilon(1e-12));
  }
  for (const double value : shape.find_vertex_property("growth")->values)
    CHECK(value == Approx(4 / 2.25).epsilon(1e-12));
  CHECK(Json::parse(bytes_of(out + "/group.json"))["scalars"][1]["name"] ==
        "growth_carried_carried");
}

TEST_CASE("group: the same bytes for 1 and 3 threads") {
  const Eggs eggs;
  std::vector<std::string> bytes;
  for (const char* threads : {"1", "3"}) {
    const Ended ended = eggs.group({"--size", "0", "--threads", threads});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    bytes.push_back(bytes_of(eggs.in_out("mean.sph.ply")) + bytes_of(eggs.in_out("shapes.tsv")) +
                    bytes_of(eggs.in_out("map_egg2.sph.ply")) + bytes_of(eggs.in_out("mode1.glb")));
  }
  CHECK(bytes[0] == bytes[1]);
}

TEST_CASE("group: a template that is no shape does not count, and held maps stay as they are") {
  const Eggs eggs;
  const std::string other = eggs.folder / "other.sph.ply";
  REQUIRE(sphparam_program({"map", eggs.paths[1], "-o", other}).code == 0);
  const Ended ended =
      sphparam_program({"group", eggs.paths[0], eggs.paths[2], "--template", other, "--hold",
                        "--grid", "template", "--size", "0", "-o", eggs.out});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(bytes_of(eggs.in_out("group.json")));
  CHECK(report["shapes"].size() == 2);
  CHECK(report["grid"] == "template");
  CHECK(report["shapes"][0]["energy"].is_null());
  CHECK(cells_of(lines_of(bytes_of(eggs.in_out("shapes.tsv")))[1])[2].empty());
  CHECK(report["template"] == other);
  const auto count = [](const std::string& path) {
    return read_mesh(fs::path(path)).mesh.vertex_count();
  };
  CHECK(count(eggs.in_out("mean.sph.ply")) == count(other));
}

TEST_CASE("group: a quoted pattern and a list stand for the shapes that they name") {
  const Eggs eggs;
  const std::string list = eggs.folder / "list.txt";
  write_bytes(list, "egg0.obj\negg1.obj # the second\negg2.obj\n");
  const std::string pattern = (fs::path(eggs.paths[0]).parent_path() / "egg?.obj").string();
  for (const std::string& place : {list, pattern}) {
    const Ended ended = sphparam_program(
        {"group", place, "--hold", "--grid", "ico:2", "--size", "0", "-o", eggs.out});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const Json shapes = Json::parse(bytes_of(eggs.in_out("group.json")))["shapes"];
    REQUIRE(shapes.size() == 3);
    for (size_t i = 0; i < 3; ++i)
      CHECK(fs::equivalent(fs::path(shapes[i]["file"].get<std::string>()), eggs.paths[i]));
  }
  const Ended none = sphparam_program({"group", eggs.folder / "*.nope", "-o", eggs.out});
  CHECK(none.code == 2);
  CHECK_THAT(none.err, Contains("*.nope"));
}

TEST_CASE("group: shapes of one name are told apart by their files") {
  const Eggs eggs;
  fs::create_directory(eggs.folder / "day2");
  const std::string second = eggs.folder / "day2/egg0.obj";
  fs::copy(eggs.paths[1], second);
  const Ended ended = sphparam_program(
      {"group", eggs.paths[0], second, "--hold", "--grid", "ico:2", "--size", "0", "-o", eggs.out});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const auto rows = lines_of(bytes_of(eggs.in_out("shapes.tsv")));
  CHECK(cells_of(rows[1]).front() == "egg0");
  CHECK(cells_of(rows[1]).back() == eggs.paths[0]);
  CHECK(cells_of(rows[2]).front() == "egg0_2");
  CHECK(cells_of(rows[2]).back() == second);
}

TEST_CASE("group: a shape in another unit is told, but not where all are brought to one size") {
  const Eggs eggs;
  TriangleMesh metres = read_mesh(fs::path(eggs.paths[2])).mesh;
  metres.positions *= 1e-3;
  write_bytes(eggs.paths[2], obj_text(metres));
  const std::string told = "egg2: its size is ";
  const Ended ended = eggs.group({"--hold", "--size", "0"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains(told) && Contains("one size with --scale") &&
                            !Contains("egg0: its size") && !Contains("egg1: its size"));
  CHECK_THAT(eggs.group({"--hold", "--size", "0", "--scale"}).err, !Contains(told));
}

TEST_CASE("group: the distance that is told is that of the table, by root mean square") {
  const Eggs eggs;
  const Ended ended = eggs.group({"--hold", "--size", "0"});
  REQUIRE(ended.code == 0);
  double squares = 0;
  const auto rows = lines_of(bytes_of(eggs.in_out("shapes.tsv")));
  for (size_t i = 1; i <= 3; ++i) squares += std::pow(std::stod(cells_of(rows[i])[4]), 2) / 3;
  const std::string told = "RMS distance from the mean ";
  const std::size_t at = ended.err.find(told);
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(ended.err.substr(at + told.size())) == Approx(std::sqrt(squares)).epsilon(5e-3));
}

TEST_CASE("group: subjects of FreeSurfer give shapes their names, and two hemispheres are told") {
  const Eggs eggs;
  std::vector<std::string> words{"group"};
  for (const char* name : {"s1/surf/lh.white", "s2/surf/rh.white"}) {
    fs::create_directories(fs::path(eggs.folder / name).parent_path());
    words.push_back(eggs.folder / name);
    REQUIRE(sphparam_program({"repair", eggs.paths[words.size() - 2], "-o", words.back()}).code ==
            0);
  }
  for (const char* word : {"--hold", "--grid", "ico:2", "--size", "0", "-o"}) words.push_back(word);
  words.push_back(eggs.out);
  const Ended ended = sphparam_program(words);
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const auto rows = lines_of(bytes_of(eggs.in_out("shapes.tsv")));
  CHECK(cells_of(rows[1])[0] == "s1_lh_white");
  CHECK(cells_of(rows[2])[0] == "s2_rh_white");
  CHECK(fs::exists(eggs.in_out("map_s2_rh_white.sph.ply")));
  CHECK_THAT(ended.err, Contains("warning: 1 surface of CortexLeft (" + words[1] +
                                 ") and 1 of CortexRight (" + words[2] + ") in one group"));
}

TEST_CASE("group: maps that lie as they are want a map of every shape") {
  const Eggs eggs;
  const std::string mapped = eggs.folder / "egg0.sph.ply";
  REQUIRE(sphparam_program({"map", eggs.paths[0], "-o", mapped}).code == 0);
  const auto group = [&](const std::vector<std::string>& shapes) {
    std::vector<std::string> words{"group"};
    words.insert(words.end(), shapes.begin(), shapes.end());
    words.insert(words.end(),
                 {"--start", "maps", "--hold", "--grid", "ico:2", "--size", "0", "-o", eggs.out});
    return sphparam_program(words);
  };
  const Ended refused = group({mapped, eggs.paths[1]});
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("--start maps: egg1.obj has no map") &&
                              Contains("`sphparam remesh " + eggs.paths[1] + " --sphere"));
  CHECK(group({mapped}).code == 0);
  CHECK(group({eggs.paths[1]}).code == 0);  // alone, it lies as it lies
}

TEST_CASE("group: the record says which shapes had no map, also where maps are moved") {
  const Eggs eggs;
  const std::string mapped = eggs.folder / "mapped.sph.ply";
  REQUIRE(sphparam_program({"map", eggs.paths[1], "-o", mapped}).code == 0);
  for (const char* rounds : {"0", "1"}) {
    const Ended ended =
        sphparam_program({"group", eggs.paths[0], mapped, "--start", "rotation", "--rounds", rounds,
                          "--grid", "ico:3", "--size", "0", "-o", eggs.out});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const Json shapes = Json::parse(bytes_of(eggs.in_out("group.json")))["shapes"];
    CHECK(shapes[0]["mapped_now"] == true);
    CHECK(shapes[1]["mapped_now"] == false);
  }
}

TEST_CASE("group: a run that cannot write leaves no folder, and a wrong landmark costs no maps") {
  const Eggs eggs;
  const std::string long_name =
      eggs.folder / (std::string(245, 'x') + ".obj");  // map_… is too long
  fs::copy(eggs.paths[0], long_name);
  const Ended unwritten = sphparam_program(
      {"group", long_name, "--hold", "--grid", "ico:2", "--size", "0", "-o", eggs.out});
  INFO(unwritten.err);
  CHECK(unwritten.code == 3);
  CHECK_FALSE(fs::exists(eggs.out));
  fs::create_directory(eggs.out);
  CHECK(sphparam_program(
            {"group", long_name, "--hold", "--grid", "ico:2", "--size", "0", "-o", eggs.out})
            .code == 3);
  CHECK(fs::exists(eggs.out));  // which was there

  write_bytes(eggs.paths[1], "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n");  // it cannot be mapped
  write_bytes(eggs.folder / "marks.txt", "100000\n");
  const Ended ended = eggs.group({"--landmarks", eggs.folder / "marks.txt", "--size", "0"});
  CHECK(ended.code == 3);
  CHECK_THAT(ended.err, Contains("marks.txt:1: the mesh has no vertex 100000"));
}

TEST_CASE("group: of files that it does not write, those of an earlier run are told") {
  const Eggs eggs;
  const Ended first = eggs.group({"--size", "0", "--rounds", "0", "--modes", "2"});
  CHECK(first.code == 0);
  CHECK_THAT(first.err, !Contains("earlier run"));
  write_bytes(eggs.in_out("own.txt"), "x");
  const auto again = [&](std::vector<std::string> shapes) {
    shapes.insert(shapes.begin(), "group");
    shapes.insert(shapes.end(), {"--size", "0", "--rounds", "0", "--hold", "--modes", "1", "--grid",
                                 "ico:3", "-o", eggs.out});
    const Ended ended = sphparam_program(shapes);
    INFO(ended.err);
    CHECK(ended.code == 0);
    return ended.err;
  };
  const std::string told = again({eggs.paths[0], eggs.paths[1]});
  CHECK_THAT(told, Contains("map_egg2.sph.ply, mode2.glb, mode2_minus.glb, mode2_plus.glb, "
                            "shape_egg2.sph.ply are of an earlier run") &&
                       !Contains("own.txt") && !Contains("egg1.sph.ply"));
  // What is read is no remainder.
  CHECK_THAT(again({eggs.in_out("map_egg2.sph.ply"), eggs.paths[0], eggs.paths[1]}),
             Contains("shape_egg2") && !Contains(" map_egg2.sph.ply"));
}

TEST_CASE("group: a mesh that cannot be mapped is told with its name") {
  const Eggs eggs;
  write_bytes(eggs.paths[1], "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const Ended ended = eggs.group({"--size", "0"});
  CHECK(ended.code == 4);
  CHECK_THAT(ended.err, Contains("egg1.obj cannot be mapped:") && Contains("not closed"));
  const Ended as_template = sphparam_program(
      {"group", eggs.paths[0], eggs.paths[2], "--template", eggs.paths[1], "-o", eggs.out});
  CHECK(as_template.code == 4);
  CHECK_THAT(as_template.err, Contains("egg1.obj cannot be mapped:"));
}

TEST_CASE("group: what makes no sense is refused, and nothing is written") {
  const Eggs eggs;
  const auto refused = [&](std::vector<std::string> more, int code, const std::string& word) {
    const Ended ended = eggs.group(std::move(more));
    INFO(ended.err);
    CHECK(ended.code == code);
    CHECK_THAT(ended.err, Contains(word));
    CHECK_FALSE(fs::exists(eggs.out));
  };
  refused({"--grid", "cube:8"}, 2, "quads");
  refused({"--grid", "ball"}, 2, "template, or");
  refused({"--size", "10"}, 2, "--size");
  refused({"--start", "luck"}, 2, "ellipsoid");
  write_bytes(eggs.folder / "marks.txt", "0 a\n5 a\n");
  refused({"--landmarks", eggs.folder / "marks.txt", "--size", "0"}, 3, "second landmark");
  write_bytes(eggs.folder / "marks.txt", "100000\n");
  refused({"--landmarks", eggs.folder / "marks.txt", "--size", "0"}, 3,
          "marks.txt:1: the mesh has no vertex 100000");
  CHECK(sphparam_program({"group", "-o", eggs.out}).code == 2);
  CHECK(sphparam_program({"group", eggs.folder / "none.obj", "-o", eggs.out}).code == 3);
  CHECK(sphparam_program({"group", eggs.paths[0], "-o", eggs.folder / "no/where/"}).code == 3);
  write_bytes(eggs.folder / "file", "x");
  CHECK(sphparam_program({"group", eggs.paths[0], "-o", eggs.folder / "file"}).code == 3);
  // What is made of a shape does not replace one.
  const std::string taken = eggs.folder / "shape_egg0.sph.ply";
  REQUIRE(sphparam_program({"map", eggs.paths[0], "-o", taken}).code == 0);
  const Ended ended = sphparam_program({"group", eggs.paths[0], taken, "-o", eggs.folder / ""});
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("it would be replaced"));
}

}  // namespace sphparam::tests
