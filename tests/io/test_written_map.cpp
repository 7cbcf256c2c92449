#include <catch2/catch.hpp>

#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/written_map.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Contains;

namespace {

MeshFile file_of(const TriangleMesh& mesh) {
  MeshFile file;
  file.mesh = mesh;
  return file;
}

}  // namespace

TEST_CASE("written map: sx sy sz of a file, else its vertices, as they are") {
  const Folder folder;
  TriangleMesh egg = icosphere(1);
  const Points rays = egg.positions;
  egg.positions.col(2) *= 2;
  write_mesh(folder / "egg.ply", file_of(egg));
  const MeshSource mesh = read_source(folder / "egg.ply");

  write_mesh(folder / "ball.obj", file_of({7 * rays, egg.triangles}));
  const WrittenMap ball = read_map_of(mesh, folder / "ball.obj");
  CHECK(ball.map.points == 7 * rays);
  CHECK(ball.provenance.empty());

  write_mesh(folder / "egg.sph.ply", attach_map(file_of(egg), {rays}, {{"method", "by hand"}}));
  const WrittenMap mapped = read_map_of(mesh, folder / "egg.sph.ply");
  CHECK(mapped.map.points == rays);
  CHECK(mapped.provenance == Provenance{{"method", "by hand"}});
  CHECK(mapped.file.mesh.positions == egg.positions);
}

TEST_CASE("written map: a file of another connectivity is refused, by the name of what it is not") {
  const Folder folder;
  write_mesh(folder / "a.ply", file_of(icosphere(1)));
  write_mesh(folder / "b.ply", file_of(icosphere(2)));
  const MeshSource mesh = read_source(folder / "a.ply");
  CHECK_THROWS_WITH(read_map_of(mesh, folder / "b.ply"), Contains("not a sphere of a.ply"));
  CHECK_THROWS_WITH(read_map_of(mesh, folder / "b.ply", {}, "map"), Contains("not a map of a.ply"));
  const std::string advice = "which `sphparam repair` with the same options writes";
  CHECK_THROWS_WITH(read_map_of(mesh, folder / "b.ply"), !Contains(advice));
  const MeshFile file = file_of(icosphere(2));
  const MeshFile own = sphere_mesh(file, {file.mesh.positions}, {{"method", "progressive"}});
  for (const char* name : {"own.surf.gii", "lh.sphere"}) {
    write_mesh(folder / name, own, {.is_sphere = true});
    CHECK_THROWS_WITH(read_map_of(mesh, folder / name), Contains(advice));
  }
}
