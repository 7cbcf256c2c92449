// OpenSubdiv's Bfr evaluates anywhere, but asks its tables each time. A regular patch is a
// polynomial Σ cᵢⱼ sⁱ tʲ, linear in its 12 or 16 control points: the matrix from these to the c is
// found once, from Bfr's own weights at as many places as there are monomials. Patches next to a
// vertex of unusual valence stay with Bfr.
//
//   normal  n = Xₛ × Xₜ / |Xₛ × Xₜ|
//   E = Xₛ·Xₛ, F = Xₛ·Xₜ, G = Xₜ·Xₜ;  L = −n·Xₛₛ, M = −n·Xₛₜ, N = −n·Xₜₜ  (n points outwards)
//   H = (EN − 2FM + GL) / 2(EG − F²),  K = (LN − M²) / (EG − F²)

#include <opensubdiv/bfr/parameterization.h>

#include <array>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lanes.h"
#include "remesh/subdivision/limit_polynomial.h"
#include "remesh/subdivision/limit_tables.h"
#include "sphparam/remesh/limit_surface.h"

namespace sphparam {

namespace {

namespace Bfr = OpenSubdiv::Bfr;
using PointDescriptor = BfrSurface::PointDescriptor;

constexpr double sign_step = 1e-7;  // in parameters, to see which way derivatives change

/// Powers of s and t of each monomial.
std::vector<std::array<int, 2>> monomials(Scheme scheme) {
  std::vector<std::array<int, 2>> powers;
  for (int i = 0; i <= (scheme == Scheme::Loop ? 4 : 3); ++i) {
    for (int j = 0; j <= (scheme == Scheme::Loop ? 4 - i : 3); ++j) powers.push_back({i, j});
  }
  return powers;
}

/// xⁿ; 0 for n < 0: what differentiation leaves of constants.
double power(double x, int n) {
  double result = n < 0 ? 0 : 1;
  for (int i = 0; i < n; ++i) result *= x;
  return result;
}

using ToCoefficients = Eigen::MatrixXd;

/// From the control points of a regular patch to its polynomial's coefficients.
ToCoefficients to_coefficients(const BfrSurface& surface, Scheme scheme) {
  const auto powers = monomials(scheme);
  const auto count = static_cast<Eigen::Index>(powers.size());
  const double last = scheme == Scheme::Loop ? 4 : 3;
  Eigen::MatrixXd values(count, count), weights(count, surface.GetNumControlPoints());
  std::vector<double> row(static_cast<size_t>(surface.GetNumControlPoints()));
  for (Eigen::Index k = 0; k < count; ++k) {
    const double s = powers[static_cast<size_t>(k)][0] / last,
                 t = powers[static_cast<size_t>(k)][1] / last;
    for (Eigen::Index m = 0; m < count; ++m) {
      const auto [i, j] = powers[static_cast<size_t>(m)];
      values(k, m) = power(s, i) * power(t, j);
    }
    const double place[2] = {s, t};
    surface.EvaluateStencil(place, row.data());
    weights.row(k) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), std::ssize(row));
  }
  return values.partialPivLu().solve(weights);
}

template <Scheme scheme>
LimitPoint point_of_polynomial(const LimitPatch::Coefficients& c, double s, double t) {
  LimitPoint point;
  for (int k = 0; k < 3; ++k) {
    const auto of = evaluate_polynomial<scheme>(c.data() + k, s, t);
    point.position[k] = of.value, point.by_s[k] = of.by_s, point.by_t[k] = of.by_t;
  }
  return point;
}

template <Scheme scheme>
void points_of_polynomial(const LimitPatch::Coefficients& c, const LimitPoints::Numbers& s,
                          const LimitPoints::Numbers& t, LimitPoints& points) {
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    for (size_t i = 0; i < LimitPoints::count; i += W) {
      const auto of = evaluate_polynomials<scheme>(c, load<W>(&s[i]), load<W>(&t[i]));
      store(of.position, points.position, i);
      store(of.by_s, points.by_s, i);
      store(of.by_t, points.by_t, i);
    }
  });
}

struct SecondDerivatives {
  Vector3 ss = Vector3::Zero(), st = Vector3::Zero(), tt = Vector3::Zero();
};

SecondDerivatives second_derivatives(const LimitPatch::Coefficients& c, Scheme scheme, double s,
                                     double t) {
  static const auto of_loop = monomials(Scheme::Loop), of_catmull = monomials(Scheme::CatmullClark);
  const auto& powers = scheme == Scheme::Loop ? of_loop : of_catmull;
  SecondDerivatives d;
  for (size_t m = 0; m < powers.size(); ++m) {
    const auto [i, j] = powers[m];
    const Vector3 coefficient = c.row(static_cast<Eigen::Index>(m));
    d.ss += i * (i - 1) * power(s, i - 2) * power(t, j) * coefficient;
    d.st += i * j * power(s, i - 1) * power(t, j - 1) * coefficient;
    d.tt += j * (j - 1) * power(s, i) * power(t, j - 2) * coefficient;
  }
  return d;
}

LimitCurvature curvature_of(const LimitPoint& point, const SecondDerivatives& d) {
  const Vector3 n = point.normal();
  const double e = point.by_s.squaredNorm(), f = point.by_s.dot(point.by_t),
               g = point.by_t.squaredNorm(), area = e * g - f * f;
  if (!(area > 0)) return {};
  const double l = -n.dot(d.ss), m = -n.dot(d.st), k = -n.dot(d.tt);
  return {(e * k - 2 * f * m + g * l) / (2 * area), (l * k - m * m) / area};
}

}  // namespace

Vector3 LimitPoint::normal() const {
  const Vector3 cross = by_s.cross(by_t);
  const double length = cross.norm();
  return length > 0 ? Vector3(cross / length) : Vector3::Zero();
}

LimitPoint LimitPoints::operator[](size_t i) const {
  const auto at = [i](const std::array<Numbers, 3>& of) {
    return Vector3(of[0][i], of[1][i], of[2][i]);
  };
  return {at(position), at(by_s), at(by_t)};
}

struct LimitPatch::Irregular {
  BfrSurface surface;
  Points points;
  int sub_face = -1;  // of a triangle among quads

  PointDescriptor descriptor() const { return {3}; }
  Bfr::Parameterization parameters() const { return surface.GetParameterization(); }

  /// The face's own parameters, which turn in its sub-faces; halves of them are whole sub-faces.
  std::array<double, 2> place(double s, double t) const {
    if (sub_face < 0) return {s, t};
    const double at[2] = {s, t};
    std::array<double, 2> result{};
    parameters().ConvertNormalizedSubFaceToCoord(sub_face, at, result.data());
    return result;
  }
  double scale() const { return sub_face < 0 ? 1 : 0.5; }

  void prepare(const Points& control) {
    points.resize(surface.GetNumPatchPoints(), 3);
    surface.PreparePatchPoints(control.data(), descriptor(), points.data(), descriptor());
  }

  /// With derivatives by the face's own parameters.
  LimitPoint evaluate(double s, double t) const {
    LimitPoint point;
    surface.Evaluate(place(s, t).data(), points.data(), descriptor(), point.position.data(),
                     point.by_s.data(), point.by_t.data());
    return point;
  }
  SecondDerivatives second(double s, double t) const {
    LimitPoint point;
    SecondDerivatives d;
    surface.Evaluate(place(s, t).data(), points.data(), descriptor(), point.position.data(),
                     point.by_s.data(), point.by_t.data(), d.ss.data(), d.st.data(), d.tt.data());
    return d;
  }
};

LimitPatch::LimitPatch(const LimitTopology& topology, const Points& control, int patch)
    : patch_(patch), topology_(&topology) {
  if (patch < 0 || patch >= topology.patch_count()) {
    throw std::invalid_argument("LimitPatch: patch " + std::to_string(patch) + " of " +
                                std::to_string(topology.patch_count()));
  }
  const LimitTopology::Tables& tables = *topology.tables_;
  const int face = topology.face_of(patch);
  BfrSurface surface;
  if (!tables.factory->InitVertexSurface(face, &surface)) {
    throw std::invalid_argument("no limit surface about face " + std::to_string(face));
  }
  if (surface.IsRegular()) {
    std::call_once(tables.read,
                   [&] { tables.to_coefficients = to_coefficients(surface, tables.scheme); });
    surface.GetControlPointIndices(control_points_.data());
    read_polynomial(control);
    return;
  }
  const bool divided = surface.GetParameterization().HasSubFaces();
  irregular_ = std::make_unique<Irregular>();
  irregular_->surface = std::move(surface);
  irregular_->prepare(control);
  if (divided) irregular_->sub_face = patch - topology.first_patch(face);
}

LimitPatch::LimitPatch(const LimitPatch& other, const Points& control)
    : patch_(other.patch_), topology_(other.topology_), control_points_(other.control_points_) {
  if (other.is_polynomial()) {
    read_polynomial(control);
    return;
  }
  irregular_ = std::make_unique<Irregular>();
  irregular_->surface = other.irregular_->surface;
  irregular_->sub_face = other.irregular_->sub_face;
  irregular_->prepare(control);
}

void LimitPatch::read_polynomial(const Points& control) {
  const ToCoefficients& to_coefficients = topology_->tables_->to_coefficients;
  coefficients_.setZero();
  for (Eigen::Index i = 0; i < to_coefficients.cols(); ++i) {
    const Eigen::RowVector3d point = control.row(control_points_[static_cast<size_t>(i)]);
    for (Eigen::Index m = 0; m < to_coefficients.rows(); ++m)
      coefficients_.row(m) += to_coefficients(m, i) * point;
  }
}

LimitPatch::~LimitPatch() = default;
LimitPatch::LimitPatch(LimitPatch&&) noexcept = default;
LimitPatch& LimitPatch::operator=(LimitPatch&&) noexcept = default;

LimitPoint LimitPatch::evaluate(double s, double t) const {
  if (!irregular_) {
    return topology_->scheme() == Scheme::Loop
               ? point_of_polynomial<Scheme::Loop>(coefficients_, s, t)
               : point_of_polynomial<Scheme::CatmullClark>(coefficients_, s, t);
  }
  LimitPoint point = irregular_->evaluate(s, t);
  point.by_s *= irregular_->scale();
  point.by_t *= irregular_->scale();
  return point;
}

void LimitPatch::evaluate(const LimitPoints::Numbers& s, const LimitPoints::Numbers& t,
                          size_t count, LimitPoints& points) const {
  if (!irregular_) {
    return topology_->scheme() == Scheme::Loop
               ? points_of_polynomial<Scheme::Loop>(coefficients_, s, t, points)
               : points_of_polynomial<Scheme::CatmullClark>(coefficients_, s, t, points);
  }
  for (size_t i = 0; i < count; ++i) {
    const LimitPoint point = evaluate(s[i], t[i]);
    for (size_t k = 0; k < 3; ++k) {
      const auto at = static_cast<int>(k);
      points.position[k][i] = point.position[at];
      points.by_s[k][i] = point.by_s[at], points.by_t[k][i] = point.by_t[at];
    }
  }
}

LimitCurvature LimitPatch::curvature(double s, double t) const {
  if (!irregular_)
    return curvature_of(evaluate(s, t),
                        second_derivatives(coefficients_, topology_->scheme(), s, t));
  // Curvature is the surface's: any parameters of it will do.
  const LimitPoint point = irregular_->evaluate(s, t);
  SecondDerivatives d = irregular_->second(s, t);
  // OpenSubdiv 3.5 turns the signs of these in sub-triangles that lie the other way round.
  const double step = s < 0.5 ? sign_step : -sign_step;
  const LimitPoint beside = irregular_->evaluate(s + step, t);
  const double agreement =
      (beside.by_s - point.by_s).dot(d.ss) + (beside.by_t - point.by_t).dot(d.st);
  if (agreement / step < 0) d = {-d.ss, -d.st, -d.tt};
  return curvature_of(point, d);
}

}  // namespace sphparam
