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

/// Of some lines the triangles of their known points: corners, components.
constexpr size_t few = 8;
using Numbers = std::array<double, few>;
using Corners = std::array<std::array<Numbers, 3>, 3>;

struct FewSeen {
  Numbers height;
  Numbers stays;  // 0 where the line leaves the surface there, no farther than the known point is
};

template <int W>
SPHPARAM_INLINE void see(const LaneVectors<W> (&corners)[3], const LineTable& lines,
                         const PointTable& known, size_t at, FewSeen& seen, size_t i) {
  const LaneVectors<W> origin = load<W>(lines.origins, at),
                       a[3] = {corners[0] - origin, corners[1] - origin, corners[2] - origin},
                       weights = load<W>(known.barycentric, at),
                       to_known = weights.x * a[0] + weights.y * a[1] + weights.z * a[2];
  const auto of = see(a, load<W>(lines.normals, at));
  const Lanes<W> least = smaller(smaller(of.weights[0], of.weights[1]), of.weights[2]),
                 height2 = of.height * of.height, known2 = dot(to_known, to_known);
  // Choices of one comparison each: GCC 12 takes masks apart where they meet one another.
  const Lanes<W> yes = 0.0, no = 1.0;
  Lanes<W> stays = smaller(select(height2 < known2, yes, no), select(height2 == known2, yes, no));
  stays = larger(stays, select(least < 0.0, no, yes));
  stays = larger(stays, select(of.sum > 0.0, yes, no));
  store(of.height, &seen.height[i]);
  store(stays, &seen.stays[i]);
}

/// Lines whose known points lie on one triangle.
void see_one(const Vector3 (&triangle)[3], const LineTable& lines, const PointTable& known,
             size_t first, size_t count, FewSeen& seen) {
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    const LaneVectors<W> corners[3] = {all_lanes<W>(triangle[0]), all_lanes<W>(triangle[1]),
                                       all_lanes<W>(triangle[2])};
    for (size_t i = 0; i < count; i += W) see<W>(corners, lines, known, first + i, seen, i);
  });
}

/// Lines of a triangle each.
void see_each(const Corners& triangles, const LineTable& lines, const PointTable& known,
              size_t first, size_t count, FewSeen& seen) {
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    for (size_t i = 0; i < count; i += W) {
      const LaneVectors<W> corners[3] = {load<W>(triangles[0], i), load<W>(triangles[1], i),
                                         load<W>(triangles[2], i)};
      see<W>(corners, lines, known, first + i, seen, i);
    }
  });
}

/// How many points from one on, few at most, are on the same face.
size_t same_face(const PointTable& known, size_t first) {
  const size_t most = std::min(first + few, known.count);
  size_t last = first + 1;
  while (last < most && known.faces[last] == known.faces[first]) ++last;
  return last - first;
}

}  // namespace

LineTable::LineTable(size_t count) {
  for (size_t k = 0; k < 3; ++k) {
    origins[k].resize(count + padding);
    normals[k].resize(count + padding);
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

void NormalLines::find_all(const LineTable& lines, const PointTable& known,
                           std::span<Crossing> crossings) const {
  for (size_t first = 0; first < known.count;) {
    const size_t alike = same_face(known, first);
    const size_t count = alike >= few / 2 ? alike : std::min(few, known.count - first);
    find_few(lines, known, first, count, crossings);
    first += count;
  }
}

/// All with known points on one face if these are half of the most, or more.
void NormalLines::find_few(const LineTable& lines, const PointTable& known, size_t first,
                           size_t count, std::span<Crossing> crossings) const {
  const auto corner = [&](size_t i, int k) {
    return surface_.position(surface_.triangles(known.faces[i], k));
  };
  FewSeen seen;
  if (same_face(known, first) >= count) {
    see_one({corner(first, 0), corner(first, 1), corner(first, 2)}, lines, known, first, count,
            seen);
  } else {
    Corners corners;
    for (size_t i = 0; i < few; ++i) {
      const size_t from = first + std::min(i, count - 1);
      for (size_t k = 0; k < 3; ++k) {
        const Vector3 at = corner(from, static_cast<int>(k));
        for (size_t c = 0; c < 3; ++c) corners[k][c][i] = at[static_cast<int>(c)];
      }
    }
    see_each(corners, lines, known, first, count, seen);
  }
  for (size_t i = 0; i < count; ++i) {
    const size_t at = first + i;
    const auto one = [at](const std::array<PaddedNumbers, 3>& x) {
      return Vector3(x[0][at], x[1][at], x[2][at]);
    };
    crossings[at] = seen.stays[i] == 0 ? Crossing{seen.height[i], LineHit::Walk}
                                       : find(one(lines.origins), one(lines.normals), known[at]);
  }
}

}  // namespace sphparam
