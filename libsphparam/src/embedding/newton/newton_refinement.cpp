#include "embedding/newton/newton_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "embedding/energy/rest_floors.h"
#include "embedding/newton/global_newton.h"
#include "embedding/newton/outlook.h"
#include "embedding/twists/twists.h"

// Levels are due at every fourfold vertex count, counted down from the finest. The smallest get a
// step in any case: all of them together cost less than a tenth of a step on the finest. Finer ones
// get steps only if the first step on the level before gained enough, relative to its energy, or
// promised to (a few triangles can block a step), or if something else has shown that sweeps do not
// suffice: rings without room, or, for the finest alone, a sample of it. Shapes with long
// protrusions gain 0.3 to 4 % there, others below 0.2 %. A draft of a large mesh leaves out the
// finest unless rings had no room, or the level before or the sample says that much is left.
// Between steps a few guarded sweeps smooth what the step has creased; half of the gain is theirs.
// They go on until little is left (outlook.cpp), where the best is wanted by exact Hessians near
// the minimum. Then twisted limbs are turned back (twists.cpp), which no step does, and steps go on
// from there.

namespace sphparam {
namespace {

constexpr int least_vertices = 100;
constexpr int growth = 4;  // from one level that is due to the next
constexpr double worthwhile = 2e-3, worthwhile_for_draft = 1e-2;
constexpr int coarse_steps = 20;
// What may be left, relative to the energy. Small meshes cost little: less is left of theirs.
constexpr double coarse_rest = 6e-3, draft_rest = 0.01, finest_rest = 5e-3, best_rest = 1e-5;
constexpr double small_mesh = 5000;  // vertices
constexpr int sweeps_between = 5;
constexpr double cut_short = 0.125;                                      // of a Newton step
constexpr double worthwhile_sampled = 4e-3, sampled_for_draft = 1.5e-2;  // of the energy
constexpr double unseen = 2;    // times as much as a sample says is left
constexpr int most_rounds = 4;  // of turning twisted limbs back
// Of a system's iterations: twice as many gain next to nothing, but where little is left.
constexpr double least_share = 0.5, least_share_of_best = 0.1;

/// Levels up to this size cost hardly anything.
int cheap(int finest) { return std::max(1000, finest / 16); }

int most_steps_of_best(int vertices, const Budget& budget) {
  return static_cast<int>(
      std::clamp<double>(budget.work / vertices, budget.least_steps, budget.most_steps));
}

/// What may be left on a finest level of n vertices.
double finest_rest_of(Quality quality, int n) {
  if (quality == Quality::Best) return best_rest;
  return (quality == Quality::Draft ? draft_rest : finest_rest) * std::min(1.0, n / small_mesh);
}

}  // namespace

NewtonRefinement::NewtonRefinement(int finest_vertices, RefinementOptions options)
    : options_(std::move(options)),
      finest_(finest_vertices),
      next_(finest_vertices),
      last_gain_(std::numeric_limits<double>::infinity()) {
  while (next_ >= growth * least_vertices) next_ /= growth;
}

bool NewtonRefinement::finest_is_open() const {
  return !due(finest_) && (options_.quality != Quality::Draft || !sweeps_suffice());
}

void NewtonRefinement::note_sampled_decrement(double share) {
  const bool draft = options_.quality == Quality::Draft;
  slivers_ = share > (draft ? sampled_for_draft : worthwhile_sampled);
  energy_left_ = last_gain_ + unseen * share;
}

bool NewtonRefinement::due(int vertices) const {
  if (vertices < next_ || vertices < std::min(least_vertices, finest_)) return false;
  const bool draft = options_.quality == Quality::Draft, finest = vertices == finest_;
  if (finest && (slivers_ || options_.quality == Quality::Best)) return true;
  if (vertices <= cheap(finest_) && !(finest && draft)) return true;
  if (finest && draft && finest_ > small_mesh)
    return protrusions_ || last_gain_ > worthwhile_for_draft;
  return !sweeps_suffice();
}

bool NewtonRefinement::sweeps_suffice() const { return last_gain_ <= worthwhile && !protrusions_; }

RestTriangles NewtonRefinement::source_of(const TriangleMesh& mesh) const {
  return fattened(measure_source(mesh, options_.threads), options_.fatness, options_.threads);
}

void NewtonRefinement::improve(const TriangleMesh& mesh, const Topology& topology,
                               const std::vector<Vertex>& pinned, std::vector<ImagePoint>& image,
                               ProgressShare share) {
  descend(mesh, topology, pinned, image, share);
  if (sweeps_suffice() || !pinned.empty() || left_slivers_) return;
  const RestTriangles source = source_of(mesh);
  const double gain = last_gain_;
  for (int round = 0; round < most_rounds; ++round) {
    if (left_slivers_ || untwist(topology, source, options_.energy, image) == 0) break;
    descend(mesh, topology, pinned, image, {share.end, share.end});
  }
  last_gain_ = std::max(gain, last_gain_);
}

void NewtonRefinement::descend(const TriangleMesh& mesh, const Topology& topology,
                               const std::vector<Vertex>& pinned, std::vector<ImagePoint>& image,
                               ProgressShare share) {
  const int n = topology.vertex_count();
  const bool finest = n == finest_;
  while (next_ <= n && next_ < finest_) next_ = std::min(finest_, growth * next_);
  const bool best = options_.quality == Quality::Best && finest;
  const int most_steps = best ? most_steps_of_best(n, options_.budget)
                              : (finest ? options_.finest_steps : coarse_steps);
  const double rest = finest ? finest_rest_of(options_.quality, n) : coarse_rest;
  GlobalNewton newton(topology, source_of(mesh), image, pinned, options_.threads);
  double done = share.begin;
  newton.ask_with([&] { report(options_.progress, "embedding", done); });
  double energy = newton.energy(options_.energy);
  last_gain_ = std::numeric_limits<double>::infinity();  // not known, should it end here
  if (finest) energy_left_ = 1;
  if (!newton.can_move() || !std::isfinite(energy)) return;  // not finite: positive, not certain
  image = std::vector<ImagePoint>();  // there is no room to spare in a step; = {} would keep it
  Outlook outlook(rest);
  int blocked = 0;  // steps in a row
  for (int step = 0; step < most_steps && !outlook.settled() && !left_slivers_; ++step) {
    const GlobalNewton::Step made =
        best ? newton.step(options_.energy, least_share_of_best, outlook.next())
             : newton.step(options_.energy, least_share);
    newton.sweep(options_.energy, sweeps_between);
    done = std::lerp(share.begin, share.end, (step + 1.0) / most_steps);
    report(options_.progress, "embedding", done);
    const double before = std::exchange(energy, newton.energy(options_.energy));
    outlook.note(made, before, energy);
    blocked = made.length < cut_short ? blocked + 1 : 0;
    left_slivers_ =
        finest && blocked > 0 && blocked == options_.most_blocked && has_slivers(source_of(mesh));
  }
  last_gain_ = outlook.first_gain();
  if (finest) energy_left_ = left_slivers_ ? 1 : outlook.left();
  newton.write_to(image);
}

}  // namespace sphparam
