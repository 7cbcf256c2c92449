#include "io/files/nearest_vertex.h"

#include <algorithm>
#include <limits>

namespace sphparam {

namespace {

double square(double x) { return x * x; }

}  // namespace

NearestVertex::NearestVertex(const TriangleMesh& mesh, const FileNumbers& numbers) {
  for (Vertex v = 0; v < mesh.vertex_count(); ++v)
    if (numbers.number(v) >= 0) places_.push_back({mesh.position(v), numbers.number(v)});
  std::ranges::stable_sort(places_, {}, [](const Place& place) { return place.position.x(); });
}

long NearestVertex::at(const Vector3& point) const {
  long nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  // Is it too far in x alone, as all behind it are?
  const auto is_beyond = [&](const Place& place) {
    if (square(place.position.x() - point.x()) > least) return true;
    const double distance = (place.position - point).squaredNorm();
    if (distance < least || (distance == least && place.number < nearest)) {
      least = distance;
      nearest = place.number;
    }
    return false;
  };
  const auto middle = std::ranges::lower_bound(
      places_, point.x(), {}, [](const Place& place) { return place.position.x(); });
  for (auto after = middle; after != places_.end() && !is_beyond(*after);) ++after;
  for (auto before = middle; before != places_.begin() && !is_beyond(*(before - 1));) --before;
  return nearest;
}

}  // namespace sphparam
