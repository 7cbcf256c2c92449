#include "embedding/global_newton.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "embedding/freed_memory.h"
#include "sphparam/parallel.h"

// Assembly goes block by block of vertices: the terms of all triangles that touch the block are
// computed into a buffer that stays in the cache, then each vertex gathers its row. Triangles on
// the rim of a block are computed twice; nothing is written from two sides, so blocks run in
// parallel with the same result.
//
// What a step needs and what the sweeps after it need are never alive at the same time: at a
// million triangles making them anew costs less than their room would.

namespace sphparam {
namespace {

constexpr int block_size = 256;  // vertices
constexpr std::int64_t vertex_grain = 2048, block_grain = 4;
constexpr int least_parallel_vertices = 4096;  // below it waking other threads costs more
constexpr int most_iterations = 60;
constexpr double longest_step = 0.7;  // radians, of any vertex
constexpr double sufficient_decrease = 1e-4;
constexpr int halvings = 40;
constexpr double most_expansion = 8;  // of a Newton step: clamped Hessians are too stiff
constexpr double boost_difference = 0.01, longest_boost = 0.3, least_boost_curvature = 1e-3;
constexpr int boost_halvings = 6;
constexpr int least_exponent = -60;       // of units: their products are floats
constexpr double over_relaxation = 1.5;   // of the sweeps
constexpr std::int64_t sweep_grain = 24;  // packs

size_t at(int i) { return static_cast<size_t>(i); }

/// Vertices in patches of `block_size` neighbours, each grown from the rim of those before.
std::vector<Vertex> patch_order(const Topology& topology) {
  const int n = topology.vertex_count();
  std::vector<Vertex> order;
  order.reserve(at(n));
  std::vector<char> seen(at(n), 0);
  const auto take = [&](Vertex v) {
    seen[at(v)] = 1;
    order.push_back(v);
  };
  const auto grow = [&](Vertex seed) {
    size_t head = order.size();
    const size_t full = head + block_size;
    take(seed);
    for (; head < order.size() && order.size() < full; ++head) {
      topology.for_each_outgoing(order[head], [&](Halfedge h) {
        const Vertex w = topology.target(h);
        if (!seen[at(w)] && order.size() < full) take(w);
      });
    }
  };
  for (Vertex start = 0; start < n; ++start) {
    if (seen[at(start)]) continue;
    size_t rim = order.size();
    grow(start);
    for (; rim < order.size(); ++rim) {
      topology.for_each_outgoing(order[rim], [&](Halfedge h) {
        if (!seen[at(topology.target(h))]) grow(topology.target(h));
      });
    }
  }
  return order;
}

}  // namespace

GlobalNewton::GlobalNewton(const Topology& topology, const SourceTriangles& source,
                           const std::vector<ImagePoint>& image, const std::vector<Vertex>& pinned,
                           int threads)
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
  pack_triangles(topology, source, new_name);
  measure_units();
  order_ = order_sweeps(hessian_.start, hessian_.column, block_size);
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

void GlobalNewton::pack_triangles(const Topology& topology, const SourceTriangles& source,
                                  const std::vector<int>& new_name) {
  const int n = topology.vertex_count();
  slots_.resize(hessian_.column.size());
  std::vector<int> place(at(topology.face_count()), -1);
  std::vector<Face> owned, touching;
  packs_.reserve(at(topology.face_count()) / 7);
  const auto fill = [&](const std::vector<Face>& faces, int base) {
    for (size_t i = 0; i < faces.size(); ++i) {
      place[at(faces[i])] = base + static_cast<int>(i);
      const int filled = static_cast<int>(i % pack_width);
      if (filled == 0) packs_.emplace_back();
      std::array<Vertex, 3> corners;
      for (int k = 0; k < 3; ++k) corners[at(k)] = new_name[at(topology.vertex(faces[i], k))];
      for (int lane = filled; lane < pack_width; ++lane) {
        fill_lane(source[at(faces[i])], corners, lane, packs_.back());
      }
    }
    return static_cast<int>((faces.size() + pack_width - 1) / pack_width);
  };
  for (int first = 0; first < n; first += block_size) {
    const int last = std::min(n, first + block_size);
    owned.clear();
    touching.clear();
    for (int v = first; v < last; ++v) {
      topology.for_each_outgoing(old_name_[at(v)], [&](Halfedge h) {
        const int a = new_name[at(topology.target(h))], b = new_name[at(topology.apex(h))];
        const int least = std::min(a, b);
        // Taken at the block's first corner of the triangle.
        if (std::min({a >= first ? a : n, b >= first ? b : n, v}) < v) return;
        (least < first ? touching : owned).push_back(Topology::face(h));
      });
    }
    Block b{packs_.size(), static_cast<int>(owned.size()), 0};
    b.packs = fill(owned, 0);
    b.packs += fill(touching, b.packs * pack_width);
    blocks_.push_back(b);
    for (int v = first; v < last; ++v) {
      int entry = hessian_.start[at(v)];
      topology.for_each_outgoing(old_name_[at(v)], [&](Halfedge h) {
        slots_[at(entry++)] = 4 * place[at(Topology::face(h))] + Topology::corner(h);
      });
    }
  }
  packs_.shrink_to_fit();
}

double GlobalNewton::energy_of(const DistortionEnergy& energy, const Image& image) const {
  std::vector<double> partial(blocks_.size());
  parallel_for(static_cast<std::int64_t>(blocks_.size()), block_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto b = static_cast<size_t>(first); b < static_cast<size_t>(last); ++b) {
                   partial[b] = guarded_energy(&packs_[blocks_[b].first_pack], blocks_[b].owned,
                                               image.data(), energy);
                 }
               });
  double sum = 0;
  for (const double e : partial) sum += e;
  return sum;
}

void GlobalNewton::gather_row(int row, const TriangleTerms* terms,
                              std::vector<std::array<double, 4>>& off) {
  const int first = hessian_.start[at(row)], valence = hessian_.start[at(row) + 1] - first;
  std::array<double, 3> d{};
  std::array<double, 2> g{};
  off.assign(at(valence), {});
  for (int e = 0; e < valence; ++e) {
    const int slot = slots_[at(first + e)], k = slot & 3, triangle = slot >> 2;
    const TriangleTerms& t = terms[triangle / pack_width];
    const int lane = triangle % pack_width, before = (k + 2) % 3;
    for (size_t i = 0; i < 3; ++i) d[i] += t.diagonal[k][i][lane];
    for (size_t i = 0; i < 2; ++i) g[i] += t.gradient[k][i][lane];
    std::array<double, 4>& to_next = off[at(e)];
    std::array<double, 4>& to_previous = off[at(e + 1 < valence ? e + 1 : 0)];
    for (size_t i = 0; i < 4; ++i) to_next[i] += t.off[k][i][lane];
    to_previous[0] += t.off[before][0][lane];
    to_previous[1] += t.off[before][2][lane];
    to_previous[2] += t.off[before][1][lane];
    to_previous[3] += t.off[before][3][lane];
  }
  const double unit = unit_[at(row)];
  const auto store = [](double value, float& to) { to = static_cast<float>(value); };
  for (int e = 0; e < valence; ++e) {
    const double units = unit * unit_[at(hessian_.column[at(first + e)])];
    for (size_t i = 0; i < 4; ++i) store(units * off[at(e)][i], hessian_.off[at(first + e)].a[i]);
  }
  std::array<float, 4>& diagonal = hessian_.diagonal[at(row)].a;
  store(unit * unit * d[0], diagonal[0]);
  store(unit * unit * d[1], diagonal[1]);
  store(unit * unit * d[1], diagonal[2]);
  store(unit * unit * d[2], diagonal[3]);
  for (size_t i = 0; i < 2; ++i) store(-unit * g[i], downhill_[2 * at(row) + i]);
}

/// False: numbers of a limb are beyond floats.
bool GlobalNewton::assemble(const DistortionEnergy& energy) {
  hessian_.off.resize(hessian_.column.size());
  hessian_.diagonal.resize(image_.size());
  downhill_.resize(2 * image_.size());
  int most_packs = 0;
  for (const Block& block : blocks_) most_packs = std::max(most_packs, block.packs);
  parallel_for(static_cast<std::int64_t>(blocks_.size()), block_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 const auto terms = std::make_unique_for_overwrite<TriangleTerms[]>(at(most_packs));
                 std::vector<std::array<double, 4>> off;
                 for (int b = static_cast<int>(first); b < static_cast<int>(last); ++b) {
                   const Block& block = blocks_[at(b)];
                   differentiate_triangles(&packs_[block.first_pack], block.packs, image_.data(),
                                           energy, terms.get());
                   const int end = std::min((b + 1) * block_size, hessian_.rows());
                   for (int row = b * block_size; row < end; ++row) {
                     gather_row(row, terms.get(), off);
                   }
                 }
               });
  bool finite = true;
  for (int row = 0; row < hessian_.rows(); ++row) {
    const bool fixed = pinned_[at(row)];
    for (int e = hessian_.start[at(row)]; e < hessian_.start[at(row) + 1]; ++e) {
      if (fixed || pinned_[at(hessian_.column[at(e)])]) hessian_.off[at(e)] = {};
    }
    std::array<float, 4>& diagonal = hessian_.diagonal[at(row)].a;
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

/// x ↦ ((1 − |a|²) x + 2 (1 + a·x) a) / |x + a|², |a| < 1
void GlobalNewton::boost(const Vector3& a, Image& image) const {
  image.resize(image_.size());
  parallel_for(static_cast<std::int64_t>(image_.size()), vertex_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto v = static_cast<size_t>(first); v < static_cast<size_t>(last); ++v) {
                   const Vector3 x = image_[v].vector();
                   const Vector3 y = (1 - a.squaredNorm()) * x + 2 * (1 + a.dot(x)) * a;
                   image[v] = image_point(y.normalized());
                 }
               });
}

double GlobalNewton::recentre(const DistortionEnergy& energy) {
  const double before = energy_of(energy, image_);
  if (std::count(pinned_.begin(), pinned_.end(), 1) > 0) return before;
  Image candidate;
  const auto energy_at = [&](const Vector3& a) {
    boost(a, candidate);
    return energy_of(energy, candidate);
  };
  // Differences of E along the axes and their sums.
  const double h = boost_difference;
  Vector3 gradient, ahead;
  Eigen::Matrix3d hessian;
  for (int i = 0; i < 3; ++i) {
    ahead[i] = energy_at(h * Vector3::Unit(i));
    const double behind = energy_at(-h * Vector3::Unit(i));
    gradient[i] = (ahead[i] - behind) / (2 * h);
    hessian(i, i) = (ahead[i] - 2 * before + behind) / (h * h);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      const double both = energy_at(h * (Vector3::Unit(i) + Vector3::Unit(j)));
      hessian(i, j) = hessian(j, i) = (both - ahead[i] - ahead[j] + before) / (h * h);
    }
  }
  if (!hessian.allFinite() || !gradient.allFinite()) return before;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(hessian);
  const Vector3 curvature = eigen.eigenvalues().cwiseAbs();
  const double floor = least_boost_curvature * curvature.maxCoeff();
  if (!(floor > 0)) return before;
  Vector3 a =
      -(eigen.eigenvectors() *
        (eigen.eigenvectors().transpose() * gradient).cwiseQuotient(curvature.cwiseMax(floor)));
  a *= std::min(1.0, longest_boost / a.norm());
  for (int i = 0; i < boost_halvings; ++i, a /= 2) {
    const double after = energy_at(a);
    if (!(after < before)) continue;
    image_.swap(candidate);
    return after;
  }
  return before;
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

/// The source triangles of a row, each seen from the row's vertex (as `rotated` turns them).
void GlobalNewton::measure_ring(int row, int lane, RingSlot* slots) const {
  const TrianglePack* packs = &packs_[blocks_[at(row / block_size)].first_pack];
  const int first = hessian_.start[at(row)], last = hessian_.start[at(row) + 1];
  for (int e = first; e < last; ++e, ++slots) {
    const int corner = slots_[at(e)] & 3, triangle = slots_[at(e)] >> 2;
    const TrianglePack& pack = packs[triangle / pack_width];
    const int from = triangle % pack_width;
    const double base = pack.inverse_base[from], height = pack.inverse_height[from];
    const double l2 = 1 / (base * base), h2 = 1 / (height * height), t = pack.foot[from];
    const double along = corner == 1 ? 1 - t : t;
    const double base2 = corner == 0 ? l2 : along * along * l2 + h2;
    const double product = corner == 0   ? t * l2
                           : corner == 1 ? (1 - t) * l2
                                         : h2 - t * (1 - t) * l2;
    slots->alpha[lane] = static_cast<float>(l2 * h2 / (8 * base2));
    slots->beta[lane] = static_cast<float>(base2 / 8);
    slots->shear[lane] = static_cast<float>(product / base2);
  }
}

RingPacks GlobalNewton::pack_rings_of_all() const {
  std::vector<Vertex> pinned;
  for (size_t v = 0; v < pinned_.size(); ++v) {
    if (pinned_[v]) pinned.push_back(static_cast<Vertex>(v));
  }
  return pack_rings(
      hessian_.start, hessian_.column,
      [&](int row, int lane, RingSlot* slots) { measure_ring(row, lane, slots); }, threads_,
      pinned);
}

void GlobalNewton::sweep(const DistortionEnergy& energy, int sweeps) {
  make_room();
  const RingPacks rings = pack_rings_of_all();
  for (int n = 0; n < sweeps * rings.colours(); ++n) {
    const int c = n % rings.colours(), first = rings.colour_start[at(c)];
    const int count = rings.colour_start[at(c) + 1] - first;
    parallel_for(count, sweep_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
      std::vector<PackScratch> scratch(at(rings.largest_valence));
      step_packs(rings, first + static_cast<int>(begin), first + static_cast<int>(end),
                 image_.data(), energy, over_relaxation, scratch.data());
    });
  }
}

bool GlobalNewton::can_move() const {
  return std::find(pinned_.begin(), pinned_.end(), 0) != pinned_.end();
}

void GlobalNewton::make_room() const {
  if (hessian_.rows() >= least_parallel_vertices) give_back_freed_memory();
}

/// The direction of a step. Leaves nothing of the Hessian but its pattern.
LinearSolution GlobalNewton::solve(const DistortionEnergy& energy, double tolerance) {
  make_room();
  if (!assemble(energy)) return {};
  if (multigrid_) {
    multigrid_->update(image_.data());
  } else {
    multigrid_.emplace(hessian_, order_, image_.data(), unit_.data(), pinned_, threads_);
  }
  LinearSolution solution = solve_by_conjugate_gradients(
      hessian_, *multigrid_, std::exchange(downhill_, {}), tolerance, most_iterations, threads_);
  hessian_.off = std::vector<sphparam::Block<2>>();  // = {} would keep the memory
  hessian_.diagonal = std::vector<sphparam::Block<2>>();
  return solution;
}

GlobalNewton::Step GlobalNewton::step(const DistortionEnergy& energy, double tolerance) {
  const double before = energy_of(energy, image_);
  const LinearSolution solution = solve(energy, tolerance);
  const double slope = -solution.gain;
  if (!(slope < 0) || !std::isfinite(slope)) return {before, solution.iterations, 0};
  const double cap = longest_step / longest(solution.x);

  Image candidate;
  double length = std::min(1.0, cap);
  for (int i = 0; i < halvings; ++i, length /= 2) {
    move(solution.x, length, candidate);
    double after = energy_of(energy, candidate);
    if (!(after < before + sufficient_decrease * length * slope)) continue;
    while (2 * length <= std::min(cap, most_expansion) && (i == 0 || length >= 1)) {
      move(solution.x, 2 * length, candidate);
      const double further = energy_of(energy, candidate);
      if (!(further < after)) {
        move(solution.x, length, candidate);  // again: cheaper than room for both
        break;
      }
      after = further;
      length *= 2;
    }
    image_.swap(candidate);
    return {after, solution.iterations, length};
  }
  return {before, solution.iterations, 0};
}

void GlobalNewton::write_to(std::vector<ImagePoint>& image) const {
  image.resize(image_.size());
  for (size_t v = 0; v < image_.size(); ++v) image[at(old_name_[v])] = image_[v];
}

}  // namespace sphparam
