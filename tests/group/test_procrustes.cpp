#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "sphparam/group/procrustes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

Eigen::Matrix3d rotation(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

Points some_shape(unsigned seed) {
  Points points = icosphere(2).positions * Eigen::Vector3d(3, 2, 1).asDiagonal();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, 0.1);
  for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] += normal(random);
  return points;
}

VectorX some_weights(Eigen::Index count) {
  VectorX weights(count);
  for (Eigen::Index v = 0; v < count; ++v) weights[v] = 1 + double(v % 7);
  return weights / weights.sum();
}

double farthest(const Points& a, const Points& b) { return (a - b).rowwise().norm().maxCoeff(); }

Points displaced(const Points& points, double angle, double scale) {
  return moved(points, {.rotation = rotation(angle, Vector3(1, 2, -angle)),
                        .scale = scale,
                        .place = Vector3(10 * angle, -3, 5)});
}

}  // namespace

TEST_CASE("procrustes: the mean of moved and turned copies of a shape is that shape, where it is") {
  const Points shape = displaced(some_shape(1), 0.4, 1);
  const VectorX weights = some_weights(shape.rows());
  const std::vector<Points> copies{displaced(shape, 1, 1), displaced(shape, -2, 1),
                                   displaced(shape, 3, 1)};
  const Procrustes found = align_by_procrustes(copies, shape, weights);
  CHECK(farthest(found.mean, shape) < 1e-12);
  for (size_t i = 0; i < copies.size(); ++i) {
    CHECK(farthest(found.shapes[i], shape) < 1e-12);
    CHECK(farthest(moved(copies[i], found.motions[i]), found.shapes[i]) == 0);
    CHECK(found.motions[i].rotation.determinant() == Approx(1));
    CHECK(found.motions[i].scale == 1);
  }
  CHECK(procrustes_distances(copies, weights).maxCoeff() < 1e-12);
}

TEST_CASE(
    "procrustes: copies of other sizes are brought to their mean size where wanted, only then") {
  const Points shape = some_shape(2);
  const VectorX weights = some_weights(shape.rows());
  const std::vector<Points> copies{displaced(shape, 1, 1), displaced(shape, -2, 2)};
  const Procrustes scaled = align_by_procrustes(copies, shape, weights, {.scale = true});
  const Vector3 centre = shape.transpose() * weights;
  const Points wanted = (shape.rowwise() - centre.transpose()) * 1.5;
  CHECK(farthest(scaled.mean.rowwise() - centre.transpose(), wanted) < 1e-12);
  CHECK(farthest(scaled.shapes[0], scaled.shapes[1]) < 1e-12);
  const Procrustes rigid = align_by_procrustes(copies, shape, weights);
  CHECK(farthest(rigid.shapes[0], rigid.shapes[1]) > 0.5);
}

TEST_CASE("procrustes: sizes that are given are those which are brought to their mean") {
  const Points shape = some_shape(4);
  const VectorX weights = some_weights(shape.rows());
  const std::vector<Points> copies{shape, shape, shape};
  ProcrustesOptions options{.scale = true, .sizes = Eigen::Vector3d(1, 2, 0)};
  const Procrustes found = align_by_procrustes(copies, shape, weights, options);
  CHECK(found.motions[0].scale == 1);
  CHECK(found.motions[1].scale == 0.5);
  CHECK(found.motions[2].scale == 1);  // it has no size
  options.sizes = Eigen::Vector2d(1, 2);
  CHECK_THROWS_WITH(align_by_procrustes(copies, shape, weights, options),
                    Catch::Contains("not as many as shapes"));
  for (const double bad : {-1.0, std::nan("")}) {
    options.sizes = Eigen::Vector3d(1, bad, 1);
    CHECK_THROWS_WITH(align_by_procrustes(copies, shape, weights, options),
                      Catch::StartsWith("sizes is"));
  }
}

TEST_CASE("procrustes: no small motion of a shape comes nearer to the mean, by the weights") {
  std::vector<Points> shapes;
  for (unsigned seed = 1; seed <= 4; ++seed)
    shapes.push_back(displaced(some_shape(seed), seed, 1 + 0.1 * seed));
  const VectorX weights = some_weights(shapes[0].rows());
  const Procrustes found = align_by_procrustes(shapes, shapes[0], weights);
  CHECK(found.iterations > 1);
  const auto squares = [&](const Points& points) {
    return (points - found.mean).rowwise().squaredNorm().dot(weights);
  };
  Points sum = Points::Zero(shapes[0].rows(), 3);
  for (const Points& shape : found.shapes) {
    sum += shape;
    const Vector3 centre = shape.transpose() * weights;
    for (int k = 0; k < 3; ++k) {
      for (const double step : {1e-3, -1e-3}) {
        const Eigen::Matrix3d turn = rotation(step, Vector3::Unit(k));
        CHECK(squares(moved(shape, {.rotation = turn, .centre = centre, .place = centre})) >
              squares(shape));
        CHECK(squares(moved(shape, {.place = step * Vector3::Unit(k)})) > squares(shape));
      }
    }
  }
  CHECK(farthest(sum / 4, found.mean) < 1e-12);
}

TEST_CASE("procrustes: a mirror image is not turned into the shape") {
  const Points shape = some_shape(3);
  Points mirrored = shape;
  mirrored.col(0) *= -1;
  const VectorX weights = some_weights(shape.rows());
  CHECK(procrustes_distances({shape, mirrored}, weights)(0, 1) > 0.1);
}

TEST_CASE("procrustes: distances are symmetric, and the same bits for any number of threads") {
  std::vector<Points> shapes;
  for (unsigned seed = 1; seed <= 7; ++seed) shapes.push_back(displaced(some_shape(seed), seed, 1));
  const VectorX weights = some_weights(shapes[0].rows());
  const MatrixX one = procrustes_distances(shapes, weights, 1);
  CHECK(one == one.transpose());
  CHECK(one.diagonal().norm() == 0);
  CHECK(one(1, 0) > 0.01);
  CHECK(procrustes_distances(shapes, weights, 3) == one);
  CHECK(align_by_procrustes(shapes, shapes[0], weights, {.threads = 1}).mean ==
        align_by_procrustes(shapes, shapes[0], weights, {.threads = 3}).mean);
}

TEST_CASE("procrustes: shapes that do not fit are refused") {
  const Points shape = some_shape(1);
  const VectorX weights = some_weights(shape.rows());
  CHECK_THROWS_AS(align_by_procrustes({}, shape, weights), std::invalid_argument);
  CHECK_THROWS_AS(align_by_procrustes({shape.topRows(3)}, shape, weights), std::invalid_argument);
  CHECK_THROWS_AS(procrustes_distances({shape}, weights.head(3)), std::invalid_argument);
  CHECK_THROWS_WITH(align_by_procrustes({shape}, shape, weights, {.tolerance = -1}),
                    Catch::StartsWith("tolerance is -1"));
}

TEST_CASE("procrustes: weights that are negative or do not sum to 1 are refused") {
  const Points shape = some_shape(1);
  const VectorX weights = some_weights(shape.rows());
  VectorX negative = weights, none = weights;
  negative[0] -= 1;
  negative[1] += 1;
  none[2] = std::nan("");
  for (const VectorX& bad : {negative, none, VectorX(2 * weights), VectorX(0 * weights)}) {
    CHECK_THROWS_AS(align_by_procrustes({shape}, shape, bad), std::invalid_argument);
    CHECK_THROWS_AS(procrustes_distances({shape}, bad), std::invalid_argument);
  }
  CHECK_THROWS_WITH(align_by_procrustes({shape}, shape, 2 * weights),
                    Catch::Contains("sum to 2: it must be 1"));
}
