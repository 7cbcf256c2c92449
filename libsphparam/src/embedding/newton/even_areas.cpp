#include "embedding/newton/even_areas.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "elementary.h"
#include "embedding/constructions/orientations.h"
#include "sphere/face_rays.h"
#include "sphere/solid_angle.h"

// (JᵀJ + μK) δ = −Jᵀr in tangent coordinates: r = √A ln(Ω/A) of each triangle, and δᵀKδ the squared
// strain of image triangles, weighted by A. Where μ is small the step is the gentlest of those that
// solve Jδ = −r.

namespace sphparam {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr int most_steps = 200;
constexpr double least_gain = 1e-4;  // of a step
constexpr double enough = 0.5;       // of the error that is good enough: what follows may cost some
constexpr double first_damping = 1, least_damping = 1e-8, greatest_damping = 1e8;
constexpr double firmness =
    1e-6;  // of the mean of K, for turns of the whole sphere, which are free
constexpr double shortest_step = 1e-3, least_descent = 1e-4;
constexpr double covered_once = 1e-6;  // of the sum of all solid angles

using Corners = std::array<Vector3, 3>;

/// Half the gradient of Ω = 2 atan2(sine, cosine) in each corner, of unit vectors.
Corners half_gradients(const Corners& x) {
  const auto [sine, cosine] = half_solid_angle_of(x[0], x[1], x[2]);
  const double scale = 1 / (sine * sine + cosine * cosine);
  Corners gradients;
  for (size_t k = 0; k < 3; ++k) {
    const Vector3 &next = x[(k + 1) % 3], &last = x[(k + 2) % 3];
    gradients[k] = scale * (cosine * next.cross(last) - sine * (next + last));
  }
  return gradients;
}

class EvenAreas {
 public:
  EvenAreas(const Topology& topology, const RestTriangles& source, SphereMap map,
            const EvenAreasOptions& options)
      : topology_(topology), source_(source), options_(options), map_(std::move(map)) {
    unknown_.assign(static_cast<size_t>(topology.vertex_count()), 0);
    for (const Vertex v : options.pinned) unknown_[static_cast<size_t>(v)] = -1;
    for (int& unknown : unknown_)
      if (unknown == 0) unknown = 2 * count_++;
  }

  EvenedMap run() {
    state_ = state_of(map_);
    int steps = 0;
    for (; count_ > 0 && steps < most_steps && state_.error > enough * options_.area_error;
         ++steps) {
      report(options_.progress, "balance", static_cast<double>(steps) / most_steps);
      const double before = state_.squares;
      if (!step() || state_.squares > (1 - least_gain) * before) break;
    }
    return {std::move(map_), steps};
  }

 private:
  struct State {
    double squares = std::numeric_limits<double>::infinity();  // Σ A (ln Ω/A)²
    double error = 0;                                          // mean |log2 Ω/A|
  };

  /// Of a map that folds: infinite.
  State state_of(const SphereMap& map) const {
    if (!all_triangles_positive(topology_, map, options_.threads)) return {};
    State state{0, 0};
    double area = 0, covered = 0;
    for (Face f = 0; f < topology_.face_count(); ++f) {
      const Corners x = face_rays(topology_, map, f);
      const double a = source_[static_cast<size_t>(f)].area;
      const double omega = solid_angle(x[0], x[1], x[2]);
      const double ratio = elementary::log(omega / a);
      state.squares += a * ratio * ratio;
      state.error += a * std::abs(ratio) / std::numbers::ln2;
      area += a;
      covered += omega;
    }
    state.error /= area;
    const bool once = std::abs(covered / (4 * std::numbers::pi) - 1) < covered_once;
    return once ? state : State{};
  }

  /// False: none gains.
  bool step() {
    assemble();
    for (; damping_ <= greatest_damping; damping_ *= 10) {
      const Matrix system = squares_ + damping_ * strain_;
      if (!analysed_) factor_.analyzePattern(system);
      analysed_ = true;
      factor_.factorize(system);
      if (factor_.info() != Eigen::Success) continue;
      const VectorX direction = factor_.solve(-slope_);
      if (!direction.allFinite() || !go_along(direction)) continue;
      return true;
    }
    return false;
  }

  bool go_along(const VectorX& direction) {
    for (double part = 1; part > shortest_step; part /= 2) {
      SphereMap moved = map_;
      for (Vertex v = 0; v < topology_.vertex_count(); ++v) {
        const int i = unknown_[static_cast<size_t>(v)];
        if (i < 0) continue;
        const Vector3 x = map_.point(v);
        moved.points.row(v) = tangent_frame(x).at(x, part * direction[i], part * direction[i + 1]);
      }
      const State state = state_of(moved);
      if (!(state.squares < (1 - least_descent * part) * state_.squares)) continue;
      map_ = std::move(moved);
      state_ = state;
      if (part == 1) damping_ = std::max(damping_ / 4, least_damping);
      return true;
    }
    return false;
  }

  void assemble() {
    const Eigen::Index size = 2 * count_;
    std::vector<Eigen::Triplet<double>> squares, strain;
    squares.reserve(static_cast<size_t>(topology_.face_count()) * 21);
    strain.reserve(squares.capacity() + static_cast<size_t>(size));
    slope_ = VectorX::Zero(size);
    for (Face f = 0; f < topology_.face_count(); ++f) add(f, squares, strain);
    double stiffness = 0;
    for (const auto& entry : strain)
      if (entry.row() == entry.col()) stiffness += entry.value();
    for (int i = 0; i < size; ++i)
      strain.emplace_back(i, i, firmness * stiffness / static_cast<double>(size));
    squares_.resize(size, size);
    squares_.setFromTriplets(squares.begin(), squares.end());
    strain_.resize(size, size);
    strain_.setFromTriplets(strain.begin(), strain.end());
  }

  /// One triangle's part: lower triangles of both matrices, and the slope.
  void add(Face f, std::vector<Eigen::Triplet<double>>& squares,
           std::vector<Eigen::Triplet<double>>& strain) {
    const Corners x = face_rays(topology_, map_, f);
    const double a = source_[static_cast<size_t>(f)].area;
    const double omega = solid_angle(x[0], x[1], x[2]);
    const Corners gradients = half_gradients(x);
    const Corners edges{x[2] - x[1], x[0] - x[2], x[1] - x[0]};
    const double weight = std::sqrt(a), ratio = elementary::log(omega / a);
    const double strained = a / edges[0].cross(edges[1]).squaredNorm();
    std::array<int, 6> at;
    Eigen::Matrix<double, 6, 1> row;
    Eigen::Matrix<double, 3, 6> axes;
    for (int k = 0; k < 3; ++k) {
      const int i = unknown_[static_cast<size_t>(topology_.vertex(f, k))];
      const TangentFrame frame = tangent_frame(x[static_cast<size_t>(k)]);
      for (int axis = 0; axis < 2; ++axis) {
        at[static_cast<size_t>(2 * k + axis)] = i < 0 ? i : i + axis;
        axes.col(2 * k + axis) = axis == 0 ? frame.u : frame.v;
        row[2 * k + axis] =
            2 * weight / omega * axes.col(2 * k + axis).dot(gradients[static_cast<size_t>(k)]);
      }
    }
    for (int i = 0; i < 6; ++i) {
      const int p = at[static_cast<size_t>(i)];
      if (p < 0) continue;
      slope_[p] += row[i] * weight * ratio;
      for (int j = 0; j < 6; ++j) {
        const int q = at[static_cast<size_t>(j)];
        if (q < 0 || q > p) continue;
        squares.emplace_back(p, q, row[i] * row[j]);
        const double along =
            edges[static_cast<size_t>(i / 2)].dot(edges[static_cast<size_t>(j / 2)]);
        strain.emplace_back(p, q, strained * along * axes.col(i).dot(axes.col(j)));
      }
    }
  }

  const Topology& topology_;
  const RestTriangles& source_;
  const EvenAreasOptions& options_;
  SphereMap map_;
  State state_;
  std::vector<int> unknown_;  // the first of a vertex; −1: pinned
  int count_ = 0;             // of vertices that are not
  Matrix squares_, strain_;   // JᵀJ and K, lower triangles
  VectorX slope_;             // Jᵀr
  double damping_ = first_damping;
  bool analysed_ = false;
  Eigen::SimplicialLDLT<Matrix> factor_;
};

}  // namespace

EvenedMap even_areas(const Topology& topology, const RestTriangles& source, SphereMap map,
                     const EvenAreasOptions& options) {
  return EvenAreas(topology, source, std::move(map), options).run();
}

}  // namespace sphparam
