#include "embedding/twists/limb_search.h"

#include <algorithm>
#include <iterator>
#include <utility>

// From a loop both ways, layer by layer: the neighbours of a layer that no limb has yet are the
// next, as long as they are again one loop of a few.

namespace sphparam {
namespace {

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

LimbSearch::LimbSearch(const Topology& topology)
    : topology_(topology), loops_(topology), used_(at(topology.vertex_count()), 0) {}

Limb LimbSearch::next() {
  while (next_ < topology_.vertex_count()) {
    const Vertex v = next_++;
    if (used_[at(v)]) continue;
    const VertexLoop loop = loops_.through(v);
    if (!loop.empty()) return limb_with(loop);
  }
  return {};
}

Limb LimbSearch::limb_with(const VertexLoop& loop) {
  mark(loop);
  Limb limb = layers_beyond(loop, Flank::Left);
  std::ranges::reverse(limb);
  limb.push_back(loop);
  std::ranges::move(layers_beyond(loop, Flank::Right), std::back_inserter(limb));
  return limb;
}

std::vector<VertexLoop> LimbSearch::layers_beyond(const VertexLoop& loop, Flank flank) {
  std::vector<VertexLoop> layers;
  VertexLoop next;
  const auto enter = [&](Vertex v) {
    if (!used_[at(v)] && std::ranges::find(next, v) == next.end()) next.push_back(v);
  };
  for_each_beside(topology_, loop, flank, enter);
  while (is_loop(next)) {
    mark(next);
    layers.push_back(std::exchange(next, {}));
    for (const Vertex v : layers.back()) {
      topology_.for_each_outgoing(v, [&](Halfedge h) {
        if (std::ssize(next) <= LoopSearch::most_around) enter(topology_.target(h));
      });
    }
  }
  return layers;
}

/// Is it one closed path, without hubs? Then it is put into its order.
bool LimbSearch::is_loop(VertexLoop& layer) const {
  if (std::ssize(layer) < 3 || std::ssize(layer) > LoopSearch::most_around) return false;
  if (std::ranges::any_of(layer, [&](Vertex v) { return loops_.is_hub(v); })) return false;
  for (size_t i = 0; i + 1 < layer.size(); ++i) {
    const auto rest = layer.begin() + static_cast<long>(i) + 1;
    const auto next = std::find_if(
        rest, layer.end(), [&](Vertex v) { return topology_.find_halfedge(layer[i], v) >= 0; });
    if (next == layer.end()) return false;
    std::iter_swap(rest, next);
  }
  return topology_.find_halfedge(layer.back(), layer.front()) >= 0;
}

void LimbSearch::mark(const VertexLoop& layer) {
  for (const Vertex v : layer) used_[at(v)] = 1;
}

}  // namespace sphparam
