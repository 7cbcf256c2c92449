#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "chart/one_to_one.h"
#include "maps.h"
#include "sphparam/chart/spherical_chart.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

SphericalChart sound_chart() {
  std::mt19937 random(1);
  const TriangleMesh mesh = icosphere(2);
  return spherical_chart(mesh, Topology(mesh), rotated({mesh.positions}, random_rotation(random)));
}

int find_wedge(const SphericalChart& chart, WedgeKind kind) {
  for (int w = 0; w < chart.wedge_count(); ++w) {
    if (chart.wedge_kinds[static_cast<size_t>(w)] == kind) return w;
  }
  return -1;
}

/// A face without pole and seam.
Face ordinary_face(const SphericalChart& chart) {
  for (Face f = 0;; ++f) {
    bool ordinary = true;
    for (int k = 0; k < 3; ++k) {
      ordinary &= chart.wedge_kinds[static_cast<size_t>(chart.wedges(f, k))] == WedgeKind::Ordinary;
    }
    if (ordinary) return f;
  }
}

/// The certificate; the short question has the same answer, also of (u, v) that a chart is given,
/// one that is certified with others and one that is not certified at all.
ChartCertificate certified(const SphericalChart& chart) {
  const ChartCertificate certificate = certify_chart(chart);
  SphericalChart other = chart;
  other.certificate = {};
  CHECK(is_one_to_one(other, chart.uv) == certificate.one_to_one());
  other.uv.setConstant(0.5);
  CHECK(is_one_to_one(other, chart.uv) == certificate.one_to_one());
  CHECK_FALSE(is_one_to_one(other, other.uv));
  other.certificate = certificate;
  CHECK_FALSE(is_one_to_one(other, other.uv));
  CHECK(is_one_to_one(other, chart.uv) == certificate.one_to_one());
  const SphericalChart sound = sound_chart();
  const auto same = [](const Triangles& a, const Triangles& b) {
    return a.rows() == b.rows() && a == b;
  };
  if (same(chart.wedges, sound.wedges) && same(chart.triangles, sound.triangles) &&
      chart.wedge_vertices == sound.wedge_vertices && chart.uv.rows() == sound.uv.rows())
    CHECK(is_one_to_one(sound, chart.uv) == certificate.one_to_one());
  return certificate;
}

}  // namespace

TEST_CASE("chart certificate: a sound chart is one-to-one") {
  const ChartCertificate certificate = certified(sound_chart());
  CHECK(certificate.one_to_one());
  CHECK(certificate.north_turns == 1);
  CHECK(certificate.south_turns == 1);
}

TEST_CASE("chart certificate: a planted fold is found, in the faces that have it and only there") {
  SphericalChart chart = sound_chart();
  const Face f = ordinary_face(chart);
  // The first corner goes to the other side of the opposite edge.
  const Eigen::RowVector2d a = chart.uv.row(chart.wedges(f, 0)),
                           b = chart.uv.row(chart.wedges(f, 1)),
                           c = chart.uv.row(chart.wedges(f, 2));
  chart.uv.row(chart.wedges(f, 0)) = b + c - a;
  const ChartCertificate certificate = certified(chart);
  CHECK_FALSE(certificate.one_to_one());
  CHECK(certificate.torn.empty());
  const auto& folded = certificate.folded;
  CHECK(std::find(folded.begin(), folded.end(), f) != folded.end());
  for (const Face g : folded) {
    CHECK((chart.wedges.row(g).array() == chart.wedges(f, 0)).any());
  }
}

TEST_CASE("chart certificate: a triangle of no area is folded") {
  SphericalChart chart = sound_chart();
  const Face f = ordinary_face(chart);
  chart.uv.row(chart.wedges(f, 0)) = chart.uv.row(chart.wedges(f, 1));
  CHECK_FALSE(certified(chart).folded.empty());
}

TEST_CASE("chart certificate: points that are no sphere map are listed, and do not harm (u, v)") {
  for (const double scale : {-1.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    SphericalChart chart = sound_chart();
    CHECK(certified(chart).inverted.empty());
    const Face f = ordinary_face(chart);
    const Vertex v = chart.triangles(f, 0);
    chart.points.row(v) *= scale;
    const ChartCertificate certificate = certified(chart);
    CHECK(certificate.one_to_one());
    const auto& inverted = certificate.inverted;
    CHECK(std::find(inverted.begin(), inverted.end(), f) != inverted.end());
    for (const Face g : inverted) CHECK((chart.triangles.row(g).array() == v).any());
  }
}

TEST_CASE("chart certificate: seam copies one unit in the last place apart are torn") {
  for (const int column : {0, 1}) {
    SphericalChart chart = sound_chart();
    double& value = chart.uv(find_wedge(chart, WedgeKind::SeamCopy), column);
    value = std::nextafter(value, 0.0);
    const ChartCertificate certificate = certified(chart);
    CHECK(certificate.torn.size() >= 2);
    CHECK_FALSE(certificate.one_to_one());
  }
}

TEST_CASE("chart certificate: two corners of a face given wedges of their own tear it off") {
  SphericalChart chart = sound_chart();
  const Face f = ordinary_face(chart);
  const int w = chart.wedges(f, 0), copy = static_cast<int>(chart.wedge_count());
  chart.uv.conservativeResize(copy + 1, 2);
  chart.uv.row(copy) = chart.uv.row(w);
  chart.uv(copy, 0) += 1e-9;
  chart.wedge_vertices.push_back(chart.wedge_vertices[static_cast<size_t>(w)]);
  chart.wedge_kinds.push_back(WedgeKind::Ordinary);
  chart.wedges(f, 0) = copy;
  const ChartCertificate certificate = certified(chart);
  CHECK(certificate.folded.empty());
  CHECK(certificate.torn.size() == 2);
}

TEST_CASE("chart certificate: points outside, not finite, or ordinary ones on a rim are found") {
  for (const double value : {-1e-300, 1.5, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    SphericalChart chart = sound_chart();
    const int w = chart.wedges(ordinary_face(chart), 0);
    chart.uv(w, 1) = value;
    CHECK(certified(chart).outside == std::vector<int>{w});
  }
  SphericalChart chart = sound_chart();
  chart.uv(chart.wedges(ordinary_face(chart), 0), 1) = 0;
  CHECK_FALSE(certified(chart).one_to_one());
}

TEST_CASE("chart certificate: the rim must run one way") {
  SphericalChart chart = sound_chart();
  for (Face f = 0;; ++f) {
    const int k = chart.pole_corner(f);
    if (k < 0) continue;
    double& from = chart.uv(chart.wedges(f, (k + 1) % 3), 0);
    double& to = chart.uv(chart.wedges(f, (k + 2) % 3), 0);
    if (from == 0 || from == 1 || to == 0 || to == 1) continue;
    std::swap(from, to);
    const auto folded = certified(chart).folded;
    CHECK(std::find(folded.begin(), folded.end(), f) != folded.end());
    break;
  }
}

TEST_CASE("chart certificate: a rectangle that is covered twice is not one-to-one") {
  // Longitudes twice as fast about both poles: two seams, every piece positive.
  const int meridians = 12, rings = 3;
  const TriangleMesh mesh = uv_sphere(meridians, rings);
  SphericalChart chart = spherical_chart(mesh, Topology(mesh), {mesh.positions});
  const auto vertices = static_cast<int>(mesh.vertex_count());
  TextureCoordinates uv(chart.wedge_count() + rings, 2);
  uv.topRows(chart.wedge_count()) = chart.uv;
  // u < 1/2 becomes 2u, u > 1/2 becomes 2u − 1; u = 1/2 is a second seam: 1 in the east, 0 beyond.
  for (int w = 0; w < chart.wedge_count(); ++w) {
    double& u = uv(w, 0);
    u = u <= 0.5 ? 2 * u : 2 * u - 1;
  }
  for (int r = 0; r < rings; ++r) {
    const Vertex v = 1 + r * meridians + meridians / 2;
    const int copy = static_cast<int>(chart.wedge_count()) + r;
    uv.row(v) << 1, chart.uv(v, 1);
    uv.row(copy) << 0, chart.uv(v, 1);
    chart.wedge_vertices.push_back(v);
    chart.wedge_kinds.push_back(WedgeKind::SeamCopy);
    for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
      for (int k = 0; k < 3; ++k) {
        const bool in_west = (chart.points(chart.triangles(f, (k + 1) % 3), 1) < -1e-9) ||
                             (chart.points(chart.triangles(f, (k + 2) % 3), 1) < -1e-9);
        if (chart.wedges(f, k) == v && in_west) chart.wedges(f, k) = copy;
      }
    }
  }
  REQUIRE(vertices == chart.points.rows());
  chart.uv = uv;
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    const int k = chart.pole_corner(f);
    if (k < 0) continue;
    chart.uv(chart.wedges(f, k), 0) = 0.5 * (chart.uv(chart.wedges(f, (k + 1) % 3), 0) +
                                             chart.uv(chart.wedges(f, (k + 2) % 3), 0));
  }
  const ChartCertificate certificate = certified(chart);
  CHECK(certificate.folded.empty());
  CHECK(certificate.torn.empty());
  CHECK(certificate.malformed.empty());
  CHECK(certificate.north_turns == 2);
  CHECK_FALSE(certificate.one_to_one());
}

TEST_CASE("chart certificate: tables that do not fit together fail closed") {
  CHECK_FALSE(certified(SphericalChart{}).one_to_one());
  {
    SphericalChart chart = sound_chart();
    chart.wedges(3, 1) = static_cast<int>(chart.wedge_count());
    CHECK(certified(chart).malformed == std::vector<Face>{3});
  }
  {
    SphericalChart chart = sound_chart();
    std::swap(chart.wedges(3, 0), chart.wedges(3, 1));  // wedges of other vertices
    CHECK(certified(chart).malformed == std::vector<Face>{3});
  }
  {
    SphericalChart chart = sound_chart();
    chart.triangles.row(5) = chart.triangles.row(4).eval();
    chart.wedges.row(5) = chart.wedges.row(4).eval();
    CHECK_FALSE(certified(chart).closed);
  }
  {
    SphericalChart chart = sound_chart();
    chart.wedge_vertices.pop_back();
    CHECK_FALSE(certified(chart).one_to_one());
  }
}

TEST_CASE("chart certificate: (u, v) that are those of other points show in the shift") {
  SphericalChart chart = sound_chart();
  CHECK(certified(chart).max_shift < 1e-15);
  std::mt19937 random(5);
  chart.points = rotated({chart.points}, random_rotation(random)).points;
  CHECK(certified(chart).max_shift > 0.01);
}

TEST_CASE(
    "chart certificate: a pole trapezoid of no width is folded, two corners on a rim malformed") {
  const SphericalChart sound = sound_chart();
  Face f = 0;
  while (sound.pole_corner(f) < 0) ++f;
  const int pole = sound.pole_corner(f);
  const int a = sound.wedges(f, (pole + 1) % 3), b = sound.wedges(f, (pole + 2) % 3);

  SphericalChart narrow = sound;
  narrow.uv(a, 0) = narrow.uv(b, 0);
  const ChartCertificate folds = certified(narrow);
  CHECK(std::count(folds.folded.begin(), folds.folded.end(), f) == 1);
  CHECK_FALSE(folds.one_to_one());

  SphericalChart flat = sound;
  flat.uv(a, 1) = flat.uv(sound.wedges(f, pole), 1);
  const ChartCertificate rims = certified(flat);
  CHECK(std::count(rims.malformed.begin(), rims.malformed.end(), f) == 1);
  CHECK_FALSE(rims.one_to_one());
}
