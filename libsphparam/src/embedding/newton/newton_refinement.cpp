#include "embedding/newton/newton_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "embedding/newton/global_newton.h"

// Levels are due at every fourfold vertex count, counted down from the finest. The smallest get a
// step in any case: all of them together cost less than a tenth of a step on the finest. Finer ones
// get steps only if the first step on the level before gained enough, relative to its energy.
// Shapes with long protrusions gain 0.3 to 4 % there, others below 0.2 %.
// Between steps a few guarded sweeps smooth what the step has creased; half of the gain is theirs.
// Gains shrink from step to step by a ratio that hardly changes: what is left is the rest of a
// geometric series.

namespace sphparam {
namespace {

constexpr int least_vertices = 100;
constexpr int growth = 4;  // from one level that is due to the next
constexpr double worthwhile = 2e-3;
constexpr int coarse_steps = 20, finest_steps = 30, best_steps = 100;
// What may be left, relative to the energy. Small meshes cost little: less is left of theirs.
constexpr double coarse_rest = 4e-3, finest_rest = 3e-3, best_rest = 1e-6;
constexpr double small_mesh = 5000;                        // vertices
constexpr double least_ratio = 0.5, greatest_ratio = 0.9;  // of a gain to the one before
constexpr int sweeps_between = 5;
constexpr double least_share = 0.5;  // of a system's iterations: twice as many gain next to nothing

/// Levels up to this size cost hardly anything.
int cheap(int finest) { return std::max(1000, finest / 16); }

/// What steps to come will gain, from the last two.
double expected(double gain, double before) {
  const double ratio = std::clamp(gain / before, least_ratio, greatest_ratio);
  return gain * ratio / (1 - ratio);
}

}  // namespace

NewtonRefinement::NewtonRefinement(int finest_vertices, RefinementOptions options)
    : options_(std::move(options)),
      finest_(finest_vertices),
      next_(finest_vertices),
      last_gain_(std::numeric_limits<double>::infinity()) {
  while (next_ >= growth * least_vertices) next_ /= growth;
}

bool NewtonRefinement::due(int vertices) const {
  const Quality quality = options_.quality;
  if (quality == Quality::Draft || vertices < next_ || vertices < least_vertices) return false;
  return quality == Quality::Best || vertices <= cheap(finest_) || !sweeps_suffice();
}

bool NewtonRefinement::sweeps_suffice() const { return last_gain_ <= worthwhile; }

void NewtonRefinement::improve(const TriangleMesh& mesh, const Topology& topology,
                               const std::vector<Vertex>& pinned, std::vector<ImagePoint>& image,
                               ProgressShare share) {
  const int n = topology.vertex_count();
  const bool finest = n == finest_;
  while (next_ <= n && next_ < finest_) next_ = std::min(finest_, growth * next_);
  const bool best = options_.quality == Quality::Best && finest;
  const int most_steps = best ? best_steps : finest ? finest_steps : coarse_steps;
  const double rest = best     ? best_rest
                      : finest ? finest_rest * std::min(1.0, n / small_mesh)
                               : coarse_rest;
  GlobalNewton newton(topology, measure_source(mesh, options_.threads), image, pinned,
                      options_.threads);
  double done = share.begin;
  newton.ask_with([&] { report(options_.progress, "embedding", done); });
  double energy = newton.energy(options_.energy);
  last_gain_ = std::numeric_limits<double>::infinity();      // not known, should it end here
  if (!newton.can_move() || !std::isfinite(energy)) return;  // not finite: positive, not certain
  image = std::vector<ImagePoint>();  // there is no room to spare in a step; = {} would keep it
  double gain_before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    newton.step(options_.energy, least_share);
    newton.sweep(options_.energy, sweeps_between);
    done = std::lerp(share.begin, share.end, (step + 1.0) / most_steps);
    report(options_.progress, "embedding", done);
    const double before = std::exchange(energy, newton.energy(options_.energy));
    const double gain = 1 - energy / before;
    if (step == 0) last_gain_ = gain;
    if (!(expected(gain, std::exchange(gain_before, gain)) >= rest)) break;
  }
  newton.write_to(image);
}

}  // namespace sphparam
