#include "pipeline/radial_map.h"

#include <algorithm>
#include <vector>

#include "mesh/triangle_geometry.h"
#include "sphparam/sphere/radial_directions.h"

// x/|x| about a centre. Its folds are what the repair ladder is for: few are untangled where they
// are, and all else stays planetocentric, bit for bit.

namespace sphparam {
namespace {

double share_of_area(const RestTriangles& source, const std::vector<Face>& faces) {
  double area = 0, all = 0;
  for (const RestTriangle& triangle : source) all += triangle.area;
  for (const Face f : faces) area += source[static_cast<size_t>(f)].area;
  return area / all;
}

}  // namespace

void map_radially(MapInProgress& work) {
  const Vector3 centre = work.options.centre;
  work.orientation = radial_directions(work.given, centre);
  work.record("radial projection", work.orientation);
  work.accept("radial projection", work.orientation);
  const Certificate& found = work.result.certificate;
  RadialRecord record{.centre = centre, .folds = found.fold_count()};
  if (record.folds > 0) {
    record.folded_area =
        share_of_area(work.source(), found.folded) + share_of_area(work.source(), found.degenerate);
  }
  work.result.radial = record;
}

void note_movement(MapInProgress& work) {
  RadialRecord& record = *work.result.radial;
  const SphereMap& map = work.result.map;
  Vertex moved = 0;
  for (Vertex v = 0; v < map.points.rows(); ++v) {
    const Vector3 x = map.point(v), direction = work.orientation.point(v);
    if (x == direction) continue;
    ++moved;
    record.largest_movement = std::max(record.largest_movement, angle_between(x, direction));
  }
  record.moved = static_cast<double>(moved) / static_cast<double>(map.points.rows());
}

}  // namespace sphparam
