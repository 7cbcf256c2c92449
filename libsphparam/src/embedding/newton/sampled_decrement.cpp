#include "embedding/newton/sampled_decrement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "embedding/energy/packed_triangles.h"
#include "sphparam/parallel.h"

// Patch i of m grows around the vertex at which (i + ½)/m of the energy is reached, vertices in
// their order: as likely as the vertex has energy. So the mean over patches of
//   ½ gᵀH⁻¹g / E
// (gradient, projected Hessian and energy of the patch) estimates the same share of the whole. The
// Hessian is dense, its rows in units of the edges at their vertex: see global_newton.h.

namespace sphparam {
namespace {

constexpr int fewest_patches = 12, most_patches = 64, vertices_a_patch = 2048;
constexpr int most_free = 19;        // vertices of a patch that may move: two rings
constexpr int most_corners = 160;    // with the fixed ones around them
constexpr double shift = 1e-10;      // of the Hessian's diagonal
constexpr int least_exponent = -60;  // of units

size_t at(int i) { return static_cast<size_t>(i); }

/// Free vertices first, then those of their triangles that are fixed.
class Patch {
 public:
  Patch(const HierarchyLevel& level, const RestFloors& floors, const std::vector<ImagePoint>& image,
        Vertex centre)
      : level_(level), floors_(floors) {
    vertices_.push_back(centre);
    for (size_t i = 0; i < vertices_.size() && free_count() < most_free; ++i) {
      for_each_neighbour(vertices_[i], [&](Vertex w) {
        if (free_count() < most_free) enter(w);
      });
    }
    free_ = free_count();
    for (int v = 0; v < free_; ++v) add_triangles(v);
    for (const Vertex v : vertices_) points_.push_back(image[at(v)]);
    measure_units();
  }

  /// ½ gᵀH⁻¹g / E; 1 where that cannot be told.
  double relative_decrement(const DistortionEnergy& energy) {
    const double value = triangles_.energy(points_, energy);
    if (!std::isfinite(value)) return 1;
    const std::vector<TrianglePack>& packs = triangles_.packs();
    terms_.resize(packs.size());
    differentiate_triangles(packs.data(), static_cast<int>(packs.size()), points_.data(), energy,
                            Curvature::Projected, terms_.data());
    assemble();
    if (!gradient_.allFinite() || !hessian_.allFinite()) return 1;
    hessian_.diagonal() *= 1 + shift;
    const Eigen::LLT<Eigen::Ref<Dense>> factor(hessian_);  // in place
    if (factor.info() != Eigen::Success) return 1;
    const double decrement = factor.matrixL().solve(gradient_).squaredNorm() / 2;
    return std::isfinite(decrement) ? std::clamp(decrement / value, 0.0, 1.0) : 1;
  }

 private:
  using Dense = Eigen::MatrixXd;

  int free_count() const { return static_cast<int>(vertices_.size()); }

  template <class Visit>
  void for_each_neighbour(Vertex v, const Visit& visit) const {
    const Vertex* ring = level_.ring_begin(v);
    const int valence = std::min(level_.valence(v), most_corners);
    for (int i = 0; i < valence; ++i) visit(ring[i]);
  }

  /// Its place in the patch.
  int enter(Vertex v) {
    const auto found = std::find(vertices_.begin(), vertices_.end(), v);
    if (found == vertices_.end()) vertices_.push_back(v);
    return static_cast<int>(std::find(vertices_.begin(), vertices_.end(), v) - vertices_.begin());
  }

  /// Those at free vertex v of which no free vertex before it is a corner.
  void add_triangles(int v) {
    const Vertex* ring = level_.ring_begin(vertices_[at(v)]);
    const int valence = level_.valence(vertices_[at(v)]);
    for (int i = 0; i < std::min(valence, most_corners); ++i) {
      const int p = enter(ring[i]), q = enter(ring[i + 1 == valence ? 0 : i + 1]);
      if (p < v || q < v) continue;
      add_triangle({v, p, q});
    }
  }

  void add_triangle(const std::array<int, 3>& corners) {
    const auto position = [&](int corner) -> Vector3 {
      return level_.positions.row(vertices_[at(corner)]);
    };
    const Vector3 a = position(corners[1]) - position(corners[0]);
    const Vector3 b = position(corners[2]) - position(corners[0]);
    triangles_.add(rest_triangle(a, b, floors_), corners);
  }

  void measure_units() {
    unit_.assign(at(free_), 1.0);
    std::vector<double> least(at(free_), 1.0);
    for (int t = 0; t < triangles_.count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int v = triangles_.corner(t, k), w = triangles_.corner(t, (k + 1) % 3);
        const double edge = (points_[at(v)].vector() - points_[at(w)].vector()).squaredNorm();
        if (v < free_) least[at(v)] = std::min(least[at(v)], edge);
        if (w < free_) least[at(w)] = std::min(least[at(w)], edge);
      }
    }
    for (int v = 0; v < free_; ++v) {
      const int exponent = least[at(v)] > 0 ? std::ilogb(least[at(v)]) / 2 : least_exponent;
      unit_[at(v)] = std::ldexp(1.0, std::max(exponent, least_exponent));
    }
  }

  void assemble() {
    gradient_ = VectorX::Zero(2 * free_);
    hessian_ = Eigen::MatrixXd::Zero(2 * free_, 2 * free_);
    for (int t = 0; t < triangles_.count(); ++t) {
      const TriangleTerms& terms = terms_[at(t / pack_width)];
      const int lane = t % pack_width;
      for (int k = 0; k < 3; ++k) {
        const int v = triangles_.corner(t, k);
        if (v >= free_) continue;
        for (int i = 0; i < 2; ++i) {
          gradient_[2 * v + i] += unit_[at(v)] * terms.gradient[k][i][lane];
          for (int j = 0; j < 2; ++j) {
            hessian_(2 * v + i, 2 * v + j) +=
                unit_[at(v)] * unit_[at(v)] * terms.diagonal[k][i + j][lane];
          }
        }
      }
      for (int k = 0; k < 3; ++k) {
        const int v = triangles_.corner(t, k), w = triangles_.corner(t, (k + 1) % 3);
        if (v >= free_ || w >= free_) continue;
        for (int i = 0; i < 4; ++i) {
          const double entry = unit_[at(v)] * unit_[at(w)] * terms.off[k][i][lane];
          hessian_(2 * v + i / 2, 2 * w + i % 2) += entry;
          hessian_(2 * w + i % 2, 2 * v + i / 2) += entry;
        }
      }
    }
  }

  const HierarchyLevel& level_;
  const RestFloors& floors_;
  std::vector<Vertex> vertices_;
  int free_ = 0;
  std::vector<ImagePoint> points_;
  std::vector<double> unit_;
  PackedTriangles triangles_;
  std::vector<TriangleTerms> terms_;
  VectorX gradient_;
  Dense hessian_;
};

/// Vertices at which the sum of the energies reaches (i + ½)/count of all.
std::vector<Vertex> vertices_by_energy(const std::vector<float>& ring_energy, int count) {
  double all = 0, sum = 0;
  for (const float e : ring_energy) all += static_cast<double>(e);
  std::vector<Vertex> vertices;
  for (size_t v = 0; v < ring_energy.size() && std::ssize(vertices) < count; ++v) {
    sum += static_cast<double>(ring_energy[v]);
    while (std::ssize(vertices) < count &&
           sum >= (static_cast<double>(vertices.size()) + 0.5) / count * all) {
      vertices.push_back(static_cast<Vertex>(v));
    }
  }
  return vertices;
}

}  // namespace

double sampled_decrement(const HierarchyLevel& level, const RestFloors& floors,
                         const std::vector<ImagePoint>& image,
                         const std::vector<float>& ring_energy, const DistortionEnergy& energy,
                         int threads) {
  const int patches =
      std::clamp(level.vertex_count() / vertices_a_patch, fewest_patches, most_patches);
  const std::vector<Vertex> centres = vertices_by_energy(ring_energy, patches);
  std::vector<double> share(centres.size());
  parallel_for(std::ssize(centres), 4, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i) {
      share[i] = Patch(level, floors, image, centres[i]).relative_decrement(energy);
    }
  });
  double sum = 0;
  for (const double s : share) sum += s;
  return share.empty() ? 1 : sum / static_cast<double>(share.size());
}

}  // namespace sphparam
