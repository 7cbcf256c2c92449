// A triangle gives each corner a kite: the corner, the middles of its two sides, the triangle's
// centre. One lookup in the kite's middle, as wide as the kite, stands for it.

#include "paint/paint_vertices.h"

#include <algorithm>
#include <cmath>

#include "sphparam/parallel.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

constexpr std::int64_t grain = 512;           // vertices
constexpr std::int64_t slice_size = 1 << 16;  // vertices between two reports
constexpr double own_weight = 7.0 / 12;       // the corner's weight in the middle of its kite …
constexpr double other = 5.0 / 24;            // … and that of the two others

using Colour = Eigen::Array4d;

Colour look_up(const EquirectangularImage& image, const Vector3& direction, double width) {
  const std::array<float, 4> colour = image.look_up(direction, width);
  return Eigen::Map<const Eigen::Array4f>(colour.data()).cast<double>();
}

Colour cell_colour(const Topology& topology, const SphereMap& map,
                   const EquirectangularImage& image, Vertex v) {
  const Vector3 own = map.point(v);
  Colour sum = Colour::Zero();
  double total = 0;
  topology.for_each_outgoing(v, [&](Halfedge h) {
    const Vector3 b = map.point(topology.target(h)), c = map.point(topology.apex(h));
    const double kite = (b - own).cross(c - own).norm() / 6;  // a third of the triangle
    sum += kite * look_up(image, own_weight * own + other * (b + c), std::sqrt(kite));
    total += kite;
  });
  if (!(total > 0)) return look_up(image, own, 0);
  return sum / total;
}

}  // namespace

Image paint_vertices(const Topology& topology, const SphereMap& map,
                     const EquirectangularImage& image, const Progress& progress, int threads) {
  const int count = topology.vertex_count();
  Image colours(count, 1, 4);
  const SrgbCurves& curves = SrgbCurves::get();
  for (std::int64_t slice = 0; slice < count; slice += slice_size) {
    report(progress, "painting vertices", static_cast<double>(slice) / count);
    const std::int64_t size = std::min<std::int64_t>(slice_size, count - slice);
    parallel_for(size, grain, threads, [&](std::int64_t first, std::int64_t last) {
      for (auto v = static_cast<Vertex>(slice + first); v < slice + last; ++v) {
        const Eigen::Array4f colour = cell_colour(topology, map, image, v).cast<float>();
        float* out = colours.pixel(v, 0);
        for (int c = 0; c < 3; ++c) out[c] = curves.to_srgb(colour[c]);
        out[3] = colour[3];
      }
    });
  }
  return colours;
}

}  // namespace sphparam
