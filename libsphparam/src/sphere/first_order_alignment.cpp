#include "sphparam/sphere/first_order_alignment.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "elementary.h"
#include "number_text.h"

// The first order is a matrix A: x = A u + centre. Its singular vectors are the axes, on the sphere
// and on the surface. The half turn about axis k of both keeps the first order as it is, and
// changes signs of the other coefficients only: (−1)^m about z, with another for sin mθ and (−1)^l
// about x and y.

namespace sphparam {
namespace {

constexpr double clear_skewness = 0.01;
constexpr double equal_axes = 0.01;    // of the longer one
constexpr double equal_shapes = 1e-3;  // distance of coefficients, of their size
constexpr double as_near = 0.1;        // the template tells half turns apart that are not so near
constexpr double crooked_axes = 1e-3;  // cosine of the angle between axes of aligned coefficients
constexpr int identity = 3;            // a half turn about axis 0, 1, 2, or none

using Matrix3 = Eigen::Matrix3d;

Functions positions_of(const Functions& coefficients) {
  if (coefficients.rows() < 4 || coefficients.cols() < 3)
    throw std::invalid_argument("first-order alignment: x, y, z of degree 1 at least are needed");
  return coefficients.leftCols(3);
}

/// Columns: what the first order makes of the directions x, y, z.
Matrix3 first_order(const Functions& c) {
  Matrix3 axes;
  axes << c.row(harmonic_index(1, 1)).transpose(), c.row(harmonic_index(1, -1)).transpose(),
      c.row(harmonic_index(1, 0)).transpose();
  return axes * std::sqrt(3 / (4 * std::numbers::pi));
}

FirstOrderAlignment along_axes(const Functions& c) {
  const Eigen::JacobiSVD<Matrix3> svd(first_order(c), Eigen::ComputeFullU | Eigen::ComputeFullV);
  FirstOrderAlignment result;
  result.semi_axes = svd.singularValues();
  result.centre = c.row(0).transpose() / std::sqrt(4 * std::numbers::pi);
  result.sphere = svd.matrixV().transpose();
  result.object = svd.matrixU().transpose();
  const double turned = result.sphere.determinant() < 0 ? -1 : 1;
  result.reversed = result.object.determinant() * turned < 0;
  result.sphere.row(2) *= turned;
  result.object.row(2) *= result.reversed ? -turned : turned;
  result.object.topRows<2>() *= -1;
  return result;
}

Vector3 half_turn(int axis) {
  Vector3 signs = Vector3::Constant(axis == identity ? 1 : -1);
  if (axis != identity) signs[axis] = 1;
  return signs;
}

/// What the half turn of the sphere about an axis makes of the coefficient of Y_lm.
double parity(int l, int m, int axis) {
  if (axis == identity) return 1;
  const int order = std::abs(m);
  const int about_z = order, about_x = l + order + (m < 0 ? 1 : 0);
  const int odd = axis == 2 ? about_z : axis == 0 ? about_x : about_x + about_z;
  return odd % 2 == 0 ? 1 : -1;
}

/// One half turn after another.
int composed(int a, int b) {
  if (a == b) return identity;
  return a == identity ? b : b == identity ? a : 3 - a - b;
}

/// The half turn of sphere and surface about an axis.
Functions flipped(Functions c, int axis) {
  const Vector3 signs = half_turn(axis);
  for (int l = 0, row = 0; row < c.rows(); ++l)
    for (int m = -l; m <= l; ++m, ++row)
      c.row(row) = parity(l, m, axis) * c.row(row).cwiseProduct(signs.transpose());
  return c;
}

/// The cube root of the volume of a box, which itself may be no number; 0 of a flat one.
double mean_length(const Vector3& sides) {
  const double longest = sides.maxCoeff();
  return longest > 0 ? longest * elementary::pow((sides / longest).prod(), 1.0 / 3) : 0;
}

double distance(const Functions& a, const Functions& b) {
  const Eigen::Index rows = std::min(a.rows(), b.rows()) - 1;
  return (a.middleRows(1, rows) - b.middleRows(1, rows)).norm();
}

/// ∫x³ / (∫x²)^{3/2} · √4π of each coordinate; a grid of 3/2 the degree integrates it exactly. Of
/// coordinates divided by √∫x², whose cubes are numbers at any size of the surface.
Vector3 skewness_of(Functions c, int threads) {
  const int degree = static_cast<int>(std::lround(std::sqrt(double(c.rows())))) - 1;
  const QuadratureGrid grid =
      quadrature_grid(std::min(greatest_harmonic_degree, (3 * degree + 1) / 2));
  for (int k = 0; k < 3; ++k) {
    const double size = c.col(k).stableNorm();
    if (size > 0) c.col(k) /= size;
  }
  const Functions x = synthesise(c, grid.directions, threads);
  return x.array().cube().matrix().transpose() * grid.weights * std::sqrt(4 * std::numbers::pi);
}

/// Axes by |skewness|, the greatest first.
std::array<int, 3> by_skewness(const Vector3& skewness) {
  std::array<int, 3> order{0, 1, 2};
  std::ranges::stable_sort(
      order, [&](int a, int b) { return std::abs(skewness[a]) > std::abs(skewness[b]); });
  return order;
}

/// The half turn that makes the two greatest positive.
int flip_by_skewness(const Vector3& skewness) {
  const auto [first, second, third] = by_skewness(skewness);
  const bool keep_first = skewness[first] >= 0, keep_second = skewness[second] >= 0;
  if (keep_first) return keep_second ? identity : first;
  return keep_second ? second : third;
}

/// How much the half turns change that skewness does not tell from none.
double undecided_by_skewness(const Functions& c, const Vector3& skewness) {
  const auto [first, second, third] = by_skewness(skewness);
  if (std::abs(skewness[second]) >= clear_skewness) return 0;
  double most = distance(c, flipped(c, first));
  if (std::abs(skewness[first]) < clear_skewness)
    most = std::max({most, distance(c, flipped(c, second)), distance(c, flipped(c, third))});
  return most / c.bottomRows(c.rows() - 1).norm();
}

/// Turned onto its axes as they are, and scaled to an ellipsoid of a fixed volume.
Functions normalised(const Functions& c) {
  const Matrix3 axes = first_order(c);
  const Vector3 lengths = axes.colwise().norm();
  if (lengths.minCoeff() <= 0)
    throw std::invalid_argument(
        "the coefficients whose flips are to be taken have a flat ellipsoid");
  Matrix3 unit = axes * lengths.cwiseInverse().asDiagonal();
  if ((unit.transpose() * unit - Matrix3::Identity()).cwiseAbs().maxCoeff() > crooked_axes)
    throw std::invalid_argument(
        "the coefficients whose flips are to be taken are not aligned: their sphere does not lie "
        "along the axes of their first-order ellipsoid");
  unit.leftCols<2>() *= -1;
  return c * unit / mean_length(lengths);
}

struct HalfTurn {
  int axis = identity;
  double undecided = 0, confidence = 1;
  bool by_skewness = true;
};

/// That of the template which its own skewness would take; none where that is not clear.
int own_half_turn(const Functions& wanted, int threads) {
  const Vector3 skewness = skewness_of(wanted, threads);
  const bool clear = std::abs(skewness[by_skewness(skewness)[1]]) >= clear_skewness;
  return clear ? flip_by_skewness(skewness) : identity;
}

Functions scaled(const Functions& c) {
  const Vector3 lengths = first_order(c).colwise().norm();
  const double mean = mean_length(lengths);
  return c / (mean > 0 ? mean : std::max(lengths.maxCoeff(), 1e-300));
}

/// How far from the template each half turn is, none the last.
std::array<double, 4> distances_after_half_turns(const Functions& c, const Functions& wanted) {
  std::array<double, 4> away{};
  const Functions lying = scaled(c);
  for (int axis = 0; axis <= identity; ++axis)
    away[size_t(axis)] = distance(flipped(lying, axis), wanted);
  return away;
}

int nearest(const std::array<double, 4>& away) {
  int best = identity;
  for (int axis = 2; axis >= 0; --axis)
    if (away[size_t(axis)] < away[size_t(best)]) best = axis;
  return best;
}

/// The nearest to the template, and how much nearer it is than others that make a difference.
HalfTurn nearest_half_turn(const Functions& c, const std::array<double, 4>& away) {
  HalfTurn result{.axis = nearest(away), .by_skewness = false};
  const double least = away[size_t(result.axis)], size = c.bottomRows(c.rows() - 1).norm();
  double next = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis <= identity; ++axis) {
    const double change = distance(c, flipped(c, composed(axis, result.axis))) / size;
    if (!(change > equal_shapes)) continue;
    next = std::min(next, away[size_t(axis)]);
    if (least > (1 - as_near) * away[size_t(axis)])
      result.undecided = std::max(result.undecided, change);
  }
  if (next > 0) result.confidence = 1 - least / next;
  return result;
}

/// Nearest to the template; where others are as good as near, by skewness, so that surfaces which
/// the template does not tell apart lie alike at least.
HalfTurn half_turn_by_template(const Functions& c, const Vector3& skewness, const Functions& flips,
                               int threads) {
  const Functions wanted = normalised(positions_of(flips));
  const std::array<double, 4> away = distances_after_half_turns(c, wanted);
  HalfTurn result = nearest_half_turn(c, away);
  if (result.undecided == 0) return result;
  const double open = undecided_by_skewness(c, skewness);
  const int own = composed(flip_by_skewness(skewness), own_half_turn(wanted, threads));
  const bool is_near = away[size_t(result.axis)] > (1 - as_near) * away[size_t(own)];
  if (open > equal_shapes || !is_near) return result;
  return {own, open, result.confidence, true};
}

HalfTurn half_turn_by_skewness(const Functions& c, const Vector3& skewness) {
  return {.axis = flip_by_skewness(skewness), .undecided = undecided_by_skewness(c, skewness)};
}

std::string skewness_text(const FirstOrderAlignment& alignment) {
  const Vector3& skewness = alignment.skewness;
  return short_number(skewness[0]) + ", " + short_number(skewness[1]) + ", " +
         short_number(skewness[2]);
}

std::string open_signs(const FirstOrderAlignment& alignment) {
  return "the signs of the axes are hardly decided: skewness along them is " +
         skewness_text(alignment) + ", and coefficients of other signs are far from these (" +
         percent(alignment.undecided) + " of their size)";
}

std::string doubt_of_template(const FirstOrderAlignment& alignment) {
  const std::string told = "the template hardly tells half turns apart: the nearest is " +
                           percent(alignment.confidence) + " nearer than another; ";
  return told + (alignment.by_skewness
                     ? "skewness along the axes decides: " + skewness_text(alignment)
                     : open_signs(alignment));
}

}  // namespace

FirstOrderAlignment first_order_alignment(const Functions& coefficients, const Functions* flips,
                                          int threads) {
  const Functions positions = positions_of(coefficients);
  FirstOrderAlignment result = along_axes(positions);
  const Functions lying = aligned(positions, result, true, threads);
  const Vector3 skewness = skewness_of(lying, threads);
  const HalfTurn taken = flips ? half_turn_by_template(lying, skewness, *flips, threads)
                               : half_turn_by_skewness(lying, skewness);
  const Vector3 signs = half_turn(taken.axis);
  result.sphere = signs.asDiagonal() * result.sphere;
  result.object = signs.asDiagonal() * result.object;
  result.skewness = signs.cwiseProduct(skewness);
  result.undecided = taken.undecided;
  result.confidence = taken.confidence;
  result.by_skewness = taken.by_skewness;
  return result;
}

Functions aligned(const Functions& coefficients, const FirstOrderAlignment& alignment, bool object,
                  int threads) {
  Functions result = turn_harmonics(coefficients, alignment.sphere, threads);
  if (!object) return result;
  result.row(0).head<3>() -= alignment.centre.transpose() * std::sqrt(4 * std::numbers::pi);
  const Functions turned = result.leftCols(3) * alignment.object.transpose();
  result.leftCols(3) = turned;
  return result;
}

std::vector<std::string> doubts_about(const FirstOrderAlignment& alignment) {
  std::vector<std::string> doubts;
  const Vector3& axes = alignment.semi_axes;
  if (axes[0] - axes[1] < equal_axes * axes[0] || axes[1] - axes[2] < equal_axes * axes[1])
    doubts.push_back("two semi-axes of the first-order ellipsoid are as good as equal (" +
                     short_number(axes[0], 6) + ", " + short_number(axes[1], 6) + ", " +
                     short_number(axes[2], 6) +
                     "): where the axes lie is hardly decided, and another such surface may have "
                     "them elsewhere");
  if (alignment.confidence < as_near)
    doubts.push_back(doubt_of_template(alignment));
  else if (alignment.undecided > equal_shapes)
    doubts.push_back(open_signs(alignment));
  if (alignment.reversed)
    doubts.push_back(
        "the first-order ellipsoid is inside out: no turn of sphere and surface makes its three "
        "axes positive, so the shortest one is negative");
  return doubts;
}

}  // namespace sphparam
