#include "embedding/newton/global_newton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "embedding/frame/mobius_recentring.h"
#include "embedding/newton/freed_memory.h"
#include "embedding/sweeps/lane_sweep.h"
#include "sphparam/parallel.h"

// Assembly goes block by block of vertices: the terms of all triangles that touch the block are
// computed into a buffer that stays in the cache, then each vertex gathers its row. Triangles on
// the rim of a block are computed twice; nothing is written from two sides, so blocks run in
// parallel with the same result.
//
// What a step needs and what the sweeps after it need are never alive at the same time on large
// meshes: at a million triangles making them anew costs less than their room would.

namespace sphparam {
namespace {

constexpr std::int64_t vertex_grain = 512;
constexpr int least_parallel_vertices = 1024;  // below it waking other threads costs more
constexpr int least_large_vertices = 1 << 18;  // below it saving memory saves little of it
constexpr int most_iterations = 60;
constexpr double longest_step = 0.7;  // radians, of any vertex
constexpr double sufficient_decrease = 1e-4;
constexpr int halvings = 40;
constexpr int most_stiffenings = 6;
constexpr double most_expansion = 8;  // of a Newton step: clamped Hessians are too stiff
// The sphere is covered once or twice, or more often: triangles that are small next to a step may
// turn over twice in it, and come out right, with a part of the mesh wound around a vertex twice.
constexpr double once = 1.5;
// Of a diagonal block's trace. Rounding lets the energy of a limb that moves as a whole by millions
// of its own small edges come out negative, and the solver gives up.
constexpr double certain_curvature = 1e-13;
constexpr int least_exponent = -60;       // of units
constexpr double over_relaxation = 1.5;   // of the sweeps
constexpr std::int64_t sweep_grain = 16;  // packs

}  // namespace

GlobalNewton::GlobalNewton(const Topology& topology, const RestTriangles& source,
                           const std::vector<ImagePoint>& image, const std::vector<Vertex>& pinned,
                           int threads, const FillerMarks& pressed)
    : threads_(topology.vertex_count() < least_parallel_vertices ? 1 : threads),
      old_name_(patch_order(topology)) {
  const int n = topology.vertex_count();
  std::vector<int> new_name(at(n));
  image_.resize(at(n));
  for (int v = 0; v < n; ++v) {
    new_name[at(old_name_[at(v)])] = v;
    image_[at(v)] = image[at(old_name_[at(v)])];
  }
  pinned_.assign(at(n), 0);
  for (const Vertex v : pinned) pinned_[at(new_name[at(v)])] = 1;
  make_pattern(topology, new_name);
  blocks_ = TriangleBlocks(topology, source, old_name_, new_name, hessian_.start, pressed);
  measure_units();
  order_ = order_sweeps(hessian_.start, hessian_.column, TriangleBlocks::size);
}

void GlobalNewton::make_pattern(const Topology& topology, const std::vector<int>& new_name) {
  const int n = topology.vertex_count();
  hessian_.start.assign(1, 0);
  hessian_.start.reserve(at(n) + 1);
  hessian_.column.reserve(at(topology.halfedge_count()));
  for (int v = 0; v < n; ++v) {
    topology.for_each_outgoing(old_name_[at(v)], [&](Halfedge h) {
      hessian_.column.push_back(new_name[at(topology.target(h))]);
    });
    hessian_.start.push_back(static_cast<int>(hessian_.column.size()));
  }
}

/// A power of two near the shortest edge of each vertex's image.
void GlobalNewton::measure_units() {
  unit_.resize(image_.size());
  parallel_for(
      std::ssize(image_), vertex_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
        for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
          const Vector3 x = image_[at(v)].vector();
          double least = 1;
          for (int e = hessian_.start[at(v)]; e < hessian_.start[at(v) + 1]; ++e) {
            least =
                std::min(least, (image_[at(hessian_.column[at(e)])].vector() - x).squaredNorm());
          }
          const int exponent = least > 0 ? std::ilogb(least) / 2 : least_exponent;
          unit_[at(v)] = std::ldexp(1.0F, std::max(exponent, least_exponent));
        }
      });
}

void GlobalNewton::gather_row(int row, const TriangleTerms* terms) {
  const int first = hessian_.start[at(row)], valence = hessian_.start[at(row) + 1] - first;
  std::array<double, 3> d{};
  std::array<double, 2> g{};
  Block<2>* const off = hessian_.off.data() + first;
  std::fill(off, off + valence, Block<2>{});
  for (int e = 0; e < valence; ++e) {
    const int triangle = blocks_.triangle(first + e), k = blocks_.corner(first + e);
    const TriangleTerms& t = terms[triangle / pack_width];
    const int lane = triangle % pack_width, before = (k + 2) % 3;
    for (size_t i = 0; i < 3; ++i) d[i] += t.diagonal[k][i][lane];
    for (size_t i = 0; i < 2; ++i) g[i] += t.gradient[k][i][lane];
    std::array<double, 4>&to_next = off[e].a, &to_previous = off[e + 1 < valence ? e + 1 : 0].a;
    for (size_t i = 0; i < 4; ++i) to_next[i] += t.off[k][i][lane];
    to_previous[0] += t.off[before][0][lane];
    to_previous[1] += t.off[before][2][lane];
    to_previous[2] += t.off[before][1][lane];
    to_previous[3] += t.off[before][3][lane];
  }
  const double shift = certain_curvature * (d[0] + d[2]);
  d[0] += shift;
  d[2] += shift;
  const double unit = unit_[at(row)];
  for (int e = 0; e < valence; ++e) {
    const double units = unit * unit_[at(hessian_.column[at(first + e)])];
    for (double& entry : off[e].a) entry *= units;
  }
  const double square = unit * unit;
  hessian_.diagonal[at(row)].a = {square * d[0], square * d[1], square * d[1], square * d[2]};
  for (size_t i = 0; i < 2; ++i) downhill_[2 * at(row) + i] = -unit * g[i];
}

/// False: numbers of a protrusion are beyond doubles.
bool GlobalNewton::assemble(const DistortionEnergy& energy, Curvature curvature) {
  hessian_.off.resize(hessian_.column.size());
  hessian_.diagonal.resize(image_.size());
  downhill_.resize(2 * image_.size());
  int most_packs = 0;
  for (int b = 0; b < blocks_.count(); ++b) {
    most_packs = std::max(most_packs, blocks_.pack_count(b));
  }
  parallel_for(blocks_.count(), TriangleBlocks::grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 const auto terms = std::make_unique_for_overwrite<TriangleTerms[]>(at(most_packs));
                 for (int b = static_cast<int>(first); b < static_cast<int>(last); ++b) {
                   differentiate_triangles(blocks_.packs_of(b), blocks_.pack_count(b),
                                           image_.data(), energy, curvature, terms.get());
                   stiffened_.apply(blocks_, b, image_, terms.get());
                   const int end = std::min((b + 1) * TriangleBlocks::size, hessian_.rows());
                   for (int row = b * TriangleBlocks::size; row < end; ++row) {
                     gather_row(row, terms.get());
                   }
                 }
               });
  bool finite = true;
  for (int row = 0; row < hessian_.rows(); ++row) {
    const bool fixed = pinned_[at(row)];
    for (int e = hessian_.start[at(row)]; e < hessian_.start[at(row) + 1]; ++e) {
      if (fixed || pinned_[at(hessian_.column[at(e)])]) hessian_.off[at(e)] = {};
    }
    std::array<double, 4>& diagonal = hessian_.diagonal[at(row)].a;
    finite &= std::isfinite(diagonal[0] + diagonal[3]);
    if (!fixed) continue;
    diagonal = {1, 0, 0, 1};
    downhill_[2 * at(row)] = downhill_[2 * at(row) + 1] = 0;
  }
  return finite;
}

void GlobalNewton::move(const Unknowns& direction, double length, Image& image) const {
  image.resize(image_.size());
  parallel_for(static_cast<std::int64_t>(image_.size()), vertex_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto v = static_cast<size_t>(first); v < static_cast<size_t>(last); ++v) {
                   if (pinned_[v]) {
                     image[v] = image_[v];
                     continue;
                   }
                   const Vector3 x = image_[v].vector();
                   const double factor = length * unit_[v];
                   image[v] = image_point(tangent_frame(x).at(x, factor * direction[2 * v],
                                                              factor * direction[2 * v + 1]));
                 }
               });
}

double GlobalNewton::recentre(const DistortionEnergy& energy) {
  const double before = this->energy(energy);
  if (std::count(pinned_.begin(), pinned_.end(), 1) > 0) return before;
  return sphparam::recentre(
      image_, before,
      [&](const Image& image) {
        ask_();
        return blocks_.energy(image, energy, threads_);
      },
      threads_);
}

/// Radians.
double GlobalNewton::longest(const Unknowns& direction) const {
  double squared = 0;
  for (size_t v = 0; v < image_.size(); ++v) {
    const double unit = unit_[v], a = unit * direction[2 * v], b = unit * direction[2 * v + 1];
    squared = std::max(squared, a * a + b * b);
  }
  return std::sqrt(squared);
}

RingPacks GlobalNewton::pack_rings_of_all() const {
  std::vector<Vertex> pinned;
  for (size_t v = 0; v < pinned_.size(); ++v) {
    if (pinned_[v]) pinned.push_back(static_cast<Vertex>(v));
  }
  return pack_rings(
      hessian_.start, hessian_.column,
      [&](int row, int lane, RingSlot* slots) {
        blocks_.measure_ring(row, hessian_.start[at(row)], hessian_.start[at(row) + 1], lane,
                             slots);
      },
      threads_, pinned);
}

void GlobalNewton::sweep(const DistortionEnergy& energy, int sweeps) {
  make_room();
  if (!rings_) rings_ = pack_rings_of_all();
  const RingPacks& rings = *rings_;
  for (int n = 0; n < sweeps * rings.colours(); ++n) {
    if (n % rings.colours() == 0) ask_();
    const int c = n % rings.colours(), first = rings.colour_start[at(c)];
    const int count = rings.colour_start[at(c) + 1] - first;
    parallel_for(count, sweep_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
      step_packs(rings, first + static_cast<int>(begin), first + static_cast<int>(end),
                 image_.data(), energy, over_relaxation);
    });
  }
  if (is_large()) rings_.reset();
}

bool GlobalNewton::can_move() const {
  return std::find(pinned_.begin(), pinned_.end(), 0) != pinned_.end();
}

bool GlobalNewton::covers_once() const { return blocks_.covering(image_, threads_) <= once; }

bool GlobalNewton::is_large() const { return hessian_.rows() >= least_large_vertices; }

void GlobalNewton::make_room() const {
  if (is_large()) give_back_freed_memory();
}

/// The solution of a step's system; nothing where `assemble` fails. Leaves nothing of the Hessian
/// but its pattern and its diagonal.
LinearSolution GlobalNewton::solve(const DistortionEnergy& energy, double least_share,
                                   Curvature curvature) {
  make_room();
  LinearSolution solution;
  if (assemble(energy, curvature)) {
    ask_();
    if (multigrid_) {
      multigrid_->update(image_.data());
    } else {
      multigrid_.emplace(hessian_, order_, image_.data(), unit_.data(), pinned_, threads_);
    }
    solution = solve_by_conjugate_gradients(hessian_, *multigrid_, std::move(downhill_),
                                            least_share, most_iterations, threads_, ask_);
  }
  hessian_.off = std::vector<Block<2>>();  // = {} would keep the memory
  downhill_ = Unknowns();
  return solution;
}

/// Of every vertex, in space.
std::vector<Vector3> GlobalNewton::motion(const Unknowns& direction) const {
  std::vector<Vector3> motion(image_.size());
  for (size_t v = 0; v < image_.size(); ++v) {
    const TangentFrame frame = tangent_frame(image_[v].vector());
    const double unit = unit_[v];
    motion[v] = unit * direction[2 * v] * frame.u + unit * direction[2 * v + 1] * frame.v;
  }
  return motion;
}

/// Which way a step goes, and what it promises, without stiffened triangles, noted in `made`.
LinearSolution GlobalNewton::direction(const DistortionEnergy& energy, double least_share,
                                       Step& made) {
  stiffened_ = {};
  LinearSolution solution = solve(energy, least_share, made.curvature);
  if (made.curvature == Curvature::Exact && !(solution.gain > 0)) {
    made.curvature = Curvature::Projected;
    solution = solve(energy, least_share, made.curvature);
  }
  made.decrement = solution.gain / 2;
  for (int n = 0; n < most_stiffenings && made.decrement > 0; ++n) {
    const VertexStiffness vertices{hessian_.diagonal, unit_, pinned_};
    if (!stiffened_.stiffen(blocks_, image_, motion(solution.x), vertices, threads_)) break;
    made.curvature = Curvature::Projected;  // of which stiffer ones are positive semidefinite too
    LinearSolution another = solve(energy, least_share, made.curvature);
    if (!(another.gain > 0)) break;
    solution = std::move(another);
  }
  hessian_.diagonal = std::vector<Block<2>>();
  made.iterations = solution.iterations;
  made.complete = solution.complete;
  return solution;
}

void GlobalNewton::lengthen(const DistortionEnergy& energy, const Unknowns& direction, double most,
                            double& length, double& after, Image& candidate) const {
  while (2 * length <= most) {
    ask_();
    move(direction, 2 * length, candidate);
    const double further = blocks_.energy(candidate, energy, threads_);
    if (!(further < after)) {
      move(direction, length, candidate);  // again: cheaper than room for both
      return;
    }
    after = further;
    length *= 2;
  }
}

GlobalNewton::Step GlobalNewton::step(const DistortionEnergy& energy, double least_share,
                                      Curvature curvature) {
  const double before = this->energy(energy);
  Step made{.energy = before, .curvature = curvature};
  const LinearSolution solution = direction(energy, least_share, made);
  const double slope = -solution.gain, kept = std::min(1.0, solution.gain / (2 * made.decrement));
  if (!(slope < 0) || !std::isfinite(slope)) return made;
  const double cap = longest_step / longest(solution.x);

  Image candidate;
  bool may_grow = true;
  double length = std::min(1.0, cap);
  for (int i = 0; i < halvings; ++i, length /= 2) {
    ask_();
    move(solution.x, length, candidate);
    double after = blocks_.energy(candidate, energy, threads_);
    if (!(after < before + sufficient_decrease * length * slope)) continue;
    if (may_grow && (i == 0 || length >= 1))
      lengthen(energy, solution.x, std::min(cap, most_expansion), length, after, candidate);
    ask_();
    if (blocks_.covering(candidate, threads_) > once) {
      may_grow = false;
      continue;
    }
    image_.swap(candidate);
    made.energy = after;
    made.length = kept * length;
    return made;
  }
  return made;
}

void GlobalNewton::write_to(std::vector<ImagePoint>& image) const {
  image.resize(image_.size());
  for (size_t v = 0; v < image_.size(); ++v) image[at(old_name_[v])] = image_[v];
}

}  // namespace sphparam
