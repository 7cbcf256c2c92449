#include "embedding/twists/layer_slides.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <utility>

#include "embedding/energy/packed_triangles.h"
#include "embedding/twists/strip.h"
#include "mesh/faces_around.h"

// 1. Layers slide where as many vertices are in each: the images of a layer are then the same
//    polygon as before, and the strip between two layers knows only how far one slides from the
//    other. Strips are decided one by one.
// 2. What lies beyond the last layer cannot slide. All slides together go round a whole number of
//    times: those that gain least are left out.
// 3. Where two layers slide alike, the strip between them is as before only if its triangles lie
//    alike all round. What comes of all slides is looked at, and taken back if it is no gain.

namespace sphparam {
namespace {

size_t at(int i) { return static_cast<size_t>(i); }

class Slider {
 public:
  Slider(const Topology& topology, const RestTriangles& source, const DistortionEnergy& energy,
         std::vector<ImagePoint>& image)
      : topology_(topology), source_(source), energy_(energy), image_(image) {}

  /// Requires: as many vertices in each.
  int run(std::vector<VertexLoop> layers) {
    std::vector<Strip::Slide> slides(layers.size());  // from the layer before
    for (size_t i = 1; i < layers.size(); ++i) {
      give_sense(layers[i - 1], layers[i]);
      slides[i] = better_slide(layers[i - 1], layers[i]);
    }
    leave_the_end(slides, static_cast<int>(layers.front().size()));
    const auto slid =
        std::ranges::count_if(slides, [](const Strip::Slide& slide) { return slide.by != 0; });
    return slid > 0 && slide_down(layers, slides) ? static_cast<int>(slid) : 0;
  }

 private:
  /// The order of `next` gets the sense of `layer`.
  void give_sense(const VertexLoop& layer, VertexLoop& next) const {
    if (has_on_left(layer, next) == has_on_left(next, layer)) std::ranges::reverse(next);
  }

  bool has_on_left(const VertexLoop& layer, const VertexLoop& other) const {
    const Halfedge h = topology_.find_halfedge(layer[0], layer[1]);
    return std::ranges::find(other, topology_.apex(h)) != other.end();
  }

  Strip::Slide better_slide(const VertexLoop& fixed, const VertexLoop& moved) const {
    const std::optional<Strip> strip = Strip::between(topology_, source_, image_, fixed, moved);
    return strip ? strip->better_slide(energy_) : Strip::Slide{};
  }

  static void leave_the_end(std::vector<Strip::Slide>& slides, int around) {
    int sum = 0;
    for (const Strip::Slide& slide : slides) sum += slide.by;
    const auto counts_against = [&](const Strip::Slide& s) {
      return sum > 0 ? s.by > 0 : s.by < 0;
    };
    while (sum % around != 0) {
      Strip::Slide* least = nullptr;
      for (Strip::Slide& slide : slides)
        if (counts_against(slide) && (!least || slide.falls_by < least->falls_by)) least = &slide;
      sum -= std::exchange(*least, {}).by;
    }
  }

  /// False: that would be no gain, and nothing has slid.
  bool slide_down(const std::vector<VertexLoop>& layers, const std::vector<Strip::Slide>& slides) {
    const PackedTriangles triangles = triangles_at(layers);
    const double energy = triangles.energy(image_, energy_), angle = triangles.solid_angle(image_);
    slide_all(layers, slides, 1);
    if (triangles.energy(image_, energy_) < energy &&
        std::abs(triangles.solid_angle(image_) - angle) < 1)
      return true;
    slide_all(layers, slides, -1);
    return false;
  }

  /// With a corner in a layer. Their corners are vertices.
  PackedTriangles triangles_at(const std::vector<VertexLoop>& layers) const {
    PackedTriangles triangles;
    for (const Face f : faces_around(topology_, std::views::join(layers)))
      triangles.add(source_[at(f)],
                    {topology_.vertex(f, 0), topology_.vertex(f, 1), topology_.vertex(f, 2)});
    return triangles;
  }

  void slide_all(const std::vector<VertexLoop>& layers, const std::vector<Strip::Slide>& slides,
                 int sense) {
    int by = 0;
    for (size_t i = 1; i < layers.size(); ++i) {
      by += slides[i].by;
      slide(layers[i], sense * by);
    }
  }

  void slide(const VertexLoop& layer, int by) {
    const int around = static_cast<int>(layer.size());
    std::vector<ImagePoint> images;
    for (const Vertex v : layer) images.push_back(image_[at(v)]);
    for (int i = 0; i < around; ++i)
      image_[at(layer[at(i)])] = images[at(((i + by) % around + around) % around)];
  }

  const Topology& topology_;
  const RestTriangles& source_;
  const DistortionEnergy& energy_;
  std::vector<ImagePoint>& image_;
};

}  // namespace

int slide_layers(const Topology& topology, const RestTriangles& source,
                 const DistortionEnergy& energy, const Limb& limb, std::vector<ImagePoint>& image) {
  Slider slider(topology, source, energy, image);
  int slid = 0;
  for (auto first = limb.begin(), end = first; first != limb.end(); first = end) {
    end = std::find_if(first, limb.end(),
                       [&](const VertexLoop& layer) { return layer.size() != first->size(); });
    slid += slider.run({first, end});
  }
  return slid;
}

}  // namespace sphparam
