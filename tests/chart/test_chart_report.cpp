#include <catch2/catch.hpp>

#include "sphparam/chart/chart_report.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Matchers::StartsWith;

TEST_CASE("chart_report: the figures of the chart of a map, whatever the length of its rays") {
  const TriangleMesh mesh = icosphere(2);
  const std::optional<ChartReport> report = report_chart(mesh, {3 * mesh.positions}, 1);
  REQUIRE(report);
  const SphericalChart chart =
      spherical_chart(mesh, Topology(mesh), normalised(3 * mesh.positions), 1);
  CHECK(report->certificate.one_to_one());
  CHECK(report->vertices == chart.points.rows());
  CHECK(report->triangles == chart.triangles.rows());
  CHECK(report->wedges == chart.wedge_count());
  CHECK(report->counts.splits() == chart.counts.splits());
  CHECK_THAT(chart_line(report), StartsWith("chart: certified, "));
}

TEST_CASE("chart_report: none of a map that folds, and no figures of one that was not made") {
  const TriangleMesh mesh = icosphere(1);
  SphereMap folded{mesh.positions};
  folded.points.row(0) *= -1;
  const std::optional<ChartReport> none = report_chart(mesh, folded, 1);
  CHECK_FALSE(none);
  CHECK_THAT(chart_line(none), StartsWith("chart: none, "));
  CHECK(chart_line(ChartReport{.not_made = "out of memory"}) == "chart: not made: out of memory");
}

TEST_CASE("chart_report: what fails is counted") {
  ChartReport report;
  report.certificate.folded = {3, 4};
  report.certificate.torn = {1};
  CHECK_THAT(chart_line(report),
             StartsWith("chart: not one-to-one, 2 folded, 1 torn edges, 0 splits "));
  report.certificate.outside = {1, 2, 3};
  report.certificate.malformed = {4};
  report.certificate.around_pole = {5};
  CHECK_THAT(chart_line(report),
             StartsWith("chart: not one-to-one, 2 folded, 1 torn edges, 3 wedges outside, "
                        "1 malformed, 1 around a pole, 0 splits "));
}
