#include "sphparam/sphere/spherical_harmonics.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/parallel.h"
#include "sphparam/sphere/sphere_locator.h"

// Points are taken in blocks that stay in the nearest cache: for every order m the Legendre
// functions run upwards in l, all points of the block in step, so that the compiler's vectors carry
// points and no sum crosses lanes but in a fixed order. cos mθ and sin mθ turn by one θ from order
// to order.

namespace sphparam {
namespace {

constexpr int block_size = 128;           // points
constexpr int lanes = 8;                  // partial sums of a dot product, whatever the machine
constexpr std::int64_t most_chunks = 32;  // each has coefficients of its own to sum into

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SPHPARAM_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SPHPARAM_CLONES
#endif

using Row = std::array<double, block_size>;

int degree_of(Eigen::Index rows) {
  const int degree = static_cast<int>(std::lround(std::sqrt(static_cast<double>(rows)))) - 1;
  if (degree < 0 || Eigen::Index(degree + 1) * (degree + 1) != rows ||
      degree > greatest_harmonic_degree) {
    throw std::invalid_argument("spherical harmonics: " + std::to_string(rows) +
                                " coefficients are no (L + 1)² with L up to " +
                                std::to_string(greatest_harmonic_degree));
  }
  return degree;
}

/// P_lm = up (x P_{l−1,m} − down P_{l−2,m}) for l > m.
struct Recursion {
  double up, down;
};

class Legendre {
 public:
  explicit Legendre(int degree) : degree_(degree), first_(size_t(degree) + 1) {
    for (int m = 0; m <= degree; ++m) {
      first_[size_t(m)] = steps_.size();
      for (int l = m + 1; l <= degree; ++l) {
        const double l2 = double(l) * l, m2 = double(m) * m, k2 = double(l - 1) * (l - 1);
        steps_.push_back({std::sqrt((4 * l2 - 1) / (l2 - m2)),
                          l == m + 1 ? 0 : std::sqrt((k2 - m2) / (4 * k2 - 1))});
      }
    }
  }
  int degree() const { return degree_; }
  /// For l = m + 1, m + 2, …
  const Recursion* steps(int m) const { return &steps_[0] + first_[size_t(m)]; }

 private:
  int degree_;
  std::vector<Recursion> steps_;
  std::vector<size_t> first_;
};

/// What runs along with the order m, for a block of points.
struct Waves {
  Row x, y, z;       // the directions; unused places repeat the north pole
  Row sectoral;      // P_mm / sin^m ϕ times …
  Row cosine, sine;  // … sin^m ϕ: cos mθ · sinᵐϕ and sin mθ · sinᵐϕ, as (x + iy)ᵐ
};

void load(const Points& directions, std::int64_t first, int count, Waves& w) {
  for (int i = 0; i < block_size; ++i) {
    const Vector3 d = i < count ? Vector3(directions.row(first + i)) : Vector3::UnitZ();
    w.x[size_t(i)] = d.x();
    w.y[size_t(i)] = d.y();
    w.z[size_t(i)] = d.z();
  }
  w.sectoral.fill(std::sqrt(1 / (4 * std::numbers::pi)));
  w.cosine.fill(1);
  w.sine.fill(0);
}

/// Of order m + 1. The √2 of m > 0 comes in with the first.
SPHPARAM_CLONES void turn(Waves& w, int m) {
  const double grow = std::sqrt((2.0 * m + 3) / (2 * m + 2)) * (m == 0 ? std::numbers::sqrt2 : 1);
  for (int i = 0; i < block_size; ++i) {
    const double c = w.cosine[size_t(i)], s = w.sine[size_t(i)];
    w.sectoral[size_t(i)] *= grow;
    w.cosine[size_t(i)] = c * w.x[size_t(i)] - s * w.y[size_t(i)];
    w.sine[size_t(i)] = s * w.x[size_t(i)] + c * w.y[size_t(i)];
  }
}

/// next = up (z · now − down · before); `before` becomes `now`, and `now` becomes `next`.
SPHPARAM_CLONES void climb(const Row& z, Recursion step, Row& before, Row& now) {
  for (int i = 0; i < block_size; ++i) {
    const double next = step.up * (z[size_t(i)] * now[size_t(i)] - step.down * before[size_t(i)]);
    before[size_t(i)] = now[size_t(i)];
    now[size_t(i)] = next;
  }
}

SPHPARAM_CLONES void add(const Row& p, double a, double b, Row& even, Row& odd) {
  for (int i = 0; i < block_size; ++i) {
    even[size_t(i)] += a * p[size_t(i)];
    odd[size_t(i)] += b * p[size_t(i)];
  }
}

SPHPARAM_CLONES double dot(const Row& a, const Row& b) {
  double sums[lanes] = {};
  for (int i = 0; i < block_size; i += lanes) {
    for (int k = 0; k < lanes; ++k) sums[k] += a[size_t(i + k)] * b[size_t(i + k)];
  }
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// Values of all functions at the points of a block.
void synthesise_block(const Legendre& legendre, const Functions& coefficients, Waves& w,
                      std::vector<Row>& values, std::vector<Row>& even, std::vector<Row>& odd) {
  const size_t functions = values.size();
  for (Row& v : values) v.fill(0);
  for (int m = 0; m <= legendre.degree(); ++m) {
    for (Row& r : even) r.fill(0);
    for (Row& r : odd) r.fill(0);
    Row before{}, now = w.sectoral;
    const Recursion* steps = legendre.steps(m);
    for (int l = m; l <= legendre.degree(); ++l) {
      if (l > m) climb(w.z, steps[l - m - 1], before, now);
      const double* a = &coefficients(harmonic_index(l, m), 0);
      const double* b = &coefficients(harmonic_index(l, -m), 0);
      for (size_t k = 0; k < functions; ++k) add(now, a[k], m > 0 ? b[k] : 0, even[k], odd[k]);
    }
    for (size_t k = 0; k < functions; ++k) {
      for (size_t i = 0; i < block_size; ++i) {
        values[k][i] += even[k][i] * w.cosine[i] + odd[k][i] * w.sine[i];
      }
    }
    turn(w, m);
  }
}

/// coefficients += Σ over the block of values · Y, the values weighted.
void analyse_block(const Legendre& legendre, const std::vector<Row>& values, Waves& w,
                   std::vector<Row>& even, std::vector<Row>& odd, Functions& coefficients) {
  const size_t functions = values.size();
  for (int m = 0; m <= legendre.degree(); ++m) {
    for (size_t k = 0; k < functions; ++k) {
      for (size_t i = 0; i < block_size; ++i) {
        even[k][i] = values[k][i] * w.cosine[i];
        odd[k][i] = values[k][i] * w.sine[i];
      }
    }
    Row before{}, now = w.sectoral;
    const Recursion* steps = legendre.steps(m);
    for (int l = m; l <= legendre.degree(); ++l) {
      if (l > m) climb(w.z, steps[l - m - 1], before, now);
      double* a = &coefficients(harmonic_index(l, m), 0);
      double* b = &coefficients(harmonic_index(l, -m), 0);
      for (size_t k = 0; k < functions; ++k) {
        a[k] += dot(now, even[k]);
        if (m > 0) b[k] += dot(now, odd[k]);
      }
    }
    turn(w, m);
  }
}

/// Calls visit(first, count) for the blocks of a chunk.
template <class Visit>
void for_each_block(std::int64_t begin, std::int64_t end, const Visit& visit) {
  for (std::int64_t first = begin; first < end; first += block_size) {
    visit(first, static_cast<int>(std::min<std::int64_t>(block_size, end - first)));
  }
}

/// Each vertex's share of the sphere: a third of its triangles' solid angles. Sums to 4π.
Eigen::VectorXd solid_angles(const Topology& topology, const SphereMap& map) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(topology.vertex_count());
  for (Face f = 0; f < topology.face_count(); ++f) {
    const Vector3 a = map.point(topology.vertex(f, 0)), b = map.point(topology.vertex(f, 1)),
                  c = map.point(topology.vertex(f, 2));
    const double angle = 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
    for (int k = 0; k < 3; ++k) shares[topology.vertex(f, k)] += angle / 3;
  }
  return shares;
}

/// Node i of n of Gauss–Legendre quadrature on [−1, 1], from 1 downwards, and its weight.
std::pair<double, double> gauss_legendre(int i, int n) {
  double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
  for (int round = 0; round < 8; ++round) {  // Newton; three or four do
    double before = 1, now = x;
    for (int l = 2; l <= n; ++l) {
      const double next = ((2 * l - 1) * x * now - (l - 1) * before) / l;
      before = now;
      now = next;
    }
    slope = n * (x * now - before) / (x * x - 1);
    x -= now / slope;
  }
  return {x, 2 / ((1 - x * x) * slope * slope)};
}

/// Values at directions of the piecewise linear functions that a map carries to the sphere.
Functions look_up(const Topology& topology, const SphereMap& map, const Functions& values,
                  const Points& directions, int threads) {
  const std::vector<SurfacePoint> points =
      SphereLocator(topology, map, threads).locate_all(directions, threads);
  Functions result(directions.rows(), values.cols());
  for (size_t i = 0; i < points.size(); ++i) {
    auto row = result.row(static_cast<Eigen::Index>(i));
    row.setZero();
    for (int k = 0; k < 3; ++k) {
      row += points[i].barycentric[k] * values.row(topology.vertex(points[i].face, k));
    }
  }
  return result;
}

void require_degree(int degree) {
  if (degree >= 0 && degree <= greatest_harmonic_degree) return;
  throw std::invalid_argument("spherical harmonics: degree " + std::to_string(degree) +
                              " is not within 0 … " + std::to_string(greatest_harmonic_degree));
}

/// Conjugate gradients on YᵀWY c = YᵀW f, all functions side by side, each with its own steps.
class NormalEquations {
 public:
  NormalEquations(const Points& directions, const Eigen::VectorXd& weights,
                  const HarmonicFitOptions& options)
      : directions_(directions), weights_(weights), options_(options) {}

  int solve(const Functions& values, Functions& coefficients) const {
    const Eigen::ArrayXd enough =
        options_.tolerance * options_.tolerance * transposed(values).colwise().squaredNorm();
    Functions residual = transposed(values - synthesised(coefficients));
    Functions direction = residual;
    Eigen::ArrayXd squared = residual.colwise().squaredNorm();
    int iteration = 0;
    while (iteration < options_.most_iterations && (squared > enough).any()) {
      report(options_.progress, "least squares",
             static_cast<double>(iteration) / options_.most_iterations);
      const Functions image = transposed(synthesised(direction));
      const Eigen::ArrayXd curvature = direction.cwiseProduct(image).colwise().sum();
      const Eigen::ArrayXd step =
          (squared > enough && curvature > 0).select(squared / curvature, 0.0);
      coefficients += direction * step.matrix().asDiagonal();
      residual -= image * step.matrix().asDiagonal();
      const Eigen::ArrayXd next = residual.colwise().squaredNorm();
      const Eigen::ArrayXd keep = (squared > enough).select(next / squared, 0.0);
      direction = residual + direction * keep.matrix().asDiagonal();
      squared = next;
      ++iteration;
    }
    return iteration;
  }

 private:
  Functions synthesised(const Functions& coefficients) const {
    return synthesise(coefficients, directions_, options_.threads);
  }
  Functions transposed(const Functions& values) const {
    return analyse(options_.degree, directions_, weights_, values, options_.threads);
  }

  const Points& directions_;
  const Eigen::VectorXd& weights_;
  const HarmonicFitOptions& options_;
};

}  // namespace

Functions synthesise(const Functions& coefficients, const Points& directions, int threads) {
  const Legendre legendre(degree_of(coefficients.rows()));
  const auto functions = static_cast<size_t>(coefficients.cols());
  Functions values(directions.rows(), coefficients.cols());
  parallel_for(directions.rows(), 8 * block_size, threads,
               [&](std::int64_t begin, std::int64_t end) {
                 Waves waves;
                 std::vector<Row> rows(functions), even(functions), odd(functions);
                 for_each_block(begin, end, [&](std::int64_t first, int count) {
                   load(directions, first, count, waves);
                   synthesise_block(legendre, coefficients, waves, rows, even, odd);
                   for (size_t k = 0; k < functions; ++k) {
                     for (int i = 0; i < count; ++i)
                       values(first + i, Eigen::Index(k)) = rows[k][size_t(i)];
                   }
                 });
               });
  return values;
}

Functions analyse(int degree, const Points& directions, const Eigen::VectorXd& weights,
                  const Functions& values, int threads) {
  require_degree(degree);
  if (weights.size() != directions.rows() || values.rows() != directions.rows()) {
    throw std::invalid_argument("spherical harmonics: not one weight and one value a direction");
  }
  const Legendre legendre(degree);
  const auto functions = static_cast<size_t>(values.cols());
  const Functions none = Functions::Zero(Eigen::Index(degree + 1) * (degree + 1), values.cols());
  const std::int64_t blocks = (directions.rows() + block_size - 1) / block_size;
  const std::int64_t grain = block_size * ((blocks + most_chunks - 1) / most_chunks);
  std::vector<Functions> partial(static_cast<size_t>(most_chunks), none);
  parallel_for(directions.rows(), grain, threads, [&](std::int64_t begin, std::int64_t end) {
    Waves waves;
    std::vector<Row> rows(functions), even(functions), odd(functions);
    for_each_block(begin, end, [&](std::int64_t first, int count) {
      load(directions, first, count, waves);
      for (size_t k = 0; k < functions; ++k) {
        rows[k].fill(0);
        for (int i = 0; i < count; ++i) {
          rows[k][size_t(i)] = weights[first + i] * values(first + i, Eigen::Index(k));
        }
      }
      analyse_block(legendre, rows, waves, even, odd, partial[static_cast<size_t>(begin / grain)]);
    });
  });
  Functions sum = none;
  for (const Functions& part : partial) sum += part;
  return sum;
}

QuadratureGrid quadrature_grid(int degree) {
  require_degree(degree);
  const int rows = degree + 1, columns = 2 * degree + 2;
  QuadratureGrid grid{Points(Eigen::Index(rows) * columns, 3),
                      Eigen::VectorXd(Eigen::Index(rows) * columns)};
  for (int i = 0; i < rows; ++i) {
    const auto [z, weight] = gauss_legendre(i, rows);
    const double radius = std::sqrt((1 - z) * (1 + z));
    for (int j = 0; j < columns; ++j) {
      const double theta = 2 * std::numbers::pi * j / columns;
      grid.directions.row(Eigen::Index(i) * columns + j) << radius * std::cos(theta),
          radius * std::sin(theta), z;
      grid.weights[Eigen::Index(i) * columns + j] = weight * 2 * std::numbers::pi / columns;
    }
  }
  return grid;
}

HarmonicFit fit_harmonics(const Topology& topology, const SphereMap& map, const Functions& values,
                          const HarmonicFitOptions& options) {
  require_degree(options.degree);
  if (values.rows() != topology.vertex_count() || map.points.rows() != topology.vertex_count()) {
    throw std::invalid_argument("spherical harmonics: not one value and one ray a vertex");
  }
  report(options.progress, "quadrature", 0);
  const QuadratureGrid grid = quadrature_grid(options.degree);
  HarmonicFit fit;
  fit.coefficients =
      analyse(options.degree, grid.directions, grid.weights,
              look_up(topology, map, values, grid.directions, options.threads), options.threads);
  const Eigen::VectorXd shares = solid_angles(topology, map);
  if (options.least_squares) {
    fit.iterations = NormalEquations(map.points, shares, options).solve(values, fit.coefficients);
  }
  const Functions left = values - synthesise(fit.coefficients, map.points, options.threads);
  fit.rms = ((shares.asDiagonal() * left.cwiseAbs2()).colwise().sum() / shares.sum()).cwiseSqrt();
  return fit;
}

Functions power_per_degree(const Functions& coefficients) {
  const int degree = degree_of(coefficients.rows());
  Functions power(degree + 1, coefficients.cols());
  for (int l = 0; l <= degree; ++l) {
    power.row(l) =
        coefficients.middleRows(harmonic_index(l, -l), 2 * l + 1).colwise().squaredNorm();
  }
  return power;
}

Vector3 first_order_ellipsoid(const Functions& coefficients) {
  const Eigen::Matrix3d axes =
      coefficients.middleRows(1, 3) * std::sqrt(3 / (4 * std::numbers::pi));
  return axes.jacobiSvd().singularValues();
}

}  // namespace sphparam
