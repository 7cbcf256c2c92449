#include "chart/spread.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <optional>

#include "chart/sheet_region.h"
#include "elementary.h"

// Gauss and Newton's steps d: a face of height h asks for h + ∇h·d = min(wanted, growth·h), and
// weighs the more the lower it is; vertices would rather stay, |d|² weighs little. A step is halved
// until every face keeps a tenth of its height and Σ ln²(wanted / h) of the low ones falls.

namespace sphparam {
namespace {

constexpr double growth = 8;
constexpr double least_weighed = 0x1p-10;  // cells: lower faces weigh as much
constexpr double high = 4;                 // × wanted: higher faces are asked for nothing
constexpr double staying = 1e-6;
constexpr double kept = 0.1;  // of its height, by every face
constexpr double least_gain = 1e-3;
constexpr int most_steps = 60;
constexpr int most_halvings = 12;

using Matrix = Eigen::SparseMatrix<double>;

class Spreading {
 public:
  Spreading(Sheet& sheet, const std::vector<Vertex>& vertices, double wanted)
      : sheet_(sheet), vertices_(vertices), wanted_(wanted), region_(sheet, vertices) {}

  void run() {
    double lack = measure();
    for (int i = 0; i < most_steps && lack > 0; ++i) {
      const double before = lack;
      const std::optional<VectorX> step = find_step();
      if (!step || !take(*step, lack) || lack > (1 - least_gain) * before) break;
    }
  }

 private:
  /// Heights of the faces, and what they lack.
  double measure() {
    double sum = 0;
    heights_.clear();
    for (const Face f : region_.faces) {
      heights_.push_back(sheet_.height(f));
      const double lack = std::max(0.0, elementary::log(wanted_ / heights_.back()));
      sum += lack * lack;
    }
    return sum;
  }

  /// What a face asks for: Σ row·d = right, of the unknowns that its corners have.
  struct Request {
    std::array<int, 6> unknowns = {};
    std::array<double, 6> row = {};
    int count = 0;
    double right = 0;

    void add(int unknown, double factor) {
      unknowns[static_cast<size_t>(count)] = unknown;
      row[static_cast<size_t>(count++)] = factor;
    }
  };

  Request request_of(size_t i) const {
    const double height = heights_[i], weight = 1 / std::max(height, least_weighed);
    Request request;
    request.right = weight * (std::max(height, std::min(wanted_, growth * height)) - height);
    const std::array<SheetPoint, 3> gradient = sheet_.height_gradient(region_.faces[i]);
    for (int k = 0; k < 3; ++k) {
      const Vertex v = sheet_.origin(3 * region_.faces[i] + k);
      const auto found = region_.first_unknown.find(v);
      if (found == region_.first_unknown.end()) continue;
      const SheetPoint& change = gradient[static_cast<size_t>(k)];
      request.add(found->second, weight * change.x);
      if (!sheet_.on_seam(v)) request.add(found->second + 1, weight * change.y);
    }
    return request;
  }

  std::optional<VectorX> find_step() const {
    std::vector<Eigen::Triplet<double>> entries;
    VectorX right = VectorX::Zero(region_.unknowns);
    for (size_t i = 0; i < region_.faces.size(); ++i) {
      if (heights_[i] > high * wanted_) continue;
      const Request request = request_of(i);
      for (size_t a = 0; a < static_cast<size_t>(request.count); ++a) {
        right[request.unknowns[a]] += request.row[a] * request.right;
        for (size_t b = 0; b < static_cast<size_t>(request.count); ++b)
          entries.emplace_back(request.unknowns[a], request.unknowns[b],
                               request.row[a] * request.row[b]);
      }
    }
    for (int i = 0; i < region_.unknowns; ++i) entries.emplace_back(i, i, staying);
    Matrix matrix(region_.unknowns, region_.unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Matrix> factor(matrix);
    if (factor.info() != Eigen::Success) return std::nullopt;
    VectorX step = factor.solve(right);
    if (!step.allFinite()) return std::nullopt;
    return step;
  }

  /// Moves by as much of a step as can be; false: by nothing.
  bool take(const VectorX& step, double& lack) {
    std::vector<SheetPoint> before;
    for (const Vertex v : vertices_) before.push_back(sheet_.place(v));
    const std::vector<double> heights = heights_;
    double share = 1;
    for (int i = 0; i < most_halvings; ++i, share /= 2) {
      move(before, step, share);
      if (!all_kept(heights)) continue;
      const double there = measure();
      if (there >= lack) continue;
      lack = there;
      return true;
    }
    for (size_t i = 0; i < vertices_.size(); ++i) sheet_.move(vertices_[i], before[i]);
    return false;
  }

  void move(const std::vector<SheetPoint>& before, const VectorX& step, double share) {
    for (size_t i = 0; i < vertices_.size(); ++i) {
      const int first = region_.first_unknown.at(vertices_[i]);
      const double by_x = share * step[first];
      const double by_y = sheet_.on_seam(vertices_[i]) ? 0 : share * step[first + 1];
      sheet_.move(vertices_[i], {before[i].x + by_x, before[i].y + by_y});
    }
  }

  bool all_kept(const std::vector<double>& heights) const {
    for (const Vertex v : vertices_) {
      if (!sheet_.allows(v, sheet_.place(v))) return false;
    }
    for (size_t i = 0; i < region_.faces.size(); ++i) {
      if (sheet_.height(region_.faces[i]) < kept * std::min(heights[i], high * wanted_))
        return false;
    }
    return true;
  }

  Sheet& sheet_;
  const std::vector<Vertex>& vertices_;
  const double wanted_;
  const SheetRegion region_;
  std::vector<double> heights_;
};

}  // namespace

void spread(Sheet& sheet, const std::vector<Vertex>& vertices, double wanted) {
  Spreading(sheet, vertices, wanted).run();
}

}  // namespace sphparam
