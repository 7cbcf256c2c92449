#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "support/joined.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// Two balls of radius 1 and 1.5 as files.
struct Balls {
  Folder folder;
  std::string small = folder / "small.obj", large = folder / "large.obj";

  Balls() {
    TriangleMesh ball = icosphere(3);
    write_bytes(small, obj_text(ball));
    ball.positions *= 1.5;
    write_bytes(large, obj_text(ball));
  }

  Ended measure(std::vector<std::string> options) const {
    std::vector<std::string> arguments = {"measure", small, large, "--samples", "5000"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return sphparam_program(arguments);
  }
};

}  // namespace

TEST_CASE("measure: both directions, with MeshLab's keys, and relative to the first mesh") {
  const Balls balls;
  const Ended ended = balls.measure({"--json", "-"});
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  for (const char* direction : {"first_to_second", "second_to_first"}) {
    const Json& side = report[direction];
    for (const char* key : {"RMS", "max", "mean", "min"}) {
      CHECK(side[key].get<double>() == Approx(0.5).margin(0.02));
    }
    CHECK(side["n_samples"] == 5000);
    const double diagonal = report["first"]["diagonal"].get<double>();
    CHECK(side["relative"]["RMS"].get<double>() == Approx(side["RMS"].get<double>() / diagonal));
    CHECK(side["max_bound"].get<double>() >= side["max"].get<double>());
  }
  CHECK(report["first_to_second"]["diag_mesh_1"] == report["second_to_first"]["diag_mesh_0"]);
  CHECK(report["second"]["diagonal"].get<double>() ==
        Approx(1.5 * report["first"]["diagonal"].get<double>()));
}

TEST_CASE("measure: a table for people, the same bytes for any number of threads") {
  const Balls balls;
  const Ended one = balls.measure({"--threads", "1"}), three = balls.measure({"--threads", "3"});
  CHECK(one.code == 0);
  CHECK_THAT(one.out, Contains("1 to 2") && Contains("2 to 1") && Contains("RMS"));
  CHECK(one.out == three.out);
  CHECK(balls.measure({"-q"}).out.empty());
  CHECK(balls.measure({"--seed", "2"}).out != one.out);
}

TEST_CASE(
    "measure: an exceeded limit ends with 6, and what was asked for is written all the same") {
  const Balls balls;
  CHECK(balls.measure({"--max-rms", "0.51", "--max-distance", "0.51"}).code == 0);
  CHECK(balls.measure({"--max-rms", "15%"}).code == 0);  // of a diagonal of 2√3: 0.52
  CHECK(balls.measure({"--max-rms", "14%"}).code == 6);
  const std::string json = balls.folder / "report.json";
  const Ended ended = balls.measure({"--max-distance", "0.4", "--json", json});
  CHECK(ended.code == 6);
  CHECK_THAT(ended.err, Contains("--max-distance 0.4"));
  const Json limit = Json::parse(bytes_of(json))["limits"][0];
  CHECK(limit["exceeded"] == true);
  const std::string measured = limit["measured"].dump(),
                    just_below = Json(limit["measured"].get<double>() * (1 - 1e-12)).dump();
  CHECK_THAT(balls.measure({"--max-distance", just_below}).err,
             Contains("measured " + measured + ", more than --max-distance " + just_below));
}

TEST_CASE("measure: the distance of every vertex, as a property and as colours") {
  const Balls balls;
  const std::string file = balls.folder / "error.ply";
  REQUIRE(balls.measure({"--per-vertex", file}).code == 0);
  const Ended info = sphparam_program({"info", file, "--json", "-"});
  REQUIRE(info.code == 0);
  const Json properties = Json::parse(info.out)["input"]["vertex_properties"];
  for (const char* name : {"error", "red", "green", "blue"}) {
    CHECK(std::count(properties.begin(), properties.end(), name) == 1);
  }
}

TEST_CASE("measure: --signed says which side, in the report, the table and the file") {
  const Balls balls;
  const std::string file = balls.folder / "deviation.ply", json = balls.folder / "d.json";
  const Ended ended = balls.measure({"--signed", "--per-vertex", file, "--json", json});
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(bytes_of(json));
  const Json side = report["first_to_second"];
  CHECK(side["signed"]["min"].get<double>() == -side["max"].get<double>());
  CHECK(side["signed"]["max"].get<double>() == -side["min"].get<double>());
  CHECK(side["signed"]["mean"].get<double>() == -side["mean"].get<double>());
  CHECK_FALSE(report["second_to_first"].contains("signed"));
  CHECK_THAT(ended.out, Contains("\nsigned, of 1 from 2, less than 0 inside: from -0."));
  const Ended info = sphparam_program({"info", file, "--json", "-"});
  const Json properties = Json::parse(info.out)["input"]["vertex_properties"];
  for (const char* name : {"error", "deviation", "red"})
    CHECK(std::count(properties.begin(), properties.end(), name) == 1);
  TriangleMesh inside_out = icosphere(3);  // its sum is another one, by rounding
  inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
  const std::string turned = balls.folder / "turned.obj";
  write_bytes(turned, obj_text(inside_out));
  CHECK_THAT(sphparam_program({"measure", balls.small, turned, "--samples", "100"}).out,
             Contains("\nvolume: 4.1") && !Contains(" more (") && !Contains(" less ("));
  const std::string open = balls.folder / "open.obj";
  write_bytes(open, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Ended refused = sphparam_program({"measure", balls.small, open, "--signed"});
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err,
             Contains("open.obj") && Contains("it is not closed") && Contains("3 edges are open") &&
                 Contains("close it alone first, as `sphparam repair B -o closed.ply` does"));
  CHECK(sphparam_program({"measure", open, balls.small, "--signed"}).code == 0);
}

TEST_CASE("measure: --signed by the fillers of holes that were kept, distances to the rest") {
  const Balls balls;
  TriangleMesh open = icosphere(3);
  open.positions *= 1.5;
  open.triangles.conservativeResize(open.face_count() - 8, 3);
  const std::string holed = balls.folder / "holed.obj", kept = balls.folder / "kept.ply";
  write_bytes(holed, obj_text(open));
  REQUIRE(sphparam_program({"repair", holed, "-o", kept, "--repair", "--keep-holes=20%"}).code ==
          0);
  const auto measured = [&](const std::string& other, const std::string& option) {
    return sphparam_program(
        {"measure", balls.small, other, "--samples", "5000", "--json", "-", option});
  };
  const Ended ended = measured(kept, "--signed");
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json side = Json::parse(ended.out)["first_to_second"];
  CHECK(side["signed"]["max"] < 0.0);  // all of it is inside, also before the hole
  CHECK(side["signed"]["mean"].get<double>() == -side["mean"].get<double>());
  const Json plain = Json::parse(measured(holed, "--upright").out)["first_to_second"];
  CHECK(side["RMS"] == plain["RMS"]);
  CHECK(measured(holed, "--signed").code == 4);
}

TEST_CASE("measure: a mesh and its copy with a global shift are asked about") {
  const Balls balls;
  TriangleMesh far = icosphere(3);
  far.positions.rowwise() += Eigen::RowVector3d(500000, 5200000, 0);
  const std::string shifted = balls.folder / "shifted.obj";
  write_bytes(shifted, obj_text(far));
  const std::string asked =
      "small.obj and shifted.obj are 5.224e+06 from one another, farther than either is large";
  const Ended ended = sphparam_program({"measure", balls.small, shifted, "--samples", "100"});
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains(asked) && Contains("--align rigid first puts B onto A"));
  CHECK_THAT(balls.measure({}).err, !Contains("farther than either"));
  const Ended aligned =
      sphparam_program({"measure", balls.small, shifted, "--samples", "100", "--align", "rigid"});
  CHECK_THAT(aligned.err, !Contains("farther than either"));
}

TEST_CASE("measure: colours of --signed are about 0 where all is outside, and over a --range") {
  const Balls balls;
  const std::string file = balls.folder / "d.ply";
  const auto comment = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line = {"measure", balls.large, balls.small,    "--samples",
                                     "100",     "--signed",  "--per-vertex", file};
    line.insert(line.end(), more.begin(), more.end());
    REQUIRE(sphparam_program(line).code == 0);
    return read_mesh(file).comments.back();
  };
  CHECK_THAT(comment({}), Contains("deviation: distance to small.obj, less than 0 inside, colours "
                                   "from -0.5"));
  CHECK(read_mesh(file).find_vertex_property("red")->values[0] >
        read_mesh(file).find_vertex_property("blue")->values[0]);
  CHECK_THAT(comment({"--range", "-0.1,0.1"}), Contains("colours from -0.1 to 0.1"));
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--range", "0,1"},
        {"--range", "1,0", "--per-vertex", file},
        {"--range", "0,1", "--per-vertex", file, "--growth"}})
    CHECK(balls.measure(wrong).code == 2);
}

TEST_CASE("measure: what A has already by the names of what is measured stays, by others") {
  const Folder folder;
  const std::string a = folder / "a.ply", b = folder / "b.obj", out = folder / "out.ply";
  write_bytes(b, "v 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\n");
  write_bytes(a,
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
              "property double z\nproperty double error\nproperty double error_a\n"
              "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
              "property list uchar int vertex_indices\nend_header\n0 0 0 5 6 1 2 3\n"
              "1 0 0 5 6 1 2 3\n0 1 0 5 6 1 2 3\n3 0 1 2\n");
  const Ended ended =
      sphparam_program({"measure", a, b, "--per-vertex", out, "--json", folder / "m.json"});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("numbers that a.ply has already are called otherwise in out.ply: "
                                 "error is error_a_a, red is red_a, green is green_a, blue is "
                                 "blue_a"));
  CHECK(Json::parse(bytes_of(folder / "m.json"))["renamed"] ==
        Json({{"error", "error_a_a"}, {"red", "red_a"}, {"green", "green_a"}, {"blue", "blue_a"}}));
  const MeshFile written = read_mesh(out);
  const auto first = [&](const char* name) {
    return written.find_vertex_property(name)->values.front();
  };
  CHECK(first("error") == 2);
  CHECK(first("error_a") == 6);
  CHECK(first("error_a_a") == 5);
  CHECK(first("green_a") == 2);
  const Json report =
      Json::parse(sphparam_program({"measure", b, a, "--per-vertex", out, "--json", "-"}).out);
  CHECK(report["renamed"] == Json::object());
}

TEST_CASE("measure: median, percentiles and the share within a length, in report and table") {
  const Folder folder;
  const std::string a = folder / "a.obj", b = folder / "b.obj";
  write_bytes(a, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_bytes(b, "v 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\n");
  const Ended ended = sphparam_program({"measure", a, b, "--within", "2", "--json", "-"});
  const Json report = Json::parse(ended.out);
  for (const char* way : {"first_to_second", "second_to_first"}) {
    for (const char* key : {"median", "P95", "P99"}) CHECK(report[way][key] == 2.0);
    CHECK(report[way]["SD"] == 0.0);
    CHECK(report[way]["within"] == Json({{"length", 2.0}, {"share", 1.0}}));
  }
  CHECK(report["two_sided"]["HD95"] == 2.0);
  // Of a diagonal of √2.
  CHECK_THAT(sphparam_program({"measure", a, b, "--within", "100%"}).out,
             Contains("\nthe larger 95 % (HD95): 2\n") &&
                 Contains("\nwithin 1.41421: 0 % of 1, 0 % of 2\n"));
  CHECK(sphparam_program({"measure", a, b, "--within", "-1"}).code == 2);
}

TEST_CASE("measure: one body in two units is asked after, a part of a whole is not") {
  const Folder folder;
  const auto file = [&](const char* name, double scale, double long_side) {
    TriangleMesh ball = icosphere(2);
    ball.positions.col(0) *= long_side;
    ball.positions *= scale;
    write_bytes(folder / name, obj_text(ball));
    return folder / name;
  };
  const auto said = [&](const std::string& a, const std::string& b) {
    return sphparam_program({"measure", a, b, "--samples", "100"}).err;
  };
  const std::string one = file("mm.obj", 10, 2), same = file("m.obj", 0.009, 2);
  CHECK_THAT(said(one, same), Contains("m.obj is 1111 times smaller than mm.obj, and of the "
                                       "same proportions: are both in one unit, not in mm and m?"));
  CHECK_THAT(said(file("inch.obj", 0.4, 2), one), Contains("inch.obj is 25 times smaller than "
                                                           "mm.obj") &&
                                                      Contains("mm and inches"));
  for (const std::string& other : {file("large.obj", 60, 2), file("part.obj", 0.01, 1)})
    CHECK_THAT(said(one, other), !Contains("times smaller"));
}

TEST_CASE("measure: --leave-out-border leaves out what lies over holes, grey in the file") {
  const Balls balls;
  TriangleMesh half = icosphere(3);
  half.positions *= 1.5;
  half.triangles.conservativeResize(half.face_count() / 2, 3);
  const std::string scan = balls.folder / "scan.obj", file = balls.folder / "error.ply";
  write_bytes(scan, obj_text(half));
  const auto measured = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"measure", balls.small, scan, "--samples", "5000"});
    return sphparam_program(options);
  };
  const std::string json = balls.folder / "report.json";
  const Ended ended = measured({"--leave-out-border", "--per-vertex", file, "--json", json});
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(bytes_of(json)), &forth = report["first_to_second"];
  CHECK(forth["left_out"].get<double>() == Approx(0.5).margin(0.05));
  CHECK(forth["n_samples"].get<double>() == Approx(5000 * (1 - forth["left_out"].get<double>())));
  CHECK(forth["max"].get<double>() < 0.51);
  CHECK(forth["max_bound"].is_null());
  CHECK(report["second_to_first"]["left_out"] == 0.0);
  CHECK_THAT(ended.out, Contains("\nleft out, nearest to the border of the other: ") &&
                            Contains(" of 1, 0 % of 2\n") && Contains("; of samples and vertices"));
  const MeshFile written = read_mesh(file);
  const auto& marks = written.find_vertex_property("left_out")->values;
  const auto& errors = written.find_vertex_property("error")->values;
  for (std::size_t v = 0; v < marks.size(); ++v) {
    for (const char* colour : {"red", "green", "blue"})
      if (marks[v] != 0) CHECK(written.find_vertex_property(colour)->values[v] == 128);
    if (marks[v] == 0) CHECK(errors[v] < 0.51);
  }
  CHECK(std::ranges::count(marks, 1.0) > 200);
  CHECK(*std::ranges::max_element(errors) > 1);
  const Json plain = Json::parse(measured({"--json", "-"}).out);
  CHECK_FALSE(plain["first_to_second"].contains("left_out"));
}

TEST_CASE("measure: volumes of closed surfaces, and what the second has more") {
  const Balls balls;
  const Ended ended = balls.measure({"--json", "-"});
  const Json report = Json::parse(ended.out);
  const double small = report["first"]["volume"], large = report["second"]["volume"];
  CHECK(large == Approx(3.375 * small).epsilon(1e-12));
  CHECK_THAT(balls.measure({}).out, Contains("\nvolume: 4.1") && Contains(" more (237 %)\n"));
  const std::string open = balls.folder / "open.obj";
  write_bytes(open, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto with_open = [&](const std::string& option) {
    return sphparam_program({"measure", balls.small, open, "--samples", "100", option, "-"}).out;
  };
  CHECK(Json::parse(with_open("--json"))["second"]["volume"].is_null());
  CHECK_THAT(sphparam_program({"measure", balls.small, open, "--samples", "100"}).out,
             !Contains("volume"));
}

TEST_CASE("measure: --growth says how areas grow between surfaces of the same triangles") {
  const Folder folder;
  TriangleMesh ball = icosphere(2);
  const std::string one = folder / "one.obj", two = folder / "two.obj", file = folder / "g.ply";
  write_bytes(one, obj_text(ball));
  ball.positions *= 2;
  write_bytes(two, obj_text(ball));
  const std::vector<std::string> words{"measure",      one,        two,      "--samples",
                                       "100",          "--growth", "--json", folder / "m.json",
                                       "--per-vertex", file};
  const Ended ended = sphparam_program(words);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.out,
             Contains("\ngrowth, area of 2 over that of 1: 4, of triangles from 4 to 4\n"));
  const Json report = Json::parse(bytes_of(folder / "m.json"));
  CHECK(report["growth"] == Json({{"total", 4.0}, {"min", 4.0}, {"max", 4.0}}));
  const MeshFile written = read_mesh(file);
  for (const Property* property :
       {written.find_vertex_property("growth"), written.find_face_property("growth")}) {
    REQUIRE(property);
    CHECK(std::ranges::count(property->values, 4.0) == std::ssize(property->values));
  }
  CHECK(written.find_vertex_property("error") != nullptr);
  CHECK(written.find_vertex_property("red")->values[0] == 253);
  CHECK(std::ranges::count(written.comments, "error: distance to two.obj") == 1);
  CHECK_FALSE(
      Json::parse(sphparam_program({"measure", one, two, "--json", "-"}).out).contains("growth"));
  write_bytes(two, obj_text(icosphere(1)));
  const Ended refused = sphparam_program(words);
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("--growth: two.obj has not the triangles of one.obj"));
}

TEST_CASE("measure: a glTF file that export has turned is told of, one that it has not is not") {
  const Folder folder;
  TriangleMesh limb = icosphere(2);
  limb.positions.col(2) *= 3;
  write_bytes(folder / "limb.obj", obj_text(limb));
  const auto said = [&](const std::vector<std::string>& up) {
    std::vector<std::string> arguments = {"export", folder / "limb.obj", "-o", folder / "limb.glb"};
    arguments.insert(arguments.end(), up.begin(), up.end());
    REQUIRE(sphparam_program(arguments).code == 0);
    const Ended ended = sphparam_program(
        {"measure", folder / "limb.glb", folder / "limb.obj", "--samples", "2000"});
    CHECK(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(said({}), Contains("y points up in limb.glb, which is glTF, and in limb.obj nothing "
                                "says what does: they may be turned; --upright measures them"));
  const Ended upright = sphparam_program({"measure", folder / "limb.glb", folder / "limb.obj",
                                          "--samples", "2000", "--upright", "--json", "-"});
  CHECK_THAT(upright.err, Contains("limb.obj is turned as limb.glb stands: z, which is up, to y, "
                                   "and -y, the front, to z"));
  const Json report = Json::parse(upright.out);
  CHECK(report["upright"] == true);
  CHECK(report["two_sided"]["max"] < 1e-6);  // numbers of 32 bits
  CHECK_THAT(said({"--up", "y"}), !Contains("glTF"));
}

TEST_CASE("measure: files that say how they stand are told to stand otherwise, or taken upright") {
  const Folder folder;
  const auto file = [&](const char* name, const Eigen::RowVector3d& far, const char* comments) {
    std::string text =
        "ply\nformat ascii 1.0\n" + std::string(comments) +
        "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n";
    for (const Eigen::RowVector3d& place : {far, Eigen::RowVector3d(far.z(), 1, far.x())}) {
      for (const double x : place) text += std::to_string(x) + " ";
      text += "\n";
    }
    write_bytes(folder / name, text + "3 0 1 2\n");
    return folder / name;
  };
  const char* y_up = "comment up axis y\ncomment front axis -z\n";
  const std::string a = file("a.ply", {1, 2, 3}, y_up);
  const std::string same = file("same.ply", {1, 2, 4}, y_up);
  // Half a turn about y: its corners are those of a where they stand.
  const std::string b = file("b.ply", {-1, 2, -3}, "comment up axis y\ncomment front axis z\n");
  const auto measured = [&](const std::string& other, const char* option) {
    const Ended ended = sphparam_program({"measure", a, other, option, "--json", "-"});
    REQUIRE(ended.code == 0);
    return ended;
  };
  CHECK_THAT(measured(b, "--samples=2000").err,
             Contains("-z looks at who sees a.ply, and in b.ply z does: they may be turned; "
                      "--upright measures them as they stand"));
  CHECK_THAT(measured(same, "--samples=2000").err, !Contains("turned"));
  CHECK_THAT(measured(file("raw.ply", {-1, 2, -3}, ""), "--samples=2000").err, !Contains("turned"));
  const Ended upright = measured(b, "--upright");
  CHECK_THAT(upright.err, !Contains("may be turned") && Contains("z, the front, to -z"));
  CHECK(Json::parse(upright.out)["first_to_second"]["max"] == 0.0);
}

TEST_CASE("measure: a body that is nearly round is told of as well where glTF has turned it") {
  const Folder folder;
  TriangleMesh body = icosphere(3);
  body.positions *= Eigen::Vector3d(3, 1, 0.93).asDiagonal();
  write_bytes(folder / "body.obj", obj_text(body));
  TriangleMesh other = body;
  other.positions.col(2) *= 0.98;
  write_bytes(folder / "other.obj", obj_text(other));
  const auto said = [&](const std::vector<std::string>& exported, const char* measured) {
    REQUIRE(sphparam_program(exported).code == 0);
    const Ended ended = sphparam_program(
        {"measure", folder / measured, folder / "body.glb", "--samples", "2000", "--json", "-"});
    CHECK(Json::parse(ended.out)["two_sided"]["relative"]["RMS"] < 0.01);
    return ended.err;
  };
  const std::vector<std::string> turns = {"export", folder / "body.obj", "-o", folder / "body.glb"};
  CHECK_THAT(said(turns, "body.obj"), Contains("y points up in body.glb, which is glTF"));
  CHECK_THAT(said(turns, "other.obj"), Contains("y points up in body.glb, which is glTF"));
  std::vector<std::string> stays = turns;
  stays.insert(stays.end(), {"--up", "y"});
  CHECK_THAT(said(stays, "other.obj"), !Contains("glTF"));
}

TEST_CASE("measure: --align puts B onto A first, and tells the matrix") {
  const Folder folder;
  TriangleMesh body = icosphere(3);
  for (Vertex v = 0; v < body.vertex_count(); ++v) {
    const Vector3 x = body.position(v);
    const double lump = std::exp(-8 * (x - Vector3(0.8, 0.5, 0.33).normalized()).squaredNorm());
    body.positions.row(v) = (1 + 0.4 * lump) * x.cwiseProduct(Vector3(1.5, 1.1, 0.8));
  }
  const std::string a = folder / "a.obj", b = folder / "b.obj", c = folder / "c.obj";
  write_bytes(a, obj_text(body));
  // (x, y, z) ↦ (10 − x, −y, z): half a turn about z, after which all but the lump fits.
  TriangleMesh turned = body;
  turned.positions.col(0) = 10 - body.positions.col(0).array();
  turned.positions.col(1) = -body.positions.col(1);
  write_bytes(b, obj_text(turned));
  turned.positions *= 1000;
  write_bytes(c, obj_text(turned));
  const auto aligned = [&](const std::string& other, const std::string& word,
                           std::vector<std::string> options = {"--json", "-"}) {
    options.insert(options.begin(), {"measure", a, other, "--samples", "1000", "--align", word});
    return sphparam_program(options);
  };
  CHECK(Json::parse(aligned(b, "none").out)["alignment"].is_null());
  const Ended ended = aligned(b, "rigid");
  CHECK(ended.code == 0);
  const Json report = Json::parse(ended.out), &alignment = report["alignment"];
  const double wanted[4][4] = {{-1, 0, 0, 10}, {0, -1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      CHECK(alignment["matrix"][i][k].get<double>() == Approx(wanted[i][k]).margin(1e-12));
  CHECK(alignment["kind"] == "rigid");
  CHECK(alignment["scale"] == 1);
  CHECK(alignment["degrees"].get<double>() == Approx(180).epsilon(1e-12));
  CHECK(alignment["start"] == "principal axes");
  CHECK(alignment["kept"] == 1);
  CHECK(report["two_sided"]["max"].get<double>() < 1e-12);
  CHECK_THAT(ended.err, !Contains("may be turned"));

  const Ended scaled = aligned(c, "similarity");
  CHECK(Json::parse(scaled.out)["alignment"]["scale"].get<double>() ==
        Approx(0.001).epsilon(1e-12));
  CHECK_THAT(scaled.err, !Contains("are both in one unit"));
  const Ended table = aligned(c, "similarity", {});
  CHECK_THAT(table.out,
             Contains("2 is put onto 1: turned by 180°, scaled by 0.001, and moved; sought "
                      "from principal axes; RMS ") &&
                 Contains(" of the 100 % of samples within ") && Contains("; its matrix:\n") &&
                 Contains("\n  0 0 0 1\n"));
  const std::string onto = folder / "onto.ply";
  CHECK(aligned(b, "rigid", {"--aligned", onto, "-q"}).code == 0);
  CHECK((read_mesh(onto).mesh.positions - body.positions).cwiseAbs().maxCoeff() < 1e-12);
  CHECK_THAT(aligned(b, "none", {"--aligned", onto}).err,
             Contains("--aligned is of B as --align puts it onto A"));
  CHECK_THAT(aligned(b, "rigid", {"--aligned", "onto.doc"}).err, Contains("--aligned"));
  const std::string normals = folder / "normals.obj";
  write_bytes(normals,
              "v 0 0 0\nv 9 0 0\nv 0 5 0\nv 0 0 1\nvn 0 0 1\n"
              "f 1//1 3//1 2//1\nf 1//1 2//1 4//1\nf 2//1 3//1 4//1\nf 3//1 1//1 4//1\n");
  const Ended told = sphparam_program(
      {"measure", normals, normals, "--samples", "100", "--align", "rigid", "--aligned", onto});
  CHECK_THAT(told.err, Contains("normals of normals.obj are left out of onto.ply"));
  CHECK_FALSE(read_mesh(onto).corner_normals);
  CHECK_THAT(aligned(b, "loosely").err, Contains("none, rigid, similarity"));
  const std::string flat = folder / "flat.obj";
  TriangleMesh point = body;
  point.positions.setOnes();
  write_bytes(flat, obj_text(point));
  CHECK_THAT(aligned(flat, "rigid").err, Contains("flat.obj: it is too"));
}

TEST_CASE("measure: meshes that are no spheres are measured too, empty ones are not") {
  const Folder folder;
  const std::string one = folder / "one.obj", two = folder / "two.obj",
                    empty = folder / "empty.obj";
  write_bytes(one, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_bytes(two, "v 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\n");
  write_bytes(empty, "v 0 0 0\n");
  const Ended ended = sphparam_program({"measure", one, two, "--json", "-"});
  REQUIRE(ended.code == 0);
  CHECK(Json::parse(ended.out)["two_sided"]["max"] == 2.0);
  CHECK(Json::parse(ended.out)["two_sided"]["RMS"] == 2.0);
  for (const auto& pair : {std::pair(one, empty), std::pair(empty, one)}) {
    const Ended refused = sphparam_program({"measure", pair.first, pair.second});
    CHECK(refused.code == 3);
    CHECK_THAT(refused.err, Contains("empty.obj") && Contains("no triangles"));
    CHECK(refused.out.empty());
  }
  write_bytes(empty, "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const Ended flat = sphparam_program({"measure", one, empty});
  CHECK(flat.code == 4);
  CHECK_THAT(flat.err, Contains("empty.obj") && Contains("no area"));
}

TEST_CASE(
    "measure: what repair leaves of a mesh is told with its name, and so is a wrong component") {
  const Folder folder;
  const std::string pair = folder / "pair.obj", ball = folder / "ball.obj";
  TriangleMesh smaller = icosphere(1);
  smaller.positions *= 0.9;
  write_bytes(pair, obj_text(joined(icosphere(1), smaller, {3, 0, 0})));
  write_bytes(ball, obj_text(icosphere(1)));
  const auto measure = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"measure", pair, ball, "--samples", "2000"});
    return sphparam_program(more);
  };
  const Ended left = measure({"--repair"});
  INFO(left.err);
  CHECK(left.code == 0);
  CHECK_THAT(left.err,
             Contains("pair.obj: not mended, and taken as it is: 2 separate components") &&
                 !Contains("ball.obj: not mended"));
  CHECK_THAT(measure({}).err, !Contains("not mended"));
  const std::string twice = folder / "twice.obj";
  const std::string text = obj_text(joined(icosphere(1), smaller, {3, 0, 0}));
  write_bytes(twice, text + text.substr(text.rfind('f')));
  CHECK_THAT(sphparam_program({"measure", twice, ball, "--samples", "2000", "--repair"}).err,
             Contains("1 duplicate face removed") &&
                 Contains("twice.obj: mended no farther than that, and taken so: 2 separate") &&
                 !Contains("not mended"));
  CHECK_THAT(measure({"--component", "1"}).err, !Contains("not mended"));
  const Ended none = measure({"--component", "2"});
  CHECK(none.code == 2);
  CHECK_THAT(none.err, Contains("--component: ball.obj: there is no component 2: the mesh has 1"));
}

TEST_CASE("measure: command lines that make no sense end with 2 and write nothing") {
  const Balls balls;
  const std::string file = balls.folder / "out.ply";
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--samples", "0"},
                                                {"--samples", "-5"},
                                                {"--over", "faecs"},
                                                {"--over", ""},
                                                {"--max-rms", "much"},
                                                {"--max-rms", "-1"},
                                                {"--max-rms", "nan"},
                                                {"--per-vertex", "error.obj"},
                                                {"--per-vertex", file, "--json", file},
                                                {"--json", balls.small}}) {
    INFO(wrong[0] << " " << wrong[1]);
    const Ended ended = balls.measure(wrong);
    CHECK(ended.code == 2);
    CHECK(ended.out.empty());
  }
  CHECK(sphparam_program({"measure", "-", "-"}).code == 2);
  CHECK(sphparam_program({"measure", balls.small}).code == 2);
  CHECK(balls.folder.names() == std::vector<std::string>{"large.obj", "small.obj"});
}

}  // namespace sphparam::tests
