#include "sphparam/sphere/spherical_harmonics.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "elementary.h"
#include "sphere/harmonic_degree.h"
#include "sphparam/parallel.h"

// Points are taken in blocks that stay in the nearest cache. For every order m the Legendre
// functions run upwards in l, eight points a vector and three functions side by side, so that a run
// stays in registers; no sum crosses lanes but in a fixed order. cos mθ and sin mθ turn by one θ
// from order to order. Coefficients are laid out order by order for it, see `Terms`.

namespace sphparam {
namespace {

constexpr int block_size = 128;           // points
constexpr int lanes = 8;                  // of a vector, whatever the machine
constexpr int wide = 3;                   // functions that share a run of the recursion
constexpr std::int64_t most_chunks = 32;  // each has coefficients of its own to sum into

// ThreadSanitizer watches the choice among clones too, which is made before it has started.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define SPHPARAM_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SPHPARAM_CLONES
#endif

using Row = std::array<double, block_size>;
using Rows = std::array<Row, wide>;
using Lanes = double __attribute__((vector_size(lanes * sizeof(double))));

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

/// NaN is no direction.
void require_unit(const Points& directions) {
  constexpr double unit = 1e-6;  // what squared lengths may be off: some roundings of float32
  for (Eigen::Index i = 0; i < directions.rows(); ++i) {
    const double squared = directions.row(i).squaredNorm();
    if (std::abs(squared - 1) <= unit) continue;
    throw std::invalid_argument("spherical harmonics: direction " + std::to_string(i) +
                                " is not of unit length");
  }
}

/// P_lm = up x P_{l−1,m} − drop P_{l−2,m} for l > m.
struct Recursion {
  double up, drop;
};

class Legendre {
 public:
  explicit Legendre(int degree) : degree_(degree), first_(size_t(degree) + 1) {
    for (int m = 0; m <= degree; ++m) {
      first_[size_t(m)] = steps_.size();
      for (int l = m + 1; l <= degree; ++l) {
        const double l2 = double(l) * l, m2 = double(m) * m, k2 = double(l - 1) * (l - 1);
        const double up = std::sqrt((4 * l2 - 1) / (l2 - m2));
        steps_.push_back({up, l == m + 1 ? 0 : up * std::sqrt((k2 - m2) / (4 * k2 - 1))});
      }
    }
  }
  int degree() const { return degree_; }
  /// For l = m + 1, m + 2, …
  const Recursion* steps(int m) const { return steps_.data() + first_[size_t(m)]; }

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

__attribute__((always_inline)) inline Lanes load(const double* from) {
  Lanes result;
  __builtin_memcpy(&result, from, sizeof result);
  return result;
}
__attribute__((always_inline)) inline void store(Lanes value, double* to) {
  __builtin_memcpy(to, &value, sizeof value);
}
__attribute__((always_inline)) inline double total(Lanes s) {
  return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

/// even_k = Σ_l a_lk P_lm, odd_k = Σ_l b_lk P_lm over `count` degrees. terms: a_l0 a_l1 a_l2 b_l0 …
SPHPARAM_CLONES void add_up(const Row& z, const Row& sectoral, const Recursion* steps, int count,
                            const double* terms, Rows& even, Rows& odd) {
  for (int i = 0; i < block_size; i += lanes) {
    const Lanes x = load(&z[size_t(i)]);
    Lanes before{}, now = load(&sectoral[size_t(i)]);
    Lanes e0 = terms[0] * now, e1 = terms[1] * now, e2 = terms[2] * now;
    Lanes o0 = terms[3] * now, o1 = terms[4] * now, o2 = terms[5] * now;
    for (int n = 1; n < count; ++n) {
      const Recursion step = steps[n - 1];
      const double* t = terms + 2 * wide * n;
      const Lanes next = (step.up * x) * now - step.drop * before;
      before = now;
      now = next;
      e0 += t[0] * now, e1 += t[1] * now, e2 += t[2] * now;
      o0 += t[3] * now, o1 += t[4] * now, o2 += t[5] * now;
    }
    store(e0, &even[0][size_t(i)]), store(e1, &even[1][size_t(i)]), store(e2, &even[2][size_t(i)]);
    store(o0, &odd[0][size_t(i)]), store(o1, &odd[1][size_t(i)]), store(o2, &odd[2][size_t(i)]);
  }
}

/// The transpose: a_lk += Σ P_lm even_k and b_lk += Σ P_lm odd_k over the points.
SPHPARAM_CLONES void project(const Row& z, const Row& sectoral, const Recursion* steps, int count,
                             const Rows& even, const Rows& odd, double* terms) {
  Row before{}, now = sectoral;
  for (int n = 0; n < count; ++n, terms += 2 * wide) {
    const Recursion step = n + 1 < count ? steps[n] : Recursion{0, 0};
    Lanes e0{}, e1{}, e2{}, o0{}, o1{}, o2{};
    for (size_t i = 0; i < block_size; i += lanes) {
      const Lanes p = load(&now[i]);
      e0 += p * load(&even[0][i]), e1 += p * load(&even[1][i]), e2 += p * load(&even[2][i]);
      o0 += p * load(&odd[0][i]), o1 += p * load(&odd[1][i]), o2 += p * load(&odd[2][i]);
      store((step.up * load(&z[i])) * p - step.drop * load(&before[i]), &now[i]);
      store(p, &before[i]);
    }
    terms[0] += total(e0), terms[1] += total(e1), terms[2] += total(e2);
    terms[3] += total(o0), terms[4] += total(o1), terms[5] += total(o2);
  }
}

/// Coefficients in the order they are used in: functions in groups of `wide`; in a group order by
/// order; in an order m degree by degree the group's coefficients of Y_lm, then of Y_l,−m.
class Terms {
 public:
  Terms(int degree, Eigen::Index functions)
      : degree_(degree),
        functions_(functions),
        numbers_(size_t(groups()) * size_t(harmonics()) * 2 * wide, 0.0) {}

  Terms(int degree, const Functions& coefficients) : Terms(degree, coefficients.cols()) {
    for_each(
        [&](double& term, int row, Eigen::Index function) { term = coefficients(row, function); });
  }

  int groups() const { return static_cast<int>((functions_ + wide - 1) / wide); }
  double* of(int group, int m) { return &numbers_[place(group, m, m)]; }
  const double* of(int group, int m) const { return &numbers_[place(group, m, m)]; }

  void operator+=(const Terms& other) {
    for (size_t i = 0; i < numbers_.size(); ++i) numbers_[i] += other.numbers_[i];
  }

  Functions coefficients() {
    Functions result(harmonic_index(degree_, degree_) + 1, functions_);
    for_each([&](double& term, int row, Eigen::Index function) { result(row, function) = term; });
    return result;
  }

 private:
  int harmonics() const { return (degree_ + 1) * (degree_ + 2) / 2; }  // with m ≥ 0
  size_t place(int group, int l, int m) const {
    const int before = m * (degree_ + 1) - m * (m - 1) / 2;
    return (size_t(group) * size_t(harmonics()) + size_t(before + l - m)) * 2 * wide;
  }

  /// visit(term, row of the coefficient, function); not those that do not exist: Y_l,−0.
  template <class Visit>
  void for_each(const Visit& visit) {
    for (Eigen::Index k = 0; k < functions_; ++k) {
      for (int m = 0; m <= degree_; ++m) {
        for (int l = m; l <= degree_; ++l) {
          double* term = &numbers_[place(int(k / wide), l, m) + size_t(k % wide)];
          visit(term[0], harmonic_index(l, m), k);
          if (m > 0) visit(term[wide], harmonic_index(l, -m), k);
        }
      }
    }
  }

  int degree_;
  Eigen::Index functions_;
  std::vector<double> numbers_;
};

/// Values of a group of functions at the points of a block.
void synthesise_block(const Legendre& legendre, const Terms& terms, int group, Waves& w,
                      Rows& values) {
  Rows even, odd;
  for (Row& v : values) v.fill(0);
  for (int m = 0; m <= legendre.degree(); ++m) {
    add_up(w.z, w.sectoral, legendre.steps(m), legendre.degree() - m + 1, terms.of(group, m), even,
           odd);
    for (size_t k = 0; k < wide; ++k) {
      for (size_t i = 0; i < block_size; ++i) {
        values[k][i] += even[k][i] * w.cosine[i] + odd[k][i] * w.sine[i];
      }
    }
    turn(w, m);
  }
}

/// terms += Σ over the block of values · Y, the values weighted.
void analyse_block(const Legendre& legendre, const Rows& values, int group, Waves& w,
                   Terms& terms) {
  Rows even, odd;
  for (int m = 0; m <= legendre.degree(); ++m) {
    for (size_t k = 0; k < wide; ++k) {
      for (size_t i = 0; i < block_size; ++i) {
        even[k][i] = values[k][i] * w.cosine[i];
        odd[k][i] = values[k][i] * w.sine[i];
      }
    }
    project(w.z, w.sectoral, legendre.steps(m), legendre.degree() - m + 1, even, odd,
            terms.of(group, m));
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

/// Calls visit(place in the group, function) for the functions of a group.
template <class Visit>
void for_each_function(int group, Eigen::Index functions, const Visit& visit) {
  const Eigen::Index first = Eigen::Index(group) * wide;
  for (Eigen::Index k = first; k < std::min(functions, first + wide); ++k) {
    visit(static_cast<size_t>(k - first), k);
  }
}

/// A group's functions at the points of a block, by weight.
Rows rows_of(const Functions& values, const VectorX& weights, int group, std::int64_t first,
             int count) {
  Rows rows{};
  for_each_function(group, values.cols(), [&](size_t row, Eigen::Index k) {
    for (int i = 0; i < count; ++i)
      rows[row][size_t(i)] = weights[first + i] * values(first + i, k);
  });
  return rows;
}

void write_rows(const Rows& rows, int group, std::int64_t first, int count, Functions& values) {
  for_each_function(group, values.cols(), [&](size_t row, Eigen::Index k) {
    for (int i = 0; i < count; ++i) values(first + i, k) = rows[row][size_t(i)];
  });
}

/// Node i of n of Gauss–Legendre quadrature on [−1, 1], from 1 downwards, and its weight.
std::pair<double, double> gauss_legendre(int i, int n) {
  double x = elementary::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
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

}  // namespace

Functions synthesise(const Functions& coefficients, const Points& directions, int threads) {
  const Legendre legendre(degree_of(coefficients.rows()));
  require_unit(directions);
  const Terms terms(legendre.degree(), coefficients);
  Functions values(directions.rows(), coefficients.cols());
  parallel_for(directions.rows(), 8 * block_size, threads,
               [&](std::int64_t begin, std::int64_t end) {
                 Waves waves;
                 Rows rows;
                 for_each_block(begin, end, [&](std::int64_t first, int count) {
                   for (int group = 0; group < terms.groups(); ++group) {
                     load(directions, first, count, waves);
                     synthesise_block(legendre, terms, group, waves, rows);
                     write_rows(rows, group, first, count, values);
                   }
                 });
               });
  return values;
}

Functions analyse(int degree, const Points& directions, const VectorX& weights,
                  const Functions& values, int threads) {
  require_harmonic_degree(degree);
  if (weights.size() != directions.rows() || values.rows() != directions.rows()) {
    throw std::invalid_argument("spherical harmonics: not one weight and one value a direction");
  }
  require_unit(directions);
  const Legendre legendre(degree);
  const std::int64_t blocks = (directions.rows() + block_size - 1) / block_size;
  const std::int64_t chunk = block_size * ((blocks + most_chunks - 1) / most_chunks);
  std::vector<Terms> partial(static_cast<size_t>(most_chunks), Terms(degree, values.cols()));
  parallel_for(directions.rows(), chunk, threads, [&](std::int64_t begin, std::int64_t end) {
    Terms& terms = partial[static_cast<size_t>(begin / chunk)];
    Waves waves;
    for_each_block(begin, end, [&](std::int64_t first, int count) {
      for (int group = 0; group < terms.groups(); ++group) {
        const Rows rows = rows_of(values, weights, group, first, count);
        load(directions, first, count, waves);
        analyse_block(legendre, rows, group, waves, terms);
      }
    });
  });
  for (size_t i = 1; i < partial.size(); ++i) partial[0] += partial[i];
  return partial[0].coefficients();
}

QuadratureGrid quadrature_grid(int degree) {
  require_harmonic_degree(degree);
  const int rows = degree + 1, columns = 2 * degree + 2;
  QuadratureGrid grid{Points(Eigen::Index(rows) * columns, 3),
                      VectorX(Eigen::Index(rows) * columns)};
  for (int i = 0; i < rows; ++i) {
    const auto [z, weight] = gauss_legendre(i, rows);
    const double radius = std::sqrt((1 - z) * (1 + z));
    for (int j = 0; j < columns; ++j) {
      const double theta = 2 * std::numbers::pi * j / columns;
      grid.directions.row(Eigen::Index(i) * columns + j) << radius * elementary::cos(theta),
          radius * elementary::sin(theta), z;
      grid.weights[Eigen::Index(i) * columns + j] = weight * 2 * std::numbers::pi / columns;
    }
  }
  return grid;
}

Functions turn_harmonics(const Functions& coefficients, const Eigen::Matrix3d& rotation,
                         int threads) {
  const int degree = degree_of(coefficients.rows());
  const QuadratureGrid grid = quadrature_grid(degree);
  const Points turned_back = (grid.directions * rotation).rowwise().normalized();  // rows: (Rᵀu)ᵀ
  return analyse(degree, grid.directions, grid.weights,
                 synthesise(coefficients, turned_back, threads), threads);
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
  if (degree_of(coefficients.rows()) < 1 || coefficients.cols() != 3)
    throw std::invalid_argument("first_order_ellipsoid: degree 1 of three functions is needed");
  const Eigen::Matrix3d axes =
      coefficients.middleRows(1, 3) * std::sqrt(3 / (4 * std::numbers::pi));
  return axes.jacobiSvd().singularValues();
}

}  // namespace sphparam
