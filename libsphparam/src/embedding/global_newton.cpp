#include "embedding/global_newton.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sphparam/parallel.h"

// Assembly goes block by block of vertices: the terms of all triangles that touch the block are
// computed into a buffer that stays in the cache, then each vertex gathers its row. Triangles on
// the rim of a block are computed twice; nothing is written from two sides, so blocks run in
// parallel with the same result.

namespace sphparam {
namespace {

constexpr int block_size = 512;  // vertices
constexpr std::int64_t vertex_grain = 2048, block_grain = 4;
constexpr int least_parallel_vertices = 4096;  // below it waking other threads costs more
constexpr int most_iterations = 60;
constexpr double longest_step = 0.7;  // radians, of any vertex
constexpr double sufficient_decrease = 1e-4;
constexpr int halvings = 40;
constexpr double most_expansion = 8;  // of a Newton step: clamped Hessians are too stiff
constexpr double diagonal_shift = 1e-9;
constexpr double boost_difference = 0.01, longest_boost = 0.3, least_boost_curvature = 1e-3;
constexpr int boost_halvings = 6;
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
  new_name_.resize(at(n));
  image_.resize(at(n));
  for (int v = 0; v < n; ++v) {
    new_name_[at(old_name_[at(v)])] = v;
    image_[at(v)] = image[at(old_name_[at(v)])];
  }
  pinned_.assign(at(n), 0);
  for (const Vertex v : pinned) pinned_[at(new_name_[at(v)])] = 1;
  make_pattern(topology);
  pack_triangles(topology, source);
  order_ = order_sweeps(hessian_.start, hessian_.column, block_size);
}

void GlobalNewton::make_pattern(const Topology& topology) {
  const int n = topology.vertex_count();
  hessian_.start.assign(1, 0);
  hessian_.column.reserve(at(topology.halfedge_count()));
  for (int v = 0; v < n; ++v) {
    topology.for_each_outgoing(old_name_[at(v)], [&](Halfedge h) {
      hessian_.column.push_back(new_name_[at(topology.target(h))]);
    });
    hessian_.start.push_back(static_cast<int>(hessian_.column.size()));
  }
  hessian_.off.resize(hessian_.column.size());
  hessian_.diagonal.resize(at(n));
  gradient_.resize(2 * at(n));
}

void GlobalNewton::pack_triangles(const Topology& topology, const SourceTriangles& source) {
  const int n = topology.vertex_count();
  slots_.resize(hessian_.column.size());
  std::vector<int> place(at(topology.face_count()), -1), placed_in(at(topology.face_count()), -1);
  std::vector<Face> owned, touching;
  packs_.reserve(at(topology.face_count()) / 6);
  const auto fill = [&](const std::vector<Face>& faces, int block, int base) {
    for (size_t i = 0; i < faces.size(); ++i) {
      place[at(faces[i])] = base + static_cast<int>(i);
      placed_in[at(faces[i])] = block;
      if (i % pack_width == 0) packs_.emplace_back();
      TrianglePack& pack = packs_.back();
      pack.filled = static_cast<int>(i % pack_width) + 1;
      const SourceTriangle& s = source[at(faces[i])];
      for (size_t lane = i % pack_width; lane < pack_width; ++lane) {
        pack.inverse_base[lane] = s.inverse_base;
        pack.inverse_height[lane] = s.inverse_height;
        pack.foot[lane] = s.foot;
        pack.area[lane] = s.area;
        for (int k = 0; k < 3; ++k) {
          pack.corner[k][lane] = new_name_[at(topology.vertex(faces[i], k))];
        }
      }
    }
    return static_cast<int>((faces.size() + pack_width - 1) / pack_width);
  };
  for (int first = 0, block = 0; first < n; first += block_size, ++block) {
    const int last = std::min(n, first + block_size);
    owned.clear();
    touching.clear();
    for (int v = first; v < last; ++v) {
      topology.for_each_outgoing(old_name_[at(v)], [&](Halfedge h) {
        const int a = new_name_[at(topology.target(h))], b = new_name_[at(topology.apex(h))];
        const int least = std::min(a, b);
        // Taken at the block's first corner of the triangle.
        if (std::min({a >= first ? a : n, b >= first ? b : n, v}) < v) return;
        (least < first ? touching : owned).push_back(Topology::face(h));
      });
    }
    Block b{packs_.size(), 0, 0};
    b.owned = fill(owned, block, 0);
    b.packs = b.owned + fill(touching, block, b.owned * pack_width);
    blocks_.push_back(b);
    for (int v = first; v < last; ++v) {
      int entry = hessian_.start[at(v)];
      topology.for_each_outgoing(old_name_[at(v)], [&](Halfedge h) {
        slots_[at(entry++)] = 4 * place[at(Topology::face(h))] + Topology::corner(h);
      });
    }
  }
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

void GlobalNewton::gather_row(int row, const TriangleTerms* terms) {
  const int first = hessian_.start[at(row)], last = hessian_.start[at(row) + 1];
  std::array<double, 3> d{};
  std::array<double, 2> g{};
  for (int e = first; e < last; ++e) hessian_.off[at(e)] = {};
  for (int e = first; e < last; ++e) {
    const int slot = slots_[at(e)], k = slot & 3, triangle = slot >> 2;
    const TriangleTerms& t = terms[triangle / pack_width];
    const int lane = triangle % pack_width, before = (k + 2) % 3;
    for (size_t i = 0; i < 3; ++i) d[i] += t.diagonal[k][i][lane];
    for (size_t i = 0; i < 2; ++i) g[i] += t.gradient[k][i][lane];
    sphparam::Block<2>& to_next = hessian_.off[at(e)];
    sphparam::Block<2>& to_previous = hessian_.off[at(e + 1 < last ? e + 1 : first)];
    for (size_t i = 0; i < 4; ++i) to_next.a[i] += t.off[k][i][lane];
    to_previous.a[0] += t.off[before][0][lane];
    to_previous.a[1] += t.off[before][2][lane];
    to_previous.a[2] += t.off[before][1][lane];
    to_previous.a[3] += t.off[before][3][lane];
  }
  hessian_.diagonal[at(row)].a = {d[0] * (1 + diagonal_shift), d[1], d[1],
                                  d[2] * (1 + diagonal_shift)};
  gradient_[2 * at(row)] = g[0];
  gradient_[2 * at(row) + 1] = g[1];
}

void GlobalNewton::assemble(const DistortionEnergy& energy) {
  parallel_for(static_cast<std::int64_t>(blocks_.size()), block_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 std::vector<TriangleTerms> terms;
                 for (int b = static_cast<int>(first); b < static_cast<int>(last); ++b) {
                   const Block& block = blocks_[at(b)];
                   terms.resize(std::max(terms.size(), at(block.packs)));
                   differentiate_triangles(&packs_[block.first_pack], block.packs, image_.data(),
                                           energy, terms.data());
                   const int end = std::min((b + 1) * block_size, hessian_.rows());
                   for (int row = b * block_size; row < end; ++row) gather_row(row, terms.data());
                 }
               });
  for (int row = 0; row < hessian_.rows(); ++row) {
    const bool fixed = pinned_[at(row)];
    for (int e = hessian_.start[at(row)]; e < hessian_.start[at(row) + 1]; ++e) {
      if (fixed || pinned_[at(hessian_.column[at(e)])]) hessian_.off[at(e)] = {};
    }
    if (!fixed) continue;
    hessian_.diagonal[at(row)].a = {1, 0, 0, 1};
    gradient_[2 * at(row)] = gradient_[2 * at(row) + 1] = 0;
  }
}

void GlobalNewton::move(const std::vector<double>& direction, double length, Image& image) const {
  image.resize(image_.size());
  parallel_for(static_cast<std::int64_t>(image_.size()), vertex_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto v = static_cast<size_t>(first); v < static_cast<size_t>(last); ++v) {
                   if (pinned_[v]) {
                     image[v] = image_[v];
                     continue;
                   }
                   const Vector3 x = image_[v].vector();
                   image[v] = image_point(tangent_frame(x).at(x, length * direction[2 * v],
                                                              length * direction[2 * v + 1]));
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

double GlobalNewton::longest(const std::vector<double>& direction) const {
  double squared = 0;
  for (size_t v = 0; v < image_.size(); ++v) {
    const double a = direction[2 * v], b = direction[2 * v + 1];
    squared = std::max(squared, a * a + b * b);
  }
  return std::sqrt(squared);
}

SourceTriangle GlobalNewton::corner(int row, int entry) const {
  const int slot = slots_[at(hessian_.start[at(row)] + entry)], triangle = slot >> 2;
  const TrianglePack& pack =
      packs_[blocks_[at(row / block_size)].first_pack + at(triangle / pack_width)];
  const int lane = triangle % pack_width;
  return rotated(
      {pack.area[lane], pack.inverse_base[lane], pack.inverse_height[lane], pack.foot[lane]},
      slot & 3);
}

void GlobalNewton::sweep(const DistortionEnergy& energy, int sweeps) {
  if (!rings_) {
    std::vector<Vertex> pinned;
    for (size_t v = 0; v < pinned_.size(); ++v) {
      if (pinned_[v]) pinned.push_back(static_cast<Vertex>(v));
    }
    rings_ = pack_rings(
        hessian_.start, hessian_.column, [&](int row, int i) { return corner(row, i); }, threads_,
        pinned);
  }
  for (int n = 0; n < sweeps * rings_->colours(); ++n) {
    const int c = n % rings_->colours(), first = rings_->colour_start[at(c)];
    const int count = rings_->colour_start[at(c) + 1] - first;
    parallel_for(count, sweep_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
      std::vector<PackScratch> scratch(at(rings_->largest_valence));
      step_packs(*rings_, first + static_cast<int>(begin), first + static_cast<int>(end),
                 image_.data(), energy, over_relaxation, scratch.data());
    });
  }
}

bool GlobalNewton::can_move() const {
  return std::find(pinned_.begin(), pinned_.end(), 0) != pinned_.end();
}

GlobalNewton::Step GlobalNewton::step(const DistortionEnergy& energy, double tolerance) {
  const double before = energy_of(energy, image_);
  assemble(energy);
  if (multigrid_) {
    multigrid_->update(image_.data());
  } else {
    multigrid_.emplace(hessian_, order_, image_.data(), pinned_, threads_);
  }
  std::vector<double> downhill(gradient_.size());
  for (size_t i = 0; i < downhill.size(); ++i) downhill[i] = -gradient_[i];
  const LinearSolution solution = solve_by_conjugate_gradients(
      hessian_, *multigrid_, downhill, tolerance, most_iterations, threads_);
  double slope = 0;
  for (size_t i = 0; i < downhill.size(); ++i) slope -= downhill[i] * solution.x[i];
  const double cap = longest_step / longest(solution.x);
  if (!(slope < 0) || !std::isfinite(slope)) return {before, solution.iterations, 0};

  Image candidate, further;
  double length = std::min(1.0, cap);
  for (int i = 0; i < halvings; ++i, length /= 2) {
    move(solution.x, length, candidate);
    double after = energy_of(energy, candidate);
    if (!(after < before + sufficient_decrease * length * slope)) continue;
    while (2 * length <= std::min(cap, most_expansion) && (i == 0 || length >= 1)) {
      move(solution.x, 2 * length, further);
      const double there = energy_of(energy, further);
      if (!(there < after)) break;
      candidate.swap(further);
      after = there;
      length *= 2;
    }
    image_.swap(candidate);
    return {after, solution.iterations, length};
  }
  return {before, solution.iterations, 0};
}

void GlobalNewton::write_to(std::vector<ImagePoint>& image) const {
  for (size_t v = 0; v < image_.size(); ++v) image[at(old_name_[v])] = image_[v];
}

}  // namespace sphparam
