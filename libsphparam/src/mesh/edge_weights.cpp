#include "sphparam/mesh/edge_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sphparam/parallel.h"

// Each face adds to the weights of its three edges, in proportion to its κ:
//   cotangent    ½ cot α to w_ij and w_ji, α the angle opposite to ij;
//   mean value   tan(γ_i/2)/r_ij to w_ij and tan(γ_j/2)/r_ij to w_ji;
//   symmetrised  the mean of these two to both.
// These terms are measured once a face and kept by half-edge: w_ij is the term of ij's own face
// times its κ plus the term of the twin's face times that face's κ.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;                      // faces a chunk
constexpr double area_floor = 1e-12;                      // of the longest edge squared
constexpr double lowest_term = 1e-6, highest_term = 1e6;  // of the median mean value term
constexpr std::int64_t median_samples = 1 << 15;          // the median only sets a scale

struct Corners {
  std::array<Vector3, 3> edge;   // corner k → corner k+1
  std::array<double, 3> length;  // of these edges
  std::array<double, 3> dot;     // of the two edges that leave corner k
  double twice_area;
};

Corners measure(const TriangleMesh& mesh, const Topology& topology, Face f) {
  Corners c;
  for (size_t k = 0; k < 3; ++k) {
    const Halfedge h = 3 * f + static_cast<int>(k);
    c.edge[k] = mesh.position(topology.target(h)) - mesh.position(topology.origin(h));
    c.length[k] = c.edge[k].norm();
  }
  for (size_t k = 0; k < 3; ++k) c.dot[k] = -c.edge[k].dot(c.edge[(k + 2) % 3]);
  c.twice_area = c.edge[0].cross(c.edge[1]).norm();
  return c;
}

/// tan(γ/2) = sin γ / (1 + cos γ) = 2A / (r_1 r_2 + r_1·r_2), γ the angle at corner k.
double tan_half_angle(const Corners& c, size_t k) {
  const double lengths = c.length[k] * c.length[(k + 2) % 3];
  if (lengths == 0) return 1;  // two vertices coincide: the angles there are as good as right ones
  const double denominator = lengths + c.dot[k];
  return denominator > 0 ? c.twice_area / denominator : std::numeric_limits<double>::infinity();
}

/// ½ cot α = ½ (r_1·r_2) / 2A, of each edge's opposite angle.
std::array<double, 3> cotangent_terms(const Corners& c) {
  const double longest = std::max({c.length[0], c.length[1], c.length[2]});
  const double twice_area = std::max(c.twice_area, 2 * area_floor * longest * longest);
  std::array<double, 3> terms;
  for (size_t k = 0; k < 3; ++k)
    terms[k] = twice_area > 0 ? 0.5 * c.dot[(k + 2) % 3] / twice_area : 0;
  return terms;
}

/// tan(γ/2) / r of each edge, γ the angle where it begins and where it ends.
struct MeanValueTerms {
  std::array<double, 3> at_origin, at_target;
};
MeanValueTerms mean_value_terms(const Corners& c) {
  const std::array<double, 3> tangent = {tan_half_angle(c, 0), tan_half_angle(c, 1),
                                         tan_half_angle(c, 2)};
  MeanValueTerms terms;
  for (size_t k = 0; k < 3; ++k) {
    terms.at_origin[k] = tangent[k] / c.length[k];
    terms.at_target[k] = tangent[(k + 1) % 3] / c.length[k];
  }
  return terms;
}

double median_of_sample(const std::vector<double>& terms) {
  const size_t step = 1 + terms.size() / static_cast<size_t>(median_samples);
  std::vector<double> sample;
  sample.reserve(terms.size() / step + 1);
  for (size_t i = 0; i < terms.size(); i += step) sample.push_back(terms[i]);
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  // Without a scale (more than half of the terms 0 or ∞) every clamped term is as good as 1.
  return std::isfinite(*middle) && *middle > 0 ? *middle : 1;
}

}  // namespace

EdgeWeights::EdgeWeights(const TriangleMesh& mesh, const Topology& topology, WeightKind kind,
                         int threads)
    : kind_(kind) {
  const size_t halfedges = static_cast<size_t>(topology.halfedge_count());
  forward_.resize(halfedges);
  if (kind == WeightKind::MeanValue) backward_.resize(halfedges);
  const auto measure_faces = [&](std::int64_t first, std::int64_t last) {
    for (Face f = static_cast<Face>(first); f < last; ++f) {
      const Corners c = measure(mesh, topology, f);
      const size_t h = 3 * static_cast<size_t>(f);
      if (kind == WeightKind::Cotangent) {
        std::ranges::copy(cotangent_terms(c), &forward_[h]);
        continue;
      }
      const auto [at_origin, at_target] = mean_value_terms(c);
      if (kind == WeightKind::MeanValue) {
        std::ranges::copy(at_origin, &forward_[h]);
        std::ranges::copy(at_target, &backward_[h]);
      } else {
        for (size_t k = 0; k < 3; ++k) forward_[h + k] = 0.5 * (at_origin[k] + at_target[k]);
      }
    }
  };
  parallel_for(topology.face_count(), grain, threads, measure_faces);
  if (kind == WeightKind::Cotangent) return;
  const double median = median_of_sample(forward_);
  clamp_terms(forward_, median);
  clamp_terms(backward_, median);
}

void EdgeWeights::clamp_terms(std::vector<double>& terms, double median) {
  const double lowest = lowest_term * median, highest = highest_term * median;
  for (double& term : terms) {
    if (term >= lowest && term <= highest) continue;
    // ∞ is the edge of zero length, or a straight angle: its ends belong together.
    term = term < lowest ? lowest : highest;
    ++clamped_;
  }
}

std::vector<double> EdgeWeights::with(const Topology& topology, const std::vector<double>& kappa,
                                      int threads) const {
  const std::vector<double>& backward = backward_.empty() ? forward_ : backward_;
  std::vector<double> weights(forward_.size());
  parallel_for(topology.halfedge_count(), 3 * grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (Halfedge h = static_cast<Halfedge>(first); h < last; ++h) {
                   const Halfedge g = topology.twin(h);
                   const size_t own = static_cast<size_t>(h), other = static_cast<size_t>(g);
                   if (kappa.empty()) {
                     weights[own] = forward_[own] + backward[other];
                   } else {
                     // w_ij = κ_T(…)_T + κ_T'(…)_T' over the two faces T, T' at ij.
                     weights[own] = kappa[static_cast<size_t>(Topology::face(h))] * forward_[own] +
                                    kappa[static_cast<size_t>(Topology::face(g))] * backward[other];
                   }
                 }
               });
  return weights;
}

}  // namespace sphparam
