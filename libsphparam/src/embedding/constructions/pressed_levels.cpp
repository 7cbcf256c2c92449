#include "embedding/constructions/pressed_levels.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "sphparam/parallel.h"

// On the first level that is due the pressure is found; each of the others begins with that of the
// one before, so that a few steps suffice. Sweeps in between know of the pressure.

namespace sphparam {
namespace {

constexpr int least_vertices = 600;
constexpr int growth = 4;  // from one level that is due to the next
constexpr double first_gain = 5e-3, on_the_way_gain = 2e-2;
constexpr int first_steps = 60, on_the_way_steps = 12;
constexpr std::int64_t pack_grain = 64;

size_t at(int i) { return static_cast<size_t>(i); }

/// Calls visit(slots, i, lane, is_filler) for each triangle of each vertex of a range of packs.
template <class Visit>
void for_each_slot(RingPacks& packs, std::int64_t first, std::int64_t last,
                   const std::vector<char>& inside, const Visit& visit) {
  for (auto p = static_cast<size_t>(first); p < static_cast<size_t>(last); ++p) {
    const RingPack& pack = packs.packs[p];
    RingSlot* slots = &packs.slots[pack.first_slot];
    for (int lane = 0; lane < pack_width; ++lane) {
      if (pack.vertex[lane] < 0) continue;
      int valence = pack.valence;  // of the lane: slots beyond it have no triangle
      while (valence > 0 && !(slots[valence - 1].beta[lane] > 0)) --valence;
      for (int i = 0; i < valence; ++i) {
        const Vertex a = slots[i].neighbour[lane],
                     b = slots[i + 1 < valence ? i + 1 : 0].neighbour[lane];
        visit(slots[i], lane, inside[at(pack.vertex[lane])] || inside[at(a)] || inside[at(b)]);
      }
    }
  }
}

double area_of(const RingSlot& slot, int lane) {
  return 4 * std::sqrt(static_cast<double>(slot.alpha[lane]) * slot.beta[lane]);
}

}  // namespace

PressedLevels::PressedLevels(const Topology& topology, const MeshHierarchy& hierarchy,
                             Options options)
    : options_(std::move(options)), next_(topology.vertex_count()) {
  if (options_.fillers.empty()) return;
  while (next_ >= growth * least_vertices) next_ /= growth;
  inside_.emplace_back(at(topology.vertex_count()), 1);
  for (Face f = 0; f < topology.face_count(); ++f) {
    if (options_.fillers[at(f)]) continue;
    for (int k = 0; k < 3; ++k) inside_[0][at(topology.vertex(f, k))] = 0;
  }
  for (size_t level = 1; level < hierarchy.size(); ++level) {
    const std::vector<Vertex>& finer = hierarchy[level].finer;
    std::vector<char> inside(finer.size());
    for (size_t v = 0; v < finer.size(); ++v) inside[v] = inside_[level - 1][at(finer[v])];
    inside_.push_back(std::move(inside));
  }
}

bool PressedLevels::due(size_t level, int vertices) const {
  return level > 0 && !options_.fillers.empty() && vertices >= next_;
}

FillerMarks PressedLevels::fillers_of(size_t level, const Topology& topology) const {
  FillerMarks marks(at(topology.face_count()), 0);
  for (Face f = 0; f < topology.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) marks[at(f)] |= inside_[level][at(topology.vertex(f, k))];
  }
  return marks;
}

SphereMap PressedLevels::pressed(size_t level, const TriangleMesh& mesh, const SphereMap& map,
                                 const std::vector<Vertex>& pinned) {
  next_ = growth * static_cast<int>(mesh.vertex_count());
  const Topology topology(mesh, options_.optimise.threads);
  OptimiseOptions optimise = options_.optimise;
  optimise.least_gain = pressure_ > 0 ? on_the_way_gain : first_gain;
  optimise.max_steps = pressure_ > 0 ? on_the_way_steps : first_steps;
  optimise.pinned = pinned;
  optimise.pressed = fillers_of(level, topology);
  PressedMap result = press_fillers(topology, measure_source(mesh, optimise.threads), map,
                                    options_.most, optimise, pressure_);
  pressure_ = result.pressure;
  return std::move(result.map);
}

void PressedLevels::mark(size_t level, RingPacks& packs) const {
  const std::vector<char>& inside = inside_[level];
  double of_fillers = 0, of_surface = 0;  // each as often as it has corners that may move
  for_each_slot(packs, 0, std::ssize(packs.packs), inside,
                [&](const RingSlot& slot, int lane, bool filler) {
                  (filler ? of_fillers : of_surface) += area_of(slot, lane);
                });
  const auto [filler_factor, surface_factor] = pressed_areas(of_fillers, of_surface, options_.most);
  const auto fillers = static_cast<float>(filler_factor),
             surface = static_cast<float>(surface_factor);
  parallel_for(std::ssize(packs.packs), pack_grain, options_.optimise.threads,
               [&](std::int64_t first, std::int64_t last) {
                 for_each_slot(packs, first, last, inside,
                               [&](RingSlot& slot, int lane, bool filler) {
                                 slot.alpha[lane] *= filler ? fillers : -surface;
                                 slot.beta[lane] *= filler ? fillers : surface;
                               });
               });
}

}  // namespace sphparam
