#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "chart/longitude.h"
#include "chart/settle.h"
#include "chart/sheet.h"
#include "chart/spread.h"
#include "chart/unbend.h"
#include "exact_area.h"
#include "maps.h"
#include "sphparam/chart/chart_failure.h"
#include "sphparam/chart/chart_report.h"
#include "sphparam/parameterize.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Matchers::Contains;

namespace {

constexpr double grid = 0x1p-24;

bool on_grid(double x) { return std::floor(x / grid) * grid == x; }

/// What a file of floats holds, that counts u or v from one end or the other.
ChartCertificate as_floats(SphericalChart chart, bool u_mirrored = false, bool v_mirrored = false) {
  for (const int k : {0, 1}) {
    const bool mirrored = k == 0 ? u_mirrored : v_mirrored;
    for (Eigen::Index w = 0; w < chart.uv.rows(); ++w) {
      double& x = chart.uv(w, k);
      x = mirrored ? 1 - static_cast<double>(static_cast<float>(1 - x))
                   : static_cast<double>(static_cast<float>(x));
    }
  }
  return certify_chart(chart);
}

/// All that holds of a chart that settled, beside the one that it was.
void check_settled(const SphericalChart& before, double most_shift = 2e-4) {
  const SphericalChart chart = settled(before, 1);
  REQUIRE(chart.certificate.one_to_one());
  CHECK(chart.triangles == before.triangles);
  CHECK(chart.wedges == before.wedges);
  CHECK(chart.points == before.points);
  for (int w = 0; w < chart.wedge_count(); ++w) {
    if (chart.wedge_kinds[static_cast<size_t>(w)] == WedgeKind::PoleFan) continue;
    CHECK((on_grid(chart.uv(w, 0)) && on_grid(chart.uv(w, 1))));
  }
  for (const bool u : {false, true}) {
    for (const bool v : {false, true}) CHECK(as_floats(chart, u, v).one_to_one());
  }
  const ExactArea area = exact_area(chart);
  CHECK(area.sum == 1);
  CHECK(area.not_positive == 0);
  CHECK(chart.certificate.max_shift < most_shift);
}

SphericalChart chart_of(const TriangleMesh& mesh, const SphereMap& map) {
  return spherical_chart(mesh, Topology(mesh), map);
}

/// A chart that no float32 holds: part of it is a ten-millionth as large as it was, or less.
SphericalChart crowded_chart(double factor, std::mt19937& random) {
  const TriangleMesh mesh = icosphere(3);
  for (;;) {
    const SphereMap map =
        rotated(squashed(rotated({mesh.positions}, random_rotation(random)), factor),
                random_rotation(random));
    if (certify(Topology(mesh), map).bijective()) return chart_of(mesh, map);
  }
}

}  // namespace

TEST_CASE("settle: hundreds of triangles in one cell of float32 come to lie side by side") {
  std::mt19937 random(31);
  for (const double factor : {1e-7, 1e-9, 1e-11, 1e-13}) {
    for (int i = 0; i < 3; ++i) {
      const SphericalChart chart = crowded_chart(factor, random);
      REQUIRE_FALSE(as_floats(chart).one_to_one());
      check_settled(chart);
    }
  }
}

TEST_CASE("settle: crowds on the seam and at the poles") {
  std::mt19937 random(32);
  const TriangleMesh mesh = icosphere(3);
  for (const double latitude : {0.0, 1e-8, 0.4, 1.5, 3.1415926}) {
    const SphereMap small = squashed(rotated({mesh.positions}, random_rotation(random)), 1e-9);
    const Eigen::AngleAxisd onto_seam(latitude, Vector3::UnitY());
    const SphericalChart chart = chart_of(mesh, rotated(small, onto_seam.toRotationMatrix()));
    check_settled(chart, 1e-3);  // about ±z, cells are long and thin
  }
}

TEST_CASE("settle: the caller is asked, and what it throws comes back") {
  std::mt19937 random(31);
  const SphericalChart chart = crowded_chart(1e-9, random);
  CHECK_THROWS_AS(settled(chart, 1, [] { throw Cancelled(); }), Cancelled);
}

TEST_CASE("settle: a chart that float32 holds is rounded and nothing more") {
  const TriangleMesh mesh = uv_sphere(12, 5);
  const SphericalChart before = chart_of(mesh, {mesh.positions});
  const SphericalChart chart = settled(before, 1);
  CHECK(chart.counts.nudged_vertices == 0);
  CHECK((chart.uv - before.uv).cwiseAbs().maxCoeff() <= grid);
  CHECK(moved_vertices(chart).empty());
  check_settled(before);
}

TEST_CASE("settle: what is no closed chart with two poles stays as it is") {
  std::mt19937 random(31);
  const SphericalChart chart = crowded_chart(1e-7, random);
  CHECK(settled(chart, 1).uv != chart.uv);
  SphericalChart open = chart, no_north = chart, no_south = chart;
  open.certificate.closed = false;
  no_north.north = -1;
  no_south.south = -1;
  for (const SphericalChart& one : {open, no_north, no_south})
    CHECK(settled(one, 1).uv == chart.uv);
}

TEST_CASE("sheet: a vertex may lie inside of it, one of the seam on the seam") {
  const TriangleMesh mesh = uv_sphere(12, 5);
  const Sheet sheet(chart_of(mesh, {mesh.positions}));
  constexpr double end = Sheet::cells, middle = 0.5 * Sheet::cells;
  int on_seam = 0, others = 0;
  for (Halfedge h = 0; h < 3 * sheet.face_count(); ++h) {
    const Vertex v = sheet.origin(h);
    if (sheet.is_pole(v)) continue;
    const bool seam = sheet.on_seam(v);
    ++(seam ? on_seam : others);
    CHECK(sheet.allows(v, {middle, middle}) == !seam);
    CHECK(sheet.allows(v, {middle, 0}) == seam);
    CHECK(sheet.allows(v, {0.75 * end, seam ? 0 : 0.75 * end}));
    for (const double out : {-middle, 0.0, end, 1.5 * end}) {
      CHECK_FALSE(sheet.allows(v, {out, seam ? 0 : middle}));
      if (!seam) CHECK_FALSE(sheet.allows(v, {middle, out}));
    }
  }
  CHECK(on_seam > 0);
  CHECK(others > 0);
}

TEST_CASE("chart: certified where triangles are smaller than the rounding of doubles") {
  std::mt19937 random(33);
  for (const double factor : {1e-15, 1e-16}) {
    for (int i = 0; i < 6; ++i) {
      const SphericalChart chart = crowded_chart(factor, random);
      CHECK(chart.certificate.one_to_one());
      CHECK(chart.counts.nudged_vertices > 0);
      CHECK(exact_area(chart).not_positive == 0);
      CHECK(as_floats(chart, true, true).one_to_one());
    }
  }
}

TEST_CASE("chart: bristles that shrink to nothing have a chart that float32 holds") {
  const TriangleMesh mesh = brush(1, 6, 60, 60);
  const SphereMap map = parameterize(mesh, {.balance = Balance::Conformal}).map;
  const SphericalChart chart = chart_of(mesh, map);
  REQUIRE_FALSE(as_floats(chart).one_to_one());
  check_settled(chart);
}

TEST_CASE("chart: what was moved is told") {
  std::mt19937 random(34);
  const SphericalChart chart = settled(crowded_chart(1e-9, random), 1);
  CHECK_THAT(moved_vertices(chart), Contains(" % of its vertices moved there, by up to "));
  const ChartReport report{
      .counts = chart.counts, .certificate = chart.certificate, .vertices = chart.points.rows()};
  CHECK_THAT(chart_line(report), Contains(moved_vertices(chart)));
}

TEST_CASE("chart: vertices that moved are counted once each") {
  std::mt19937 random(38);
  for (const double factor : {1e-9, 1e-15}) {
    const SphericalChart chart = settled(crowded_chart(factor, random), 1);
    int moved = 0;
    for (Vertex v = 0; v < chart.points.rows(); ++v) {
      const ChartPoint mapped = chart_point(chart.points.row(v));
      if (v == chart.north || v == chart.south) continue;
      moved +=
          std::abs(chart.uv(v, 0) - mapped.u) > grid || std::abs(chart.uv(v, 1) - mapped.v) > grid;
    }
    CHECK(chart.counts.nudged_vertices == moved);
  }
}

TEST_CASE("sheet: vertices taken out come back, and all is as it was") {
  std::mt19937 random(35);
  const TriangleMesh mesh = icosphere(3);
  const SphericalChart chart = chart_of(mesh, rotated({mesh.positions}, random_rotation(random)));
  Sheet sheet(chart);
  const Sheet whole(chart);
  int out = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto h = static_cast<Halfedge>(random() % static_cast<unsigned>(3 * sheet.face_count()));
    if (sheet.is_out(Topology::face(h)) || !sheet.may_take_out(h)) continue;
    sheet.take_out(h);
    ++out;
  }
  CHECK(out > mesh.vertex_count() / 2);
  int left = 0;
  for (Face f = 0; f < sheet.face_count(); ++f) left += !sheet.is_out(f);
  CHECK(left == whole.face_count() - 2 * out);
  while (sheet.any_out()) {
    const Halfedge h = sheet.put_back();
    sheet.move(sheet.origin(h), whole.place(sheet.origin(h)));
  }
  for (Halfedge h = 0; h < 3 * whole.face_count(); ++h) {
    CHECK(sheet.origin(h) == whole.origin(h));
    CHECK(sheet.twin(h) == whole.twin(h));
    if (whole.is_pole(whole.origin(h))) continue;
    CHECK((sheet.corner(h).x == whole.corner(h).x && sheet.corner(h).y == whole.corner(h).y));
  }
}

TEST_CASE("sheet: the gradient of a height is what it changes by") {
  std::mt19937 random(36);
  const TriangleMesh mesh = icosphere(1);
  Sheet sheet(chart_of(mesh, rotated({mesh.positions}, random_rotation(random))));
  constexpr double step = 16;  // cells, of a million
  for (Face f = 0; f < sheet.face_count(); ++f) {
    const std::array<SheetPoint, 3> gradient = sheet.height_gradient(f);
    for (int k = 0; k < 3; ++k) {
      const Vertex v = sheet.origin(3 * f + k);
      if (sheet.is_pole(v) || sheet.on_seam(v)) continue;
      const SheetPoint at = sheet.place(v);
      const auto difference = [&](double dx, double dy) {
        sheet.move(v, {at.x + dx, at.y + dy});
        const double ahead = sheet.height(f);
        sheet.move(v, {at.x - dx, at.y - dy});
        const double behind = sheet.height(f);
        sheet.move(v, at);
        return (ahead - behind) / (2 * step);
      };
      const SheetPoint& change = gradient[static_cast<size_t>(k)];
      CHECK(difference(step, 0) == Approx(change.x).margin(1e-3));
      CHECK(difference(0, step) == Approx(change.y).margin(1e-3));
    }
  }
}

TEST_CASE("spread: a crowd about a point makes room for itself") {
  std::mt19937 random(37);
  const TriangleMesh mesh = icosphere(3);
  Sheet sheet(chart_of(mesh, rotated({mesh.positions}, random_rotation(random))));
  // A vertex in the middle of the rectangle, and the ring around it at a hundredth of a cell.
  Vertex middle = 0;
  for (Vertex v = 0; v < sheet.vertex_count(); ++v) {
    const auto off = [&](Vertex w) {
      return sheet.is_pole(w) ? HUGE_VAL
                              : std::hypot(sheet.place(w).x - 0.5 * Sheet::cells,
                                           sheet.place(w).y - 0.5 * Sheet::cells);
    };
    if (off(v) < off(middle)) middle = v;
  }
  const SheetPoint at = sheet.place(middle);
  std::vector<Vertex> crowd = {middle};
  sheet.for_each_spoke(middle, [&](Halfedge h) { crowd.push_back(sheet.target(h)); });
  for (const Vertex v : crowd) {
    const SheetPoint away = sheet.place(v) - at;
    sheet.move(v, {at.x + 1e-8 * away.x, at.y + 1e-8 * away.y});
  }
  REQUIRE(sheet.lowest_around(middle) > 0);
  REQUIRE(sheet.lowest_around(middle) < 0.1);
  spread(sheet, crowd, 4);
  CHECK(sheet.lowest_around(middle) > 3.9);
}

TEST_CASE("unbend: a vertex far beyond the edge opposite to it, and all around, unfold") {
  std::mt19937 random(39);
  const TriangleMesh mesh = icosphere(3);
  Sheet sheet(chart_of(mesh, rotated({mesh.positions}, random_rotation(random))));
  int tried = 0;
  for (Halfedge h = 0; h < 3 * sheet.face_count() && tried < 10; h += 37) {
    const Halfedge across = Topology::next(h);
    const Vertex v = sheet.origin(h);
    const auto is_free = [&](Vertex w) { return !sheet.is_pole(w) && !sheet.on_seam(w); };
    std::vector<Vertex> region = {v};
    sheet.for_each_spoke(v, [&](Halfedge spoke) { region.push_back(sheet.target(spoke)); });
    if (!std::ranges::all_of(region, is_free)) continue;
    const SheetPoint a = sheet.corner(across), b = sheet.corner(Topology::next(across));
    const SheetPoint at = sheet.place(v);
    sheet.move(v, {a.x + b.x - at.x, a.y + b.y - at.y});
    REQUIRE(sheet.height(Topology::face(h)) < -1000);
    unbend(sheet, region, 4);
    for (const Vertex w : region) CHECK(sheet.lowest_around(w) > 0);
    ++tried;
  }
  CHECK(tried == 10);
}

TEST_CASE("chart: one that is not one-to-one is refused, with what is wrong with it") {
  const TriangleMesh mesh = uv_sphere(12, 5);
  SphericalChart chart = chart_of(mesh, {mesh.positions});
  CHECK_NOTHROW(require_one_to_one(chart, "a.ply"));
  chart.certificate.folded = {3, 5};
  CHECK_THROWS_WITH(require_one_to_one(chart, "a.ply"),
                    Contains("a.ply: its map is one-to-one, but thinner in (u, v)") &&
                        Contains("2 triangles fold there"));
  chart.counts.at_limit = true;
  CHECK_THROWS_WITH(require_one_to_one(chart, "a.ply"), Contains("splits that are made at most"));
}
