// Seen along n, corner i of a triangle at aᵢ (from the origin of the line) has the edge functions
//   eₖ = n · (aᵢ × aⱼ),  (i, j) the edge opposite to corner k,
// all of them positive where the line leaves the surface through it, and then the weights of the
// point; their sum is twice the triangle's area as the line sees it. The walk crosses the edge
// whose e is least.

#include "displace/normal_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "rays/interpolation.h"

namespace sphparam {

namespace {

constexpr int most_crossed = 64;     // edges, before rays are asked
constexpr int most_layers = 16;      // of the surface that a ray is followed through, each way
constexpr double steepness = 3;      // of what is believed: height over distance
constexpr int most_approaches = 64;  // of the line's point nearest to the surface
constexpr double approached = 1e-3;  // of its distance, that a step gains no more

}  // namespace

NormalLines::NormalLines(const TriangleMesh& surface, const Topology& topology)
    : surface_(surface), topology_(topology) {}

const RayScene& NormalLines::scene() const {
  std::call_once(scene_made_, [&] { scene_ = std::make_unique<RayScene>(surface_); });
  return *scene_;
}

Vector3 NormalLines::point(const SurfacePoint& on) const {
  return interpolate(surface_.positions, surface_.triangles, on);
}

std::optional<NormalLines::Walked> NormalLines::walk(const Line& line, Face start) const {
  Face face = start;
  bool started_outwards = false;
  for (int crossed = 0; crossed < most_crossed; ++crossed) {
    std::array<Vector3, 3> a;
    for (int k = 0; k < 3; ++k)
      a[static_cast<size_t>(k)] = surface_.position(surface_.triangles(face, k)) - line.origin;
    const std::array<double, 3> e = {line.normal.dot(a[1].cross(a[2])),
                                     line.normal.dot(a[2].cross(a[0])),
                                     line.normal.dot(a[0].cross(a[1]))};
    const double sum = e[0] + e[1] + e[2];
    if (crossed == 0) started_outwards = sum > 0;
    const auto least = std::min_element(e.begin(), e.end());
    if (*least >= 0) {
      if (!(sum > 0)) return std::nullopt;
      const Vector3 hit = (e[0] * a[0] + e[1] * a[1] + e[2] * a[2]) / sum;
      return Walked{hit.dot(line.normal), started_outwards};
    }
    const auto opposite = static_cast<int>(least - e.begin());
    face = Topology::face(topology_.twin(3 * face + (opposite + 1) % 3));
  }
  return std::nullopt;
}

/// The crossing of least height, up to `reach`; inwards ones only where there is no other.
std::optional<double> NormalLines::cast(const Line& line, double reach) const {
  const double step = scene().clearance();
  std::optional<double> outwards, inwards;
  for (const double way : {1.0, -1.0}) {
    double gone = -step;  // what lies at the origin counts too
    for (int layer = 0; layer < most_layers && gone < reach; ++layer) {
      const RayHit hit = scene().first_hit(line.at(way * gone), way * line.normal, reach - gone);
      if (hit.face < 0) break;
      gone += hit.distance;
      const double height = way * gone;
      gone += step;
      const auto corner = [&](int k) { return surface_.position(surface_.triangles(hit.face, k)); };
      const Vector3 area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
      auto& found = area.dot(line.normal) > 0 ? outwards : inwards;
      if (!found || std::abs(height) < std::abs(*found)) found = height;
    }
  }
  return outwards ? outwards : inwards;
}

/// From one point of the line to the surface's nearest, to that one's foot on the line, and so on:
/// each time nearer.
double NormalLines::approach(const Line& line, double height) const {
  for (int i = 0; i < most_approaches; ++i) {
    const NearestPoint nearest = scene().nearest(line.at(height));
    const double before = std::exchange(height, (point(nearest.on) - line.origin).dot(line.normal));
    if (std::abs(height - before) <= approached * std::sqrt(nearest.squared_distance)) break;
  }
  return height;
}

NormalLines::Crossing NormalLines::find(const Vector3& origin, const Vector3& normal,
                                        const SurfacePoint& known) const {
  const Line line{origin, normal};
  const std::optional<Walked> walked = walk(line, known.face);
  if (walked && walked->started_outwards &&
      std::abs(walked->height) <= (point(known) - origin).norm()) {
    return {walked->height, LineHit::Walk};
  }
  const double reach = steepness * std::sqrt(scene().nearest(origin, known.face).squared_distance);
  if (walked && std::abs(walked->height) <= reach) return {walked->height, LineHit::Walk};
  if (const std::optional<double> height = cast(line, reach)) return {*height, LineHit::Ray};
  return {approach(line, 0), LineHit::Near};
}

}  // namespace sphparam
