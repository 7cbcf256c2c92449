#include "sphparam/sphere/spherical_correlation.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "elementary.h"
#include "sphere/harmonic_turns.h"
#include "sphparam/parallel.h"

// R = R_z(α) R_y(β) R_z(γ). For each β the correlation is a trigonometric polynomial of α and γ,
//   Σ_mn (cos mα, sin mα) T_mn (cos nγ, sin nγ)ᵀ,
// with T from the turn about y of all degrees, and its values on a grid are two matrix products.
// A maximum is then followed by Newton's method: with J the generators of turns, the gradient is
// ⟨to, J_k f⟩, the Hessian ⟨to, (J_j J_k + J_k J_j)/2 f⟩.
// Of functions that are known on parts, with m where each is known, mf and mf² there, six such
// grids have all sums over what is shared: of 1 (m, m'), f, f', f², f'², ff'.

namespace sphparam {
namespace {

using Matrix3 = Eigen::Matrix3d;
constexpr int grid_degree = 12;
constexpr double least_angle = std::numbers::pi / 9;  // between two maxima
constexpr int most_steps = 30;
constexpr double small_step = 1e-13;     // radians
constexpr double least_shared = 0.5;     // of the smaller of two parts
constexpr double least_variance = 1e-3;  // on what is shared, of the mean square on the part

int degree_of(const Functions& c) {
  return static_cast<int>(std::lround(std::sqrt(double(c.rows())))) - 1;
}

/// Without means, each of unit norm; those of the second divided by their number, too.
Functions normalised(Functions c) {
  c.row(0).setZero();
  for (Eigen::Index k = 0; k < c.cols(); ++k) {
    const double norm = c.col(k).norm();
    if (!(norm > 0)) throw std::invalid_argument("spherical correlation: a function is constant");
    c.col(k) /= norm;
  }
  return c;
}

Functions of_degree(const Functions& c, int degree) {
  return c.topRows(Eigen::Index(degree + 1) * (degree + 1));
}

Matrix3 about_z(double angle) {
  Matrix3 turn = Matrix3::Identity();
  turn(0, 0) = turn(1, 1) = elementary::cos(angle);
  turn(1, 0) = elementary::sin(angle);
  turn(0, 1) = -turn(1, 0);
  return turn;
}

Matrix3 about_y(double angle) {
  Matrix3 turn = Matrix3::Identity();
  turn(0, 0) = turn(2, 2) = elementary::cos(angle);
  turn(0, 2) = elementary::sin(angle);
  turn(2, 0) = -turn(0, 2);
  return turn;
}

/// Correlations at all rotations of a grid of Euler angles.
class EulerGrid {
 public:
  EulerGrid(const Functions& from, const Functions& to, int threads)
      : degree_(degree_of(from)),
        around_(4 * degree_ + 2),
        down_(2 * degree_ + 1),
        from_(from),
        to_(to),
        turns_(degree_),
        waves_(waves()) {
    values_.resize(static_cast<size_t>(down_));
    parallel_for(down_, 1, threads, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
        values_[static_cast<size_t>(i)] = waves_ * terms(polar(i)) * waves_.transpose();
    });
  }

  std::int64_t count() const { return std::int64_t{down_} * around_ * around_; }
  double value(std::int64_t i) const {
    return values_[static_cast<size_t>(i / (around_ * around_))](i / around_ % around_,
                                                                 i % around_);
  }
  Matrix3 rotation(std::int64_t i) const {
    const double step = 2 * std::numbers::pi / around_;
    return about_z(step * double(i / around_ % around_)) * about_y(polar(i / (around_ * around_))) *
           about_z(step * double(i % around_));
  }

 private:
  double polar(std::int64_t i) const { return std::numbers::pi * (double(i) + 0.5) / down_; }

  /// A row an angle: 1, cos α, sin α, cos 2α, …
  Eigen::MatrixXd waves() const {
    Eigen::MatrixXd result(around_, 2 * degree_ + 1);
    for (int i = 0; i < around_; ++i) {
      const double angle = 2 * std::numbers::pi * i / around_;
      result(i, 0) = 1;
      for (int m = 1; m <= degree_; ++m) {
        result(i, 2 * m - 1) = elementary::cos(m * angle);
        result(i, 2 * m) = elementary::sin(m * angle);
      }
    }
    return result;
  }

  /// What cos mα and sin mα, of rows 2m − 1 and 2m, are factors of in ⟨R_z(−α) to, …⟩: rows of
  /// coefficients of one degree, a column a place in `waves`. `sign`: of the turn.
  static Eigen::MatrixXd spread(const Functions& c, int l, Eigen::Index k, int degree,
                                double sign) {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(2 * l + 1, 2 * degree + 1);
    result(l, 0) = c(harmonic_index(l, 0), k);
    for (int m = 1; m <= l; ++m) {
      const double cosine = c(harmonic_index(l, m), k), sine = c(harmonic_index(l, -m), k);
      result(l + m, 2 * m - 1) = cosine;
      result(l - m, 2 * m - 1) = sine;
      result(l + m, 2 * m) = -sign * sine;
      result(l - m, 2 * m) = sign * cosine;
    }
    return result;
  }

  /// T, for one β.
  Eigen::MatrixXd terms(double polar) const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(2 * degree_ + 1, 2 * degree_ + 1);
    for (int l = 1; l <= degree_; ++l) {
      const Eigen::MatrixXd turn = turns_.about_y(l, polar);
      for (Eigen::Index k = 0; k < from_.cols(); ++k)
        sum += spread(to_, l, k, degree_, -1).transpose() * turn * spread(from_, l, k, degree_, 1);
    }
    return sum / double(from_.cols());
  }

  int degree_, around_, down_;
  const Functions &from_, &to_;
  HarmonicTurns turns_;
  Eigen::MatrixXd waves_;
  std::vector<Eigen::MatrixXd> values_;
};

double angle_between(const Matrix3& a, const Matrix3& b) {
  return elementary::acos(std::clamp(((a.transpose() * b).trace() - 1) / 2, -1.0, 1.0));
}

/// The greatest values at the rotations of a grid, far enough from one another.
std::vector<TurnOfFunctions> peaks(const EulerGrid& grid, const VectorX& values, int most) {
  std::vector<std::int64_t> order(static_cast<size_t>(grid.count()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](auto a, auto b) { return values[a] > values[b]; });
  std::vector<TurnOfFunctions> found;
  for (const std::int64_t i : order) {
    if (!std::isfinite(values[i])) break;
    const Matrix3 rotation = grid.rotation(i);
    if (std::ranges::all_of(found, [&](const TurnOfFunctions& other) {
          return angle_between(rotation, other.rotation) > least_angle;
        }))
      found.push_back({rotation, values[i]});
    if (std::ssize(found) == most) break;
  }
  return found;
}

VectorX values_of(const EulerGrid& grid) {
  VectorX values(grid.count());
  for (std::int64_t i = 0; i < grid.count(); ++i) values[i] = grid.value(i);
  return values;
}

/// Integrals over the sphere of the product of two functions, one turned, at all rotations.
VectorX products(const Functions& from, const Functions& to, Eigen::Index k, int threads) {
  const int degree = std::min(degree_of(from), grid_degree);
  const Functions f = of_degree(from, degree).col(k), g = of_degree(to, degree).col(k);
  return values_of(EulerGrid(f, g, threads)).array() + f(0, 0) * g(0, 0);
}

/// Correlations over what is shared, at all rotations; −∞ where they say nothing.
VectorX shared_correlations(const PartlyKnown& from, const PartlyKnown& to, Eigen::Index k,
                            int threads) {
  const auto integral = [&](const Functions& c) {
    return c(0, k) * std::sqrt(4 * std::numbers::pi);
  };
  const double smaller = std::min(integral(from.known), integral(to.known));
  const VectorX n = products(from.known, to.known, k, threads);
  const VectorX f = products(from.values, to.known, k, threads);
  const VectorX g = products(from.known, to.values, k, threads);
  const VectorX ff = products(from.squares, to.known, k, threads);
  const VectorX gg = products(from.known, to.squares, k, threads);
  const VectorX fg = products(from.values, to.values, k, threads);
  const double least_f = least_variance * integral(from.squares) / integral(from.known);
  const double least_g = least_variance * integral(to.squares) / integral(to.known);
  VectorX result(n.size());
  for (Eigen::Index i = 0; i < n.size(); ++i) {
    const double of_f = ff[i] / n[i] - f[i] * f[i] / (n[i] * n[i]);
    const double of_g = gg[i] / n[i] - g[i] * g[i] / (n[i] * n[i]);
    const bool tells = n[i] >= least_shared * smaller && of_f > least_f && of_g > least_g;
    result[i] = tells ? (fg[i] / n[i] - f[i] * g[i] / (n[i] * n[i])) / std::sqrt(of_f * of_g)
                      : -std::numeric_limits<double>::infinity();
  }
  return result;
}

/// The turn by the vector w, up to second order: (1 − W/2)⁻¹ (1 + W/2), W x = w × x.
Matrix3 cayley(const Vector3& w) {
  Matrix3 half;
  half << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  half /= 2;
  return (Matrix3::Identity() - half).inverse() * (Matrix3::Identity() + half);
}

class Ascent {
 public:
  Ascent(const Functions& from, const Functions& to)
      : from_(from), to_(to), turns_(degree_of(from)) {}

  TurnOfFunctions run(const Matrix3& start) const {
    TurnOfFunctions at{start, correlation(start)};
    for (int i = 0; i < most_steps; ++i) {
      const std::optional<Vector3> step = step_at(at.rotation);
      if (!step || !take(*step, at) || step->norm() < small_step) break;
    }
    return at;
  }

 private:
  Functions turned(const Matrix3& rotation) const { return turn_harmonics(from_, rotation, 1); }
  double product(const Functions& f) const {
    return to_.cwiseProduct(f).sum() / double(to_.cols());
  }
  double correlation(const Matrix3& rotation) const { return product(turned(rotation)); }

  /// Newton's, where the Hessian is negative; else uphill by a hundredth.
  std::optional<Vector3> step_at(const Matrix3& rotation) const {
    const Functions f = turned(rotation);
    Vector3 gradient;
    Matrix3 hessian;
    for (int k = 0; k < 3; ++k) {
      const Functions moved = turns_.generator(k, f);
      gradient[k] = product(moved);
      for (int j = 0; j < 3; ++j) hessian(j, k) = product(turns_.generator(j, moved));
    }
    const Matrix3 symmetric = (hessian + hessian.transpose()) / 2;
    const Vector3 newton = -symmetric.inverse() * gradient;
    const bool is_uphill = newton.allFinite() && newton.dot(gradient) > 0 && newton.norm() < 1;
    if (is_uphill) return newton;
    if (!(gradient.norm() > 0)) return std::nullopt;
    return Vector3(0.01 * gradient.normalized());
  }

  /// The step or a part of it, where that goes up.
  bool take(const Vector3& step, TurnOfFunctions& at) const {
    for (double part = 1; part > 1e-3; part /= 4) {
      const Matrix3 rotation = cayley(part * step) * at.rotation;
      const double value = correlation(rotation);
      if (value < at.correlation) continue;
      at = {rotation, value};
      return true;
    }
    return false;
  }

  const Functions &from_, &to_;
  HarmonicTurns turns_;
};

void require_alike(const Functions& from, const Functions& to, int most) {
  if (from.rows() != to.rows() || from.cols() != to.cols() || from.cols() == 0)
    throw std::invalid_argument(
        "spherical correlation: not as many functions, or coefficients, in both");
  const Eigen::Index side = degree_of(from) + 1;
  if (side < 2 || side * side != from.rows())
    throw std::invalid_argument("spherical correlation: " + std::to_string(from.rows()) +
                                " coefficients are no (L + 1)² of a degree L ≥ 1");
  if (most < 1) throw std::invalid_argument("spherical correlation: most is less than 1");
}

}  // namespace

std::vector<TurnOfFunctions> turns_by_correlation(const Functions& from, const Functions& to,
                                                  int most, int threads) {
  require_alike(from, to, most);
  const Functions f = normalised(from), g = normalised(to);
  const int degree = std::min(degree_of(f), grid_degree);
  const Functions coarse_f = of_degree(f, degree), coarse_g = of_degree(g, degree);
  const EulerGrid grid(coarse_f, coarse_g, threads);
  const Ascent ascent(f, g);
  std::vector<TurnOfFunctions> found;
  for (const TurnOfFunctions& peak : peaks(grid, values_of(grid), most)) {
    const TurnOfFunctions turn = ascent.run(peak.rotation);
    const bool is_new = std::ranges::all_of(found, [&](const TurnOfFunctions& other) {
      return angle_between(other.rotation, turn.rotation) > least_angle;
    });
    if (is_new) found.push_back(turn);
  }
  std::ranges::stable_sort(found, std::greater{}, &TurnOfFunctions::correlation);
  return found;
}

std::vector<TurnOfFunctions> turns_by_shared_correlation(const PartlyKnown& from,
                                                         const PartlyKnown& to, int most,
                                                         int threads) {
  for (const auto& [one, other] :
       {std::pair(&from.known, &to.known), std::pair(&from.values, &to.values),
        std::pair(&from.squares, &to.squares), std::pair(&from.known, &from.values),
        std::pair(&from.known, &from.squares)})
    require_alike(*one, *other, most);
  VectorX values = shared_correlations(from, to, 0, threads);
  for (Eigen::Index k = 1; k < from.known.cols(); ++k)
    values += shared_correlations(from, to, k, threads);
  values /= static_cast<double>(from.known.cols());
  const int degree = std::min(degree_of(from.known), grid_degree);
  const Functions any = Functions::Zero(Eigen::Index(degree + 1) * (degree + 1), 1);
  return peaks(EulerGrid(any, any, threads), values, most);  // for its rotations alone
}

}  // namespace sphparam
