#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "chart/nudge.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A sphere with vertices at the poles and along the meridian, so that its chart needs no split.
struct Flat {
  TriangleMesh mesh = uv_sphere(12, 6);
  Topology topology{mesh};
  FlatMesh flat{RefinedMesh(topology, {mesh.positions}, mesh.triangles, 1)};

  Flat() {
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
      const Vector3 x = mesh.position(v);
      if (x.head<2>().norm() < 1e-9) (x.z() > 0 ? flat.north : flat.south) = v;
      const double turn = std::atan2(x.y(), x.x()) / (2 * std::numbers::pi);
      const double u = std::abs(turn) < 1e-9 ? 0 : turn < 0 ? turn + 1 : turn;
      flat.uv.push_back({u, std::acos(std::clamp(x.z(), -1.0, 1.0)) / std::numbers::pi});
    }
  }

  std::vector<Face> folded() const {
    std::vector<Face> faces;
    for (Face f = 0; f < topology.face_count(); ++f)
      if (!flat.positive(f)) faces.push_back(f);
    return faces;
  }

  /// Far from the poles and from the meridian.
  bool is_inner(Vertex v) const {
    const ChartPoint& p = flat.uv[static_cast<size_t>(v)];
    return std::abs(p.v - 0.5) < 0.1 && std::abs(p.u - 0.5) < 0.3;
  }
};

double beyond(double from, double to, int roundings) {
  const double away = to > from ? 1 : to < from ? -1 : 0;
  return to * (1 + away * roundings * 0x1p-52);
}

}  // namespace

TEST_CASE("nudge: a vertex some roundings beyond an edge comes back, whichever way that is") {
  Flat sound;
  REQUIRE(sound.folded().empty());
  int tried = 0;
  for (Halfedge h = 0; h < sound.topology.halfedge_count(); ++h) {
    const Vertex v = sound.topology.origin(h);
    if (!sound.is_inner(v)) continue;
    Flat bent;
    std::vector<ChartPoint>& uv = bent.flat.uv;
    ChartPoint& place = uv[static_cast<size_t>(v)];
    const ChartPoint a = uv[static_cast<size_t>(sound.topology.target(h))],
                     b = uv[static_cast<size_t>(sound.topology.apex(h))];
    place = {beyond(place.u, (a.u + b.u) / 2, 64), beyond(place.v, (a.v + b.v) / 2, 64)};
    const std::vector<ChartPoint> before = uv;
    std::vector<Face> folded = bent.folded();
    REQUIRE(folded == std::vector<Face>{Topology::face(h)});
    const int moved = nudge(bent.flat, folded);
    CHECK(folded.empty());
    CHECK(bent.folded().empty());
    int elsewhere = 0;
    for (size_t i = 0; i < uv.size(); ++i) {
      elsewhere += uv[i].u != before[i].u || uv[i].v != before[i].v;
      CHECK(std::abs(uv[i].u - before[i].u) < 0x1p-38);
      CHECK(std::abs(uv[i].v - before[i].v) < 0x1p-38);
    }
    CHECK(moved == elsewhere);
    CHECK(moved > 0);
    ++tried;
  }
  CHECK(tried >= 12);
}

TEST_CASE("nudge: what no rounding unfolds stays where it is") {
  Flat bent;
  Vertex v = 0;
  while (!bent.is_inner(v)) ++v;
  bent.flat.uv[static_cast<size_t>(v)].u += 0.15;
  const std::vector<ChartPoint> before = bent.flat.uv;
  std::vector<Face> folded = bent.folded();
  const std::vector<Face> wanted = folded;
  REQUIRE_FALSE(folded.empty());
  CHECK(nudge(bent.flat, folded) == 0);
  CHECK(folded == wanted);
  for (size_t i = 0; i < before.size(); ++i) CHECK(bent.flat.uv[i].u == before[i].u);
}
