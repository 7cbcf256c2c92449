#include "embedding/newton/twists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "elementary.h"
#include "embedding/energy/triangle_packs.h"
#include "sphere/solid_angle.h"

// 1. A loop: a shortest closed path of a few edges that has more than a few vertices on both sides.
// 2. A limb: from there on both ways layer by layer, as long as each is again a loop of a few.
// 3. Between two layers lies a strip of triangles. If all beyond it is turned as one piece, about
//    the middle of the image of the second layer, no other triangle changes: strips are decided one
//    by one, by their own energy, and cost next to nothing.
// 4. What lies beyond the strips of a limb is turned by the product of their turns: that side of
//    the mesh which has fewer vertices.

namespace sphparam {
namespace {

constexpr int most_around = 8;   // edges of a loop; with more around no twist stays
constexpr int least_beyond = 8;  // vertices on either side of the first loop of a limb
constexpr int ball_radius = most_around / 2;
constexpr int plain_radius = 2,
              plain_growth = 3;      // a layer of a plane has 6 vertices more than the one before
constexpr int most_valence = 16;     // of vertices in loops
constexpr double least_gain = 1e-3;  // of a strip's energy: not worth it

size_t at(int i) { return static_cast<size_t>(i); }

using Loop = std::vector<Vertex>;
using Image = std::vector<ImagePoint>;
using Matrix3 = Eigen::Matrix3d;

/// Rodrigues' formula.
Matrix3 turn_about(const Vector3& axis, double angle) {
  Matrix3 cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return Matrix3::Identity() + elementary::sin(angle) * cross +
         (1 - elementary::cos(angle)) * cross * cross;
}

/// Triangles in packs, whose corners are numbers of points of their own.
class Patch {
 public:
  void add(const RestTriangle& rest, const std::array<Vertex, 3>& corners) {
    const int lane = count_ % pack_width;
    if (lane == 0) packs_.emplace_back();
    for (int l = lane; l < pack_width; ++l) fill_lane(rest, corners, l, packs_.back());
    ++count_;
  }
  double energy(const Image& points, const DistortionEnergy& energy) const {
    return guarded_energy(packs_.data(), count_, points.data(), energy);
  }
  /// Of all triangles.
  double solid_angle(const Image& points) const {
    double sum = 0;
    for (int t = 0; t < count_; ++t) {
      const auto corner = [&](int k) {
        return points[at(packs_[at(t / pack_width)].corner[k][t % pack_width])].vector();
      };
      sum += sphparam::solid_angle(corner(0), corner(1), corner(2));
    }
    return sum;
  }

 private:
  std::vector<TrianglePack> packs_;
  int count_ = 0;
};

/// Visits the vertices next to a loop on one side.
template <class Visit>
void for_each_beside(const Topology& topology, const Loop& loop, bool left, const Visit& visit) {
  const size_t n = loop.size();
  for (size_t i = 0; i < n; ++i) {
    const Vertex next = loop[(i + 1) % n], previous = loop[(i + n - 1) % n];
    const Vertex from = left ? next : previous, to = left ? previous : next;
    Halfedge h = topology.rotate_ccw(topology.find_halfedge(loop[i], from));
    for (; topology.target(h) != to; h = topology.rotate_ccw(h)) visit(topology.target(h));
  }
}

/// Loops of a few edges through vertices.
class LoopSearch {
 public:
  explicit LoopSearch(const Topology& topology)
      : topology_(topology),
        depth_(at(topology.vertex_count()), -1),
        parent_(depth_.size(), -1),
        branch_(depth_.size(), -1),
        side_(depth_.size(), 0),
        plain_(depth_.size(), 0),
        valence_(depth_.size(), 0) {
    for (Halfedge h = 0; h < topology.halfedge_count(); ++h) ++valence_[at(topology.origin(h))];
  }

  /// A shortest one through v that goes round a limb; empty: there is none, or none is needed.
  Loop through(Vertex v) {
    Loop found;
    if (plain_[at(v)] || is_plain_about(v)) return found;
    if (grow_ball(v, ball_radius) && !ball_is_disk()) found = shortest_loop();
    forget_ball();
    return found;
  }

 private:
  bool is_hub(Vertex v) const { return valence_[at(v)] > most_valence; }

  /// Where a larger ball grows as on a plain surface, no vertex near its middle has such a loop.
  bool is_plain_about(Vertex v) {
    constexpr int radius = ball_radius + plain_radius;
    bool plain = grow_ball(v, radius);
    std::array<int, radius + 1> layers{};
    for (const Vertex w : ball_) ++layers[at(depth_[at(w)])];
    for (int d = 1; d <= radius; ++d) plain = plain && layers[at(d)] >= plain_growth * d;
    for (size_t i = 0; plain && i < ball_.size() && depth_[at(ball_[i])] <= plain_radius; ++i) {
      plain_[at(ball_[i])] = 1;
    }
    forget_ball();
    return plain;
  }

  void forget_ball() {
    for (const Vertex w : ball_) depth_[at(w)] = -1;
  }

  /// False: there is a hub in it.
  bool grow_ball(Vertex v, int radius) {
    ball_.assign(1, v);
    depth_[at(v)] = 0;
    for (size_t i = 0; i < ball_.size(); ++i) {
      const Vertex w = ball_[i];
      if (is_hub(w)) return false;
      if (depth_[at(w)] == radius) continue;
      topology_.for_each_outgoing(w, [&](Halfedge h) {
        const Vertex x = topology_.target(h);
        if (depth_[at(x)] >= 0) return;
        depth_[at(x)] = depth_[at(w)] + 1;
        parent_[at(x)] = w;
        branch_[at(x)] = w == v ? x : branch_[at(w)];
        ball_.push_back(x);
      });
    }
    return true;
  }

  /// By the numbers of its vertices, edges and triangles.
  bool ball_is_disk() const {
    int edges = 0, corners = 0;
    for (const Vertex w : ball_) {
      topology_.for_each_outgoing(w, [&](Halfedge h) {
        if (depth_[at(topology_.target(h))] < 0) return;
        ++edges;
        corners += depth_[at(topology_.apex(h))] >= 0;
      });
    }
    return static_cast<int>(ball_.size()) - edges / 2 + corners / 3 == 1;
  }

  Loop shortest_loop() {
    std::vector<std::pair<int, Halfedge>> closing;
    for (const Vertex a : ball_) {
      topology_.for_each_outgoing(a, [&](Halfedge h) {
        const Vertex b = topology_.target(h);
        if (depth_[at(a)] < 1 || depth_[at(b)] < 1 || branch_[at(a)] == branch_[at(b)]) return;
        const int length = depth_[at(a)] + depth_[at(b)] + 1;
        if (length <= most_around && a < b) closing.emplace_back(length, h);
      });
    }
    std::ranges::sort(closing);
    for (const auto& [length, h] : closing) {
      Loop loop = closed_by(h);
      if (goes_round(loop)) return loop;
    }
    return {};
  }

  Loop closed_by(Halfedge h) const {
    Loop loop;
    for (Vertex a = topology_.origin(h); a >= 0 && depth_[at(a)] > 0; a = parent_[at(a)]) {
      loop.push_back(a);
    }
    loop.push_back(ball_.front());
    std::ranges::reverse(loop);
    for (Vertex b = topology_.target(h); depth_[at(b)] > 0; b = parent_[at(b)]) loop.push_back(b);
    return loop;
  }

  /// Has it more than a few vertices on its left, and on its right?
  bool goes_round(const Loop& loop) { return reaches(loop, true) && reaches(loop, false); }

  bool reaches(const Loop& loop, bool left) {
    for (const Vertex v : loop) side_[at(v)] = 1;
    std::vector<Vertex> seen;
    const auto enter = [&](Vertex v) {
      if (std::exchange(side_[at(v)], 1) == 0) seen.push_back(v);
    };
    for_each_beside(topology_, loop, left, enter);
    bool hub = false;
    for (size_t i = 0; i < seen.size() && std::ssize(seen) < least_beyond; ++i) {
      hub = is_hub(seen[i]);  // as good as many vertices
      if (hub) break;
      topology_.for_each_outgoing(seen[i], [&](Halfedge h) { enter(topology_.target(h)); });
    }
    for (const Vertex v : loop) side_[at(v)] = 0;
    for (const Vertex v : seen) side_[at(v)] = 0;
    return hub || std::ssize(seen) >= least_beyond;
  }

  const Topology& topology_;
  std::vector<int> depth_;  // −1: not in the ball
  std::vector<Vertex> parent_, branch_;
  std::vector<char> side_;  // 0 between uses
  std::vector<char> plain_;
  std::vector<int> valence_;
  std::vector<Vertex> ball_;
};

class Untwister {
 public:
  Untwister(const Topology& topology, const RestTriangles& source, const DistortionEnergy& energy,
            Image& image)
      : topology_(topology),
        source_(source),
        energy_(energy),
        image_(image),
        layer_(at(topology.vertex_count()), -1),
        used_(layer_.size(), 0),
        reached_(layer_.size(), 0) {}

  int run() {
    LoopSearch search(topology_);
    int turned = 0;
    for (Vertex v = 0; v < topology_.vertex_count(); ++v) {
      if (used_[at(v)]) continue;
      const Loop loop = search.through(v);
      if (!loop.empty()) turned += untwist_limb(loop);
    }
    return turned;
  }

 private:
  int untwist_limb(const Loop& loop) {
    std::vector<Loop> limb = layers_from(loop);
    int turned = 0;
    std::vector<Matrix3> turns(1, Matrix3::Identity());  // of each layer and all beyond it
    size_t first = 0;                                    // layer that is turned
    for (size_t i = 1; i < limb.size(); ++i) {
      const std::optional<Matrix3> turn = better_turn(limb[i - 1], limb[i]);
      if (turn && ++turned == 1) first = i;
      turns.push_back(turn ? Matrix3(turns.back() * *turn) : turns.back());
    }
    if (turned > 0) apply(limb, turns, first);
    for (const Loop& l : limb) {
      for (const Vertex v : l) layer_[at(v)] = -1;
    }
    return turned;
  }

  /// The layers of a limb in order, numbered in `layer_`.
  std::vector<Loop> layers_from(const Loop& loop) {
    mark(loop);
    std::vector<Loop> limb = layers_beyond(loop, true);
    std::ranges::reverse(limb);
    limb.push_back(loop);
    std::ranges::move(layers_beyond(loop, false), std::back_inserter(limb));
    for (size_t i = 0; i < limb.size(); ++i) {
      for (const Vertex v : limb[i]) layer_[at(v)] = static_cast<int>(i);
    }
    return limb;
  }

  void mark(const Loop& layer) {
    for (const Vertex v : layer) used_[at(v)] = 1;
  }

  std::vector<Loop> layers_beyond(const Loop& loop, bool left) {
    std::vector<Loop> layers;
    Loop next;
    const auto enter = [&](Vertex v) {
      if (!used_[at(v)] && std::ranges::find(next, v) == next.end()) next.push_back(v);
    };
    for_each_beside(topology_, loop, left, enter);
    while (is_loop(next)) {
      mark(next);
      layers.push_back(std::exchange(next, {}));
      for (const Vertex v : layers.back()) {
        topology_.for_each_outgoing(v, [&](Halfedge h) {
          if (std::ssize(next) <= most_around) enter(topology_.target(h));
        });
      }
    }
    return layers;
  }

  /// Is it one closed path? Then it is put into its order.
  bool is_loop(Loop& layer) const {
    if (std::ssize(layer) < 3 || std::ssize(layer) > most_around) return false;
    for (size_t i = 0; i + 1 < layer.size(); ++i) {
      const auto rest = layer.begin() + static_cast<long>(i) + 1;
      const auto next = std::find_if(
          rest, layer.end(), [&](Vertex v) { return topology_.find_halfedge(layer[i], v) >= 0; });
      if (next == layer.end()) return false;
      std::iter_swap(rest, next);
    }
    return topology_.find_halfedge(layer.back(), layer.front()) >= 0;
  }

  /// The turn of the second layer that lowers the strip's energy most; nothing: none does.
  std::optional<Matrix3> better_turn(const Loop& fixed, const Loop& moved) const {
    Image points;
    for (const Vertex v : fixed) points.push_back(image_[at(v)]);
    for (const Vertex v : moved) points.push_back(image_[at(v)]);
    const std::optional<Patch> strip = strip_between(fixed, moved);
    if (!strip) return std::nullopt;
    double least = (1 - least_gain) * strip->energy(points, energy_);
    const double covered = strip->solid_angle(points);
    std::optional<Matrix3> best;
    for (const Loop* layer : {&fixed, &moved}) {
      const std::optional<Vector3> middle = middle_of(*layer);
      if (!middle) continue;
      for (const int by : {-1, 1, -2, 2}) {
        const double angle = by * 2 * std::numbers::pi / static_cast<double>(layer->size());
        const Matrix3 turn = turn_about(*middle, angle);
        for (size_t i = 0; i < moved.size(); ++i) {
          points[fixed.size() + i] = image_point(turn * image_[at(moved[i])].vector());
        }
        const double value = strip->energy(points, energy_);
        if (!(value < least)) continue;
        // Triangles that wind about a middle once more are all positive, too.
        if (!(std::abs(strip->solid_angle(points) - covered) < 1)) continue;
        least = value;
        best = turn;
      }
    }
    return best;
  }

  std::optional<Vector3> middle_of(const Loop& layer) const {
    Vector3 sum = Vector3::Zero();
    for (const Vertex v : layer) sum += image_[at(v)].vector();
    if (!(sum.squaredNorm() > 0)) return std::nullopt;
    return sum.normalized();
  }

  /// Nothing: it is no ring of triangles.
  std::optional<Patch> strip_between(const Loop& fixed, const Loop& moved) const {
    const auto number = [&](Vertex v) {
      auto found = std::ranges::find(fixed, v);
      if (found != fixed.end()) return static_cast<int>(found - fixed.begin());
      found = std::ranges::find(moved, v);
      if (found == moved.end()) return -1;
      return static_cast<int>(fixed.size()) + static_cast<int>(found - moved.begin());
    };
    Patch strip;
    size_t count = 0;
    const int split = static_cast<int>(fixed.size());
    for (const Loop* layer : {&fixed, &moved}) {
      for (const Vertex v : *layer) {
        topology_.for_each_outgoing(v, [&](Halfedge h) {
          const Vertex p = topology_.target(h), q = topology_.apex(h);
          const int a = number(v), b = number(p), c = number(q);
          const int beyond = (a >= split) + (b >= split) + (c >= split);
          // Once a triangle: at the corner that is alone in its layer.
          const bool alone = beyond == 1 ? a >= split : beyond == 2 && a < split;
          if (b < 0 || c < 0 || !alone) return;
          const Face f = Topology::face(h);
          strip.add(rotated(source_[at(f)], Topology::corner(h)), {a, b, c});
          ++count;
        });
      }
    }
    if (count != fixed.size() + moved.size()) return std::nullopt;
    return strip;
  }

  /// Layers from `first` on get their turns, what lies beyond them that of the last; or, with the
  /// same result, the other side the inverse of that.
  void apply(const std::vector<Loop>& limb, const std::vector<Matrix3>& turns, size_t first) {
    std::vector<Vertex> beyond = limb[first], before = limb[first - 1];
    const bool beyond_is_small = grow_until_one_ends(beyond, before);
    const Matrix3 back =
        beyond_is_small ? Matrix3(Matrix3::Identity()) : Matrix3(turns.back().transpose());
    const auto turn = [&](Vertex v, const Matrix3& by) {
      image_[at(v)] = image_point((by * image_[at(v)].vector()).normalized());
    };
    for (const Vertex v : beyond_is_small ? beyond : before) {
      if (layer_[at(v)] < static_cast<int>(first)) turn(v, beyond_is_small ? turns.back() : back);
    }
    for (size_t l = first; l < limb.size(); ++l) {
      for (const Vertex v : limb[l]) turn(v, back * turns[l]);
    }
  }

  /// The two sides of a strip, from a layer each, until one is whole. True: the first is.
  bool grow_until_one_ends(std::vector<Vertex>& a, std::vector<Vertex>& b) {
    for (const std::vector<Vertex>* side : {&a, &b}) {
      for (const Vertex v : *side) reached_[at(v)] = 1;
    }
    const auto grow = [&](std::vector<Vertex>& side, size_t i) {
      topology_.for_each_outgoing(side[i], [&](Halfedge h) {
        const Vertex w = topology_.target(h);
        if (!std::exchange(reached_[at(w)], 1)) side.push_back(w);
      });
    };
    size_t i = 0;
    for (; i < a.size() && i < b.size(); ++i) {
      grow(a, i);
      grow(b, i);
    }
    for (const std::vector<Vertex>* side : {&a, &b}) {
      for (const Vertex v : *side) reached_[at(v)] = 0;
    }
    return i == a.size();
  }

  const Topology& topology_;
  const RestTriangles& source_;
  const DistortionEnergy& energy_;
  Image& image_;
  std::vector<int> layer_;     // of the limb at hand
  std::vector<char> used_;     // by a limb
  std::vector<char> reached_;  // 0 between uses
};

double energy_of_all(const Topology& topology, const RestTriangles& source,
                     const DistortionEnergy& energy, const Image& image) {
  Patch all;
  for (Face f = 0; f < topology.face_count(); ++f) {
    all.add(source[at(f)], {topology.vertex(f, 0), topology.vertex(f, 1), topology.vertex(f, 2)});
  }
  return all.energy(image, energy);
}

}  // namespace

int untwist(const Topology& topology, const RestTriangles& source, const DistortionEnergy& energy,
            std::vector<ImagePoint>& image) {
  Image turned = image;
  const int count = Untwister(topology, source, energy, turned).run();
  if (count == 0) return 0;
  // Pieces are turned up to rounding: what is as thin as that may have lost its orientation.
  const double before = energy_of_all(topology, source, energy, image);
  if (!(energy_of_all(topology, source, energy, turned) < before)) return 0;
  image = std::move(turned);
  return count;
}

}  // namespace sphparam
