#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "exact_area.h"
#include "io/polygons/welding.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parameterize.h"
#include "support/real_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace fs = std::filesystem;

TEST_CASE("real meshes: every map has a certified chart, by an independent count too") {
  for (const fs::path& path : real_meshes()) {
    INFO(path.filename().string());
    const TriangleMesh mesh =
        sphparam::prepare_for_mapping(sphparam::read_mesh(path.string())).mesh;
    const Topology topology(mesh);
    const SphereMap map = parameterize(mesh, {.quality = Quality::Draft}).map;
    const SphericalChart chart = spherical_chart(mesh, topology, map);
    CHECK(chart.certificate.one_to_one());
    CHECK(chart.certificate.max_shift < 1e-15);
    CHECK(chart.certificate.inverted.empty());
    CHECK(count_folds(chart) == 0);
    const Topology refined(chart.triangles, static_cast<int>(chart.points.rows()));
    CHECK(certify(refined, {chart.points}).bijective());
    // The meridian is a line; a fold takes about ten pieces.
    CHECK(chart.counts.splits() <
          4 * std::sqrt(mesh.face_count()) + 16 * chart.counts.folded_faces);
  }
}
