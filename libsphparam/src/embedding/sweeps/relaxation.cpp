#include "embedding/sweeps/relaxation.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "elementary.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/energy/orientation_guard.h"
#include "embedding/sweeps/least_colour.h"
#include "free_vertices.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// For the ring triangle (x, p, q) let a = p − x, b = q − x, u = b − t a (t, l, h: foot, base and
// height of the rest triangle seen from x) and S = det(x, a, b)/2. Then
//   d = ½(|a|²/l² + |u|²/h²),  ∇d = −a/l² − (1 − t)u/h²,  ∇²d = 1/l² + (1 − t)²/h²  (times I),
//   s = S/A,                   ∇s = (p × q)/2A,            ∇²s = 0,
// and on the sphere ∇² loses the normal slope ∇f·x. Differences are rotated into the tangent frame
// before they are multiplied: the small triangles of a long protrusion keep their relative
// precision.
//
// Where the guard (energy/orientation_guard.h; turned into the frame, a and b carry three roundings
// more, which its margin covers) cannot tell whether a triangle is positive, the exact predicate
// can.

namespace sphparam {
namespace {

constexpr double least_gain = 1e-12;      // of the ring's energy: above the rounding of the sum
constexpr double least_curvature = 1e-3;  // smaller eigenvalue of a 2×2 Hessian, of the larger
constexpr double longest_step = 0.5;      // radians
constexpr double shrink = 0.4;            // of a refused step
constexpr int tries = 8;
constexpr std::int64_t grain = 256;  // vertices a chunk

/// The ring triangle (x, neighbour, next slot's neighbour), as the source has it.
struct Slot {
  double inverse_base;
  double inverse_height;
  double foot;
  Vertex neighbour;
};

/// Rings of the vertices that may move, vertices of one colour together. No two of a colour are
/// neighbours, so they may move at the same time.
struct Rings {
  std::vector<Vertex> vertices;
  std::vector<size_t> first_slot;  // #vertices + 1
  std::vector<Slot> slots;
  std::vector<std::int64_t> first_of_colour;  // #colours + 1, into vertices
};

/// Greedy: each vertex in turn takes the least colour that none of its neighbours has.
std::vector<int> colour(const Topology& topology, const std::vector<Vertex>& vertices) {
  std::vector<int> colours(static_cast<size_t>(topology.vertex_count()), -1);
  for (const Vertex v : vertices) {
    colours[static_cast<size_t>(v)] = least_free_colour(0, [&](const auto& take) {
      topology.for_each_outgoing(
          v, [&](Halfedge h) { take(colours[static_cast<size_t>(topology.target(h))]); });
    });
  }
  return colours;
}

Rings make_rings(const Topology& topology, const RestTriangles& source,
                 std::vector<Vertex> vertices, int threads) {
  const std::vector<int> colours = colour(topology, vertices);
  std::stable_sort(vertices.begin(), vertices.end(), [&](Vertex a, Vertex b) {
    return colours[static_cast<size_t>(a)] < colours[static_cast<size_t>(b)];
  });
  Rings rings{std::move(vertices), {0}, {}, {}};
  int last_colour = -1;
  for (size_t i = 0; i < rings.vertices.size(); ++i) {
    const Vertex v = rings.vertices[i];
    if (const int c = colours[static_cast<size_t>(v)]; c != last_colour) {
      rings.first_of_colour.push_back(static_cast<std::int64_t>(i));
      last_colour = c;
    }
    rings.first_slot.push_back(rings.first_slot.back() + static_cast<size_t>(topology.valence(v)));
  }
  rings.first_of_colour.push_back(static_cast<std::int64_t>(rings.vertices.size()));
  rings.slots.resize(rings.first_slot.back());
  const std::int64_t count = static_cast<std::int64_t>(rings.vertices.size());
  parallel_for(count, grain, threads, [&](std::int64_t first, std::int64_t last) {
    Slot* slot = rings.slots.data() + rings.first_slot[static_cast<size_t>(first)];
    for (std::int64_t i = first; i < last; ++i) {
      topology.for_each_outgoing(rings.vertices[static_cast<size_t>(i)], [&](Halfedge h) {
        const RestTriangle t =
            rotated(source[static_cast<size_t>(Topology::face(h))], Topology::corner(h));
        *slot++ = {t.inverse_base, t.inverse_height, t.foot, topology.target(h)};
      });
    }
  });
  return rings;
}

/// One vertex with its ring.
class Ring {
 public:
  Ring(const Slot* first, const Slot* last, const Points& points, const DistortionEnergy& energy)
      : first_(first), last_(last), points_(points), energy_(energy) {}

  /// The ring's energy with the vertex at x; +∞ if an orientation is not certain.
  double energy_at(const Vector3& x) const {
    double sum = 0;
    Vector3 a = difference(first_, x);
    for (const Slot* slot = first_; slot != last_; ++slot) {
      const Slot* following = slot + 1 == last_ ? first_ : slot + 1;
      const Vector3 b = difference(following, x);
      const double s2 = x.dot(a.cross(b));  // 2S
      const double aa = a.squaredNorm(), bb = b.squaredNorm();
      if (!certainly_positive(s2 / 2, aa + bb) && !certain(*slot, *following, x, s2)) {
        return std::numeric_limits<double>::infinity();
      }
      const double i2a = slot->inverse_base * slot->inverse_height;  // 1/2A
      const double uu = (b - slot->foot * a).squaredNorm();
      const double d = (aa * slot->inverse_base * slot->inverse_base +
                        uu * slot->inverse_height * slot->inverse_height) /
                       2;
      sum += energy_density(energy_, d, s2 * i2a) / (2 * i2a);
      a = b;
    }
    return sum;
  }

  struct Model {
    double energy = 0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  };

  /// Second-order model at x in the tangent frame; energy +∞ if an orientation is not certain.
  Model model_at(const Vector3& x, const TangentFrame& frame) const {
    Model model;
    double g0 = 0, g1 = 0, h00 = 0, h01 = 0, h11 = 0, energy = 0;
    const auto in_frame = [&](const Slot* slot) {
      const Vector3 e = difference(slot, x);
      return Vector3(e.dot(frame.u), e.dot(frame.v), e.dot(x));
    };
    Vector3 a = in_frame(first_);
    for (const Slot* slot = first_; slot != last_; ++slot) {
      const Slot* following = slot + 1 == last_ ? first_ : slot + 1;
      const Vector3 b = in_frame(following);
      // 1. The triangle is positive.
      const double s2 = a.x() * b.y() - a.y() * b.x();  // 2S
      const double aa = a.squaredNorm(), bb = b.squaredNorm();
      if (!certainly_positive(s2 / 2, aa + bb) && !certain(*slot, *following, x, s2)) {
        model.energy = std::numeric_limits<double>::infinity();
        return model;
      }
      // 2. d, s and f's derivatives by them.
      const double il2 = slot->inverse_base * slot->inverse_base;
      const double ih2 = slot->inverse_height * slot->inverse_height;
      const double i2a = slot->inverse_base * slot->inverse_height, area = 1 / (2 * i2a);
      const double r = 1 - slot->foot, k = r * ih2;
      const Vector3 u = b - slot->foot * a;
      const double d = (aa * il2 + u.squaredNorm() * ih2) / 2, s = s2 * i2a;
      const EnergyDerivatives f = differentiate(energy_, d, s);

      // 3. ∇d and ∇s; dn is ∇d·x.
      const double d0 = -il2 * a.x() - k * u.x(), d1 = -il2 * a.y() - k * u.y();
      const double dn = -il2 * a.z() - k * u.z();
      // p × q with p = x + a, q = x + b, in the frame
      const double s0 = (a.y() - b.y() + a.y() * b.z() - a.z() * b.y()) * i2a;
      const double s1 = (b.x() - a.x() + a.z() * b.x() - a.x() * b.z()) * i2a;
      // 4. Their share of value, gradient and Hessian.
      const double isotropic = f.f_d * (il2 + r * k - dn) - f.f_s * s;
      energy += area * f.f;
      g0 += area * (f.f_d * d0 + f.f_s * s0);
      g1 += area * (f.f_d * d1 + f.f_s * s1);
      h00 += area * (2 * f.f_ds * d0 * s0 + f.f_ss * s0 * s0 + isotropic);
      h11 += area * (2 * f.f_ds * d1 * s1 + f.f_ss * s1 * s1 + isotropic);
      h01 += area * (f.f_ds * (d0 * s1 + d1 * s0) + f.f_ss * s0 * s1);
      a = b;
    }
    model.energy = energy;
    model.gradient << g0, g1;
    model.hessian << h00, h01, h01, h11;
    return model;
  }

 private:
  Vector3 difference(const Slot* slot, const Vector3& x) const {
    return points_.row(slot->neighbour).transpose() - x;
  }

  bool certain(const Slot& p, const Slot& q, const Vector3& x, double s2) const {
    return s2 / 2 > guard_least &&
           orientation(x, points_.row(p.neighbour), points_.row(q.neighbour)) > 0;
  }

  const Slot* first_;
  const Slot* last_;
  const Points& points_;
  const DistortionEnergy& energy_;
};

/// −H⁻¹g, with H shifted until its eigenvalues are positive.
Eigen::Vector2d newton_step(const Ring::Model& model) {
  double h00 = model.hessian(0, 0), h11 = model.hessian(1, 1);
  const double h01 = model.hessian(0, 1);
  const double middle = (h00 + h11) / 2, spread = elementary::hypot((h00 - h11) / 2, h01);
  const double least = least_curvature * (std::abs(middle) + spread);
  const double shift = std::max(0.0, least - (middle - spread));
  h00 += shift;
  h11 += shift;
  const double determinant = h00 * h11 - h01 * h01;
  const double g0 = model.gradient[0], g1 = model.gradient[1];
  return Eigen::Vector2d(h01 * g1 - h11 * g0, h01 * g0 - h00 * g1) / determinant;
}

enum class Visit { Moved, Refused, Skipped, AtRest };

Visit visit(const Ring& ring, Vertex v, Points& points, double over_relaxation) {
  const Vector3 x = points.row(v);
  const TangentFrame frame = tangent_frame(x);
  const Ring::Model model = ring.model_at(x, frame);
  if (!std::isfinite(model.energy)) return Visit::Skipped;
  const Eigen::Vector2d step = newton_step(model);
  const double gain = -model.gradient.dot(step) / 2, length = step.norm();
  if (!(gain > least_gain * model.energy) || !std::isfinite(length)) return Visit::AtRest;
  double t = std::min(over_relaxation, longest_step / length);
  for (int i = 0; i < tries; ++i, t *= shrink) {
    const Vector3 y = frame.at(x, t * step[0], t * step[1]);
    if (ring.energy_at(y) < (1 - least_gain) * model.energy) {
      points.row(v) = y;
      return Visit::Moved;
    }
  }
  return Visit::Refused;
}

struct Counts {
  std::atomic<long> moved{0}, refused{0}, skipped{0};

  void add(const std::array<long, 4>& visits) {
    moved += visits[static_cast<size_t>(Visit::Moved)];
    refused += visits[static_cast<size_t>(Visit::Refused)];
    skipped += visits[static_cast<size_t>(Visit::Skipped)];
  }
};

void sweep(const Rings& rings, Points& points, const DistortionEnergy& energy,
           const RelaxationOptions& options, Counts& counts) {
  for (size_t c = 0; c + 1 < rings.first_of_colour.size(); ++c) {
    const std::int64_t begin = rings.first_of_colour[c], end = rings.first_of_colour[c + 1];
    parallel_for(end - begin, grain, options.threads, [&](std::int64_t first, std::int64_t last) {
      std::array<long, 4> visits{};
      for (std::int64_t i = begin + first; i < begin + last; ++i) {
        const size_t k = static_cast<size_t>(i);
        const Slot* slots = rings.slots.data();
        const Ring ring(slots + rings.first_slot[k], slots + rings.first_slot[k + 1], points,
                        energy);
        ++visits[static_cast<size_t>(
            visit(ring, rings.vertices[k], points, options.over_relaxation))];
      }
      counts.add(visits);
    });
  }
}

void require_domain(const RelaxationOptions& options, int vertices) {
  require_domain(options.energy);
  require_at_least("sweeps", options.sweeps, 0);
  require_between("over_relaxation", options.over_relaxation, 0, most_over_relaxation);
  if (options.vertices) require_vertices("vertices", *options.vertices, vertices);
  require_vertices("pinned", options.pinned, vertices);
}

}  // namespace

Relaxation relax(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                 const RelaxationOptions& options) {
  require_domain(options, topology.vertex_count());
  DistortionEnergy energy = options.energy;
  energy.epsilon = 0;
  Relaxation result{map, {}};
  RelaxationReport& report = result.report;
  if (options.measure_energy) {
    report.energy_before = distortion_energy(topology, source, map, energy, options.threads);
  }
  const Rings rings = make_rings(
      topology, source, free_vertices(topology.vertex_count(), options.vertices, options.pinned),
      options.threads);
  Counts counts;
  for (; report.sweeps < options.sweeps; ++report.sweeps) {
    sweep(rings, result.map.points, energy, options, counts);
    sphparam::report(options.progress, "relax",
                     (report.sweeps + 1.0) / static_cast<double>(options.sweeps));
  }
  report.steps = counts.moved;
  report.refused = counts.refused;
  report.skipped = counts.skipped;
  if (options.measure_energy) {
    report.energy_after = distortion_energy(topology, source, result.map, energy, options.threads);
  }
  return result;
}

}  // namespace sphparam
