#include "baselines/equal_areas.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "baselines/tangent_basis.h"
#include "sphere/face_rays.h"
#include "sphere/solid_angle.h"
#include "sphparam/parallel.h"

// Unknowns: x_i + B_i d_i, back to the sphere; B_i two unit vectors of the tangent plane. With J
// the derivatives of the areas Ω, the step solves
//   (L + ρ Jᵀ A⁻¹ J + μ D) d = −∇merit,
// L the Hessian of −Σ cos(side) = −Σ x_i·x_j, its diagonal raised to the valence, which makes it
// semidefinite; D_i = ρ / (area of the star of i), so that damping μ bounds moves in proportion to
// the size of the star. Each face couples its own three vertices only: the pattern is that of
// edges.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;
constexpr double held_weight = 1e4;   // weight of an active constraint, of that of its area
constexpr double least_star = 1e-12;  // of the sphere: stars are no smaller in D

/// ∂Ω/∂a: tan(Ω/2) = N/D, N = det(a, b, c), D = 1 + a·b + b·c + c·a. (Ω: Van Oosterom, Strackee.)
Vector3 area_gradient(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = (b - a).cross(c - a);
  const double n = a.dot(normal), d = 1 + a.dot(b) + b.dot(c) + c.dot(a);
  const double length2 = n * n + d * d;
  return length2 > 0 ? Vector3(2 / length2 * (d * b.cross(c) - n * (b + c)))
                     : Vector3(Vector3::Zero());
}

}  // namespace

EqualAreas::EqualAreas(const Topology& topology, std::vector<double> shares, int threads)
    : topology_(topology), shares_(std::move(shares)), threads_(threads), system_(topology, 2) {}

double EqualAreas::area_term(const SphereMap& map) const {
  return parallel_sum(topology_.face_count(), threads_, [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (Face f = static_cast<Face>(first); f < last; ++f) {
      const double target = 4 * std::numbers::pi * shares_[static_cast<size_t>(f)];
      const auto [a, b, c] = face_rays(topology_, map, f);
      const double error = solid_angle(a, b, c) - target;
      sum += error * error / target;
    }
    return sum;
  });
}

double EqualAreas::merit(const SphereMap& map, double penalty) const {
  const double sides = parallel_sum(
      topology_.halfedge_count(), threads_, [&](std::int64_t first, std::int64_t last) {
        double sum = 0;  // 1 − cos = |x_i − x_j|²/2, each edge twice: does not cancel
        for (Halfedge h = static_cast<Halfedge>(first); h < last; ++h) {
          sum +=
              (map.point(topology_.origin(h)) - map.point(topology_.target(h))).squaredNorm() / 4;
        }
        return sum;
      });
  return sides + penalty / 2 * area_term(map);
}

double EqualAreas::area_error(const SphereMap& map) const {
  return std::sqrt(area_term(map) / (4 * std::numbers::pi));
}

std::vector<char> EqualAreas::negative_angles(const SphereMap& map) const {
  std::vector<char> negative(shares_.size(), 0);
  const auto of_chunk = [&](std::int64_t first, std::int64_t last) {
    for (Face f = static_cast<Face>(first); f < last; ++f) {
      negative[static_cast<size_t>(f)] = face_orientation(topology_, map, f) <= 0;
    }
  };
  parallel_for(topology_.face_count(), grain, threads_, of_chunk);
  return negative;
}

void EqualAreas::add_sides(const SphereMap& map) {
  for (Vertex i = 0; i < topology_.vertex_count(); ++i) {
    const Vector3 x = map.point(i);
    const Eigen::Matrix<double, 3, 2> basis = tangent_basis(x);
    Vector3 pull = Vector3::Zero();
    double valence = 0;
    topology_.for_each_outgoing(i, [&](Halfedge h) {
      const Vector3 y = map.point(topology_.target(h));
      pull += y - x;
      ++valence;
      const Eigen::Matrix2d block = -basis.transpose() * tangent_basis(y);
      double* out = off_diagonal_.data() + 4 * static_cast<size_t>(h);
      out[0] = block(0, 0), out[1] = block(0, 1), out[2] = block(1, 0), out[3] = block(1, 1);
    });
    double* out = diagonal_.data() + 4 * static_cast<size_t>(i);
    out[0] = out[3] = valence;
    force_.segment<2>(2 * i) = basis.transpose() * pull;
  }
}

void EqualAreas::add_areas(const SphereMap& map, double penalty, double damping,
                           const std::vector<char>& active) {
  std::vector<double> star(static_cast<size_t>(topology_.vertex_count()), 0);
  for (Face f = 0; f < topology_.face_count(); ++f) {
    const std::array<Vertex, 3> t = {topology_.vertex(f, 0), topology_.vertex(f, 1),
                                     topology_.vertex(f, 2)};
    const std::array<Vector3, 3> x = {map.point(t[0]), map.point(t[1]), map.point(t[2])};
    const double area = solid_angle(x[0], x[1], x[2]);
    const double target = 4 * std::numbers::pi * shares_[static_cast<size_t>(f)];
    const bool held = active[static_cast<size_t>(f)] != 0;
    const double weight = (held ? held_weight : 1) * penalty / target;
    const double error = held ? 0 : area - target;
    std::array<Eigen::Vector2d, 3> row;  // of J
    for (size_t k = 0; k < 3; ++k) {
      row[k] =
          tangent_basis(x[k]).transpose() * area_gradient(x[k], x[(k + 1) % 3], x[(k + 2) % 3]);
      force_.segment<2>(2 * t[k]) -= weight * error * row[k];
      star[static_cast<size_t>(t[k])] += std::abs(area);
    }
    const auto add = [&](double* out, size_t a, size_t b) {
      const Eigen::Matrix2d block = weight * row[a] * row[b].transpose();
      out[0] += block(0, 0), out[1] += block(0, 1), out[2] += block(1, 0), out[3] += block(1, 1);
    };
    for (size_t k = 0; k < 3; ++k) {
      const Halfedge h = 3 * f + static_cast<int>(k);
      add(diagonal_.data() + 4 * static_cast<size_t>(t[k]), k, k);
      add(off_diagonal_.data() + 4 * static_cast<size_t>(h), k, (k + 1) % 3);
      add(off_diagonal_.data() + 4 * static_cast<size_t>(topology_.twin(h)), (k + 1) % 3, k);
    }
  }
  const double least = least_star * 4 * std::numbers::pi;
  for (size_t i = 0; i < star.size(); ++i) {
    const double damped = damping * penalty / std::max(star[i], least);
    diagonal_[4 * i] += damped;
    diagonal_[4 * i + 3] += damped;
  }
}

VectorX EqualAreas::step(const SphereMap& map, double penalty, double damping,
                         const std::vector<char>& active) {
  diagonal_.assign(4 * static_cast<size_t>(topology_.vertex_count()), 0);
  off_diagonal_.assign(4 * static_cast<size_t>(topology_.halfedge_count()), 0);
  force_.setZero(2 * topology_.vertex_count());
  add_sides(map);
  add_areas(map, penalty, damping, active);
  system_.factorise(diagonal_, off_diagonal_);
  return system_.solve(force_);
}

SphereMap EqualAreas::moved(const SphereMap& map, const VectorX& step) const {
  SphereMap next = map;
  for (Vertex v = 0; v < topology_.vertex_count(); ++v) {
    const Vector3 x = map.point(v);
    next.points.row(v) = moved_on_sphere(x, step.segment<2>(2 * v));
  }
  return next;
}

}  // namespace sphparam
