#include "sphparam/embedding/landmarks.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "embedding/orientations.h"
#include "sphparam/embedding/newton.h"
#include "sphparam/embedding/relaxation.h"

// A round: (1) each pin in turn goes a part t of its way, t = 1, ½, ¼ …, the first for which all
// triangles of its ring stay positive; where t < 1 it then draws back by half, so as not to lie on
// the border of the kernel; (2) relaxation of all other vertices.

namespace sphparam {
namespace {

constexpr double least_part = 1e-3;      // of the way left: a shorter move is none
const double kernel_width = getenv("KW") ? atof(getenv("KW")) : 0.5;
const int patience = getenv("PA") ? atoi(getenv("PA")) : 30;             // rounds
constexpr double least_progress = 0.02;  // of the sum of residuals, within `patience` rounds

Vector3 along_great_circle(const Vector3& from, const Vector3& to, double part) {
  const double angle = std::atan2(from.cross(to).norm(), from.dot(to));
  Vector3 side = to - from.dot(to) * from;
  // Opposite points: any great circle serves.
  side = side.norm() > 1e-12 ? Vector3(side.normalized()) : from.unitOrthogonal();
  return (std::cos(part * angle) * from + std::sin(part * angle) * side).normalized();
}

/// Moves one pin along its way; false where it cannot.
bool advance(const Topology& topology, SphereMap& map, const Pin& pin) {
  const Vector3 from = map.point(pin.vertex);
  const auto fits = [&](const Vector3& x) {
    map.points.row(pin.vertex) = x;
    return ring_is_positive(topology, map, pin.vertex);
  };
  if (fits(pin.point)) return true;
  for (double part = 0.5; part > least_part; part /= 2) {
    if (!fits(along_great_circle(from, pin.point, part))) continue;
    if (!fits(along_great_circle(from, pin.point, part / 2))) break;
    return true;
  }
  map.points.row(pin.vertex) = from;
  return false;
}

Vector3 way_to(const Vector3& from, const Vector3& to) {
  const Vector3 side = to - from.dot(to) * from;
  const double sine = side.norm();
  const double angle = std::atan2(from.cross(to).norm(), from.dot(to));
  return sine > 1e-12 ? Vector3(angle / sine * side) : Vector3(angle * from.unitOrthogonal());
}

double kernel(double distance) {
  const double r = distance / kernel_width;
  return (1 + r) * std::exp(-r);
}

/// Moves all vertices by a smooth field that takes every pin along its way; false where no part
/// of the way keeps the map valid.
bool flow(const Topology& topology, SphereMap& map, const std::vector<Pin>& pins, int threads, double turn) {
  const Eigen::Index k = static_cast<Eigen::Index>(pins.size());
  Eigen::MatrixXd kernels(k, k), ways(k, 3);
  double longest = 0;
  for (Eigen::Index i = 0; i < k; ++i) {
    const Vector3 x = map.point(pins[static_cast<size_t>(i)].vertex);
    ways.row(i) = way_to(x, pins[static_cast<size_t>(i)].point);
    if (turn != 0 && ways.row(i).norm() > 0) {const Vector3 w = ways.row(i).normalized(); ways.row(i) = 0.3 * (std::cos(turn) * w + std::sin(turn) * x.cross(w));}
    longest = std::max(longest, ways.row(i).norm());
    for (Eigen::Index j = 0; j < k; ++j) {
      kernels(i, j) = kernel((x - map.point(pins[static_cast<size_t>(j)].vertex)).norm());
    }
  }
  if (longest == 0) return false;
  const Eigen::MatrixXd weights = kernels.ldlt().solve(ways);
  Points field = Points::Zero(map.points.rows(), 3);
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    for (Eigen::Index j = 0; j < k; ++j) {
      const double w = kernel((map.points.row(v) - map.points.row(pins[static_cast<size_t>(j)].vertex)).norm());
      field.row(v) += w * weights.row(j);
    }
    field.row(v) -= field.row(v).dot(map.points.row(v)) * map.points.row(v);
  }
  for (double part = std::min(1.0, 0.3 / longest); part > least_part; part /= 2) {
    SphereMap moved = normalised(map.points + part * field);
    if (!all_triangles_positive(topology, moved, threads)) continue;
    map = std::move(moved);
    return true;
  }
  return false;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

}  // namespace

bool LandmarkPlacement::exact() const { return sum(residuals) == 0; }

Eigen::Matrix3d best_rotation(const SphereMap& map, const std::vector<Pin>& pins) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Pin& pin : pins) covariance += pin.point * map.points.row(pin.vertex);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

std::vector<double> pin_residuals(const SphereMap& map, const std::vector<Pin>& pins) {
  std::vector<double> residuals;
  for (const Pin& pin : pins) {
    const Vector3 x = map.point(pin.vertex);
    const double angle = std::atan2(x.cross(pin.point).norm(), x.dot(pin.point));
    residuals.push_back(x == pin.point ? 0
                                       : std::max(angle, std::numeric_limits<double>::min()));
  }
  return residuals;
}

LandmarkPlacement place_landmarks(const Topology& topology, const SourceTriangles& source,
                                  const SphereMap& map, const std::vector<Pin>& pins,
                                  const LandmarkOptions& options) {
  LandmarkPlacement result;
  result.map = {map.points * best_rotation(map, pins).transpose()};
  result.map = normalised(std::move(result.map.points));
  if (!all_triangles_positive(topology, result.map, options.threads)) result.map = map;

  RelaxationOptions relaxation{
      .energy = options.energy, .sweeps = getenv("SW") ? atoi(getenv("SW")) : options.sweeps, .threads = options.threads};
  for (const Pin& pin : pins) relaxation.pinned.push_back(pin.vertex);
  int detours = 0, detour = 0; const int most_detours = getenv("DT") ? atoi(getenv("DT")) : 4; const double turn = getenv("TU") ? atof(getenv("TU")) : -1.2;
  const bool flow_wanted = !getenv("NOFLOW");
  std::vector<double> history;  // sums of residuals
  for (;; ++result.rounds) {
    const bool flowed = flow_wanted && flow(topology, result.map, pins, options.threads, detour > 0 ? turn : 0);
    if (!(detour > 0 ||(flowed && getenv("SNAP")))) for (const Pin& pin : pins) advance(topology, result.map, pin);
    else for (const Pin& pin : pins) { const Vector3 from = result.map.point(pin.vertex); result.map.points.row(pin.vertex) = pin.point; if (!ring_is_positive(topology, result.map, pin.vertex)) result.map.points.row(pin.vertex) = from; }
    result.residuals = pin_residuals(result.map, pins);
    history.push_back(sum(result.residuals));
    result.map = relax(topology, source, result.map, relaxation).map;
    report(options.progress, "pins", 1 - history.back() / std::max(history.front(), 1e-300));
    const size_t k = history.size();
    const bool stalled = k > patience && history[k - 1] > (1 - least_progress) *
                                                              history[k - 1 - patience];
    if(getenv("DBG")&&(stalled||result.exact()||result.rounds==options.most_rounds)){fprintf(stderr,"n %ld rounds %d sum %.4g  E %.4g flowed %d:",(long)map.points.rows(),result.rounds,history.back(),distortion_energy(topology,source,result.map,options.energy),flowed);for(double r:result.residuals)fprintf(stderr," %.2g",r);fprintf(stderr,"\n");}
    if (detour > 0 && --detour == 0) history.clear();
    if (stalled && detours < most_detours && !result.exact()) {
      ++detours; detour = 5; history.clear();
      RelaxationOptions loose = relaxation; loose.sweeps = 20; loose.pinned.clear();
      for (size_t i = 0; i < pins.size(); ++i) if (result.residuals[i] == 0) loose.pinned.push_back(pins[i].vertex);
      result.map = relax(topology, source, result.map, loose).map;
      continue;
    }
    if (result.exact() || stalled || result.rounds == options.most_rounds) return result;
  }
}

}  // namespace sphparam
