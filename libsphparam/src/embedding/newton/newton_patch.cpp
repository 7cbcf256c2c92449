#include "newton_patch.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>

#include "mesh/triangle_geometry.h"
#include "sphparam/sphere/orientation.h"

// E does not change when its triangle turns about the centre: three of the six tangent directions
// carry no shape. The Hessian is projected in the three others only, where the negative curvature
// that matters is; of the rotations the one in the triangle's own plane keeps its curvature if it
// is positive, the other two are dropped. Clamping all six eigenvalues is stiffer and slower.

namespace sphparam {
namespace {

constexpr double least_curvature = 1e-6;  // of the largest entry of a 3×3 Hessian
constexpr double longest_step = 0.7;      // radians, of any vertex
constexpr double sufficient_decrease = 1e-4;
constexpr int halvings = 40;
constexpr double first_shift = 1e-9, last_shift = 1e-1;  // of the diagonal

using Matrix6 = decltype(TriangleEnergy::hessian);

Eigen::Matrix3d positive_part(const Eigen::Matrix3d& h) {
  const double scale = h.cwiseAbs().maxCoeff();
  if (!(scale > 0)) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d shifted = h / scale - least_curvature * Eigen::Matrix3d::Identity();
  if (shifted.llt().info() == Eigen::Success) return h;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(h / scale);
  const Vector3 values = scale * eigen.eigenvalues().cwiseMax(least_curvature);
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

Matrix6 projected(const Matrix6& hessian, const ImageTriangle& image,
                  const std::array<TangentFrame, 3>& frames) {
  // Columns: infinitesimal rotations about two axes in the triangle's plane and about its centre.
  const TangentFrame axes = tangent_frame((image[0] + image[1] + image[2]).stableNormalized());
  const std::array<Vector3, 3> omega{axes.u, axes.v, axes.u.cross(axes.v)};
  Eigen::Matrix<double, 6, 3> rotations;
  for (size_t k = 0; k < 3; ++k) {
    for (int r = 0; r < 3; ++r) {
      const Vector3 velocity = omega[static_cast<size_t>(r)].cross(image[k]);
      rotations(2 * static_cast<int>(k), r) = velocity.dot(frames[k].u);
      rotations(2 * static_cast<int>(k) + 1, r) = velocity.dot(frames[k].v);
    }
  }
  const Matrix6 basis = Eigen::HouseholderQR<Eigen::Matrix<double, 6, 3>>(rotations).householderQ();
  const auto shape = basis.rightCols<3>();
  const auto spin = basis.col(2);
  const double spin_curvature = std::max(0.0, spin.dot(hessian * spin));
  return shape * positive_part(shape.transpose() * hessian * shape) * shape.transpose() +
         spin_curvature * spin * spin.transpose();
}

template <class T>
void sort_unique(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace

NewtonPatch::NewtonPatch(const Topology& topology, const RestTriangles& source,
                         const Points& points, std::vector<Vertex> free)
    : free_(std::move(free)) {
  std::sort(free_.begin(), free_.end());
  std::vector<Face> faces;
  for (const Vertex v : free_) {
    topology.for_each_outgoing(v, [&](Halfedge h) { faces.push_back(Topology::face(h)); });
  }
  sort_unique(faces);
  std::vector<Vertex> rim;
  for (const Face f : faces) {
    for (int k = 0; k < 3; ++k) {
      const Vertex v = topology.vertex(f, k);
      if (!std::binary_search(free_.begin(), free_.end(), v)) rim.push_back(v);
    }
  }
  sort_unique(rim);
  const auto local = [&](Vertex v) {
    const auto at = std::lower_bound(free_.begin(), free_.end(), v);
    if (at != free_.end() && *at == v) return static_cast<int>(at - free_.begin());
    return free_count() +
           static_cast<int>(std::lower_bound(rim.begin(), rim.end(), v) - rim.begin());
  };
  points_.resize(free_count() + static_cast<Eigen::Index>(rim.size()), 3);
  for (const std::vector<Vertex>* list : {&free_, &rim}) {
    for (const Vertex v : *list) points_.row(local(v)) = points.row(v);
  }
  for (const Face f : faces) {
    triangles_.push_back(
        {local(topology.vertex(f, 0)), local(topology.vertex(f, 1)), local(topology.vertex(f, 2))});
    source_.push_back(source[static_cast<size_t>(f)]);
  }
  make_pattern();
}

void NewtonPatch::make_pattern() {
  const int n = free_count();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_block = [&](int i, int j) {  // rows of i, columns of j, i ≥ j
    for (int p = 0; p < 2; ++p) {
      for (int q = 0; q < 2; ++q) {
        if (i > j || p >= q) entries.emplace_back(2 * i + p, 2 * j + q, 0.0);
      }
    }
  };
  for (int i = 0; i < n; ++i) add_block(i, i);
  for (const Corners& t : triangles_) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [j, i] = std::minmax(t[k], t[(k + 1) % 3]);
      if (i < n) add_block(i, j);
    }
  }
  hessian_.resize(2 * n, 2 * n);
  hessian_.setFromTriplets(entries.begin(), entries.end());

  const int* rows = hessian_.innerIndexPtr();
  const int* columns = hessian_.outerIndexPtr();
  for (const Corners& t : triangles_) {
    Corners blocks{-1, -1, -1};
    for (size_t k = 0; k < 3; ++k) {
      const auto [j, i] = std::minmax(t[k], t[(k + 1) % 3]);
      if (i >= n) continue;
      blocks[k] = static_cast<int>(
          std::lower_bound(rows + columns[2 * j], rows + columns[2 * j + 1], 2 * i) - rows);
    }
    blocks_.push_back(blocks);
  }
  factor_.analyzePattern(hessian_);
}

double NewtonPatch::energy_of(const DistortionEnergy& energy, const Points& points) const {
  double sum = 0;
  for (size_t f = 0; f < triangles_.size(); ++f) {
    const auto [d, s] = distortion(source_[f], image(triangles_[f], points));
    sum += source_[f].area * energy_density(energy, d, s);
  }
  return sum;
}

bool NewtonPatch::positive(const Points& points) const {
  return std::all_of(triangles_.begin(), triangles_.end(), [&](const Corners& t) {
    const ImageTriangle x = image(t, points);
    return orientation(x[0], x[1], x[2]) > 0;
  });
}

int NewtonPatch::folds() const {
  return static_cast<int>(
      std::count_if(triangles_.begin(), triangles_.end(), [&](const Corners& t) {
        const ImageTriangle x = image(t, points_);
        return orientation(x[0], x[1], x[2]) <= 0;
      }));
}

std::vector<double> NewtonPatch::stretches() const {
  std::vector<double> stretches;
  stretches.reserve(triangles_.size());
  for (size_t f = 0; f < triangles_.size(); ++f) {
    stretches.push_back(distortion(source_[f], image(triangles_[f], points_)).s);
  }
  return stretches;
}

void NewtonPatch::fit_source_area() {
  double area = 0, image_area = 0;
  for (size_t f = 0; f < triangles_.size(); ++f) {
    const ImageTriangle x = image(triangles_[f], points_);
    area += source_[f].area;
    image_area += triangle_area(x[0], x[1], x[2]);
  }
  if (!(image_area > 0)) return;
  for (RestTriangle& triangle : source_) triangle = scaled(triangle, image_area / area);
}

/// Adds a 6×6 matrix to the blocks of the lower triangle.
void NewtonPatch::scatter(const Corners& corners, const Corners& blocks, const Matrix6& h) {
  double* values = hessian_.valuePtr();
  const int* columns = hessian_.outerIndexPtr();
  for (int k = 0; k < 3; ++k) {
    const int v = corners[static_cast<size_t>(k)];
    if (v < free_count()) {
      values[columns[2 * v]] += h(2 * k, 2 * k);
      values[columns[2 * v] + 1] += h(2 * k + 1, 2 * k);
      values[columns[2 * v + 1]] += h(2 * k + 1, 2 * k + 1);
    }
    const int block = blocks[static_cast<size_t>(k)];
    if (block < 0) continue;
    const int next = (k + 1) % 3, w = corners[static_cast<size_t>(next)];
    const int row = v > w ? k : next, column = v > w ? next : k, j = std::min(v, w);
    // The second column has the same rows as the first but for the diagonal block's upper entry.
    const int second = columns[2 * j + 1] + (block - columns[2 * j]) - 1;
    for (int p = 0; p < 2; ++p) {
      values[block + p] += h(2 * row + p, 2 * column);
      values[second + p] += h(2 * row + p, 2 * column + 1);
    }
  }
}

void NewtonPatch::assemble(const DistortionEnergy& energy, const Frames& frames) {
  gradient_ = VectorX::Zero(2 * free_count());
  std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.0);
  for (size_t f = 0; f < triangles_.size(); ++f) {
    const Corners& t = triangles_[f];
    const ImageTriangle x = image(t, points_);
    const std::array<TangentFrame, 3> at{frames[static_cast<size_t>(t[0])],
                                         frames[static_cast<size_t>(t[1])],
                                         frames[static_cast<size_t>(t[2])]};
    const TriangleEnergy local = triangle_energy(energy, source_[f], x, at);
    scatter(t, blocks_[f], projected(local.hessian, x, at));
    for (int k = 0; k < 3; ++k) {
      const int v = t[static_cast<size_t>(k)];
      if (v < free_count()) gradient_.segment<2>(2 * v) += local.gradient.segment<2>(2 * k);
    }
  }
}

/// −H⁻¹g, the diagonal raised as little as makes that a descent direction; else −g / diagonal.
VectorX NewtonPatch::newton_direction() {
  const VectorX diagonal = hessian_.diagonal();
  for (double shift = first_shift; shift <= last_shift; shift *= 1e4) {
    hessian_.diagonal() = (1 + shift) * diagonal;
    factor_.factorize(hessian_);
    if (factor_.info() != Eigen::Success) continue;
    VectorX direction = factor_.solve(-gradient_);
    if (direction.allFinite() && gradient_.dot(direction) < 0) return direction;
  }
  const double floor = std::numeric_limits<double>::min();
  return -gradient_.cwiseQuotient(diagonal.cwiseMax(floor));
}

Points NewtonPatch::moved(const VectorX& direction, double t, const Frames& frames) const {
  Points points = points_;
  for (int v = 0; v < free_count(); ++v) {
    points.row(v) = frames[static_cast<size_t>(v)].at(points_.row(v), t * direction[2 * v],
                                                      t * direction[2 * v + 1]);
  }
  return points;
}

NewtonPatch::Step NewtonPatch::step(const DistortionEnergy& energy) {
  Frames frames(static_cast<size_t>(points_.rows()));
  for (size_t v = 0; v < frames.size(); ++v) {
    frames[v] = tangent_frame(points_.row(static_cast<Eigen::Index>(v)));
  }
  const double before = energy_of(energy, points_);
  assemble(energy, frames);
  const VectorX direction = newton_direction();
  const double decrement = -gradient_.dot(direction);
  double longest = 0;
  for (int v = 0; v < free_count(); ++v) {
    longest = std::max(longest, direction.segment<2>(2 * v).norm());
  }
  if (!(decrement > 0) || !std::isfinite(longest)) return {before, 0, false};
  double t = std::min(1.0, longest_step / longest);
  for (int i = 0; i < halvings; ++i, t /= 2) {
    Points candidate = moved(direction, t, frames);
    const double after = energy_of(energy, candidate);
    if (!(after < before - sufficient_decrease * t * decrement)) continue;
    if (!(energy.epsilon > 0) && !positive(candidate)) continue;
    points_ = std::move(candidate);
    return {after, decrement, true};
  }
  return {before, decrement, false};
}

void NewtonPatch::write_to(Points& points) const {
  for (size_t v = 0; v < free_.size(); ++v) {
    points.row(free_[v]) = points_.row(static_cast<Eigen::Index>(v));
  }
}

}  // namespace sphparam
