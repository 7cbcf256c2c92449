#include "sphparam/group/procrustes.h"

#include <cmath>
#include <stdexcept>

#include "embedding/frame/nearest_rotation.h"
#include "group/shape_weights.h"
#include "option_domain.h"
#include "sphparam/parallel.h"

// All shapes are centred and, where wanted, scaled once. Then, in turn: each is turned to the mean,
// and the mean is that of the turned shapes, which never lets the sum of squares grow.

namespace sphparam {
namespace {

using Matrix3 = Eigen::Matrix3d;

size_t at(std::int64_t i) { return static_cast<size_t>(i); }

void require_alike(const std::vector<Points>& shapes, const VectorX& weights) {
  if (shapes.empty()) throw std::invalid_argument("Procrustes: there is no shape");
  for (const Points& shape : shapes)
    if (shape.rows() != weights.size())
      throw std::invalid_argument("Procrustes: not as many points in all shapes as weights");
  require_weights(weights);
}

Vector3 centre_of(const Points& points, const VectorX& weights) {
  return points.transpose() * weights;
}

Points centred(const Points& points, const Vector3& centre) {
  return points.rowwise() - centre.transpose();
}

/// Of centred points: RMS distance from the centre.
double size_of(const Points& points, const VectorX& weights) {
  return std::sqrt(points.rowwise().squaredNorm().dot(weights));
}

template <class Visit>
void for_each(const std::vector<Points>& shapes, int threads, const Visit& visit) {
  parallel_for(std::ssize(shapes), 1, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) visit(at(i));
  });
}

Points mean_of(const std::vector<Points>& shapes) {
  Points sum = Points::Zero(shapes.front().rows(), 3);
  for (const Points& shape : shapes) sum += shape;
  return sum / static_cast<double>(shapes.size());
}

void require_domain(const ProcrustesOptions& options, size_t shapes) {
  require_at_least("most_iterations", options.most_iterations, 1);
  require_at_least("tolerance", options.tolerance, 0);
  const VectorX& sizes = options.sizes;
  if (sizes.size() > 0 && static_cast<size_t>(sizes.size()) != shapes)
    throw std::invalid_argument("sizes: there are not as many as shapes");
  for (const double size : sizes) require_at_least("sizes", size, 0);
}

/// Centres and sizes, once and for all.
std::vector<ProcrustesMotion> placed(const std::vector<Points>& shapes, const VectorX& weights,
                                     const ProcrustesOptions& options) {
  std::vector<ProcrustesMotion> motions(shapes.size());
  for (size_t i = 0; i < shapes.size(); ++i) motions[i].centre = centre_of(shapes[i], weights);
  if (!options.scale) return motions;
  VectorX sizes = options.sizes;
  if (sizes.size() == 0) {
    sizes.resize(std::ssize(shapes));
    for (size_t i = 0; i < shapes.size(); ++i)
      sizes[static_cast<Eigen::Index>(i)] = size_of(centred(shapes[i], motions[i].centre), weights);
  }
  if (shapes.empty()) return motions;
  const double mean = sizes.mean();
  for (size_t i = 0; i < shapes.size(); ++i)
    if (const double size = sizes[static_cast<Eigen::Index>(i)]; size > 0)
      motions[i].scale = mean / size;
  return motions;
}

}  // namespace

Points moved(const Points& points, const ProcrustesMotion& motion) {
  const Matrix3 turn = motion.scale * motion.rotation;
  Points result(points.rows(), 3);
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    result.row(v) = (turn * (points.row(v).transpose() - motion.centre) + motion.place).transpose();
  return result;
}

Procrustes align_by_procrustes(const std::vector<Points>& shapes, const Points& reference,
                               const VectorX& weights, const ProcrustesOptions& options) {
  require_alike(shapes, weights);
  require_alike({reference}, weights);
  require_domain(options, shapes.size());
  Procrustes result;
  result.motions = placed(shapes, weights, options);
  const Vector3 place = centre_of(reference, weights);
  const Points wanted = centred(reference, place);
  result.mean = wanted;
  result.shapes.resize(shapes.size());
  const double size = size_of(wanted, weights);
  for (double change = 1; change > options.tolerance * size;) {
    for_each(shapes, options.threads, [&](size_t i) {
      ProcrustesMotion& motion = result.motions[i];
      motion.rotation = nearest_rotation(centred(shapes[i], motion.centre), result.mean, weights);
      result.shapes[i] = moved(shapes[i], motion);
    });
    Points mean = mean_of(result.shapes);
    mean = mean * nearest_rotation(mean, wanted, weights).transpose();
    change = size_of(mean - result.mean, weights);
    result.mean = std::move(mean);
    if (++result.iterations == options.most_iterations) break;
  }
  for_each(shapes, options.threads, [&](size_t i) {
    result.motions[i].place = place;
    result.motions[i].rotation =
        nearest_rotation(centred(shapes[i], result.motions[i].centre), result.mean, weights);
    result.shapes[i] = moved(shapes[i], result.motions[i]);
  });
  result.mean = mean_of(result.shapes);
  return result;
}

MatrixX procrustes_distances(const std::vector<Points>& shapes, const VectorX& weights,
                             int threads) {
  require_alike(shapes, weights);
  std::vector<Points> about_centre(shapes.size());
  for_each(shapes, threads,
           [&](size_t i) { about_centre[i] = centred(shapes[i], centre_of(shapes[i], weights)); });
  const Eigen::Index count = std::ssize(shapes);
  MatrixX distances = MatrixX::Zero(count, count);
  parallel_for(count, 1, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      for (std::int64_t j = 0; j < i; ++j) {
        const Points& a = about_centre[at(i)];
        const Points& b = about_centre[at(j)];
        const Points turned = a * nearest_rotation(a, b, weights).transpose();
        distances(i, j) = size_of(turned - b, weights);
      }
    }
  });
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = i + 1; j < count; ++j) distances(i, j) = distances(j, i);
  return distances;
}

}  // namespace sphparam
