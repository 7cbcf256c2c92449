#include "correspondence/moving_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "embedding/energy/orientation_guard.h"
#include "embedding/sweeps/least_colour.h"
#include "sphparam/parallel.h"

// The local step: −|H|⁻¹g with the blocks of its own of the triangles about a vertex, eigenvalues
// turned positive.

namespace sphparam {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int halvings = 5;
constexpr double longest_way = 0.3;       // the surface has the area 4π
constexpr double least_curvature = 1e-6;  // of the trace
constexpr std::int64_t vertex_grain = 64, face_grain = 1024;

/// Whether det(x, p, q) is certain to be positive.
bool is_certain(const Vector3& x, const Vector3& p, const Vector3& q) {
  const Vector3 a = p - x, b = q - x;
  return certainly_positive(0.5 * x.dot(a.cross(b)), a.squaredNorm() + b.squaredNorm());
}

/// −|H|⁻¹ g of a symmetric 2×2 matrix.
Eigen::Vector2d descent(const Eigen::Matrix2d& h, const Eigen::Vector2d& g) {
  const double middle = (h(0, 0) + h(1, 1)) / 2, half = (h(0, 0) - h(1, 1)) / 2;
  const double radius = std::sqrt(half * half + h(0, 1) * h(0, 1));
  const double floor = least_curvature * (std::abs(middle) + radius);
  const double most = std::max(std::abs(middle + radius), floor);
  const double least = std::max(std::abs(middle - radius), floor);
  if (!(least > 0)) return Eigen::Vector2d::Zero();
  Eigen::Vector2d axis(1, 0);  // of the eigenvalue middle + radius
  if (radius > 0) {
    axis = half >= 0 ? Eigen::Vector2d(half + radius, h(0, 1))
                     : Eigen::Vector2d(h(0, 1), radius - half);
    axis.normalize();
  }
  const Eigen::Vector2d other(-axis.y(), axis.x());
  return -(axis.dot(g) / most * axis + other.dot(g) / least * other);
}

}  // namespace

MovingSurface::MovingSurface(const Topology& topology, const RestTriangles& rest,
                             const TargetSurface& target, std::vector<char> held,
                             std::vector<Place> places, FeatureTerm features)
    : topology_(topology),
      rest_(rest),
      target_(target),
      held_(std::move(held)),
      places_(std::move(places)),
      features_(std::move(features)) {}

Places3 MovingSurface::corners(Face face, const std::vector<Place>& places) const {
  const auto corner = [&](int k) {
    return &places[static_cast<size_t>(topology_.vertex(face, k))];
  };
  return {corner(0), corner(1), corner(2)};
}

bool MovingSurface::certain(Face face, const std::vector<Place>& places) const {
  const auto corner = [&](int k) -> const Vector3& {
    return places[static_cast<size_t>(topology_.vertex(face, k))].direction;
  };
  return is_certain(corner(0), corner(1), corner(2));
}

double MovingSurface::energy_of(Face face, const ComposedEnergy& energy,
                                const std::vector<Place>& places) const {
  return composed_energy(energy, rest_[static_cast<size_t>(face)], corners(face, places));
}

double MovingSurface::energy(const ComposedEnergy& energy, const std::vector<Place>& places,
                             int threads) const {
  const double distortion =
      parallel_sum(topology_.face_count(), threads, [&](std::int64_t first, std::int64_t last) {
        double sum = 0;
        for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
          sum += certain(f, places) ? energy_of(f, energy, places) : infinity;
        }
        return sum;
      });
  if (!features_.is_there()) return distortion;
  return distortion +
         parallel_sum(
             topology_.vertex_count(), threads, [&](std::int64_t first, std::int64_t last) {
               double sum = 0;
               for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v)
                 sum += feature_energy(v, places[static_cast<size_t>(v)]);
               return sum;
             });
}

double MovingSurface::feature_energy(Vertex v, const Place& at) const {
  if (!features_.is_there()) return 0;
  const Functions& there = *features_.there;
  double sum = 0;
  for (Eigen::Index c = 0; c < there.cols(); ++c) {
    double value = 0;
    for (int k = 0; k < 3; ++k) value += at.at.barycentric[k] * there(target_.corner(at, k), c);
    const double difference = features_.here(v, c) - value;
    sum += difference * difference;
  }
  return features_.weight[v] / static_cast<double>(there.cols()) * sum;
}

MovingSurface::FeatureTerms MovingSurface::feature_terms(Vertex v) const {
  FeatureTerms terms{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  if (!features_.is_there()) return terms;
  const Functions& there = *features_.there;
  const Vector3& weights = place(v).at.barycentric;
  const Eigen::Matrix<double, 3, 2> changes = target_.changes_of_weights(place(v));
  for (Eigen::Index c = 0; c < there.cols(); ++c) {
    Vector3 corners;
    for (int k = 0; k < 3; ++k) corners[k] = there(target_.corner(place(v), k), c);
    const Eigen::Vector2d slope = changes.transpose() * corners;
    terms.gradient -= (features_.here(v, c) - weights.dot(corners)) * slope;
    terms.hessian += slope * slope.transpose();
  }
  const double factor = 2 * features_.weight[v] / static_cast<double>(there.cols());
  return {factor * terms.gradient, factor * terms.hessian};
}

double MovingSurface::ring_energy(Vertex v, const Place& at, const ComposedEnergy& energy) const {
  double sum = feature_energy(v, at);
  topology_.for_each_outgoing(v, [&](Halfedge h) {
    if (sum == infinity) return;
    const Place &p = place(topology_.origin(topology_.next(h))), &q = place(topology_.apex(h));
    if (!is_certain(at.direction, p.direction, q.direction)) {
      sum = infinity;
      return;
    }
    sum +=
        composed_energy(energy, rotated(rest_[static_cast<size_t>(h / 3)], h % 3), {&at, &p, &q});
  });
  return sum;
}

bool MovingSurface::step(Vertex v, const ComposedEnergy& energy) {
  const Place& from = place(v);
  const double before = ring_energy(v, from, energy);
  if (!std::isfinite(before)) return false;
  FeatureTerms sum = feature_terms(v);
  topology_.for_each_outgoing(v, [&](Halfedge h) {
    const ComposedTerms of_face = terms(h / 3, energy);
    sum.gradient += of_face.gradient.segment<2>(2 * (h % 3));
    sum.hessian += of_face.hessian.block<2, 2>(2 * (h % 3), 2 * (h % 3));
  });
  const Eigen::Vector2d u = descent(sum.hessian, sum.gradient);
  if (!u.allFinite() || u.isZero(0)) return false;
  Vector3 way = u[0] * from.frame.u + u[1] * from.frame.v;
  way *= std::min(1.0, longest_way / way.norm());
  for (int i = 0; i < halvings; ++i, way /= 2) {
    const Place to = target_.walk(from, way);
    if (!(ring_energy(v, to, energy) < before)) continue;
    set(v, to);
    return true;
  }
  return false;
}

void MovingSurface::make_colours() {
  std::vector<int> colour(held_.size(), -1);
  for (Vertex v = 0; v < topology_.vertex_count(); ++v) {
    if (is_held(v)) continue;
    const int c = least_free_colour(0, [&](const auto& taken) {
      topology_.for_each_outgoing(v, [&](Halfedge h) {
        taken(colour[static_cast<size_t>(topology_.origin(topology_.next(h)))]);
      });
    });
    colour[static_cast<size_t>(v)] = c;
    if (std::ssize(colours_) <= c) colours_.resize(static_cast<size_t>(c) + 1);
    colours_[static_cast<size_t>(c)].push_back(v);
  }
}

void MovingSurface::sweep(const std::vector<Vertex>& independent, const ComposedEnergy& energy,
                          int threads) {
  parallel_for(std::ssize(independent), vertex_grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto i = first; i < last; ++i) {
                   const Vertex v = independent[static_cast<size_t>(i)];
                   if (!is_held(v)) step(v, energy);
                 }
               });
}

void MovingSurface::sweep(const ComposedEnergy& energy, int threads) {
  for_each_in_turn(threads, [&](Vertex v) { step(v, energy); });
}

void MovingSurface::for_each_in_turn(int threads, const std::function<void(Vertex)>& visit) {
  if (colours_.empty()) make_colours();
  for (const std::vector<Vertex>& colour : colours_) {
    parallel_for(std::ssize(colour), vertex_grain, threads,
                 [&](std::int64_t first, std::int64_t last) {
                   for (auto i = first; i < last; ++i) visit(colour[static_cast<size_t>(i)]);
                 });
  }
}

}  // namespace sphparam
