#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "program.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Matchers::Contains;

#ifndef __SANITIZE_ADDRESS__  // which has memory of its own
TEST_CASE("limits: a grid that this machine has no memory for is refused before any work") {
  const double needed = 400.0 * 167772162;
  if (static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)) >
      needed)
    return;  // it has
  const Ended ended = sphparam_program({"remesh", "nowhere.ply", "--grid", "ico:12", "--csv", "-"});
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("--grid ico:12: its 167772162 vertices take 67.1 GB of memory or "
                                 "more, and this machine has "));
}

TEST_CASE("limits: more memory than --max-memory ends with 1, says so and leaves nothing") {
  const Folder folder;
  write_bytes(folder / "mesh.obj", obj_text(icosphere(5)));
  for (const char* threads : {"1", "4"}) {
    const Ended ended = sphparam_program({"map", folder / "mesh.obj", "-o", folder / "map.ply",
                                          "--threads", threads, "--max-memory", "2M"});
    CHECK(ended.code == 1);
    CHECK_THAT(ended.err, Contains("more than --max-memory 2M"));
    CHECK(folder.names() == std::vector<std::string>{"mesh.obj"});
  }
  CHECK(sphparam_program({"info", folder / "mesh.obj", "--max-memory", "1G"}).code == 0);
}
#endif

TEST_CASE("limits: sizes are whole numbers of bytes, K, M, G or T") {
  for (const char* size : {"", "0", "-1", "1.5G", "2X", "2GB", "G", "20000000T"}) {
    INFO(size);
    CHECK(sphparam_program({"info", "-", "--max-memory", size}).code == 2);
  }
}

TEST_CASE("limits: every limit of input files is an option, exact to one") {
  const std::string pentagon_pyramids =
      "OFF\n7 10 0\n0 0 1\n0 0 -1\n1 0 0\n0.3 1 0\n-0.8 0.6 0\n-0.8 -0.6 0\n0.3 -1 0\n"
      "3 0 2 3\n3 0 3 4\n3 0 4 5\n3 0 5 6\n3 0 6 2\n3 1 3 2\n3 1 4 3\n3 1 5 4\n3 1 6 5\n3 1 2 6\n";
  const auto code = [&](const std::string& name, std::size_t value) {
    return sphparam_program({"info", "-", "--limit", name + "=" + std::to_string(value)},
                            pentagon_pyramids)
        .code;
  };
  const std::vector<std::pair<std::string, std::size_t>> limits = {
      {"vertices", 7},
      {"faces", 10},
      {"degree", 3},
      {"line", 11},
      {"file", pentagon_pyramids.size()}};
  for (const auto& [name, value] : limits) {
    INFO(name);
    CHECK(code(name, value - 1) == 3);
    CHECK(code(name, value) == 0);
    CHECK(code(name, value + 1) == 0);
  }
}

TEST_CASE("limits: several may be given, unknown ones are answered with the known ones") {
  const std::string mesh = obj_text(octahedron());
  CHECK(sphparam_program({"info", "-", "--limit", "faces=8", "--limit", "vertices=6"}, mesh).code ==
        0);
  CHECK(sphparam_program({"info", "-", "--limit", "faces=8", "--limit", "vertices=5"}, mesh).code ==
        3);
  const Ended unknown = sphparam_program({"info", "-", "--limit", "vertces=5"}, mesh);
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("did you mean vertices?"));
  CHECK(sphparam_program({"info", "-", "--limit", "faces"}, mesh).code == 2);
}

TEST_CASE(
    "limits: a folder that is missing is told before any work, one that will be made is not") {
  const Folder folder;
  write_bytes(folder / "mesh.obj", obj_text(octahedron()));
  const Ended lost =
      sphparam_program({"map", folder / "mesh.obj", "-o", folder / "no/out.ply", "--json", "-"});
  CHECK(lost.code == 3);
  CHECK_THAT(lost.err, Contains("does not exist") && !Contains("certified"));
  CHECK(folder.names() == std::vector<std::string>{"mesh.obj"});
  const Ended made =
      sphparam_program({"map", folder / "mesh.obj", "-o", folder / "out.ply", "--plots",
                        folder / "charts/", "--json", folder / "charts/map.json"});
  CHECK(made.code == 0);
  CHECK(fs::exists(folder / "charts/map.json"));
}

TEST_CASE("limits: a mesh of more parts than files may be open at first is mapped") {
  constexpr int parts = 100;
  const Folder folder;
  const TriangleMesh part = tetrahedron();
  TriangleMesh many{Points(4 * parts, 3), Triangles(4 * parts, 3)};
  for (int k = 0; k < parts; ++k) {
    many.positions.middleRows(4 * k, 4) =
        part.positions.rowwise() + Eigen::RowVector3d(3 * k, 0, 0);
    many.triangles.middleRows(4 * k, 4) = (part.triangles.array() + 4 * k).matrix();
  }
  write_bytes(folder / "many.obj", obj_text(many));
  CHECK(std::system(("ulimit -Sn 64 && " + program_file() + " map " + folder / "many.obj" +
                     " --all-components -q -o " + folder / "m.sph.ply")
                        .c_str()) == 0);
  CHECK(folder.names().size() == parts + 1);
}

TEST_CASE("limits: two spellings of one output are refused before any work") {
  const Folder folder;
  write_bytes(folder / "mesh.obj", obj_text(octahedron()));
  const Ended ended = sphparam_program(
      {"map", folder / "mesh.obj", "-o", folder / "out.ply", "--write-sphere",
       folder / "../" + fs::path(folder / "x").parent_path().filename().string() + "/./out.ply"});
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("the same file, out.ply"));
  CHECK(folder.names() == std::vector<std::string>{"mesh.obj"});
}

TEST_CASE("limits: where one output cannot be written, no other is there") {
  const Folder folder;
  write_bytes(folder / "mesh.obj", obj_text(octahedron()));
  const auto map = [&](const std::string& output, const std::string& sphere,
                       const std::string& json) {
    return sphparam_program(
        {"map", folder / "mesh.obj", "-o", output, "--write-sphere", sphere, "--json", json});
  };
  CHECK(map(folder / "a.ply", folder / "b.obj", folder / "no/c.json").code == 3);
  CHECK(map(folder / "a.ply", folder / "no/b.obj", folder / "c.json").code == 3);
  CHECK(map(folder / "no/a.ply", folder / "b.obj", folder / "c.json").code == 3);
  CHECK(map(folder / "a.ply", folder / "b.obj", "/dev/full").code == 3);
  CHECK(folder.names() == std::vector<std::string>{"mesh.obj"});
}
