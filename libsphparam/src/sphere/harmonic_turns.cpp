#include "sphere/harmonic_turns.h"

#include <numbers>

#include "elementary.h"

namespace sphparam {
namespace {

/// z to y, y to −z.
Eigen::Matrix3d tilt_about_x() {
  Eigen::Matrix3d tilt;
  tilt << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return tilt;
}

/// Row of order m among those of its degree.
Eigen::Index row_of(int l, int m) { return l + m; }

/// Rows of one degree, turned about z.
void turn_about_z(Eigen::Ref<Eigen::MatrixXd> rows, int l, double angle) {
  for (int m = 1; m <= l; ++m) {
    const double c = elementary::cos(m * angle), s = elementary::sin(m * angle);
    const Eigen::RowVectorXd cosine = rows.row(row_of(l, m)), sine = rows.row(row_of(l, -m));
    rows.row(row_of(l, m)) = c * cosine - s * sine;
    rows.row(row_of(l, -m)) = s * cosine + c * sine;
  }
}

Functions generator_about_z(const Functions& c, int degree) {
  Functions result = Functions::Zero(c.rows(), c.cols());
  for (int l = 1; l <= degree; ++l) {
    for (int m = 1; m <= l; ++m) {
      result.row(harmonic_index(l, m)) = -m * c.row(harmonic_index(l, -m));
      result.row(harmonic_index(l, -m)) = m * c.row(harmonic_index(l, m));
    }
  }
  return result;
}

/// By a right angle.
Functions quarter_about_z(Functions c, int degree, double sign) {
  for (int l = 1; l <= degree; ++l) {
    Eigen::MatrixXd rows = c.middleRows(harmonic_index(l, -l), 2 * l + 1);
    turn_about_z(rows, l, sign * std::numbers::pi / 2);
    c.middleRows(harmonic_index(l, -l), 2 * l + 1) = rows;
  }
  return c;
}

}  // namespace

HarmonicTurns::HarmonicTurns(int degree) {
  const Eigen::Index count = Eigen::Index(degree + 1) * (degree + 1);
  const Functions all = turn_harmonics(Functions::Identity(count, count), tilt_about_x(), 1);
  for (int l = 0; l <= degree; ++l) {
    const Eigen::Index first = harmonic_index(l, -l);
    tilts_.push_back(all.block(first, first, 2 * l + 1, 2 * l + 1));
  }
}

Eigen::MatrixXd HarmonicTurns::about_y(int l, double angle) const {
  Eigen::MatrixXd rows = tilt(l).transpose();
  turn_about_z(rows, l, angle);
  return tilt(l) * rows;
}

Functions HarmonicTurns::tilted(Functions c, Way way) const {
  for (int l = 1; l <= degree(); ++l) {
    auto rows = c.middleRows(harmonic_index(l, -l), 2 * l + 1);
    const Eigen::MatrixXd before = rows;
    if (way == Way::Back)
      rows = tilt(l).transpose() * before;
    else
      rows = tilt(l) * before;
  }
  return c;
}

// About y: tilt · z · tilt⁻¹. About x, to which a right angle about y takes z: the same between
// turns by that angle, which are tilt · (a right angle about z) · tilt⁻¹.
Functions HarmonicTurns::generator(int axis, const Functions& coefficients) const {
  if (axis == 2) return generator_about_z(coefficients, degree());
  Functions c = tilted(coefficients, Way::Back);
  if (axis == 0) c = tilted(quarter_about_z(std::move(c), degree(), -1), Way::There);
  if (axis == 1) return tilted(generator_about_z(c, degree()), Way::There);
  c = generator_about_z(c, degree());
  return tilted(quarter_about_z(tilted(std::move(c), Way::Back), degree(), 1), Way::There);
}

}  // namespace sphparam
