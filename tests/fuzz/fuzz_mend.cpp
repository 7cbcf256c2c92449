// What is done to any triangles: listed, mended, taken apart, wrapped, measured. A mended mesh says
// where all of it comes from and is mended for good; a sphere among them has a certified map; a
// wrap is a sphere that leaves nothing outside.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "expect.h"
#include "recipe.h"
#include "sphparam/errors.h"
#include "sphparam/io/components.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "sphparam/wrap/wrap.h"

namespace {

using namespace sphparam;
using namespace sphparam::tests;

RepairOptions options_of(Recipe& recipe) {
  RepairOptions options;
  const unsigned what = recipe.byte();
  options.duplicates = !(what & 1);
  options.orientation = !(what & 2);
  options.non_manifold = !(what & 4);
  options.keep_holes = (what & 8) != 0;
  options.handle_choice = static_cast<HandleChoice>(what / 16 % 4);
  if (what & 64) options.longest_handle = 100;
  if (what & 128) options.weld_share = recipe.byte() / 1024.0;
  options.least_kept = recipe.byte() / 255.0;
  return options;
}

void expect_origins(const TriangleMesh& soup, const RepairedMesh& made) {
  expect(std::ssize(made.vertex_origin) == made.mesh.vertex_count() &&
             std::ssize(made.face_origin) == made.mesh.face_count() &&
             std::ssize(made.corner_origin) == 3 * made.mesh.face_count(),
         "everything comes from somewhere");
  for (Eigen::Index v = 0; v < made.mesh.vertex_count(); ++v) {
    const Vertex from = made.vertex_origin[static_cast<std::size_t>(v)];
    expect(from == -1 || made.mesh.positions.row(v) == soup.positions.row(from),
           "what was there stays where it was");
  }
  for (const CreatedVertex& one : made.created)
    expect(
        made.vertex_origin.at(static_cast<std::size_t>(one.vertex)) == -1 && !one.mean_of.empty(),
        "a created vertex is the mean of some");
}

void expect_mended(const TriangleMesh& soup, const RepairOptions& options) {
  const RepairedMesh made = repair_mesh(soup, options);
  expect_origins(soup, made);
  if (!made.inspection.is_sphere()) return;
  const RepairedMesh again = repair_mesh(made.mesh);
  expect(again.mesh.triangles == made.mesh.triangles || options.keep_holes ||
             again.actions.front().kind >= RepairKind::TurnedOutward,
         "mended once, a mesh is mended");
  const Parameterization map =
      parameterize(made.mesh, {.fillers = made.fillers, .quality = Quality::Draft, .threads = 1});
  expect(map.certificate.bijective(), "the map is certified");
}

void expect_parts(const TriangleMesh& soup) {
  MeshSource source;
  source.file.mesh = soup;
  source.inspection = inspect_mesh(soup);
  Eigen::Index faces = 0;
  for (const MeshPart& part : connected_parts(std::move(source)))
    faces += part.source.file.mesh.face_count();
  expect(faces == soup.face_count(), "each face is in one part");
}

void expect_wrapped(const TriangleMesh& soup, unsigned taste) {
  const WrapOptions options{.resolution = 4 + static_cast<int>(taste % 16),
                            .largest = taste >= 128,
                            .faces = taste & 16 ? 40 : 0,
                            .threads = 1};
  try {
    const Wrap made = wrap_soup(soup, options);
    require_sphere(made.mesh, 1);
    expect(options.largest || options.faces > 0 || made.outside == 0, "a wrap encloses the soup");
  } catch (const UnmeasurableMesh&) {  // one point, or too large
  } catch (const VoxelError&) {
  }
}

void expect_measured(const TriangleMesh& soup, const TriangleMesh& other) {
  try {
    const SurfaceDistance apart = measure_distance(soup, other, {.samples = 200, .threads = 1});
    expect(apart.forth.max <= apart.forth.max_bound && apart.back.max <= apart.back.max_bound,
           "no point is farther than the bound");
    expect(apart.forth.mean <= apart.forth.max && apart.forth.rms <= apart.forth.max * (1 + 1e-12),
           "means are below the maximum");
  } catch (const UnmeasurableSurface&) {  // without area
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Recipe recipe({data, size});
  const unsigned taste = recipe.byte();
  const unsigned wrap = recipe.byte();
  const RepairOptions options = options_of(recipe);
  const TriangleMesh soup = recipe.soup();
  expect_mended(soup, options);
  if (taste % 4 == 0) expect_parts(soup);
  if (taste % 4 == 1) expect_wrapped(soup, wrap);
  if (taste % 4 == 2) expect_measured(soup, recipe.soup());
  return 0;
}
