#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.h"
#include "sphparam/io/vertex_data.h"
#include "support/test_meshes.h"

/// Batches as users run them.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// A folder with balls and what is none.
struct Shapes {
  Folder folder;
  std::string work = folder / "work";

  explicit Shapes(int good = 3) {
    fs::create_directories(folder / "in");
    for (int i = 0; i < good; ++i) {
      TriangleMesh ball = icosphere(2);
      ball.positions.col(0) *= 1 + 0.3 * i;
      write_bytes(folder / ("in/ball" + std::to_string(i) + ".obj"), obj_text(ball));
    }
  }
  void add_bad() const {
    write_bytes(folder / "in/bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }

  Ended plan(std::vector<std::string> words = {"map"}, const std::string& chunk = "2") const {
    words.insert(words.begin(),
                 {"batch", "plan", folder / "in", "-o", work, "--chunk", chunk, "--"});
    return sphparam_program(words);
  }
  Ended batch(const std::string& command, std::vector<std::string> words = {}) const {
    words.insert(words.begin(), {"batch", command, work});
    return sphparam_program(words);
  }
  Json status() const { return Json::parse(batch("status", {"--json", "-", "-q"}).out); }
  Json record(const std::string& id) const {
    return Json::parse(bytes_of(work + "/results/" + id + "/record.json"));
  }
  std::string map(const std::string& id) const {
    return bytes_of(work + "/results/" + id + "/" + id + ".sph.ply");
  }
};

}  // namespace

TEST_CASE("batch: all shapes are mapped, the same bytes as by map, and a bad one stops nobody") {
  const Shapes shapes;
  shapes.add_bad();
  REQUIRE(shapes.plan().code == 0);
  const Ended run = shapes.batch("run", {"--threads", "2"});
  CHECK(run.code == 0);
  CHECK_THAT(run.err, Contains("4 items: 3 done, 1 failed, 0 done before"));
  REQUIRE(
      sphparam_program({"map", shapes.folder / "in/ball1.obj", "-o", shapes.folder / "m.sph.ply"})
          .code == 0);
  CHECK(shapes.map("ball1") == bytes_of(shapes.folder / "m.sph.ply"));
  CHECK(shapes.record("ball1")["outcome"] == "certified");
  CHECK(shapes.record("ball1")["steps"][0]["report"]["certificate"]["one_to_one"] == true);
  const Json failure = Json::parse(bytes_of(shapes.work + "/failed/bad.json"));
  CHECK(failure["code"] == 4);
  CHECK_THAT(failure["log"].get<std::string>(), Contains("hint"));
  CHECK(fs::is_empty(shapes.work + "/staging"));
  CHECK(shapes.batch("run", {"--strict"}).code == 4);
}

TEST_CASE("batch: what is done is skipped until its input, its options or its files change") {
  const Shapes shapes;
  shapes.plan();
  shapes.batch("run");
  CHECK_THAT(shapes.batch("run").err, Contains("3 items: 0 done, 0 failed, 3 done before"));
  CHECK_THAT(shapes.batch("run", {"--rehash"}).err, Contains("3 done before"));

  fs::remove(shapes.work + "/results/ball0/ball0.sph.ply");
  CHECK_THAT(shapes.batch("run").err, Contains("1 done, 0 failed, 2 done before"));

  write_bytes(shapes.folder / "in/ball1.obj", obj_text(icosphere(1)));
  CHECK_THAT(shapes.batch("run").err, Contains("0 done, 1 failed, 2 done before"));
  CHECK_THAT(shapes.batch("status").out, Contains("the input has changed since the plan"));
  shapes.plan();
  CHECK_THAT(shapes.batch("run").err, Contains("1 done, 0 failed, 2 done before"));

  shapes.plan({"map", "--quality", "draft"});
  CHECK_THAT(shapes.batch("run").err, Contains("3 done, 0 failed, 0 done before"));
  CHECK(shapes.status()["done"] == 3);
}

TEST_CASE("batch: a mesh whose buffer or material library changes is another input") {
  const Shapes shapes(1);
  const auto write_buffer = [&](float height) {
    const float points[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, height};
    const std::uint16_t corners[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    write_bytes(shapes.folder / "in/x.gltf.bin",
                std::string(reinterpret_cast<const char*>(points), sizeof points) +
                    std::string(reinterpret_cast<const char*>(corners), sizeof corners));
  };
  write_bytes(shapes.folder / "in/x.gltf", R"({"asset": {"version": "2.0"},
    "buffers": [{"uri": "x.gltf.bin", "byteLength": 72}],
    "bufferViews": [{"buffer": 0, "byteLength": 48},
                    {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 9]},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})");
  write_buffer(1);
  const std::string ball = shapes.folder / "in/ball0.obj";
  write_bytes(ball, "mtllib ball.mtl\n" + bytes_of(ball));
  shapes.plan();
  CHECK_THAT(shapes.batch("run").err, Contains("2 items: 2 done, 0 failed, 0 done before"));
  CHECK_THAT(shapes.batch("run").err, Contains("0 done, 0 failed, 2 done before"));
  const std::string map = shapes.map("x");

  write_buffer(3);
  CHECK_THAT(shapes.batch("run").err, Contains("0 done, 1 failed, 1 done before"));
  CHECK_THAT(shapes.batch("status").out,
             Contains("the input has changed since the plan, or a file that it names"));
  shapes.plan();
  CHECK_THAT(shapes.batch("run").err, Contains("1 done, 0 failed, 1 done before"));
  CHECK(shapes.map("x") != map);

  write_bytes(shapes.folder / "in/ball.mtl", "newmtl m\n");
  shapes.plan();
  CHECK_THAT(shapes.batch("run").err, Contains("1 done, 0 failed, 1 done before"));
}

TEST_CASE("batch: data that the options name is part of the input, as the mesh is") {
  const Shapes shapes(2);
  const auto write_data = [&](const std::string& name, double value) {
    VertexData data;
    data.columns.push_back({"", ScalarType::Float32, std::vector<double>(162, value)});
    write_vertex_data(shapes.folder / name, data);
  };
  write_data("a.shape.gii", 1);
  write_data("b.shape.gii", 2);
  write_bytes(shapes.folder / "t.tsv", "path\tsulc\nin/ball0.obj\t" +
                                           (shapes.folder / "a.shape.gii") + "\nin/ball1.obj\t" +
                                           (shapes.folder / "b.shape.gii") + "\n");
  const auto plan = [&] {
    return sphparam_program({"batch", "plan", shapes.folder / "t.tsv", "-o", shapes.work, "--chunk",
                             "1", "--", "map", "--data", "{sulc}"})
        .code;
  };
  REQUIRE(plan() == 0);
  CHECK_THAT(shapes.batch("run").err, Contains("2 items: 2 done, 0 failed, 0 done before"));
  CHECK_THAT(shapes.batch("run").err, Contains("0 done, 0 failed, 2 done before"));
  write_data("b.shape.gii", 3);
  CHECK_THAT(shapes.batch("run").err, Contains("0 done, 1 failed, 1 done before"));
  CHECK_THAT(shapes.batch("status").out,
             Contains("a file that the options name has changed since the plan"));
  REQUIRE(plan() == 0);
  CHECK_THAT(shapes.batch("run").err, Contains("1 done, 0 failed, 1 done before"));
}

TEST_CASE("batch: texts that are too long for names are no files, and no error of ours") {
  const Shapes shapes(1);
  const std::string text(300, 't');
  write_bytes(shapes.folder / "t.csv", "path,remark\nin/ball0.obj," + text + "\n");
  CHECK(sphparam_program({"batch", "plan", shapes.folder / "t.csv", "-o", shapes.work, "--chunk",
                          "1", "--", "map"})
            .code == 0);
  const Ended status = sphparam_program({"batch", "status", shapes.folder / text});
  CHECK(status.code == 3);
  CHECK_THAT(status.err, Contains("no batch in this folder"));
}

TEST_CASE("batch: a plan never changes, tasks that wait run what they were planned for") {
  const Shapes shapes;
  shapes.plan();
  const std::string first = bytes_of(shapes.work + "/plan").substr(0, 16);
  const std::string manifest = bytes_of(shapes.work + "/plan-" + first + ".tsv");
  shapes.plan({"map", "--quality", "draft"});
  CHECK(bytes_of(shapes.work + "/plan-" + first + ".tsv") == manifest);
  CHECK_THAT(bytes_of(shapes.work + "/array.sbatch"), !Contains(first));
  CHECK(shapes.batch("run", {"--plan", first, "--task", "1"}).code == 0);
  CHECK(shapes.record("ball0")["steps"][0]["command"].size() == 4);
  write_bytes(shapes.work + "/plan-" + first + ".tsv", manifest + "\n");
  const Ended changed = shapes.batch("run", {"--plan", first});
  CHECK(changed.code == 3);
  CHECK_THAT(changed.err, Contains("it was changed"));
}

TEST_CASE("batch: the script of a batch that was moved says what mends it, which does") {
  const Shapes shapes(1);
  shapes.plan({"map"}, "1");
  const std::string moved = shapes.folder / "moved", script = moved + "/array.sbatch";
  fs::rename(shapes.work, moved);
  const std::string said = shapes.folder / "said", command = "SLURM_ARRAY_TASK_ID=1 sh ";
  CHECK(std::system((command + script + " 2>" + said).c_str()) != 0);
  std::string advice = bytes_of(said);
  CHECK_THAT(advice, Contains("its folder is not there; if it was moved to NEW, `sed -i"));
  for (std::size_t at; (at = advice.find("NEW")) != std::string::npos;)
    advice.replace(at, 3, "moved");
  CHECK(type_advice(advice.substr(0, advice.find("Try")), shapes.folder / ".") == 2);
  CHECK(fs::exists(moved + "/results/ball0/ball0.sph.ply"));
  CHECK_THAT(bytes_of(script), Contains("\"moved/logs/") && !Contains(shapes.work));
}

TEST_CASE("batch: failures are tried again when somebody says so, and attempts are counted") {
  const Shapes shapes(1);
  shapes.add_bad();
  shapes.plan();
  shapes.batch("run");
  CHECK_THAT(shapes.batch("run").err, Contains("1 failed before"));
  CHECK_THAT(shapes.batch("retry", {"--code", "5"}).err, Contains("0 items in 0 tasks"));
  const Ended retry = shapes.batch("retry", {"--code", "4,5"});
  CHECK_THAT(retry.err, Contains("1 item in 1 task") && Contains("--array=1 "));
  const Json waiting = shapes.status();
  CHECK(waiting["to_retry"] == 1);
  CHECK(waiting["done"].get<int>() + waiting["failed"].get<int>() + waiting["open"].get<int>() ==
        waiting["items"]);
  CHECK_THAT(shapes.batch("status").out, Contains("2 items: 1 done (50 %), 1 failed, 0 open") &&
                                             Contains("to be tried again: 1 of the failed") &&
                                             Contains("of the done: 1 certified one-to-one\n"));
  CHECK_THAT(shapes.batch("run").err, Contains("0 done, 1 failed, 1 done before"));
  CHECK(Json::parse(bytes_of(shapes.work + "/failed/bad.json"))["attempt"] == 2);
  CHECK(shapes.batch("retry", {"--id", "ball0"}).code == 2);
}

TEST_CASE("batch: ids to try again are looked at before any is marked, and count once") {
  const Shapes shapes(1);
  shapes.add_bad();
  shapes.plan();
  shapes.batch("run");
  const Ended wrong = shapes.batch("retry", {"--id", "bad", "--id", "nosuch"});
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Contains("nosuch: no item that failed") && Contains("batch status"));
  CHECK(shapes.status()["to_retry"] == 0);
  const std::string mark = shapes.work + "/tasks/" + bytes_of(shapes.work + "/plan").substr(0, 16);
  fs::create_directories(mark);
  write_bytes(mark + "/1.done", "");
  CHECK_THAT(shapes.batch("retry", {"--id", "bad", "--id", "bad"}).err,
             Contains("1 item in 1 task"));
  CHECK(shapes.status()["to_retry"] == 1);
  CHECK_FALSE(fs::exists(mark + "/1.done"));
}

TEST_CASE("batch: several steps a shape, with values of a table") {
  const Shapes shapes(2);
  write_bytes(shapes.folder / "pins.txt", "0 1.0 1.0\n");
  write_bytes(shapes.folder / "t.csv",
              "path,grid,options\nin/ball0.obj,ico:3,--quality draft\nin/ball1.obj,ico:4,\n");
  REQUIRE(sphparam_program({"batch",
                            "plan",
                            shapes.folder / "t.csv",
                            "-o",
                            shapes.work,
                            "--chunk",
                            "1",
                            "--",
                            "map",
                            "--pin",
                            shapes.folder / "pins.txt",
                            "--",
                            "remesh",
                            "--grid",
                            "{grid}",
                            "--",
                            "spharm",
                            "--degree",
                            "4",
                            "--",
                            "export"})
              .code == 0);
  REQUIRE(shapes.batch("run").code == 0);
  for (const char* name :
       {"ball1.sph.ply", "ball1_remesh.sph.ply", "ball1_spharm.csv", "ball1.glb"})
    CHECK(fs::exists(shapes.work + "/results/ball1/" + name));
  CHECK(shapes.record("ball0")["steps"][0]["report"]["options"]["quality"] == "draft");
  CHECK(shapes.record("ball1")["steps"][0]["report"]["options"]["quality"] == "normal");

  CHECK(shapes.batch("table", {"-o", shapes.folder / "all.csv"}).code == 0);
  CHECK_THAT(bytes_of(shapes.folder / "all.csv"),
             Contains("map.distortion.mean_abs_ln_area") && Contains("remesh."));
  CHECK_THAT(shapes.batch("run").err, Contains("0 done, 0 failed, 2 done before"));
  write_bytes(shapes.folder / "pins.txt", "0 2.0 1.0\n");  // what is done is asked for its pins
  CHECK_THAT(shapes.batch("run").err, Contains("0 done, 2 failed, 0 done before"));
}

TEST_CASE("batch: mistakes are told before anything is planned") {
  const Shapes shapes(1);
  const auto complaint = [&](const std::vector<std::string>& steps) {
    const Ended ended = shapes.plan(steps);
    CHECK(ended.code == 2);
    return ended.err;
  };
  CHECK_THAT(complaint({"map", "--qualty", "draft"}), Contains("did you mean --quality?"));
  CHECK_THAT(complaint({"mpa"}), Contains("did you mean map?"));
  CHECK_THAT(complaint({"map", "--pin", "{pin}"}), Contains("no {pin} among"));
  CHECK_THAT(complaint({"map", "--", "--"}), Contains("without a subcommand"));
  CHECK_THAT(complaint({"map", "-o", "{id}.stl"}), Contains("make no sense: -o: the map is"));
  CHECK_THAT(complaint({"map", "--balance", "foo"}), Contains("--balance: expected"));
  CHECK_THAT(complaint({"map", "--pin", "nowhere.txt"}), Contains("nowhere.txt: no such file"));
  CHECK_THAT(complaint({"map", "--", "bake", "--map", "nope"}), Contains("there is no map nope"));
  CHECK(sphparam_program({"batch", "plan", shapes.folder / "in", "-o", shapes.work}).code == 2);
  CHECK_FALSE(fs::exists(shapes.work));
  CHECK_THAT(shapes.batch("run").err, Contains("no batch in this folder"));
}

TEST_CASE("batch: pins of each shape are found when it runs, by its id or its path") {
  const Shapes shapes(2);
  fs::create_directories(shapes.folder / "pins");
  for (const char* const name : {"pins/ball0.txt", "pins/ball1.txt", "in/ball0.obj.txt"})
    write_bytes(shapes.folder / name, "0 1.0 1.0\n");
  CHECK(shapes.plan({"map", "{input}", "--pin", "{input}.txt"}).code == 0);
  CHECK(shapes.plan({"map", "--pin=" + (shapes.folder / "pins/{id}.txt")}).code == 0);
  CHECK_THAT(shapes.batch("run").err, Contains("2 done, 0 failed"));
}

TEST_CASE("batch: a Snakefile of the user's own is no batch's, one of a batch is replaced") {
  const Shapes shapes(1);
  fs::create_directories(shapes.work);
  write_bytes(shapes.work + "/Snakefile", "rule all:\n");
  CHECK_THAT(shapes.plan().err, Contains("would be replaced: move it"));
  CHECK(bytes_of(shapes.work + "/Snakefile") == "rule all:\n");
  fs::remove(shapes.work + "/Snakefile");
  CHECK(shapes.plan().code == 0);
  CHECK(shapes.plan({"map", "--quality", "draft"}).code == 0);
}

TEST_CASE("batch: a plan's file is its name, and marks go once another plan was made") {
  const Shapes shapes(1);
  REQUIRE(shapes.plan().code == 0);
  REQUIRE(shapes.batch("run").code == 0);  // marks are of what ran
  std::string name = bytes_of(shapes.work + "/plan");
  name.pop_back();
  CHECK(shapes.batch("status", {"--plan", shapes.work + "/plan-" + name + ".tsv"}).code == 0);
  const std::string mark = shapes.work + "/tasks/" + name + "/1.done";
  fs::create_directories(fs::path(mark).parent_path());
  write_bytes(mark, "");
  REQUIRE(shapes.plan().code == 0);
  CHECK(fs::exists(mark));
  REQUIRE(shapes.plan({"map", "--quality", "draft"}).code == 0);
  REQUIRE(shapes.plan().code == 0);
  CHECK_FALSE(fs::exists(mark));
}

TEST_CASE("batch: what was made of an input that is bad now goes when that is recorded") {
  const Shapes shapes(1);
  REQUIRE(shapes.plan().code == 0);
  REQUIRE(shapes.batch("run").code == 0);
  CHECK(fs::exists(shapes.work + "/results/ball0"));
  write_bytes(shapes.folder / "in/ball0.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  REQUIRE(shapes.plan().code == 0);
  REQUIRE(shapes.batch("run").code == 0);
  CHECK(fs::exists(shapes.work + "/failed/ball0.json"));
  CHECK_FALSE(fs::exists(shapes.work + "/results/ball0"));
}

TEST_CASE("batch: results of another program stay when this one fails with the same input") {
  const Shapes shapes(1);
  REQUIRE(shapes.plan().code == 0);
  REQUIRE(shapes.batch("run").code == 0);
  const std::string record = shapes.work + "/results/ball0/record.json";
  std::string bytes = bytes_of(record);
  const std::string mark = "\"program\":\"";
  bytes[bytes.find(mark) + mark.size()] ^= 1;
  write_bytes(record, bytes);
  const Ended run = sphparam_program({"--limit", "vertices=10", "batch", "run", shapes.work});
  CHECK_THAT(run.err, Contains("0 done, 1 failed"));
  CHECK(fs::exists(shapes.work + "/failed/ball0.json"));
  CHECK_FALSE(shapes.map("ball0").empty());
}

TEST_CASE("batch: maps of all components are certified, and their repairs counted together") {
  const Shapes shapes(0);
  std::string two;
  for (const char* const at : {"0", "5"})  // octahedra that lack a face
    for (const char* const place : {"1 0 ", "-1 0 ", "0 1 ", "0 -1 "})
      two += std::string("v ") + place + at + "\n";
  two += "v 0 0 1\nv 0 0 -1\nv 0 0 6\nv 0 0 4\n";
  for (const auto& [shift, top] : {std::pair{0, 9}, {4, 11}})
    for (const auto& [from, to] : {std::pair{1, 3}, {3, 2}, {2, 4}, {4, 1}}) {
      const std::string i = std::to_string(from + shift), j = std::to_string(to + shift);
      two += "f " + i + " " + j + " " + std::to_string(top) + "\n";
      if (from < 4) two += "f " + j + " " + i + " " + std::to_string(top + 1) + "\n";
    }
  write_bytes(shapes.folder / "in/two.obj", two);
  REQUIRE(shapes.plan({"map", "--repair", "--all-components"}).code == 0);
  REQUIRE(shapes.batch("run").code == 0);
  CHECK(shapes.record("two")["outcome"] == "certified");
  CHECK(shapes.record("two")["repairs"] == "hole-filled 2");
}

TEST_CASE("batch: with --chunk auto three shapes are tried, and are done for good") {
  const Shapes shapes(5);
  const Ended plan = shapes.plan({"map"}, "auto");
  CHECK(plan.code == 0);
  CHECK_THAT(plan.err, Contains("an item takes about"));
  CHECK(shapes.status()["done"] == 3);
  CHECK(shapes.plan({"map", "--lambda", "1", "--balance", "conformal"}, "auto").code == 2);
}

TEST_CASE("batch: planned again where the trial is done, tasks are as long as before") {
  const Shapes shapes(40);
  REQUIRE(shapes.plan({"map", "--quality", "draft"}, "auto").code == 0);
  const Ended again = shapes.plan({"map", "--quality", "draft"}, "auto");
  CHECK_THAT(again.err,
             Contains("an item takes about") && !Contains("40 tasks") && Contains("array.sbatch"));
}

TEST_CASE("batch: a plan whose shapes were all tried has nothing to submit, and no double slash") {
  const Shapes shapes(2);
  shapes.add_bad();
  const Ended plan = sphparam_program(
      {"batch", "plan", shapes.folder / "in", "-o", shapes.work + "/", "--", "map"});
  CHECK(plan.code == 0);
  CHECK_THAT(plan.err, Contains("nothing left to do") && !Contains("array.sbatch"));
  CHECK_THAT(bytes_of(shapes.work + "/array.sbatch"), Contains("work/logs/") && !Contains("//"));
  shapes.batch("retry");
  CHECK_THAT(shapes.plan({"map"}, "1").err, Contains("array.sbatch"));
}

TEST_CASE(
    "batch: marks of Snakemake whose results are gone are told, and go as it is planned again") {
  const Shapes shapes(4);
  shapes.add_bad();
  shapes.plan({"map"}, "2");
  shapes.batch("run");
  const std::string name = bytes_of(shapes.work + "/plan").substr(0, 16);
  const auto mark = [&](int task) {
    return shapes.work + "/tasks/" + name + "/" + std::to_string(task) + ".done";
  };
  fs::create_directories(shapes.work + "/tasks/" + name);
  for (const int task : {1, 2, 3}) write_bytes(mark(task), "");
  CHECK(shapes.status()["marked_open"] == 0);
  fs::remove_all(shapes.work + "/results/ball2");  // bad, ball0 · ball1, ball2 · ball3
  CHECK(shapes.status()["marked_open"] == 1);
  CHECK_THAT(shapes.batch("status").out,
             Contains("Snakemake has 1 task for done with open items, by marks in the folder "
                      "tasks: `batch plan` again, or without that folder, it runs them"));
  shapes.plan({"map"}, "2");
  CHECK(fs::exists(mark(1)));
  CHECK_FALSE(fs::exists(mark(2)));
  CHECK(fs::exists(mark(3)));
  CHECK(shapes.status()["marked_open"] == 0);
}

TEST_CASE("batch: a shape that another file of its name gives another id is told") {
  const Shapes shapes(1);
  shapes.plan({"map"}, "1");
  CHECK_THAT(shapes.plan({"map"}, "1").err, !Contains("another id"));
  shapes.batch("run");
  fs::create_directories(shapes.folder / "more");
  fs::copy_file(shapes.folder / "in/ball0.obj", shapes.folder / "more/ball0.obj");
  const Ended both =
      sphparam_program({"batch", "plan", shapes.folder / "in", shapes.folder / "more", "-o",
                        shapes.work, "--chunk", "1", "--", "map"});
  CHECK(both.code == 0);
  CHECK_THAT(both.err, Contains("warning: 1 shape has another id than in the plan before (ball0 is "
                                "in_ball0 now), as where others have the same name: what was made "
                                "under the old one stays, and counts no more; a table with the "
                                "column id keeps ids"));
  CHECK(fs::exists(shapes.work + "/results/ball0/record.json"));
}

TEST_CASE("batch: where nobody mounted /proc a batch runs, and clears nothing of others away") {
  const std::string hidden = "mount -t tmpfs none /proc && ";
  if (std::system(("unshare -rm sh -c '" + hidden + "true' 2>/dev/null").c_str()) != 0) {
    WARN("skipped: no name space of one's own here");
    return;
  }
  const Shapes shapes(2);
  const auto run = [&](const std::string& words) {
    return std::system(
        ("unshare -rm sh -c '" + hidden + program_file() + " batch " + words + "' >/dev/null 2>&1")
            .c_str());
  };
  CHECK(run("plan " + shapes.folder / "in" + " -o " + shapes.work + " --chunk 1 -- map") == 0);
  const std::string others = shapes.work + "/staging/x~host.12345678~12345678~4026531836~1~2";
  fs::create_directories(others);
  CHECK(run("run " + shapes.work) == 0);
  CHECK(shapes.record("ball0")["outcome"] == "certified");
  CHECK(shapes.record("ball1")["outcome"] == "certified");
  CHECK(fs::exists(others));
  CHECK_THAT(shapes.batch("run").err, Contains("2 done before"));  // of the same program
}

TEST_CASE("batch: a mesh that was repaired is told in the table, the page and the status") {
  const Shapes shapes(1);
  TriangleMesh open = icosphere(2);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  write_bytes(shapes.folder / "in/open.obj", obj_text(open));
  shapes.plan({"map", "--repair"});
  REQUIRE(shapes.batch("run").code == 0);
  CHECK(shapes.record("open")["repairs"] == "hole-filled 1");
  CHECK(shapes.record("ball0")["repairs"] == "");
  const Json status = shapes.status();
  CHECK(status["done"] == 2);
  CHECK(status["certified"] == 2);
  CHECK(status["repaired"] == 1);
  CHECK_THAT(shapes.batch("status").out,
             Contains("of the done: 2 certified one-to-one, 1 repaired\n"));
  REQUIRE(shapes.batch("table", {"-o", shapes.folder / "t.csv"}).code == 0);
  const std::string table = bytes_of(shapes.folder / "t.csv");
  CHECK_THAT(table, Contains("id,path,outcome,code,step,reason,attempt,repairs,warnings,"));
  CHECK_THAT(table, Contains("open.obj,certified,0,,,1,hole-filled 1,0,") &&
                        Contains("ball0.obj,certified,0,,,1,,0,"));
  REQUIRE(shapes.batch("report", {"-o", shapes.folder / "all.html"}).code == 0);
  CHECK_THAT(bytes_of(shapes.folder / "all.html"), Contains("\"hole-filled 1\",[]]"));
}

TEST_CASE("batch: what steps warn of is told in the table, the page and the status") {
  const Shapes shapes(1);
  TriangleMesh turned = icosphere(2);
  turned.triangles.col(0).swap(turned.triangles.col(1));
  write_bytes(shapes.folder / "in/turned.obj", obj_text(turned));
  shapes.plan({"map"});
  REQUIRE(shapes.batch("run").code == 0);
  const Json warnings = shapes.record("turned")["warnings"];
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].get<std::string>(), Contains("inside out"));
  CHECK(shapes.record("ball0")["warnings"] == Json::array());
  CHECK(shapes.status()["warned"] == 1);
  CHECK_THAT(shapes.batch("status").out,
             Contains("of the done: 2 certified one-to-one, 1 with warnings\n"));
  const std::string table = shapes.batch("table", {"-o", "-", "-q"}).out;
  CHECK_THAT(table, Contains("turned.obj,certified,0,,,1,,1,") &&
                        Contains("ball0.obj,certified,0,,,1,,0,"));
  REQUIRE(shapes.batch("report", {"-o", shapes.folder / "all.html"}).code == 0);
  CHECK_THAT(bytes_of(shapes.folder / "all.html"), Contains("inside out"));
}

TEST_CASE("batch: folders that steps name for their results are made") {
  const Shapes shapes(1);
  shapes.plan({"map", "--", "bake", "--map", "position", "--size", "32", "-o", "img/", "--",
               "export", "-o", "glb/lit/{id}.glb", "--image-size", "32"});
  REQUIRE(shapes.batch("run").code == 0);
  CHECK(shapes.status()["done"] == 1);
  const std::string results = shapes.work + "/results/ball0/";
  CHECK(fs::exists(results + "glb/lit/ball0.glb"));
  CHECK(std::distance(fs::directory_iterator(results + "img"), {}) == 1);
}

TEST_CASE("batch: an item that needs too much memory fails alone") {
  const Shapes shapes(2);
  write_bytes(shapes.folder / "in/large.obj", obj_text(icosphere(6)));
  shapes.plan();
  CHECK(shapes.batch("run", {"--max-memory", "14M", "--threads", "1"}).code == 0);
  CHECK(shapes.status()["done"] == 2);
  CHECK_THAT(shapes.batch("status").out, Contains("code 1: out of memory"));
}

TEST_CASE("batch: what is left of a record after a loss of power is no record, its item is open") {
  const Shapes shapes(2);
  shapes.plan();
  shapes.batch("run");
  const std::string record = shapes.work + "/results/ball0/record.json";
  for (const std::size_t left : {0, 40, 700}) {
    write_bytes(record, bytes_of(record).substr(0, left));
    CHECK(shapes.status()["open"] == 1);
    CHECK(shapes.batch("table", {"-o", "-", "-q"}).code == 0);
    CHECK_THAT(shapes.batch("run").err, Contains("1 done, 0 failed, 1 done before"));
    CHECK(shapes.record("ball0")["outcome"] == "certified");
  }
}

TEST_CASE("batch: a file that every shape would write is told before anything is planned") {
  const Shapes shapes(2);
  const std::string shared = shapes.folder / "all.csv";
  for (const std::string& path : {shared, std::string("../../all.csv")}) {
    const Ended plan = shapes.plan({"map", "--", "spharm", "--csv", path});
    CHECK(plan.code == 2);
    CHECK_THAT(plan.err, Contains("every shape would write " + path));
  }
  CHECK(shapes.plan({"map", "--", "spharm", "--csv", shapes.folder / "{id}.csv"}).code == 0);
  CHECK(shapes.plan({"map", "--", "spharm", "--csv", "/dev/null"}).code == 0);
}

TEST_CASE("batch: two steps that write one file are told before anything is planned") {
  const Shapes shapes(1);
  const Ended named = shapes.plan({"map", "--", "spharm", "--degree", "3", "--", "spharm"});
  CHECK(named.code == 2);
  CHECK_THAT(named.err, Contains("would replace ball0_spharm.csv of `spharm {id}.sph.ply --degree "
                                 "3 --csv {id}_spharm.csv`"));
  CHECK_THAT(named.err, Contains("as in {id}_3.csv"));
  const Ended same = shapes.plan({"map", "-o", "a.ply", "--", "repair", "a.ply", "-o", "./a.ply"});
  CHECK(same.code == 2);
  CHECK_THAT(same.err, Contains("would replace ./a.ply of `map {input} -o a.ply`"));
  const std::vector<std::string> apart = {
      "map", "--",   "spharm", "--degree", "3",  "--",   "spharm", "--csv",   "b.csv",
      "--",  "bake", "--map",  "mask",     "--", "bake", "--map",  "position"};
  CHECK(shapes.plan(apart).code == 0);
}

TEST_CASE("batch: files of a list between commas are named from the root, and hashed") {
  const Shapes shapes(1);
  const auto label_of = [](const std::string& vertex) {
    return "#!ascii label  , from subject x\n1\n" + vertex + " 0 0 0 1\n";
  };
  const std::string one = shapes.folder / "one.label", two = shapes.folder / "two.label";
  write_bytes(one, label_of("1"));
  write_bytes(two, label_of("2"));
  const std::string list = one + "," + two;
  REQUIRE(shapes.plan({"map", "--", "remesh", "--grid", "ico:2", "--data", list}).code == 0);
  CHECK_THAT(shapes.batch("run").err, Contains("1 done"));
  CHECK_THAT(shapes.batch("run").err, Contains("1 done before"));
  write_bytes(two, label_of("3"));
  CHECK(shapes.plan({"map", "--", "remesh", "--grid", "ico:2", "--data", list}).code == 0);
  CHECK_THAT(shapes.batch("run").err, Contains("0 done before"));
}

TEST_CASE("batch: the table has the columns of the one it was planned from, and .tsv has tabs") {
  const Shapes shapes(2);
  write_bytes(shapes.folder / "t.csv",
              "path,age,code,map.quality\nin/ball0.obj,7,x,u\nin/ball1.obj,\"8, or\t9\",y,v\n");
  REQUIRE(sphparam_program({"batch", "plan", shapes.folder / "t.csv", "-o", shapes.work, "--chunk",
                            "1", "--", "map", "--quality", "draft"})
              .code == 0);
  shapes.batch("run");
  const std::string table = shapes.batch("table", {"-o", "-", "-q"}).out;
  CHECK_THAT(table, Contains("repairs,warnings,age,table.code,") && Contains(",\"8, or\t9\",y,v,"));
  REQUIRE(shapes.batch("table", {"-o", shapes.folder / "all.tsv"}).code == 0);
  CHECK_THAT(bytes_of(shapes.folder / "all.tsv"), Contains("repairs\twarnings\tage\ttable.code\t"));
  CHECK(shapes.batch("table", {"-o", shapes.folder / "all.xlsx"}).code == 2);
}

TEST_CASE("batch: the page of a folder that takes no pictures says so") {
  const Shapes shapes(1);
  shapes.plan();
  shapes.batch("run");
  write_bytes(shapes.work + "/pictures", "where the folder should be");
  REQUIRE(shapes.batch("report", {"-o", shapes.folder / "all.html"}).code == 0);
  CHECK_THAT(bytes_of(shapes.folder / "all.html"), Contains("1 picture could not be drawn"));
}

TEST_CASE("batch: killed or stopped, nothing is lost, half or done twice") {
  const Shapes shapes(12);
  shapes.plan();
  for (const int signal : {SIGKILL, SIGTERM, SIGKILL}) {
    Running run({"batch", "run", shapes.work, "--threads", "2"}, "");
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    run.signal(signal);
    const int code = run.wait().code;
    if (signal == SIGTERM) CHECK((code == 130 || code == 0));
  }
  std::vector<std::string> before;
  for (const auto& entry : fs::directory_iterator(shapes.work + "/results"))
    before.push_back(entry.path().string() + bytes_of(entry.path().string() + "/record.json"));
  CHECK(shapes.batch("run").code == 0);
  for (const std::string& record : before)
    CHECK(bytes_of(record.substr(0, record.find('{')) + "/record.json") ==
          record.substr(record.find('{')));
  CHECK(shapes.status()["done"] == 12);
  CHECK(fs::is_empty(shapes.work + "/staging"));
}

TEST_CASE("batch: failures that differ in numbers are told together, with no figure of one alone") {
  const Shapes shapes(1);
  const auto balls = [&](const std::string& name, int count) {
    std::string text, faces;
    const TriangleMesh ball = icosphere(0);
    for (int i = 0; i < count; ++i) {
      TriangleMesh moved = ball;
      moved.positions.col(0).array() += 3 * i;
      std::istringstream lines(obj_text(moved));
      for (std::string line; std::getline(lines, line);)
        if (line.starts_with("v ")) text += line + "\n";
      for (Face f = 0; f < ball.face_count(); ++f)
        faces += "f " + std::to_string(ball.triangles(f, 0) + 1 + 12 * i) + " " +
                 std::to_string(ball.triangles(f, 1) + 1 + 12 * i) + " " +
                 std::to_string(ball.triangles(f, 2) + 1 + 12 * i) + "\n";
    }
    write_bytes(shapes.folder / ("in/" + name + ".obj"), text + faces);
  };
  balls("pair", 2);
  balls("soup", 5);
  shapes.plan();
  shapes.batch("run");
  CHECK_THAT(
      shapes.batch("status").out,
      Contains("2 × code 4: NAME: this is not a closed genus-0 mesh: 2 to 5 separate components; "
               "the largest has 20 faces and 20 to "
               "50 %") &&
          Contains("pair, soup"));
  const Json failures = shapes.status()["failures"];
  REQUIRE(failures.size() == 1);
  CHECK_THAT(failures[0]["reason"].get<std::string>(), Contains("2 to 5 separate components"));
}

TEST_CASE("batch: the page has every shape, failures by reason and pictures beside it") {
  const Shapes shapes(2);
  shapes.add_bad();
  shapes.plan();
  shapes.batch("run");
  REQUIRE(shapes.batch("report", {"-o", shapes.folder / "all.html"}).code == 0);
  const std::string page = bytes_of(shapes.folder / "all.html");
  CHECK_THAT(page, Contains("\"ball0\",\"certified\"") && Contains("\"bad\",\"failed\""));
  CHECK_THAT(page, Contains("const folder = \"work/\"") && Contains("<h2>Failures</h2>"));
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(shapes.work + "/pictures")) {
    CHECK_THAT(page, Contains(entry.path().filename().string()));
    ++pictures;
  }
  CHECK(pictures == 2);
}

}  // namespace sphparam::tests
