#include "chart/unbend.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <optional>

#include "chart/sheet_region.h"

// Levenberg and Marquardt's method for Σ max(0, 1 − h / wanted)² over the faces: the damped step d
// of the linearised problem, each coordinate held inside the rectangle; where that brings nothing,
// the damping grows, else it shrinks.

namespace sphparam {
namespace {

constexpr double first_damping = 1e-9, least_damping = 1e-13, most_damping = 1;
constexpr double damping_step = 8;
constexpr int most_steps = 60;
constexpr double least_gain = 1e-3;
constexpr double kept = 0.1;  // of the distance from the border, by every vertex

using Matrix = Eigen::SparseMatrix<double>;

class Unbending {
 public:
  Unbending(Sheet& sheet, const std::vector<Vertex>& vertices, double wanted)
      : sheet_(sheet), vertices_(vertices), wanted_(wanted), region_(sheet, vertices) {}

  void run() {
    double lack = measure();
    for (int i = 0; i < most_steps && lack > 0 && damping_ <= most_damping; ++i) {
      const double before = lack;
      linearise();
      while (damping_ <= most_damping && !take(lack)) damping_ *= damping_step;
      if (lack > (1 - least_gain) * before) break;
      damping_ = std::max(least_damping, damping_ / damping_step);
    }
  }

 private:
  double lack_of(Face f) const { return std::max(0.0, 1 - sheet_.height(f) / wanted_); }

  double measure() const {
    double sum = 0;
    for (const Face f : region_.faces) sum += lack_of(f) * lack_of(f);
    return sum;
  }

  /// The normal equations of ∇h·d = wanted − h, of the faces that lack something.
  void linearise() {
    std::vector<Eigen::Triplet<double>> entries;
    right_ = VectorX::Zero(region_.unknowns);
    for (const Face f : region_.faces) {
      const double lack = lack_of(f);
      if (lack == 0) continue;
      const Row row = row_of(f);
      for (int a = 0; a < row.count; ++a) {
        const auto [unknown, factor] = row.entries[static_cast<size_t>(a)];
        right_[unknown] += factor * lack;
        for (int b = 0; b < row.count; ++b) {
          const auto [other, other_factor] = row.entries[static_cast<size_t>(b)];
          entries.emplace_back(unknown, other, factor * other_factor);
        }
      }
    }
    for (int i = 0; i < region_.unknowns; ++i) entries.emplace_back(i, i, 0.0);
    normal_.resize(region_.unknowns, region_.unknowns);
    normal_.setFromTriplets(entries.begin(), entries.end());
  }

  struct Row {
    std::array<std::pair<int, double>, 6> entries = {};
    int count = 0;
  };

  /// ∇h / wanted of a face, by the unknowns that its corners have.
  Row row_of(Face f) const {
    Row row;
    const std::array<SheetPoint, 3> gradient = sheet_.height_gradient(f);
    for (int k = 0; k < 3; ++k) {
      const Vertex v = sheet_.origin(3 * f + k);
      const auto found = region_.first_unknown.find(v);
      if (found == region_.first_unknown.end()) continue;
      const SheetPoint& change = gradient[static_cast<size_t>(k)];
      row.entries[static_cast<size_t>(row.count++)] = {found->second, change.x / wanted_};
      if (!sheet_.on_seam(v))
        row.entries[static_cast<size_t>(row.count++)] = {found->second + 1, change.y / wanted_};
    }
    return row;
  }

  std::optional<VectorX> find_step() const {
    Matrix damped = normal_;
    damped.diagonal().array() += damping_;
    const Eigen::SimplicialLDLT<Matrix> factor(damped);
    if (factor.info() != Eigen::Success) return std::nullopt;
    VectorX step = factor.solve(right_);
    if (!step.allFinite()) return std::nullopt;
    return step;
  }

  /// Takes a step if less is lacking after it.
  bool take(double& lack) {
    const std::optional<VectorX> step = find_step();
    if (!step) return false;
    std::vector<SheetPoint> before;
    for (const Vertex v : vertices_) before.push_back(sheet_.place(v));
    move(*step);
    const double there = measure();
    if (there < lack) {
      lack = there;
      return true;
    }
    for (size_t i = 0; i < vertices_.size(); ++i) sheet_.move(vertices_[i], before[i]);
    return false;
  }

  void move(const VectorX& step) {
    for (const Vertex v : vertices_) {
      const int first = region_.first_unknown.at(v);
      const SheetPoint at = sheet_.place(v);
      sheet_.move(
          v, {inside(at.x, step[first]), sheet_.on_seam(v) ? 0 : inside(at.y, step[first + 1])});
    }
  }

  static double inside(double x, double by) {
    return std::clamp(x + by, kept * x, Sheet::cells - kept * (Sheet::cells - x));
  }

  Sheet& sheet_;
  const std::vector<Vertex>& vertices_;
  const double wanted_;
  const SheetRegion region_;
  Matrix normal_;
  VectorX right_;
  double damping_ = first_damping;
};

}  // namespace

void unbend(Sheet& sheet, const std::vector<Vertex>& vertices, double wanted) {
  Unbending(sheet, vertices, wanted).run();
}

}  // namespace sphparam
