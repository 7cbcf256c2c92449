// Normal equations Σ Wᵀ G W δ = Σ Wᵀ G (q − W C), G = w (τ I + (1 − τ) n nᵀ), for the correction δ
// of C, so that nothing depends on where the origin is. Patches write what they have for each of
// their control points into places of their own; vertices then add these up in order.

#include "remesh/subdivision/stencil_least_squares.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sphparam/errors.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t patch_grain = 128, vertex_grain = 1024;
constexpr double thin_share = 1e-3;  // of the mean weight of a control point
constexpr double rounding = 1e-14;   // of a residual, in parts of what it is the difference of

double dot(const Points& a, const Points& b, int threads) {
  return parallel_sum(a.rows(), threads, [&](std::int64_t first, std::int64_t last) {
    return a.middleRows(first, last - first).cwiseProduct(b.middleRows(first, last - first)).sum();
  });
}

/// Lists of items by key: items of key k are items[starts[k]] … items[starts[k + 1] − 1],
/// ascending.
template <class Index, class KeyOf>
void sort_by_key(std::int64_t count, int keys, const KeyOf& key_of, std::vector<Index>& starts,
                 std::vector<Index>& items) {
  starts.assign(static_cast<size_t>(keys) + 1, 0);
  items.resize(static_cast<size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) ++starts[static_cast<size_t>(key_of(i)) + 1];
  for (size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  for (std::int64_t i = 0; i < count; ++i) {
    items[static_cast<size_t>(next[static_cast<size_t>(key_of(i))]++)] = static_cast<Index>(i);
  }
}

}  // namespace

StencilLeastSquares::StencilLeastSquares(const LimitStencils& stencils, const Polygons& faces,
                                         VectorX weights, int threads)
    : stencils_(stencils), weights_(std::move(weights)), threads_(threads) {
  list_entries();
  list_neighbours(faces);
  list_thin_vertices();
  make_preconditioner();
}

void StencilLeastSquares::list_entries() {
  const int patches = stencils_.patch_count();
  const std::int64_t count = stencils_.first_entry(patches);
  patch_of_.reserve(static_cast<size_t>(count));
  for (int p = 0; p < patches; ++p) {
    patch_of_.resize(static_cast<size_t>(stencils_.first_entry(p + 1)), p);
  }
  const int* const vertices = stencils_.controls(0).data();
  sort_by_key(
      count, stencils_.vertex_count(), [&](std::int64_t e) { return vertices[e]; }, entry_starts_,
      entries_);
}

void StencilLeastSquares::list_neighbours(const Polygons& faces) {
  sort_by_key(
      std::ssize(faces.corners), stencils_.vertex_count(),
      [&](std::int64_t i) { return faces.corners[static_cast<size_t>(i)]; }, neighbour_starts_,
      neighbours_);
  std::vector<int> next(faces.corners.size());  // vertex after each corner, about its face
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const auto corners = faces.polygon(f);
    for (size_t k = 0; k < corners.size(); ++k) {
      next[static_cast<size_t>(faces.starts[static_cast<size_t>(f)]) + k] =
          corners[(k + 1) % corners.size()];
    }
  }
  for (int& corner : neighbours_) corner = next[static_cast<size_t>(corner)];
}

template <class Visit>
void StencilLeastSquares::for_each_entry(int v, const Visit& visit) const {
  for (std::int64_t i = entry_starts_[static_cast<size_t>(v)];
       i < entry_starts_[static_cast<size_t>(v) + 1]; ++i) {
    const std::int64_t e = entries_[static_cast<size_t>(i)];
    const int patch = patch_of_[static_cast<size_t>(e)];
    visit(patch, stencils_.weights(patch).col(e - stencils_.first_entry(patch)));
  }
}

void StencilLeastSquares::list_thin_vertices() {
  const int vertices = stencils_.vertex_count();
  VectorX seen(vertices);  // Σ W² w
  const std::int64_t m = std::ssize(stencils_.places());
  parallel_for(vertices, vertex_grain, threads_, [&](std::int64_t first, std::int64_t last) {
    for (auto v = static_cast<int>(first); v < static_cast<int>(last); ++v) {
      seen[v] = 0;
      for_each_entry(v, [&](int patch, const auto& column) {
        seen[v] += column.cwiseAbs2().dot(weights_.segment(patch * m, m));
      });
    }
  });
  const double enough = thin_share * seen.mean();
  for (int v = 0; v < vertices; ++v) {
    if (seen[v] < enough) thin_.push_back({v, enough - seen[v]});
  }
}

Eigen::Matrix3d StencilLeastSquares::diagonal_block(int v) const {
  const std::int64_t m = std::ssize(stencils_.places());
  Eigen::Matrix3d along = Eigen::Matrix3d::Zero();
  double all = 0;
  for_each_entry(v, [&](int patch, const auto& column) {
    for (std::int64_t k = 0; k < m; ++k) {
      const double weight = column[k] * column[k] * weights_[patch * m + k];
      all += weight;
      if (tangential_ < 1) {
        const Vector3 n = normals_.row(patch * m + k);
        along += weight * n * n.transpose();
      }
    }
  });
  return tangential_ * all * Eigen::Matrix3d::Identity() + (1 - tangential_) * along;
}

void StencilLeastSquares::make_preconditioner() {
  inverse_blocks_.resize(static_cast<size_t>(stencils_.vertex_count()));
  parallel_for(std::ssize(inverse_blocks_), vertex_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto v = static_cast<int>(first); v < static_cast<int>(last); ++v)
                   inverse_blocks_[static_cast<size_t>(v)] = diagonal_block(v);
               });
  for (const ThinVertex& thin : thin_) {
    const auto v = static_cast<size_t>(thin.vertex);
    inverse_blocks_[v] += thin.weight * Eigen::Matrix3d::Identity();
  }
  for (Eigen::Matrix3d& block : inverse_blocks_) block = block.inverse().eval();
}

void StencilLeastSquares::set_metric(Points normals, double tangential) {
  normals_ = std::move(normals);
  tangential_ = tangential;
  make_preconditioner();
}

Eigen::MatrixX3d StencilLeastSquares::at_patch(int patch, const Points& control) const {
  const auto controls = stencils_.controls(patch);
  Eigen::MatrixX3d points(std::ssize(controls), 3);
  for (size_t k = 0; k < controls.size(); ++k) {
    points.row(static_cast<Eigen::Index>(k)) = control.row(controls[k]);
  }
  return stencils_.weights(patch).lazyProduct(points);
}

Points StencilLeastSquares::evaluate(const Points& control) const {
  const std::int64_t m = std::ssize(stencils_.places());
  Points points(stencils_.patch_count() * m, 3);
  parallel_for(stencils_.patch_count(), patch_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto p = static_cast<int>(first); p < static_cast<int>(last); ++p) {
                   points.middleRows(p * m, m) = at_patch(p, control);
                 }
               });
  return points;
}

Eigen::MatrixX3d StencilLeastSquares::in_metric(int patch, Eigen::MatrixX3d y) const {
  const std::int64_t m = std::ssize(stencils_.places());
  const auto w = weights_.segment(patch * m, m);
  if (tangential_ < 1) {
    const auto n = normals_.middleRows(patch * m, m);
    const VectorX along = (1 - tangential_) * n.cwiseProduct(y).rowwise().sum().cwiseProduct(w);
    y = tangential_ * (w.asDiagonal() * y).eval();
    y += along.asDiagonal() * n;
  } else {
    y = (w.asDiagonal() * y).eval();
  }
  return y;
}

template <class AtSamples>
Points StencilLeastSquares::gather(const AtSamples& at_samples) const {
  Points of_entries(std::ssize(entries_), 3);
  parallel_for(stencils_.patch_count(), patch_grain, threads_,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto p = static_cast<int>(first); p < static_cast<int>(last); ++p) {
                   const Eigen::MatrixX3d y = in_metric(p, at_samples(p));
                   const std::int64_t entry = stencils_.first_entry(p);
                   of_entries.middleRows(entry, stencils_.first_entry(p + 1) - entry) =
                       stencils_.weights(p).transpose().lazyProduct(y);
                 }
               });
  Points sums(stencils_.vertex_count(), 3);
  parallel_for(sums.rows(), vertex_grain, threads_, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      Vector3 sum = Vector3::Zero();
      for (std::int64_t i = entry_starts_[static_cast<size_t>(v)];
           i < entry_starts_[static_cast<size_t>(v) + 1]; ++i) {
        sum += of_entries.row(entries_[static_cast<size_t>(i)]);
      }
      sums.row(v) = sum;
    }
  });
  return sums;
}

Points StencilLeastSquares::apply(const Points& control) const {
  Points sum = gather([&](int patch) { return at_patch(patch, control); });
  add_fairness(control, 1, sum);
  return sum;
}

Vector3 StencilLeastSquares::umbrella(int vertex, const Points& control) const {
  const int first = neighbour_starts_[static_cast<size_t>(vertex)],
            last = neighbour_starts_[static_cast<size_t>(vertex) + 1];
  Vector3 sum = Vector3::Zero();
  for (int i = first; i < last; ++i) sum += control.row(neighbours_[static_cast<size_t>(i)]);
  return control.row(vertex).transpose() - sum / (last - first);
}

/// Adds factor · Lᵀ a L C, L the difference of a vertex and the mean of its neighbours.
void StencilLeastSquares::add_fairness(const Points& control, double factor, Points& sum) const {
  for (const ThinVertex& thin : thin_) {
    const Vector3 pull = factor * thin.weight * umbrella(thin.vertex, control);
    const int first = neighbour_starts_[static_cast<size_t>(thin.vertex)],
              last = neighbour_starts_[static_cast<size_t>(thin.vertex) + 1];
    sum.row(thin.vertex) += pull;
    for (int i = first; i < last; ++i) {
      sum.row(neighbours_[static_cast<size_t>(i)]) -= pull / (last - first);
    }
  }
}

Points StencilLeastSquares::precondition(const Points& residual) const {
  Points result(residual.rows(), 3);
  parallel_for(residual.rows(), vertex_grain, threads_, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      result.row(v) = residual.row(v) * inverse_blocks_[static_cast<size_t>(v)];
    }
  });
  return result;
}

StencilLeastSquares::Outcome StencilLeastSquares::minimise(const Points& targets, Points& control,
                                                           double reduction,
                                                           const Progress& progress) const {
  const std::int64_t m = std::ssize(stencils_.places());
  const auto of_targets = [&](int patch) -> Eigen::MatrixX3d {
    return targets.middleRows(patch * m, m);
  };
  Points residual = gather(of_targets);
  const double scale = dot(residual, precondition(residual), threads_);
  residual = gather(
      [&](int patch) -> Eigen::MatrixX3d { return of_targets(patch) - at_patch(patch, control); });
  add_fairness(control, -1, residual);
  Points towards = precondition(residual);
  Points direction = towards;
  double square = dot(residual, towards, threads_);
  const double first = square,
               enough = std::max(reduction * reduction * first, rounding * rounding * scale);
  Outcome outcome;
  for (; square > enough; ++outcome.steps) {
    report(progress, "fit", 0);
    if (outcome.steps == most_steps)
      throw SolveError("subdivision fit: the least squares do not converge");
    const Points image = apply(direction);
    const double length = square / dot(direction, image, threads_);
    control += length * direction;
    residual -= length * image;
    towards = precondition(residual);
    const double before = std::exchange(square, dot(residual, towards, threads_));
    direction = towards + square / before * direction;
  }
  outcome.reduction = first > 0 ? std::sqrt(square / first) : 0;
  return outcome;
}

}  // namespace sphparam
