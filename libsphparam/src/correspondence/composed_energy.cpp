#include "correspondence/composed_energy.h"

#include <cmath>
#include <limits>

// Of a triangle in space, d = (|x|² + |y|²)/2 and s = |x × y| = √q, q = |x|²|y|² − (x·y)²:
//   ∇s = ((|y|²x − (x·y)y), (|x|²y − (x·y)x)) / s
//   s∇²s = ½∇²q − ∇s∇sᵀ;  ½∇²q: xx |y|² − yyᵀ, yy |x|² − xxᵀ, xy 2xyᵀ − yxᵀ − (x·y)
// On the sphere, s = det(p0, p1, p2)/2A; 2A i_b i_h = 1. x and y are linear in the corners, and
// these in the ways: (x, y) = M u. Second derivatives of the corners in the ways are left out.

namespace sphparam {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Ways = Eigen::Matrix<double, 3, 2>;

struct Measures {
  double d, s;
  Vector6 of_d, of_s;
  Matrix6 second_of_d, second_of_s;
};

ImageTriangle positions(const Places3& places) {
  return {places[0]->position, places[1]->position, places[2]->position};
}

ImageTriangle directions(const Places3& places) {
  return {places[0]->direction, places[1]->direction, places[2]->direction};
}

double area_on_sphere(const RestTriangle& rest, const ImageTriangle& p) {
  return p[0].dot((p[1] - p[0]).cross(p[2] - p[0])) * rest.inverse_base * rest.inverse_height;
}

/// (x, y) of the Jacobian as a linear function of the ways, where corners change like this.
Matrix6 to_jacobian(const RestTriangle& rest, const std::array<Ways, 3>& changes) {
  const std::array<double, 3> of_x{-rest.inverse_base, rest.inverse_base, 0};
  const std::array<double, 3> of_y{rest.inverse_height * (rest.foot - 1),
                                   -rest.inverse_height * rest.foot, rest.inverse_height};
  Matrix6 m;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<size_t>(k);
    m.block<3, 2>(0, 2 * k) = of_x[i] * changes[i];
    m.block<3, 2>(3, 2 * k) = of_y[i] * changes[i];
  }
  return m;
}

/// d and s of the triangle in space, in the ways.
Measures in_space(const RestTriangle& rest, const Places3& places) {
  const auto [x, y] = jacobian(rest, positions(places));
  std::array<Ways, 3> changes;
  for (size_t k = 0; k < 3; ++k) changes[k] << places[k]->frame.of_u, places[k]->frame.of_v;
  const Matrix6 m = to_jacobian(rest, changes);
  const double xx = x.squaredNorm(), yy = y.squaredNorm(), xy = x.dot(y);
  const double s = std::max(x.cross(y).norm(), std::numeric_limits<double>::min());
  Vector6 j, of_s;
  j << x, y;
  of_s << (yy * x - xy * y) / s, (xx * y - xy * x) / s;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  Matrix6 second;
  second.topLeftCorner<3, 3>() = yy * identity - y * y.transpose();
  second.bottomRightCorner<3, 3>() = xx * identity - x * x.transpose();
  second.topRightCorner<3, 3>() = 2 * x * y.transpose() - y * x.transpose() - xy * identity;
  second.bottomLeftCorner<3, 3>() = second.topRightCorner<3, 3>().transpose();
  second -= of_s * of_s.transpose();
  second /= s;
  return {(xx + yy) / 2,     s,
          m.transpose() * j, m.transpose() * of_s,
          m.transpose() * m, m.transpose() * second * m};
}

/// d and s of the triangle on the sphere, in the ways.
Measures on_sphere(const RestTriangle& rest, const Places3& places) {
  const ImageTriangle p = directions(places);
  const auto [x, y] = jacobian(rest, p);
  std::array<Ways, 3> changes;
  for (size_t k = 0; k < 3; ++k) changes[k] << places[k]->frame.turn_u, places[k]->frame.turn_v;
  const Matrix6 m = to_jacobian(rest, changes);
  const double scale = rest.inverse_base * rest.inverse_height;
  Measures result;
  Vector6 j;
  j << x, y;
  result.d = j.squaredNorm() / 2;
  result.s = area_on_sphere(rest, p);
  result.of_d = m.transpose() * j;
  result.second_of_d = m.transpose() * m;
  result.second_of_s.setZero();
  for (size_t k = 0; k < 3; ++k) {
    const size_t l = (k + 1) % 3, n = (k + 2) % 3;
    const auto row = static_cast<Eigen::Index>(2 * k), column = static_cast<Eigen::Index>(2 * l);
    result.of_s.segment<2>(row) = scale * changes[k].transpose() * p[l].cross(p[n]);
    for (Eigen::Index i = 0; i < 2; ++i) {
      for (Eigen::Index c = 0; c < 2; ++c) {
        const double mixed =
            scale * Vector3(changes[k].col(i)).cross(Vector3(changes[l].col(c))).dot(p[n]);
        result.second_of_s(row + i, column + c) = result.second_of_s(column + c, row + i) = mixed;
      }
    }
  }
  return result;
}

void add(ComposedTerms& terms, const EnergyDerivatives& f, const Measures& m, double weight) {
  terms.value += weight * f.f;
  terms.gradient += weight * (f.f_d * m.of_d + f.f_s * m.of_s);
  terms.hessian += weight * (f.f_d * m.second_of_d + f.f_s * m.second_of_s +
                             f.f_ds * (m.of_d * m.of_s.transpose() + m.of_s * m.of_d.transpose()) +
                             f.f_ss * m.of_s * m.of_s.transpose());
}

/// f(d + χ − s, s), with χ − s > 0 where ε > 0: see docs/mathematics.md.
EnergyDerivatives regularised(const DistortionEnergy& energy, double d, double s) {
  const double e2 = energy.epsilon * energy.epsilon, root = std::sqrt(s * s + e2);
  if (e2 == 0) return differentiate(energy, d, s);
  const double lift = e2 / (2 * (s + root)), lift_s = -lift / root;
  const double lift_ss = e2 / (2 * root * root * root);
  EnergyDerivatives f = differentiate(energy, d + lift, s);
  f.f_ss += 2 * f.f_ds * lift_s + f.f_d * lift_ss;
  f.f_s += f.f_d * lift_s;
  return f;
}

/// d/s
constexpr DistortionEnergy mips{.kind = EnergyKind::AngleAndArea, .lambda = 0};

}  // namespace

Jacobian jacobian(const RestTriangle& rest, const ImageTriangle& image) {
  const Vector3 a = image[1] - image[0], b = image[2] - image[0];
  return {rest.inverse_base * a, rest.inverse_height * (b - rest.foot * a)};
}

double composed_energy(const ComposedEnergy& energy, const RestTriangle& rest,
                       const Places3& places) {
  const auto squares = [](const Jacobian& j) {
    return (j.x.squaredNorm() + j.y.squaredNorm()) / 2;
  };
  const Jacobian j = jacobian(rest, positions(places));
  double density = regularised(energy.energy, squares(j), j.x.cross(j.y).norm()).f;
  if (energy.barrier > 0) {
    const ImageTriangle p = directions(places);
    density +=
        energy.barrier * energy_density(mips, squares(jacobian(rest, p)), area_on_sphere(rest, p));
  }
  return std::isfinite(density) ? rest.area * density : std::numeric_limits<double>::infinity();
}

ComposedTerms composed_terms(const ComposedEnergy& energy, const RestTriangle& rest,
                             const Places3& places) {
  ComposedTerms terms{0, Vector6::Zero(), Matrix6::Zero()};
  const Measures space = in_space(rest, places);
  add(terms, regularised(energy.energy, space.d, space.s), space, rest.area);
  if (energy.barrier > 0) {
    const Measures sphere = on_sphere(rest, places);
    add(terms, differentiate(mips, sphere.d, sphere.s), sphere, energy.barrier * rest.area);
  }
  return terms;
}

}  // namespace sphparam
