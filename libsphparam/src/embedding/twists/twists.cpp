#include "embedding/twists/twists.h"

#include <optional>
#include <utility>

#include "embedding/twists/layer_slides.h"
#include "embedding/twists/strip.h"

// 1. A limb: loops of a few vertices, layer beside layer (limb_search.cpp).
// 2. Where layers have as many vertices each, they slide (layer_slides.cpp).
// 3. Between two layers lies a strip of triangles. If all beyond it is turned as one piece, about
//    the middle of the image of either layer, no other triangle changes: strips are decided one by
//    one, by their own energy, and cost next to nothing (strip.cpp).
// 4. What lies beyond the strips of a limb is turned by the product of their turns: that side of
//    the mesh which has fewer vertices.

namespace sphparam {
namespace {

size_t at(int i) { return static_cast<size_t>(i); }

using Image = std::vector<ImagePoint>;
using Matrix3 = Eigen::Matrix3d;

class Untwister {
 public:
  Untwister(const Topology& topology, const RestTriangles& source, const DistortionEnergy& energy,
            Image& image)
      : topology_(topology),
        source_(source),
        energy_(energy),
        image_(image),
        placed_(at(topology.vertex_count()), 0),
        reached_(placed_.size(), 0) {}

  int run() {
    LimbSearch search(topology_);
    int turned = 0;
    for (Limb limb = search.next(); !limb.empty(); limb = search.next()) {
      turned += slide_layers(topology_, source_, energy_, limb, image_);
      turned += untwist_limb(limb);
    }
    return turned;
  }

 private:
  int untwist_limb(const Limb& limb) {
    int turned = 0;
    std::vector<Matrix3> turns(1, Matrix3::Identity());  // of each layer and all beyond it
    size_t first = 0;                                    // layer that is turned
    for (size_t i = 1; i < limb.size(); ++i) {
      const std::optional<Matrix3> turn = better_turn(limb[i - 1], limb[i]);
      if (turn && ++turned == 1) first = i;
      turns.push_back(turn ? Matrix3(turns.back() * *turn) : turns.back());
    }
    if (turned > 0) apply(limb, turns, first);
    return turned;
  }

  std::optional<Matrix3> better_turn(const VertexLoop& fixed, const VertexLoop& moved) const {
    const std::optional<Strip> strip = Strip::between(topology_, source_, image_, fixed, moved);
    return strip ? strip->better_turn(energy_) : std::nullopt;
  }

  /// Layers from `first` on get their turns, what lies beyond them that of the last; or, with the
  /// same result, the other side the inverse of that.
  void apply(const Limb& limb, const std::vector<Matrix3>& turns, size_t first) {
    std::vector<Vertex> beyond = limb[first], before = limb[first - 1];
    const bool beyond_is_small = grow_until_one_ends(beyond, before);
    const Matrix3 of_last = turns.back();
    const Matrix3 back = beyond_is_small ? Matrix3(Matrix3::Identity()) : of_last.transpose();
    const auto for_each_in_layers = [&](const auto& visit) {
      for (size_t l = first; l < limb.size(); ++l) {
        for (const Vertex v : limb[l]) visit(v, l);
      }
    };
    for_each_in_layers([&](Vertex v, size_t l) {
      turn(v, back * turns[l]);
      placed_[at(v)] = 1;
    });
    for (const Vertex v : beyond_is_small ? beyond : before)
      if (!placed_[at(v)]) turn(v, beyond_is_small ? of_last : back);
    for_each_in_layers([&](Vertex v, size_t) { placed_[at(v)] = 0; });
  }

  void turn(Vertex v, const Matrix3& by) {
    image_[at(v)] = image_point((by * image_[at(v)].vector()).normalized());
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
  std::vector<char> placed_;   // in layers that have their turns; 0 between uses
  std::vector<char> reached_;  // 0 between uses
};

double energy_of_all(const Topology& topology, const RestTriangles& source,
                     const DistortionEnergy& energy, const Image& image) {
  PackedTriangles all;
  for (Face f = 0; f < topology.face_count(); ++f)
    all.add(source[at(f)], {topology.vertex(f, 0), topology.vertex(f, 1), topology.vertex(f, 2)});
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
