#include "correspondence/composition_newton.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "sphparam/parallel.h"

// Unknowns: two tangent coordinates a vertex, in the plane of its face of the target, y_i(u) = y_i
// + T_i u_i. A triangle's Jacobian is linear in them, (x, y) = M u; its Hessian is MᵀHM with
// eigenvalues below 0 cut to 0. Columns of the lower triangle: a free vertex's own 2×2 block, then
// those of its neighbours of greater number.

namespace sphparam {
namespace {

constexpr std::int64_t face_grain = 256, vertex_grain = 256;
constexpr int halvings = 8, local_halvings = 12;
constexpr double longest_way = 0.3;      // of a vertex; the surface has the area 4π
constexpr double regularisation = 1e-9;  // of the diagonal's mean
/// More free vertices are solved for by iterations: what is left there is short-waved, and filling
/// a factor costs more than linear.
constexpr int direct_vertices = 4000;
constexpr int most_iterations = 60;
constexpr double least_residual = 0.02;  // of the gradient

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

CompositionNewton::CompositionNewton(MovingSurface& surface, int threads)
    : surface_(surface), threads_(threads), unknown_(at(surface.topology().vertex_count()), -1) {
  for (Vertex v = 0; v < surface.topology().vertex_count(); ++v) {
    if (surface.is_held(v)) continue;
    unknown_[at(v)] = static_cast<int>(free_.size());
    free_.push_back(v);
  }
  make_pattern();
}

void CompositionNewton::make_pattern() {
  const Topology& topology = surface_.topology();
  const auto size = 2 * std::ssize(free_);
  std::vector<int> inner, outer{0};
  std::vector<int> later;
  for (int i = 0; i < std::ssize(free_); ++i) {
    later.clear();
    topology.for_each_outgoing(free_[at(i)], [&](Halfedge h) {
      const int j = unknown_[at(topology.origin(topology.next(h)))];
      if (j > i) later.push_back(j);
    });
    std::ranges::sort(later);
    for (int column = 0; column < 2; ++column) {
      for (int row = column; row < 2; ++row) inner.push_back(2 * i + row);
      for (const int j : later) inner.insert(inner.end(), {2 * j, 2 * j + 1});
      outer.push_back(static_cast<int>(inner.size()));
    }
  }
  const std::vector<double> zeros(inner.size(), 0.0);
  hessian_ = Eigen::Map<const Eigen::SparseMatrix<double>>(
      size, size, std::ssize(inner), outer.data(), inner.data(), zeros.data());
  gradient_.resize(size);
  if (is_direct()) factor_.analyzePattern(hessian_);
}

bool CompositionNewton::is_direct() const { return std::ssize(free_) <= direct_vertices; }

/// False: the way is no number.
bool CompositionNewton::solve() {
  if (is_direct()) {
    factor_.factorize(hessian_);
    if (factor_.info() != Eigen::Success) return false;
    way_ = -factor_.solve(gradient_);
  } else {
    ConjugateGradients iterations;
    iterations.setTolerance(least_residual);
    iterations.setMaxIterations(most_iterations);
    iterations.compute(hessian_);
    if (iterations.info() != Eigen::Success) return false;
    way_ = -iterations.solve(gradient_);
  }
  return way_.allFinite();
}

CompositionNewton::FaceTerms CompositionNewton::face_terms(Face face,
                                                           const ComposedEnergy& energy) const {
  const ComposedTerms terms = surface_.terms(face, energy);
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(terms.hessian);
  return {terms.gradient, eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                              eigen.eigenvectors().transpose()};
}

void CompositionNewton::gather(Vertex v, const std::vector<FaceTerms>& terms) {
  const Topology& topology = surface_.topology();
  const int i = unknown_[at(v)];
  const int* outer = hessian_.outerIndexPtr();
  const int* inner = hessian_.innerIndexPtr();
  double* values = hessian_.valuePtr();
  const std::array<int, 2> first{outer[2 * i], outer[2 * i + 1]};
  std::fill(values + first[0], values + outer[2 * i + 2], 0.0);
  MovingSurface::FeatureTerms own = surface_.feature_terms(v);
  values[first[0]] = own.hessian(0, 0);
  values[first[0] + 1] = own.hessian(1, 0);
  values[first[1]] = own.hessian(1, 1);
  topology.for_each_outgoing(v, [&](Halfedge h) {
    const FaceTerms& t = terms[at(h / 3)];
    const int k = h % 3;
    own.gradient += t.gradient.segment<2>(2 * k);
    values[first[0]] += t.hessian(2 * k, 2 * k);
    values[first[0] + 1] += t.hessian(2 * k + 1, 2 * k);
    values[first[1]] += t.hessian(2 * k + 1, 2 * k + 1);
    for (int other = 1; other < 3; ++other) {
      const int l = (k + other) % 3, j = unknown_[at(topology.vertex(h / 3, l))];
      if (j <= i) continue;
      const int* begin = inner + first[0] + 2;
      const auto place = std::lower_bound(begin, inner + first[1], 2 * j) - begin;
      for (int row = 0; row < 2; ++row) {
        values[first[0] + 2 + place + row] += t.hessian(2 * l + row, 2 * k);
        values[first[1] + 1 + place + row] += t.hessian(2 * l + row, 2 * k + 1);
      }
    }
  });
  gradient_.segment<2>(2 * i) = own.gradient;
}

void CompositionNewton::assemble(const ComposedEnergy& energy) {
  std::vector<FaceTerms> terms(at(surface_.topology().face_count()));
  parallel_for(std::ssize(terms), face_grain, threads_, [&](std::int64_t first, std::int64_t last) {
    for (auto f = first; f < last; ++f)
      terms[static_cast<size_t>(f)] = face_terms(static_cast<Face>(f), energy);
  });
  parallel_for(std::ssize(free_), vertex_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto i = first; i < last; ++i) gather(free_[static_cast<size_t>(i)], terms);
               });
  double sum = 0;
  for (Eigen::Index i = 0; i < hessian_.cols(); ++i)
    sum += hessian_.valuePtr()[hessian_.outerIndexPtr()[i]];
  const double shift = regularisation * sum / static_cast<double>(hessian_.cols());
  for (Eigen::Index i = 0; i < hessian_.cols(); ++i)
    hessian_.valuePtr()[hessian_.outerIndexPtr()[i]] += shift;
}

/// Halves the lengths of the corners of triangles that would not be certain until all are.
bool CompositionNewton::lengths_that_keep(std::vector<double>& lengths,
                                          std::vector<Place>& places) const {
  const Topology& topology = surface_.topology();
  std::vector<char> changed(free_.size(), 1);
  for (int round = 0; round < local_halvings; ++round) {
    parallel_for(std::ssize(free_), vertex_grain, threads_,
                 [&](std::int64_t first, std::int64_t last) {
                   for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i) {
                     if (!changed[i]) continue;
                     const PlaceFrame& frame = surface_.place(free_[i]).frame;
                     const auto k = static_cast<Eigen::Index>(2 * i);
                     Vector3 way = way_[k] * frame.u + way_[k + 1] * frame.v;
                     way *= std::min(1.0, longest_way / way.norm());
                     places[at(free_[i])] =
                         surface_.target().walk(surface_.place(free_[i]), lengths[i] * way);
                   }
                 });
    std::ranges::fill(changed, 0);
    bool all = true;
    for (Face f = 0; f < topology.face_count(); ++f) {
      if (surface_.certain(f, places)) continue;
      all = false;
      for (int k = 0; k < 3; ++k) {
        const int i = unknown_[at(topology.vertex(f, k))];
        if (i >= 0) changed[at(i)] = 1;
      }
    }
    if (all) return true;
    for (size_t i = 0; i < changed.size(); ++i)
      if (changed[i]) lengths[i] /= 2;
  }
  return false;
}

CompositionNewton::Step CompositionNewton::step(const ComposedEnergy& energy, double before) {
  if (free_.empty()) return {before, false};
  assemble(energy);
  if (!solve()) return {before, false};
  std::vector<double> lengths(free_.size(), 1.0);
  std::vector<Place> places = surface_.places();
  for (int i = 0; i < halvings; ++i) {
    if (lengths_that_keep(lengths, places)) {
      const double after = surface_.energy(energy, places, threads_);
      if (after < before) {
        surface_.swap_places(places);
        return {after, true};
      }
    }
    for (double& length : lengths) length /= 2;
  }
  return {before, false};
}

}  // namespace sphparam
