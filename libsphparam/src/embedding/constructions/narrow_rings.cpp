#include "embedding/constructions/narrow_rings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "embedding/newton/newton_patch.h"
#include "embedding/sweeps/kernel_placement.h"
#include "embedding/sweeps/lane_sweep.h"
#include "embedding/sweeps/ring_packs.h"

// A ring is narrow where its energy is a hundred times that of an isometry. Long rods need as much
// at their best: relaxation goes on only as long as it lowers the energy of what is narrow, and
// Newton steps are made only around vertices that have far more than the others.

namespace sphparam {
namespace {

// From the middle of the kernel to where the vertex belongs.
constexpr double shares_of_the_way[] = {1, 0.95, 0.8, 0.6, 0.4, 0.2, 0.1, 0.03};
// Each time twice as wide, and as many sweeps.
constexpr int openings = 3, first_rings = 3, first_sweeps = 50;
constexpr double least_opening = 0.9;  // of the energy of what is narrow
constexpr double outlier = 20;         // times the median of the narrow rings' energies,
constexpr double large_part = 0.2;     // or this of their sum
constexpr size_t most_patches = 8, largest_patch = 100;
constexpr int patch_steps = 40;
constexpr double least_gain = 1e-2;  // of a patch's step

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

NarrowRings::PlacedRing NarrowRings::placed_ring(Vertex v) const {
  std::vector<Vector3> image, edges;
  const Vertex* begin = level_.ring_begin(v);
  for (int i = 0; i < level_.valence(v); ++i) {
    image.push_back(image_[at(begin[i])].vector());
    edges.emplace_back(level_.positions.row(begin[i]) - level_.positions.row(v));
  }
  return {std::move(image), RestRing(edges, options_.floors)};
}

Room NarrowRings::place(Vertex v) {
  const PlacedRing ring = placed_ring(v);
  const auto middle = place_in_kernel(ring.image);
  if (!middle) return Room::None;
  const Vector3 wanted = ring.rest.mean_value_point(ring.image);
  Vector3 best = *middle;
  double least = ring.rest.energy(options_.energy, ring.image, best);
  for (const double share : shares_of_the_way) {
    const Vector3 x = (*middle + share * (wanted - *middle)).normalized();
    const double energy = ring.rest.energy(options_.energy, ring.image, x);
    if (!(energy < least)) continue;
    least = energy;
    best = x;
  }
  image_[at(v)] = image_point(best);
  return ring.rest.is_narrow(options_.energy, least) ? Room::Narrow : Room::Enough;
}

void NarrowRings::open(std::vector<Vertex> narrow, const std::vector<Vertex>& pinned) {
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < openings && !narrow.empty(); ++i) {
    const std::vector<Vertex> near = neighbourhood(std::move(narrow), first_rings << i);
    relax(near, pinned, first_sweeps << i);
    const std::vector<Crowd> crowds = crowds_among(near);
    double energy = 0;
    narrow.clear();
    for (const Crowd& crowd : crowds) {
      energy += crowd.energy;
      narrow.push_back(crowd.vertex);
    }
    const bool helps = energy < least_opening * std::exchange(before, energy);
    if (!helps || i + 1 == openings) return open_by_newton(crowds, pinned);
  }
}

/// These vertices, and all that so many edges lead to.
std::vector<Vertex> NarrowRings::neighbourhood(std::vector<Vertex> near, int rings) const {
  std::vector<char> seen(at(level_.vertex_count()), 0);
  for (const Vertex v : near) seen[at(v)] = 1;
  size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    for (const size_t end = near.size(); begin < end; ++begin) {
      const Vertex v = near[begin];
      for (int i = 0; i < level_.valence(v); ++i) {
        const Vertex w = level_.ring_begin(v)[i];
        if (!std::exchange(seen[at(w)], 1)) near.push_back(w);
      }
    }
  }
  return near;
}

void NarrowRings::relax(const std::vector<Vertex>& near, const std::vector<Vertex>& pinned,
                        int sweeps) {
  std::vector<char> moves(image_.size(), 0);
  for (const Vertex v : near) moves[at(v)] = 1;
  for (const Vertex v : pinned) moves[at(v)] = 0;
  std::vector<Vertex> others;
  for (Vertex v = 0; v < level_.vertex_count(); ++v) {
    if (!moves[at(v)]) others.push_back(v);
  }
  const RingPacks packs = pack_rings(level_, options_.floors, options_.threads, others);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    options_.ask();
    sweep_packs(packs, 0, image_.data(), options_.energy, options_.over_relaxation,
                options_.threads);
  }
}

std::vector<NarrowRings::Crowd> NarrowRings::crowds_among(const std::vector<Vertex>& near) const {
  std::vector<Crowd> crowds;
  for (const Vertex v : near) {
    const PlacedRing ring = placed_ring(v);
    const double energy = ring.rest.energy(options_.energy, ring.image, image_[at(v)].vector());
    if (ring.rest.is_narrow(options_.energy, energy)) crowds.push_back({energy, v});
  }
  return crowds;
}

/// Where neighbours are as cramped as the vertex itself, sweeps do not get it out.
void NarrowRings::open_by_newton(std::vector<Crowd> crowds, const std::vector<Vertex>& pinned) {
  if (crowds.empty()) return;
  std::sort(crowds.begin(), crowds.end(), [](const Crowd& a, const Crowd& b) {
    return std::pair(-a.energy, a.vertex) < std::pair(-b.energy, b.vertex);
  });
  double all = 0;
  for (const Crowd& crowd : crowds) all += crowd.energy;
  const double far = std::min(large_part * all, outlier * crowds[crowds.size() / 2].energy);
  if (!(crowds.front().energy > far)) return;
  const TriangleMesh mesh = triangle_mesh(level_);
  const Topology topology(mesh, options_.threads);
  const RestTriangles source = fattened(measure_source(mesh, options_.threads),
                                        options_.floors.fatness.mu, options_.threads);
  Points points(level_.vertex_count(), 3);
  for (Vertex v = 0; v < level_.vertex_count(); ++v) points.row(v) = image_[at(v)].vector();
  for (size_t i = 0; i < std::min(crowds.size(), most_patches); ++i) {
    if (!(crowds[i].energy > far)) break;
    options_.ask();
    std::vector<Vertex> free = neighbourhood({crowds[i].vertex}, first_rings);
    std::erase_if(free, [&](Vertex v) { return std::ranges::find(pinned, v) != pinned.end(); });
    if (free.size() > largest_patch) free.resize(largest_patch);
    NewtonPatch patch(topology, source, points, std::move(free));
    double energy = patch.energy(options_.energy);
    for (int step = 0; step < patch_steps && std::isfinite(energy); ++step) {
      const double before = std::exchange(energy, patch.step(options_.energy).energy);
      if (!(energy < (1 - least_gain) * before)) break;
    }
    patch.write_to(points);
  }
  for (Vertex v = 0; v < level_.vertex_count(); ++v) image_[at(v)] = image_point(points.row(v));
}

}  // namespace sphparam
