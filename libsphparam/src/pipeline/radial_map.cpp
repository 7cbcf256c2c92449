#include "pipeline/radial_map.h"

#include <algorithm>
#include <vector>

#include "mesh/triangle_geometry.h"
#include "sphparam/sphere/radial_directions.h"

// x/|x| about a centre. Its folds are what the repair ladder is for: few are untangled where they
// are, and all else stays planetocentric, bit for bit.

namespace sphparam {
namespace {

bool is_filler(const MapInProgress& work, Face f) {
  const FillerMarks& fillers = work.options.fillers;
  return !fillers.empty() && fillers[static_cast<size_t>(f)];
}

/// What folds of the surface: fillers are none.
void note_folds(MapInProgress& work, RadialRecord& record) {
  const RestTriangles& source = work.source();
  double area = 0, all = 0;
  for (Face f = 0; f < std::ssize(source); ++f)
    if (!is_filler(work, f)) all += source[static_cast<size_t>(f)].area;
  for (const std::vector<Face>* faces :
       {&work.result.certificate.folded, &work.result.certificate.degenerate}) {
    for (const Face f : *faces) {
      if (is_filler(work, f)) continue;
      ++record.folds;
      area += source[static_cast<size_t>(f)].area;
    }
  }
  record.folded_area = record.folds > 0 ? area / all : 0;
}

}  // namespace

void map_radially(MapInProgress& work) {
  const Vector3 centre = work.options.centre;
  work.orientation = radial_directions(work.given, centre);
  work.record("radial projection", work.orientation);
  work.accept("radial projection", work.orientation);
  RadialRecord record{.centre = centre};
  if (work.result.certificate.fold_count() > 0) note_folds(work, record);
  work.result.radial = record;
}

void note_movement(MapInProgress& work) {
  RadialRecord& record = *work.result.radial;
  const SphereMap& map = work.result.map;
  const std::vector<Vertex> surface = surface_vertices(work);
  Vertex moved = 0;
  for (const Vertex v : surface) {
    const Vector3 x = map.point(v), direction = work.orientation.point(v);
    if (x == direction) continue;
    ++moved;
    record.largest_movement = std::max(record.largest_movement, angle_between(x, direction));
  }
  record.moved = static_cast<double>(moved) / static_cast<double>(surface.size());
}

std::vector<Vertex> surface_vertices(const MapInProgress& work) {
  std::vector<char> used(static_cast<size_t>(work.topology.vertex_count()), 0);
  for (Face f = 0; f < work.topology.face_count(); ++f) {
    if (is_filler(work, f)) continue;
    for (int k = 0; k < 3; ++k) used[static_cast<size_t>(work.topology.vertex(f, k))] = 1;
  }
  std::vector<Vertex> vertices;
  for (Vertex v = 0; v < work.topology.vertex_count(); ++v)
    if (used[static_cast<size_t>(v)]) vertices.push_back(v);
  return vertices;
}

}  // namespace sphparam
