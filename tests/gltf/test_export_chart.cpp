#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "charted.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/forks.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

TEST_CASE("export_chart: u is where each convention has it, and runs from 0 to 1") {
  for (const ConventionInfo& info : all_conventions()) {
    INFO(info.name);
    const Charted egg({.convention = info.convention});
    const SphericalChart& chart = egg.chart.chart;
    REQUIRE(chart.certificate.one_to_one());
    const FloatRows uv = stored_uv(chart, {.mirrored = egg.chart.mirrored});
    CHECK(uv.col(0).minCoeff() == 0);
    CHECK(uv.col(0).maxCoeff() == 1);
    for (Vertex v = 0; v < static_cast<Vertex>(egg.map.points.rows()); ++v) {
      const Vector3 x = egg.map.points.row(v);
      const double theta = std::atan2(x.y(), x.x()), u0 = theta / (2 * std::numbers::pi);
      const double turns = info.turns * u0 + info.offset - static_cast<double>(uv(v, 0));
      if (chart.wedge_kinds[static_cast<size_t>(v)] == WedgeKind::PoleFan) continue;
      CHECK(std::abs(turns - std::round(turns)) < 1e-6);
      CHECK(static_cast<double>(uv(v, 1)) == Approx(std::acos(x.z()) / std::numbers::pi));
    }
  }
}

TEST_CASE("export_chart: θ of the attribute is that of the map in every convention") {
  for (const ConventionInfo& info : all_conventions()) {
    INFO(info.name);
    const Charted egg({.convention = info.convention});
    const ExportGeometry geometry = egg.geometry({.buffers = {.theta_phi = true}});
    const FloatRows& angles = geometry.surface.custom.front().values;
    const auto turn = static_cast<float>(2 * std::numbers::pi);
    for (Eigen::Index w = 0; w < angles.rows(); ++w) {
      const bool at_end = egg.chart.theta_offset == 0 && egg.chart.chart.uv(w, 0) == 1;
      CHECK(angles(w, 0) >= 0);
      CHECK((angles(w, 0) < turn || (at_end && angles(w, 0) == turn)));
    }
    for (Vertex v = 0; v < static_cast<Vertex>(egg.map.points.rows()); ++v) {
      const double theta = static_cast<double>(angles(v, 0)),
                   phi = static_cast<double>(angles(v, 1));
      const Vector3 x(std::cos(theta) * std::sin(phi), std::sin(theta) * std::sin(phi),
                      std::cos(phi));
      CHECK((x.transpose() - egg.map.points.row(v)).norm() < 1e-5);
    }
  }
}

TEST_CASE("export_chart: a kept topology has the mesh's vertices, triangles, and says what folds") {
  const Charted egg({.keep_topology = true});
  CHECK(egg.chart.chart.triangles == egg.file.mesh.triangles);
  const ExportGeometry geometry = egg.geometry();
  CHECK_FALSE(geometry.stored.one_to_one());
  const auto extras = chart_extras(egg.chart, geometry, {.keep_topology = true});
  CHECK(std::ranges::find(extras, std::pair<std::string, std::string>(
                                      "topology", "kept: no vertex was added")) != extras.end());
}

TEST_CASE("export_chart: texture coordinates as stored are certified as stored") {
  const Charted egg;
  CHECK(egg.geometry().stored.one_to_one());
  CHECK(egg.geometry({.buffers = {.uv = {.sixteen_bits = true}}}).stored.one_to_one());
  // All of it within a millionth of a turn: no float32 tells the vertices apart.
  Charted tiny;
  tiny.chart.chart.uv.col(0) = tiny.chart.chart.uv.col(0).array() * 1e-9 + 0.5;
  CHECK_FALSE(tiny.geometry().stored.folded.empty());
}

TEST_CASE(
    "export_chart: what float32 cannot tell apart is moved until it can, in every convention") {
  std::mt19937 random(5);
  const TriangleMesh mesh = icosphere(3);
  const SphereMap map = rotated(squashed({mesh.positions}, 1e-9), random_rotation(random));
  const Topology topology(mesh);
  const SphericalChart plain = spherical_chart(mesh, topology, map);
  REQUIRE(plain.certificate.one_to_one());
  REQUIRE_FALSE(certify_stored(plain, stored_uv(plain, {}), {}).one_to_one());
  for (const ConventionInfo& info : all_conventions()) {
    INFO(info.name);
    const ExportChart chart = export_chart(mesh, topology, map, {.convention = info.convention});
    const UvStorage storage{.mirrored = chart.mirrored};
    CHECK(certify_stored(chart.chart, stored_uv(chart.chart, storage), storage).one_to_one());
    CHECK(chart.chart.counts.nudged_vertices > 50);
    CHECK(chart.chart.certificate.max_shift < 1e-4);
  }
}

TEST_CASE("export: who is to work by one thread makes no other") {
  const Charted egg({}, 5);  // several chunks of all loops
  const GeometryOptions alone{
      .morph = Morph::Flat, .buffers = {.tangents = true, .theta_phi = true}, .threads = 1};
  CHECK(stays_alone([&] { egg.geometry(alone); }));
  GeometryOptions by_two = alone;
  by_two.threads = 2;
  CHECK_FALSE(stays_alone([&] { egg.geometry(by_two); }));
  CHECK(egg.geometry(alone).surface.positions == egg.geometry(by_two).surface.positions);
}
