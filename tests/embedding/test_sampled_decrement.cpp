#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "embedding/constructions/progressive.h"
#include "embedding/newton/sampled_decrement.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

struct Level {
  explicit Level(const TriangleMesh& mesh)
      : topology(mesh), hierarchy(build_hierarchy(mesh, topology, 1)) {
    for (size_t l = hierarchy.size() - 1; l-- > 0;) {
      complete_positions(hierarchy[l], hierarchy[l + 1], 1);
    }
  }

  double sample(const std::vector<ImagePoint>& image) const {
    const std::vector<float> even(image.size(), 1.0F);
    return sampled_decrement(hierarchy.front(), 1e-14, image, even, {}, 1);
  }

  Topology topology;
  MeshHierarchy hierarchy;
};

std::vector<ImagePoint> image_of(const Points& points) {
  std::vector<ImagePoint> image;
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    image.push_back(image_point(Vector3(points.row(v)).normalized()));
  }
  return image;
}

}  // namespace

TEST_CASE("sampled decrement: next to nothing at the least energy, much beside it") {
  const TriangleMesh mesh = with_slivers(icosphere(4), 0.2, 0.01, 1);
  const Level level(mesh);
  const ProgressiveEmbedding best =
      embed_progressively(mesh, level.topology, {.quality = Quality::Best});
  std::vector<ImagePoint> image = image_of(best.map->points);
  const double least = level.sample(image);
  CHECK(least < 1e-4);

  // Vertices that lie near others move a little: their triangles are slivers.
  std::mt19937 random(3);
  for (size_t v = 2562; v < image.size(); ++v) {
    const Vector3 away(1e-4 * static_cast<double>(random() % 100) / 100, 0, 0);
    image[v] = image_point((image[v].vector() + away).normalized());
  }
  CHECK(level.sample(image) > 100 * least);
}

TEST_CASE("sampled decrement: a patch whose triangles are not certain is all there is to gain") {
  const TriangleMesh mesh = icosphere(2);
  const Level level(mesh);
  std::vector<ImagePoint> image = image_of(mesh.positions);
  CHECK(level.sample(image) < 0.01);
  for (ImagePoint& point : image) point = image[0];
  CHECK(level.sample(image) == 1);
}
