// OpenSubdiv's Bfr evaluates anywhere, but asks its tables each time. A regular patch is a
// polynomial Σ cᵢⱼ sⁱ tʲ, linear in its 12 or 16 control points: the matrix from these to the c is
// found once, from Bfr's own weights at as many places as there are monomials. Patches next to a
// vertex of unusual valence stay with Bfr.
//
//   normal  n = Xₛ × Xₜ / |Xₛ × Xₜ|
//   E = Xₛ·Xₛ, F = Xₛ·Xₜ, G = Xₜ·Xₜ;  L = −n·Xₛₛ, M = −n·Xₛₜ, N = −n·Xₜₜ  (n points outwards)
//   H = (EN − 2FM + GL) / 2(EG − F²),  K = (LN − M²) / (EG − F²)

#include "sphparam/remesh/limit_surface.h"

#include <opensubdiv/bfr/parameterization.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "remesh/subdivision/limit_tables.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr std::int64_t grain = 2048;
constexpr int isolation_levels = 6;  // about vertices of unusual valence, before Gregory patches
constexpr double sign_step = 1e-7;   // in parameters, to see which way derivatives change
constexpr int most_control_points = 16;  // of a polynomial patch

using PointDescriptor = BfrSurface::PointDescriptor;

std::unique_ptr<Far::TopologyRefiner> make_refiner(const Polygons& faces, int vertex_count,
                                                   Scheme scheme) {
  std::vector<int> degrees(static_cast<size_t>(faces.count()));
  for (size_t f = 0; f < degrees.size(); ++f)
    degrees[f] = faces.degree(static_cast<std::int64_t>(f));
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = vertex_count;
  descriptor.numFaces = static_cast<int>(degrees.size());
  descriptor.numVertsPerFace = degrees.data();
  descriptor.vertIndicesPerFace = faces.corners.data();
  using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const auto type = scheme == Scheme::Loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      RefinerFactory::Create(descriptor, RefinerFactory::Options(type, Sdc::Options())));
  if (!refiner) throw std::invalid_argument("OpenSubdiv refuses these faces");
  return refiner;
}

Bfr::SurfaceFactory::Options factory_options() {
  Bfr::SurfaceFactory::Options options;
  options.SetApproxLevelSmooth(isolation_levels);
  return options;
}

void check(const Polygons& faces, int vertex_count, Scheme scheme) {
  std::vector<int> about(static_cast<size_t>(vertex_count), 0);
  for (const int v : faces.corners) {
    if (v < 0 || v >= vertex_count) {
      throw std::invalid_argument("a face has vertex " + std::to_string(v) + " of " +
                                  std::to_string(vertex_count));
    }
    if (++about[static_cast<size_t>(v)] > LimitTopology::most_faces_about_a_vertex) {
      throw std::invalid_argument(
          "more than " + std::to_string(LimitTopology::most_faces_about_a_vertex) +
          " faces about vertex " + std::to_string(v) + ", which no limit surface is made for");
    }
  }
  const int most = scheme == Scheme::Loop ? 3 : 4;
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const int degree = faces.degree(f);
    if (degree >= 3 && degree <= most) continue;
    throw std::invalid_argument("face " + std::to_string(f) + " has " + std::to_string(degree) +
                                " corners, and " +
                                (scheme == Scheme::Loop ? "Loop's scheme is for triangles"
                                                        : "triangles and quads are expected"));
  }
}

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

/// A polynomial and its derivatives at a point; `row_length(i)` monomials sⁱ tʲ of each i.
template <Scheme scheme>
LimitPoint evaluate_polynomial(const LimitPatch::Coefficients& c, double s, double t) {
  constexpr int rows = scheme == Scheme::Loop ? 5 : 4;
  LimitPoint point;
  int end = scheme == Scheme::Loop ? 15 : 16;
  for (int i = rows - 1; i >= 0; --i) {
    const int length = scheme == Scheme::Loop ? rows - i : rows;
    Vector3 value = c.row(end - 1), by_t = Vector3::Zero();
    for (int j = length - 2; j >= 0; --j) {
      by_t = by_t * t + value;
      value = value * t + c.row(end - length + j).transpose();
    }
    point.by_s = point.by_s * s + point.position;
    point.position = point.position * s + value;
    point.by_t = point.by_t * s + by_t;
    end -= length;
  }
  return point;
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

/// Calls put(i, patch, place) for every place, with the patch made once for those in a row on it.
template <class Put>
void for_each_place(const LimitSurface& surface, std::span<const LimitPlace> places, int threads,
                    const Put& put) {
  parallel_for(std::ssize(places), grain, threads, [&](std::int64_t first, std::int64_t last) {
    std::optional<LimitPatch> patch;
    for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i) {
      if (!patch || patch->index() != places[i].patch) patch = surface.patch(places[i].patch);
      put(i, *patch, places[i]);
    }
  });
}

}  // namespace

LimitTopology::LimitTopology(const Polygons& faces, int vertex_count, Scheme scheme)
    : tables_(std::make_unique<Tables>()) {
  check(faces, vertex_count, scheme);
  tables_->scheme = scheme;
  tables_->vertex_count = vertex_count;
  const int regular = scheme == Scheme::Loop ? 3 : 4;
  tables_->first_patch.push_back(0);
  bool one_each = true;
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const int patches = faces.degree(f) == regular ? 1 : faces.degree(f);
    tables_->first_patch.push_back(tables_->first_patch.back() + patches);
    one_each &= patches == 1;
  }
  if (!one_each) {
    for (int f = 0; f < static_cast<int>(faces.count()); ++f)
      tables_->face_of.resize(static_cast<size_t>(first_patch(f + 1)), f);
  }
  tables_->refiner = make_refiner(faces, vertex_count, scheme);
  tables_->factory = std::make_unique<BfrFactory>(*tables_->refiner, factory_options());
}

LimitTopology::~LimitTopology() = default;
Scheme LimitTopology::scheme() const { return tables_->scheme; }
int LimitTopology::vertex_count() const { return tables_->vertex_count; }
int LimitTopology::patch_count() const { return tables_->first_patch.back(); }
int LimitTopology::first_patch(int face) const {
  return tables_->first_patch[static_cast<size_t>(face)];
}
int LimitTopology::face_of(int patch) const {
  return tables_->face_of.empty() ? patch : tables_->face_of[static_cast<size_t>(patch)];
}

Vector3 LimitPoint::normal() const {
  const Vector3 cross = by_s.cross(by_t);
  const double length = cross.norm();
  return length > 0 ? Vector3(cross / length) : Vector3::Zero();
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
    : patch_(patch), scheme_(topology.scheme()) {
  const LimitTopology::Tables& tables = *topology.tables_;
  const int face = topology.face_of(patch);
  BfrSurface surface;
  if (!tables.factory->InitVertexSurface(face, &surface)) {
    throw std::invalid_argument("no limit surface about face " + std::to_string(face));
  }
  const PointDescriptor descriptor(3);
  if (surface.IsRegular()) {
    std::call_once(tables.read,
                   [&] { tables.to_coefficients = to_coefficients(surface, scheme_); });
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor, most_control_points, 3> points(
        surface.GetNumControlPoints(), 3);
    surface.GatherControlPoints(control.data(), descriptor, points.data(), descriptor);
    coefficients_.topRows(tables.to_coefficients.rows()).noalias() =
        tables.to_coefficients.lazyProduct(points);
    return;
  }
  const bool divided = surface.GetParameterization().HasSubFaces();
  irregular_ = std::make_unique<Irregular>();
  irregular_->points.resize(surface.GetNumPatchPoints(), 3);
  surface.PreparePatchPoints(control.data(), descriptor, irregular_->points.data(), descriptor);
  irregular_->surface = std::move(surface);
  if (divided) irregular_->sub_face = patch - topology.first_patch(face);
}

LimitPatch::~LimitPatch() = default;
LimitPatch::LimitPatch(LimitPatch&&) noexcept = default;
LimitPatch& LimitPatch::operator=(LimitPatch&&) noexcept = default;

LimitPoint LimitPatch::evaluate(double s, double t) const {
  if (!irregular_) {
    return scheme_ == Scheme::Loop ? evaluate_polynomial<Scheme::Loop>(coefficients_, s, t)
                                   : evaluate_polynomial<Scheme::CatmullClark>(coefficients_, s, t);
  }
  LimitPoint point = irregular_->evaluate(s, t);
  point.by_s *= irregular_->scale();
  point.by_t *= irregular_->scale();
  return point;
}

LimitCurvature LimitPatch::curvature(double s, double t) const {
  if (!irregular_)
    return curvature_of(evaluate(s, t), second_derivatives(coefficients_, scheme_, s, t));
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

LimitSurface::LimitSurface(std::shared_ptr<const LimitTopology> topology, Points control)
    : topology_(std::move(topology)), control_(std::move(control)) {
  if (control_.rows() != topology_->vertex_count()) {
    throw std::invalid_argument("LimitSurface: " + std::to_string(control_.rows()) +
                                " control points for " + std::to_string(topology_->vertex_count()) +
                                " vertices");
  }
}

LimitSurface::LimitSurface(const Polygons& faces, Points control, Scheme scheme)
    : LimitSurface(std::make_shared<LimitTopology>(faces, static_cast<int>(control.rows()), scheme),
                   control) {}

LimitPoint LimitSurface::evaluate(const LimitPlace& place) const {
  return patch(place.patch).evaluate(place.s, place.t);
}

LimitCurvature LimitSurface::curvature(const LimitPlace& place) const {
  return patch(place.patch).curvature(place.s, place.t);
}

std::vector<LimitPoint> LimitSurface::evaluate_all(std::span<const LimitPlace> places,
                                                   int threads) const {
  std::vector<LimitPoint> points(places.size());
  for_each_place(*this, places, threads,
                 [&](size_t i, const LimitPatch& patch, const LimitPlace& place) {
                   points[i] = patch.evaluate(place.s, place.t);
                 });
  return points;
}

std::vector<LimitCurvature> LimitSurface::curvature_all(std::span<const LimitPlace> places,
                                                        int threads) const {
  std::vector<LimitCurvature> curvatures(places.size());
  for_each_place(*this, places, threads,
                 [&](size_t i, const LimitPatch& patch, const LimitPlace& place) {
                   curvatures[i] = patch.curvature(place.s, place.t);
                 });
  return curvatures;
}

}  // namespace sphparam
