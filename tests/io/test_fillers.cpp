#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A ball whose first faces are fillers, with all that a mesh can carry.
MeshFile marked_ball(int fillers = 30) {
  MeshFile file;
  file.mesh = icosphere(2);
  const auto faces = static_cast<size_t>(file.mesh.face_count());
  FillerMarks marks(faces, 0);
  std::fill_n(marks.begin(), fillers, 1);
  std::vector<double> numbers(faces), of_vertices(static_cast<size_t>(file.mesh.vertex_count()));
  for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i);
  for (size_t i = 0; i < of_vertices.size(); ++i) of_vertices[i] = static_cast<double>(10 * i);
  file.set_face_property({"number", ScalarType::Int32, numbers});
  file.set_vertex_property({"tens", ScalarType::Int32, of_vertices});
  file.corner_texcoords = CornerTexcoords::Random(3 * file.mesh.face_count(), 2);
  mark_fillers(file, marks);
  return file;
}

MappedMesh mapped_ball() {
  return MappedMesh({.file = marked_ball(), .map = {icosphere(2).positions}});
}

}  // namespace

TEST_CASE("fillers: marks are written down and read back, and taken away") {
  MeshFile file = marked_ball();
  const FillerMarks marks = fillers_of(file);
  REQUIRE(std::ssize(marks) == file.mesh.face_count());
  CHECK(std::count(marks.begin(), marks.end(), 1) == 30);
  const std::string bytes = serialise_ply(file);
  const MeshFile read = read_mesh(std::string_view(bytes), "ball.ply", ReadOptions{});
  CHECK(fillers_of(read) == marks);
  CHECK(read.find_face_property(filler_property)->type == ScalarType::Uint8);
  mark_fillers(file, {});
  CHECK(fillers_of(file).empty());
  CHECK_FALSE(file.find_face_property(filler_property));
  mark_fillers(file, FillerMarks(static_cast<size_t>(file.mesh.face_count()), 0));
  CHECK(fillers_of(file).empty());  // none is set
  mark_fillers(file, FillerMarks(static_cast<size_t>(file.mesh.face_count()), 1));
  CHECK(fillers_of(file).empty());  // nothing would be surface
}

TEST_CASE(
    "fillers: marks live in VTK and VTP, packed or not, and what has no place for them tells") {
  const MeshFile file = marked_ball();
  const auto tells = [](const std::vector<std::string>& losses) {
    return std::ranges::any_of(
        losses, [](const std::string& loss) { return loss.find("filler") != std::string::npos; });
  };
  for (const char* name : {"a.vtk", "a.vtp", "a.vtk.gz", "a.vtp.gz", "a.ply.gz"}) {
    const Folder folder;
    PendingFiles files;
    CHECK_FALSE(tells(add_mesh(files, folder / name, file)));
    files.publish();
    CHECK(fillers_of(read_mesh(folder / name)) == fillers_of(file));
  }
  for (const char* name : {"a.obj", "a.off", "a.mz3", "a.white", "a.surf.gii"}) {
    const Folder folder;
    PendingFiles files;
    CHECK(tells(add_mesh(files, folder / name, file)));
  }
}

TEST_CASE("fillers: what is left has all it carried, by its own faces and vertices") {
  const MeshFile file = marked_ball(), surface = without_fillers(file);
  CHECK(fillers_of(surface).empty());
  REQUIRE(surface.mesh.face_count() == file.mesh.face_count() - 30);
  for (Face f = 0; f < surface.mesh.face_count(); ++f) {
    const auto from = static_cast<Face>(surface.find_face_property("number")->values[f]);
    REQUIRE(from == f + 30);
    for (int k = 0; k < 3; ++k) {
      const Vertex v = surface.mesh.triangles(f, k), was = file.mesh.triangles(from, k);
      REQUIRE(surface.mesh.position(v) == file.mesh.position(was));
      REQUIRE(surface.find_vertex_property("tens")->values[v] == 10 * was);
      REQUIRE(surface.corner_texcoords->row(3 * f + k) == file.corner_texcoords->row(3 * from + k));
    }
  }
  for (const MeshDefect& defect : inspect_mesh(surface.mesh).defects) {
    CHECK(defect.kind != DefectKind::UnusedVertex);
  }
}

TEST_CASE("fillers: a mapped mesh knows them, and its surface") {
  const MappedMesh ball = mapped_ball();
  CHECK(ball.fillers() == fillers_of(ball.file()));
  CHECK(ball.surface().face_count() == ball.mesh().face_count() - 30);
  const MappedMesh plain(
      {.file = without_fillers(marked_ball(0)), .map = {icosphere(2).positions}});
  CHECK(plain.fillers().empty());
  CHECK(&plain.surface() == &plain.mesh());
}

TEST_CASE("fillers: a surface alone is refused for numbers that are not finite, by its vertices") {
  const Folder folder;
  MeshFile file = marked_ball();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto says = [&](const std::string& what) {
    const MappedMesh ball({.file = file, .map = {icosphere(2).positions}});
    PendingFiles files;
    CHECK_THROWS_AS(add_mapped(files, folder / "a.ply", ball, 1, {}, FillersInFile::Left),
                    UnmeasurableMesh);
    CHECK_THROWS_WITH(add_mapped(files, folder / "a.ply", ball, 1, {}, FillersInFile::Left),
                      Catch::Contains("a.ply: not written: " + what));
  };
  const Eigen::Index all = without_fillers(file).mesh.vertex_count();
  const std::string last = " of vertex " + std::to_string(all - 1) + " of " + std::to_string(all);
  REQUIRE(all < file.mesh.vertex_count());
  file.vertex_properties[0].values.back() = infinity;
  says("'tens'" + last);
  MeshFile plain = without_fillers(file);
  plain.mesh.positions(all - 1, 2) = infinity;
  PendingFiles files;
  CHECK_THROWS_WITH(add_mesh(files, folder / "a.ply", plain),
                    Catch::Contains("a.ply: not written: the position" + last));
}

TEST_CASE("fillers: files of maps keep them marked, others get the surface alone") {
  const Folder folder;
  const MappedMesh ball = mapped_ball();
  const auto written = [&](const std::string& name, FillersInFile fillers) {
    PendingFiles files;
    const std::vector<std::string> losses = add_mapped(files, folder / name, ball, 1, {}, fillers);
    files.publish();
    const std::int64_t left =
        std::ranges::count(losses,
                           "the surface alone, without the map: 30 fillers of holes left out") > 0
            ? 30
            : 0;
    const MeshFile read = read_mesh(folder / name);
    CHECK(read.mesh.face_count() == ball.mesh().face_count() - left);
    return std::pair(left, read);
  };
  CHECK(written("a.sph.ply", FillersInFile::Marked).first == 0);
  CHECK(fillers_of(read_mesh(folder / "a.sph.ply")) == ball.fillers());
  CHECK(load_mapped(folder / "a.sph.ply").fillers() == ball.fillers());
  CHECK(written("b.obj", FillersInFile::Marked).first == 30);
  CHECK(written("b.off", FillersInFile::Marked).first == 30);
  CHECK(written("c.obj", FillersInFile::Kept).first == 0);
  const auto [left, read] = written("d.ply", FillersInFile::Left);
  CHECK(left == 30);
  CHECK_FALSE(read_sphere(read));  // an open surface has no map
}
