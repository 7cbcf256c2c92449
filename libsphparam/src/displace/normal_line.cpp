// Seen along n, corner i of a triangle at aᵢ (from the origin of the line) has the edge functions
//   eₖ = n · (aᵢ × aⱼ),  (i, j) the edge opposite to corner k,
// all of them positive where the line leaves the surface through it, and then the weights of the
// point; their sum is twice the triangle's area as the line sees it. The walk crosses the edge
// whose e is least. Of many lines the first triangle is seen side by side; few walk on.

#include "displace/normal_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lanes.h"
#include "rays/interpolation.h"

namespace sphparam {

namespace {

constexpr int most_crossed = 64;     // edges, before rays are asked
constexpr int most_layers = 16;      // of the surface that a ray is followed through, each way
constexpr double steepness = 3;      // of what is believed: height over distance
constexpr int most_approaches = 64;  // of the line's point nearest to the surface
constexpr double approached = 1e-3;  // of its distance, that a step gains no more

/// A triangle as a line sees it, with its corners from the line's origin. One line, or several
/// lanes of them.
template <class Number>
struct Seen {
  Number weights[3];  // of where the line meets the triangle's plane, not divided by
  Number sum;
  Number height;  // of that, along the line
};

template <class Vector>
SPHPARAM_INLINE auto see(const Vector (&a)[3], const Vector& normal) {
  using Number = decltype(dot(normal, normal));
  const Number w0 = dot(cross(a[1], a[2]), normal), w1 = dot(cross(a[2], a[0]), normal),
               w2 = dot(cross(a[0], a[1]), normal), sum = w0 + w1 + w2;
  const Number height =
      (w0 * dot(a[0], normal) + w1 * dot(a[1], normal) + w2 * dot(a[2], normal)) / sum;
  return Seen<Number>{{w0, w1, w2}, sum, height};
}

/// Some lines, and of each the triangle of its known point.
struct Few {
  static constexpr size_t count = 8;
  using Numbers = std::array<double, count>;
  using Vectors = std::array<Numbers, 3>;
  Vectors corners[3], origins, normals, barycentric;
};

struct FewSeen {
  Few::Numbers least, sum, height;  // least of the weights
  Few::Numbers known2;              // squared distance to the known point
};

void see(const Few& few, FewSeen& seen) {
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    for (size_t i = 0; i < Few::count; i += W) {
      const LaneVectors<W> origin = load<W>(few.origins, i);
      const LaneVectors<W> a[3] = {load<W>(few.corners[0], i) - origin,
                                   load<W>(few.corners[1], i) - origin,
                                   load<W>(few.corners[2], i) - origin};
      const LaneVectors<W> weights = load<W>(few.barycentric, i),
                           known = weights.x * a[0] + weights.y * a[1] + weights.z * a[2];
      const auto of = see(a, load<W>(few.normals, i));
      store(smaller(smaller(of.weights[0], of.weights[1]), of.weights[2]), &seen.least[i]);
      store(of.sum, &seen.sum[i]);
      store(of.height, &seen.height[i]);
      store(dot(known, known), &seen.known2[i]);
    }
  });
}

}  // namespace

LineTable::LineTable(size_t count) {
  for (size_t k = 0; k < 3; ++k) {
    origins[k].resize(count);
    normals[k].resize(count);
  }
}

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
    Vector3 a[3];
    for (int k = 0; k < 3; ++k) a[k] = surface_.position(surface_.triangles(face, k)) - line.origin;
    const auto seen = see(a, line.normal);
    if (crossed == 0) started_outwards = seen.sum > 0;
    const auto least = std::min_element(seen.weights, seen.weights + 3);
    if (*least >= 0) {
      if (!(seen.sum > 0)) return std::nullopt;
      return Walked{seen.height, started_outwards};
    }
    const auto opposite = static_cast<int>(least - seen.weights);
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

void NormalLines::find_all(const LineTable& lines, std::span<const SurfacePoint> known,
                           std::span<Crossing> crossings) const {
  for (size_t first = 0; first < known.size(); first += Few::count) {
    const size_t count = std::min(known.size() - first, Few::count);
    find_few(lines, first, known.subspan(first, count), crossings.subspan(first, count));
  }
}

void NormalLines::find_few(const LineTable& lines, size_t first,
                           std::span<const SurfacePoint> known,
                           std::span<Crossing> crossings) const {
  Few few;
  for (size_t i = 0; i < Few::count; ++i) {
    const size_t from = std::min(i, known.size() - 1);  // the last one again where there are fewer
    for (size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const Vertex corner = surface_.triangles(known[from].face, axis);
      for (size_t c = 0; c < 3; ++c)
        few.corners[k][c][i] = surface_.positions(corner, static_cast<Eigen::Index>(c));
      few.barycentric[k][i] = known[from].barycentric[axis];
      few.origins[k][i] = lines.origins[k][first + from];
      few.normals[k][i] = lines.normals[k][first + from];
    }
  }
  FewSeen seen;
  see(few, seen);
  for (size_t i = 0; i < known.size(); ++i) {
    const double height = seen.height[i];
    if (seen.least[i] >= 0 && seen.sum[i] > 0 && height * height <= seen.known2[i]) {
      crossings[i] = {height, LineHit::Walk};
    } else {
      const auto one = [i](const Few::Vectors& x) { return Vector3(x[0][i], x[1][i], x[2][i]); };
      crossings[i] = find(one(few.origins), one(few.normals), known[i]);
    }
  }
}

}  // namespace sphparam
