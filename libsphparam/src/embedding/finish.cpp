#include "embedding/finish.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "embedding/global_newton.h"

// Levels are due at every fourfold vertex count, counted down from the finest. The smallest get a
// step in any case: all of them together cost less than a tenth of a step on the finest. Finer ones
// get steps only if the first step on the level before gained enough, relative to its energy.
// Shapes with long limbs gain 0.15 to 4 % there, others below 0.05 %.
// Between steps a few guarded sweeps smooth what the step has creased; half of the gain is theirs.

namespace sphparam {
namespace {

constexpr int least_vertices = 100;
constexpr int growth = 4;  // from one level that is due to the next
constexpr double worthwhile = 1e-3;
constexpr int coarse_steps = 20, finest_steps = 8, best_steps = 100;
// Gains halve from step to step, or better: what is left is no more than the last gain.
constexpr double coarse_gain = 4e-3, finest_gain = 3e-3, best_gain = 1e-6;
constexpr int sweeps_between = 5;
constexpr double linear_tolerance = 0.5;

/// Levels up to this size cost hardly anything.
int cheap(int finest) { return std::max(1000, finest / 16); }

}  // namespace

Finish::Finish(Quality quality, const DistortionEnergy& energy, int finest_vertices, int threads)
    : quality_(quality),
      energy_(energy),
      finest_(finest_vertices),
      threads_(threads),
      next_(finest_vertices),
      last_gain_(std::numeric_limits<double>::infinity()) {
  while (next_ >= growth * least_vertices) next_ /= growth;
}

bool Finish::due(int vertices) const {
  if (quality_ == Quality::Draft || vertices < next_ || vertices < least_vertices) return false;
  return quality_ == Quality::Best || vertices <= cheap(finest_) || last_gain_ > worthwhile;
}

void Finish::improve(const TriangleMesh& mesh, const Topology& topology,
                     const std::vector<Vertex>& pinned, std::vector<ImagePoint>& image) {
  const int n = topology.vertex_count();
  const bool finest = n == finest_;
  while (next_ <= n && next_ < finest_) next_ = std::min(finest_, growth * next_);
  const bool best = quality_ == Quality::Best && finest;
  const int most_steps = best ? best_steps : finest ? finest_steps : coarse_steps;
  const double enough = best ? best_gain : finest ? finest_gain : coarse_gain;
  GlobalNewton newton(topology, measure_source(mesh), image, pinned, threads_);
  double energy = newton.energy(energy_);
  if (!newton.can_move() || !std::isfinite(energy)) return;  // not finite: positive, not certain
  image = std::vector<ImagePoint>();  // there is no room to spare in a step; = {} would keep it
  for (int step = 0; step < most_steps; ++step) {
    newton.step(energy_, linear_tolerance);
    newton.sweep(energy_, sweeps_between);
    const double before = std::exchange(energy, newton.energy(energy_));
    const double gain = 1 - energy / before;
    if (step == 0) last_gain_ = gain;
    if (gain < enough) break;
  }
  newton.write_to(image);
}

}  // namespace sphparam
