#include <catch2/catch.hpp>

#include "batch/thumbnail.h"
#include "sphparam/io/up_axis.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("thumbnail: a mesh stands as its file says, and its sphere has the pole on top") {
  DrawnMesh drawn;
  drawn.file.mesh = icosphere(2);
  drawn.map = SphereMap{drawn.file.mesh.positions};
  drawn.file.mesh.positions.col(2) *= 2;  // tall, with z up
  drawn.file.mesh.positions.col(0) *= 0.5;
  const std::string stands = draw_thumbnail(drawn, 64);
  const Points z_up = drawn.file.mesh.positions;
  drawn.file.mesh.positions << z_up.col(0), z_up.col(2), -z_up.col(1);
  CHECK(draw_thumbnail(drawn, 64) != stands);
  note_up(drawn.file, {.direction = Vector3::UnitY()});
  CHECK(draw_thumbnail(drawn, 64) == stands);
}
