#include "embedding/energy/map_image.h"

namespace sphparam {

std::vector<ImagePoint> image_of(const SphereMap& map) {
  std::vector<ImagePoint> image(static_cast<size_t>(map.points.rows()));
  for (size_t v = 0; v < image.size(); ++v) {
    image[v] = image_point(map.point(static_cast<Vertex>(v)));
  }
  return image;
}

SphereMap map_of(const std::vector<ImagePoint>& image) {
  SphereMap map;
  map.points.resize(static_cast<Eigen::Index>(image.size()), 3);
  for (size_t v = 0; v < image.size(); ++v) {
    map.points.row(static_cast<Vertex>(v)) = image[v].vector();
  }
  return map;
}

}  // namespace sphparam
