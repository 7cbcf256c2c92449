#include "correspondence/feature_scales.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "elementary.h"
#include "mesh/surface_average.h"
#include "mesh/triangle_geometry.h"
#include "sphparam/mesh/vertex_areas.h"

namespace sphparam {
namespace {

constexpr double wild = 3;                             // spreads
constexpr double low_share = 0.16, high_share = 0.84;  // one standard deviation of a normal one
constexpr double least_share = 1e-9;                   // of the mean area of a vertex
constexpr double telling_share = 0.03;                 // of the area, known on one side alone

VectorX face_areas(const TriangleMesh& mesh) {
  VectorX areas(mesh.face_count());
  for (Face f = 0; f < mesh.face_count(); ++f) areas[f] = face_area(mesh, f);
  return areas;
}

/// Finite values in order, and the share of the area that is below each.
class Quantiles {
 public:
  Quantiles(const VectorX& values, const VectorX& area) : values_(values) {
    for (Eigen::Index v = 0; v < values.size(); ++v)
      if (std::isfinite(values[v])) order_.push_back(v);
    std::ranges::stable_sort(order_, {}, [&](Eigen::Index v) { return values[v]; });
    double sum = 0;
    for (const Eigen::Index v : order_) below_.push_back(sum += area[v]);
  }

  double operator()(double share) const {
    const auto place = std::ranges::lower_bound(below_, share * below_.back()) - below_.begin();
    return values_[order_[std::min(static_cast<size_t>(place), order_.size() - 1)]];
  }

 private:
  const VectorX& values_;
  std::vector<Eigen::Index> order_;
  std::vector<double> below_;
};

/// Centred on the median, in spreads, cut; what is not finite is 0. A column that is constant but
/// for less than a third of the area has no spread, and is measured by its standard deviation.
VectorX tamed(const VectorX& values, const VectorX& area) {
  const Quantiles quantile(values, area);
  const double middle = quantile(0.5);
  double spread = (quantile(high_share) - quantile(low_share)) / 2;
  const auto centred = [&](double x) { return std::isfinite(x) ? x - middle : 0; };
  VectorX result = values.unaryExpr(centred);
  if (!(spread > 0)) spread = std::sqrt(area.dot(result.cwiseAbs2()) / area.sum());
  if (!(spread > 0)) return VectorX::Zero(values.size());
  return (result / spread).cwiseMax(-wild).cwiseMin(wild);
}

/// Mean 0 and mean square 1; a constant stays 0.
void standardise(Functions& values, const VectorX& area) {
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    auto column = values.col(c);
    column.array() -= area.dot(column) / area.sum();
    const double spread = std::sqrt(area.dot(column.cwiseAbs2()) / area.sum());
    if (spread > 0) column /= spread;
  }
}

/// The share of the area of vertices at which a column has a finite number.
double known_share(const VectorX& values, const VectorX& area) {
  return values.array().isFinite().select(area, 0.0).sum() / area.sum();
}

}  // namespace

FeatureScales::Side FeatureScales::side_of(const TriangleMesh& mesh, const Topology& topology,
                                           const Functions& values) {
  VectorX area = vertex_areas(mesh);
  area = area.cwiseMax(least_share * area.mean());
  Functions tame(values.rows(), values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) tame.col(c) = tamed(values.col(c), area);
  return {mesh, topology, face_areas(mesh), std::move(area), std::move(tame)};
}

FeatureScales::FeatureScales(const TriangleMesh& from, const Topology& from_topology,
                             const TriangleMesh& to, const Topology& to_topology,
                             const MatchFeatures& features)
    : from_(side_of(from, from_topology, features.from)),
      to_(side_of(to, to_topology, features.to)),
      weight_(features.weight) {}

Functions FeatureScales::averaged(const Side& side, double distance) {
  const SurfaceAverage average(side.mesh, side.topology, side.face_area, side.area, distance);
  Functions result(side.values.rows(), side.values.cols());
  for (Eigen::Index c = 0; c < result.cols(); ++c)
    result.col(c) = average(side.values.col(c).cwiseProduct(side.area));
  standardise(result, side.area);
  return result;
}

const FeatureField& FeatureScales::at(double distance) const {
  const int exponent = static_cast<int>(std::ceil(2 * elementary::log2(distance)));
  const auto found = fields_.find(exponent);
  if (found != fields_.end()) return found->second;
  const double scale = std::sqrt(std::ldexp(1.0, exponent));
  return fields_.emplace(exponent, FeatureField{averaged(from_, scale), averaged(to_, scale)})
      .first->second;
}

FeatureField FeatureScales::raw() const {
  FeatureField field{from_.values, to_.values};
  standardise(field.from, from_.area);
  standardise(field.to, to_.area);
  return field;
}

bool varies(const VectorX& values) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  const auto first = std::ranges::find_if(values, is_finite);
  return std::any_of(first, values.end(),
                     [&](double x) { return std::isfinite(x) && x != *first; });
}

std::optional<OneSidedFeature> one_sided_feature(const MatchFeatures& features,
                                                 const MappedMesh& from, const MappedMesh& to) {
  const VectorX from_area = vertex_areas(from.surface());
  const VectorX to_area = vertex_areas(to.surface());
  for (Eigen::Index c = 0; c < features.from.cols(); ++c) {
    const double here = known_share(features.from.col(c), from_area);
    const double there = known_share(features.to.col(c), to_area);
    if (std::abs(here - there) > telling_share) return OneSidedFeature{c, here, there};
  }
  return std::nullopt;
}

double correlation_of(const Functions& a, const Functions& b, const VectorX& area) {
  double sum = 0;
  for (Eigen::Index c = 0; c < a.cols(); ++c) {
    VectorX x = a.col(c), y = b.col(c);
    x.array() -= area.dot(x) / area.sum();
    y.array() -= area.dot(y) / area.sum();
    const double of_both = area.dot(x.cwiseAbs2()) * area.dot(y.cwiseAbs2());
    if (of_both > 0) sum += area.dot(x.cwiseProduct(y)) / std::sqrt(of_both);
  }
  return sum / static_cast<double>(a.cols());
}

}  // namespace sphparam
