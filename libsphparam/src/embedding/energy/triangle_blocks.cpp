#include "embedding/energy/triangle_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "elementary.h"
#include "sphere/solid_angle.h"
#include "sphparam/parallel.h"

// Triangles on the rim of a block are packed with every block that they touch, and count in the
// first: nothing is ever written from two sides.

namespace sphparam {
namespace {

size_t at(int i) { return static_cast<size_t>(i); }

/// Appends packs of these triangles; lanes left over in the last one repeat its last triangle.
/// Returns how many packs.
int append_packs(const Topology& topology, const RestTriangles& source, const FillerMarks& pressed,
                 const std::vector<int>& new_name, const std::vector<Face>& faces,
                 std::vector<TrianglePack>& packs) {
  for (size_t i = 0; i < faces.size(); ++i) {
    const int filled = static_cast<int>(i % pack_width);
    if (filled == 0) packs.emplace_back();
    std::array<Vertex, 3> corners;
    for (int k = 0; k < 3; ++k) corners[at(k)] = new_name[at(topology.vertex(faces[i], k))];
    for (int lane = filled; lane < pack_width; ++lane) {
      fill_lane(source[at(faces[i])], corners, lane, packs.back());
      if (!pressed.empty() && pressed[at(faces[i])]) press_lane(lane, packs.back());
    }
  }
  return static_cast<int>((faces.size() + pack_width - 1) / pack_width);
}

/// To some per mille, mostly without an arctangent.
double about_half_of_solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const HalfSolidAngle half = half_solid_angle_of(a, b, c);
  constexpr double small = 0.1;
  if (half.sine < small * half.cosine) return half.sine / half.cosine;
  return elementary::atan2(half.sine, half.cosine);
}

}  // namespace

std::vector<Vertex> patch_order(const Topology& topology) {
  const int n = topology.vertex_count();
  std::vector<Vertex> order;
  order.reserve(at(n));
  std::vector<char> seen(at(n), 0);
  const auto take = [&](Vertex v) {
    seen[at(v)] = 1;
    order.push_back(v);
  };
  const auto grow = [&](Vertex seed) {
    size_t head = order.size();
    const size_t full = head + TriangleBlocks::size;
    take(seed);
    for (; head < order.size() && order.size() < full; ++head) {
      topology.for_each_outgoing(order[head], [&](Halfedge h) {
        const Vertex w = topology.target(h);
        if (!seen[at(w)] && order.size() < full) take(w);
      });
    }
  };
  for (Vertex start = 0; start < n; ++start) {
    if (seen[at(start)]) continue;
    size_t rim = order.size();
    grow(start);
    for (; rim < order.size(); ++rim) {
      topology.for_each_outgoing(order[rim], [&](Halfedge h) {
        if (!seen[at(topology.target(h))]) grow(topology.target(h));
      });
    }
  }
  return order;
}

TriangleBlocks::TriangleBlocks(const Topology& topology, const RestTriangles& source,
                               const std::vector<Vertex>& old_name,
                               const std::vector<int>& new_name, const std::vector<int>& start,
                               const FillerMarks& pressed) {
  const int n = topology.vertex_count();
  slots_.resize(at(topology.halfedge_count()));
  std::vector<int> place(at(topology.face_count()), -1);
  std::vector<Face> owned, touching;
  packs_.reserve(at(topology.face_count()) / 7);
  const auto append = [&](const std::vector<Face>& faces, int first_place) {
    for (size_t i = 0; i < faces.size(); ++i) {
      place[at(faces[i])] = first_place + static_cast<int>(i);
    }
    return append_packs(topology, source, pressed, new_name, faces, packs_);
  };
  for (int first = 0; first < n; first += size) {
    const int last = std::min(n, first + size);
    owned.clear();
    touching.clear();
    for (int v = first; v < last; ++v) {
      topology.for_each_outgoing(old_name[at(v)], [&](Halfedge h) {
        const int a = new_name[at(topology.target(h))], b = new_name[at(topology.apex(h))];
        const int least = std::min(a, b);
        // Taken at the block's first corner of the triangle.
        if (std::min({a >= first ? a : n, b >= first ? b : n, v}) < v) return;
        (least < first ? touching : owned).push_back(Topology::face(h));
      });
    }
    Block b{packs_.size(), static_cast<int>(owned.size()), 0};
    b.packs = append(owned, 0);
    b.packs += append(touching, b.packs * pack_width);
    blocks_.push_back(b);
    for (int v = first; v < last; ++v) {
      int entry = start[at(v)];
      topology.for_each_outgoing(old_name[at(v)], [&](Halfedge h) {
        slots_[at(entry++)] = 4 * place[at(Topology::face(h))] + Topology::corner(h);
      });
    }
  }
  packs_.shrink_to_fit();
}

double TriangleBlocks::covering(const std::vector<ImagePoint>& image, int threads) const {
  std::vector<double> partial(blocks_.size());
  parallel_for(count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto b = static_cast<size_t>(first); b < static_cast<size_t>(last); ++b) {
      for (int t = 0; t < blocks_[b].owned; ++t) {
        const TrianglePack& pack = packs_[blocks_[b].first_pack + at(t / pack_width)];
        const auto corner = [&](int k) {
          return image[at(pack.corner[k][t % pack_width])].vector();
        };
        partial[b] += about_half_of_solid_angle(corner(0), corner(1), corner(2));
      }
    }
  });
  double sum = 0;
  for (const double angle : partial) sum += angle;
  return sum / (2 * std::numbers::pi);
}

double TriangleBlocks::energy(const std::vector<ImagePoint>& image,
                              const DistortionEnergy& distortion, int threads) const {
  std::vector<double> partial(blocks_.size());
  parallel_for(static_cast<std::int64_t>(blocks_.size()), grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto b = static_cast<size_t>(first); b < static_cast<size_t>(last); ++b) {
                   partial[b] = guarded_energy(&packs_[blocks_[b].first_pack], blocks_[b].owned,
                                               image.data(), distortion);
                 }
               });
  double sum = 0;
  for (const double e : partial) sum += e;
  return sum;
}

void TriangleBlocks::measure_ring(int row, int first, int last, int lane, RingSlot* slots) const {
  const TrianglePack* packs = packs_of(row / size);
  for (int e = first; e < last; ++e, ++slots) {
    const int corner = this->corner(e), place = triangle(e);
    const TrianglePack& pack = packs[place / pack_width];
    const int from = place % pack_width;
    const double base = pack.inverse_base[from], height = pack.inverse_height[from];
    const double l2 = 1 / (base * base), h2 = 1 / (height * height), t = pack.foot[from];
    const double along = corner == 1 ? 1 - t : t;
    const double base2 = corner == 0 ? l2 : along * along * l2 + h2;
    const double product = corner == 0   ? t * l2
                           : corner == 1 ? (1 - t) * l2
                                         : h2 - t * (1 - t) * l2;
    slots->alpha[lane] = static_cast<float>(std::copysign(l2 * h2 / (8 * base2), base));
    slots->beta[lane] = static_cast<float>(base2 / 8);
    slots->shear[lane] = static_cast<float>(product / base2);
  }
}

}  // namespace sphparam
