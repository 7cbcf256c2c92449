#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>

#include "io/files/file_bytes.h"
#include "io/formats/ply/ply_writer.h"
#include "reading.h"
#include "sphparam/io/coarse_coordinates.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/mesh/mesh_repair.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;
using sphparam::ReadOptions;

TEST_CASE("mesh_reader: floats that are far from the origin for the size of a mesh are told") {
  const auto notes = [](ScalarType type, double away, double size) {
    MeshFile file;
    file.mesh = icosphere(2);
    file.mesh.positions *= size;
    file.mesh.positions.col(1).array() += away;
    for (double& value : file.mesh.positions.reshaped())
      if (type == ScalarType::Float32) value = static_cast<double>(static_cast<float>(value));
    file.position_type = type;
    return read(serialise_ply(file)).notes;
  };
  const std::vector<std::string> found = notes(ScalarType::Float32, 5.2e6, 2);
  CHECK(found == std::vector<std::string>{
                     "coordinates: so far from the origin, numbers of 32 bits are 0.5 apart, 12.5 "
                     "% of the mesh's length and 80.5 % of its mean edge: area, volume and "
                     "distances are rough; export it in doubles, or moved nearer"});
  CHECK(coarse_coordinates_among(found) == found);
  CHECK(notes(ScalarType::Float64, 5.2e6, 2).empty());
  CHECK(notes(ScalarType::Float32, 5.2e6, 20).empty());
  CHECK(notes(ScalarType::Float32, 0, 2).empty());
  MeshFile whole;  // metres, of which floats are half of one apart there: nothing was rounded
  whole.mesh = icosphere(0);
  whole.mesh.positions = (2 * whole.mesh.positions).array().round();
  whole.mesh.positions.col(1).array() += 5.2e6;
  whole.position_type = ScalarType::Float32;
  CHECK(coarse_coordinates_among(read(serialise_ply(whole)).notes).empty());
}

TEST_CASE("mesh_reader: content decides the format before the name does") {
  CHECK(read(tetrahedron_ply, "a.obj").format == "PLY ASCII");
  CHECK(read(tetrahedron_off, "a.ply").format == "OFF");
  CHECK(read(tetrahedron_obj, "standard input").format == "OBJ");
  CHECK(read("# a comment first\n" + tetrahedron_obj, "mesh").format == "OBJ");
}

TEST_CASE("mesh_reader: other formats are refused by name") {
  const auto refused = [](const std::string& bytes, const std::string& name,
                          const std::string& expected) {
    INFO(expected);
    CHECK(contains(complaint(bytes, name), expected));
  };
  refused("MZ\x03", "a.mz3", "the file ends within its header");
  refused("MZ\x03", "a.exe", "not recognised");
  refused("\x1f\x8b\x08", "a.mz3", "gzip data is cut short");
  refused("PK\x03\x04", "part.3mf", "a ZIP archive (unpack it first)");
  refused("PK\x03\x04", "part.usdz", "this is USDZ, which");
  refused("<?xml version", "part.AMF", "this is AMF, which");
  refused("PK\x03\x04", "parts.zip", "a ZIP archive (unpack it first)");
  refused("<?xml version", "a.xml", "XML other than GIFTI and VTP");
  refused("\xff\xff\xff\x01", "lh.curv", "a FreeSurfer file of values");
  refused("hello", "a.txt", "not recognised");
  refused("hello", "a.ply", "a.ply:1: expected the magic word");
  refused("hello", "t1.nii.gz", "a volume (NIfTI), not a mesh");
  std::string header(540, '\0');
  header.replace(344, 4, std::string("n+1\0", 4));
  refused(header, "a", "make a surface of it first");
  header.replace(4, 4, std::string("n+2\0", 4));
  refused(header, "a.obj", "a volume (NIfTI)");
  header.replace(504, 2, "\xbe\x0b");  // 3006
  refused(header, "a.dscalar.nii", "CIFTI-2");
  refused(header.substr(0, 508), "a.dscalar.nii", "CIFTI-2");  // the code is the last that is there
  refused(header.substr(0, 507), "a.dscalar.nii", "a volume (NIfTI)");
  refused("", "a.obj", "empty");
  refused("\xef\xbb\xbf", "a.obj", "empty");
}

TEST_CASE("mesh_reader: files that cannot be opened say so") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(sphparam::read_mesh("no/such/file.obj"), Contains("no/such/file.obj: No such"));
  CHECK_THROWS_WITH(sphparam::read_mesh("/"), Contains("is a directory"));
}

TEST_CASE("mesh_reader: a name that only components bear is answered with theirs") {
  using Catch::Matchers::Contains;
  const Folder folder;
  const std::string path = folder / "two.sph.ply";
  std::ofstream(folder / "two_0002.sph.ply") << tetrahedron_ply;
  CHECK_THROWS_WITH(read_mesh(path), Contains("1 component: name one, ") &&
                                         Contains("two_0002.sph.ply") && !Contains(" to "));
  std::ofstream(folder / "two_0011.sph.ply") << tetrahedron_ply;
  CHECK_THROWS_WITH(read_mesh(path), Contains("2 components") && Contains("two_0011.sph.ply"));
  std::ofstream(path) << tetrahedron_ply;
  CHECK_NOTHROW(read_mesh(path));
}

TEST_CASE("mesh_reader: a file on disk reads like its bytes") {
  const Folder folder;
  const std::string path = folder / "a.off";
  std::ofstream(path) << tetrahedron_off;
  CHECK(sphparam::read_mesh(path).mesh.triangles == read(tetrahedron_off).mesh.triangles);
  ReadOptions options;
  options.max_file_bytes = tetrahedron_off.size();
  CHECK_NOTHROW(sphparam::read_mesh(path, options));
  options.max_file_bytes -= 1;
  CHECK_THROWS_WITH(sphparam::read_mesh(path, options),
                    Catch::Matchers::Contains("`--limit file=N` raises it"));
}

TEST_CASE("mesh_reader: what a link's mesh names is beside the link, or else beside the mesh") {
  namespace fs = std::filesystem;
  const Folder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path / name) << text;
  };
  fs::create_directories(folder.path / "store");
  fs::create_directories(folder.path / "work");
  write("store/a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl p\nf 1 2 3\n");
  write("store/a.mtl", "newmtl p\nKd 1 0 0\n");
  fs::create_symlink("../store/a.obj", folder.path / "work/link.obj");
  const auto red_of_link = [&] {
    const MeshFile file = sphparam::read_mesh(folder / "work/link.obj");
    REQUIRE(file.base_colours.size() == 1);
    return file.base_colours[0].factor[0];
  };
  CHECK(red_of_link() == 1);
  write("work/a.mtl", "newmtl p\nKd 0.5 0 0\n");
  CHECK(red_of_link() == 0.5);
  fs::remove(folder.path / "work/a.mtl");
  fs::remove(folder.path / "store/a.mtl");
  const MeshFile bare = sphparam::read_mesh(folder / "work/link.obj");
  CHECK(bare.base_colours.empty());
  CHECK(bare.notes == std::vector<std::string>{
                          "not carried: colours and textures of 1 material in 'a.mtl' (No "
                          "such file or directory), which is not read; their names are kept"});
}

TEST_CASE("mesh_reader: of what has no end no more is read than the limit") {
  CHECK_THROWS_WITH(FileBytes("/dev/zero", 1000),
                    "/dev/zero: is larger than the limit of 1000 bytes");
  ReadOptions options;
  options.max_file_bytes = 1000;
  CHECK_THROWS_WITH(FileBytes("/dev/zero", options),
                    Catch::Contains("limit of 1000 bytes; `--limit file=N` raises it"));
  CHECK(FileBytes("/dev/null", 0).view().empty());
  // It says that it has 0 bytes.
  CHECK(FileBytes("/proc/self/stat", 1000).view().starts_with(std::to_string(::getpid()) + " "));
  CHECK_THROWS_WITH(FileBytes("/proc/self/stat", 3),
                    "/proc/self/stat: is larger than the limit of 3 bytes");
}

TEST_CASE(
    "mesh_reader: faces that name a vertex twice come through for a repair, and it removes them") {
  const std::string faulty[] = {tetrahedron_obj + "f 1 2 1\nf 4 3 2 1 4 2\n",
                                replaced(replaced(tetrahedron_off, "4 4 6", "4 6 6"), "3 0 1 3\n",
                                         "3 0 1 3\n4 0 1 2 1\n3 3 3 3\n"),
                                replaced(replaced(tetrahedron_ply, "face 4", "face 6"), "3 0 1 3\n",
                                         "3 0 1 3\n3 2 1 2\n5 0 1 2 0 3\n")};
  const sphparam::MeshFile sound = read(tetrahedron_obj);
  for (const std::string& bytes : faulty) {
    CHECK(contains(complaint(bytes), "face names a vertex twice"));
    const MeshFile file = read(bytes, "mesh", {.repeated_corners = true});
    CHECK(file.mesh.face_count() == 6);
    RepairOptions options = RepairOptions::none();
    options.duplicates = true;
    const RepairedMesh repaired = repair_mesh(file.mesh, options);
    REQUIRE(repaired.actions.size() == 1);
    CHECK(repaired.actions[0].kind == RepairKind::InvalidFaceRemoved);
    CHECK(repaired.actions[0].count == 2);
    CHECK(repaired.mesh.triangles == sound.mesh.triangles);
    CHECK(repaired.inspection.is_sphere());
  }
}

TEST_CASE("mesh_reader: every limit holds at its value and not beyond") {
  const std::string pentagon_obj =
      "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n# 345678901234567890\n";
  const std::string pentagon_off =
      "OFF\n5 1 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n# 345678901234567890\n";
  const std::string pentagon_ply =
      "ply\nformat ascii 1.0\ncomment 8901234567890123456789012345678901234567\n"
      "element vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
      "0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n";
  const auto check_limit = [](const std::string& bytes, auto member, auto value) {
    for (const int step : {-1, 0, 1}) {
      ReadOptions options;
      options.*member = value + step;
      INFO(bytes.substr(0, 3) << " limit " << value + step << ": "
                              << complaint(bytes, "a.obj", options));
      CHECK(complaint(bytes, "a.obj", options).empty() == (step >= 0));
    }
  };
  for (const std::string& bytes : {pentagon_obj, pentagon_off, pentagon_ply}) {
    check_limit(bytes, &ReadOptions::max_file_bytes, bytes.size());
    check_limit(bytes, &ReadOptions::max_vertices, 5);
    check_limit(bytes, &ReadOptions::max_faces, 3);  // triangles
    check_limit(bytes, &ReadOptions::max_polygon_degree, 5);
  }
  check_limit(pentagon_obj, &ReadOptions::max_line_bytes, 20);
  check_limit(pentagon_off, &ReadOptions::max_line_bytes, 20);
  check_limit(pentagon_ply, &ReadOptions::max_line_bytes, 48);
  check_limit(pentagon_ply, &ReadOptions::max_ply_elements, 2);
  check_limit(pentagon_ply, &ReadOptions::max_ply_properties, 3);
  check_limit(replaced(pentagon_obj, " 4 5", " \\\n 4 5"), &ReadOptions::max_line_bytes, 20);
}

TEST_CASE("mesh_reader: damaged files give a mesh or a ReadError, nothing else") {
  MeshFile rich = read(
      "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0.5 1 1 1\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
      "vn 1 0 0\nusemtl a\nf 1/1/1 2/2/1 3/1/1\nusemtl b\nf 1/2/2 3/2/2 4/1/1\nf -1 -2 -3 -4\n",
      "a.obj");
  const std::string seeds[] = {tetrahedron_obj,
                               tetrahedron_off,
                               tetrahedron_ply,
                               serialise_ply(rich),
                               serialise_obj(rich),
                               serialise_off(rich),
                               "OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5 6 7\n"};
  std::mt19937 random(2006);
  long accepted = 0, refused = 0;
  for (const std::string& seed : seeds)
    for (int round = 0; round < 4000; ++round) {
      std::string bytes = seed;
      for (auto edits = random() % 3 + 1; edits > 0; --edits) {
        const std::size_t at = random() % bytes.size();
        switch (random() % 5) {
          case 0:
            bytes[at] = static_cast<char>(random());
            break;
          case 1:
            bytes[at] = "0123456789-/. \n#\\ef"[random() % 19];
            break;
          case 2:
            bytes.resize(at + 1);
            break;
          case 3:
            bytes.erase(at, random() % 8);
            break;
          default:
            bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 12));
        }
        if (bytes.empty()) bytes.push_back('x');
      }
      try {
        const MeshFile file = read(bytes, "a.obj");
        ++accepted;
        const auto& triangles = file.mesh.triangles;
        REQUIRE(file.mesh.positions.allFinite());
        if (triangles.size() > 0) {
          REQUIRE(triangles.minCoeff() >= 0);
          REQUIRE(triangles.maxCoeff() < file.mesh.vertex_count());
        }
      } catch (const sphparam::ReadError&) {
        ++refused;
      }
    }
  CHECK(accepted > 1000);
  CHECK(refused > 1000);
}
