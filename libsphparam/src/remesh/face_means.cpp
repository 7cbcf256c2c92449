// Counting sort by face of the grid: within one, faces of the source come in order.

#include "remesh/face_means.h"

#include <numeric>
#include <optional>

#include "mesh/flat_face.h"
#include "mesh/unit_size.h"
#include "remesh/grid_domain.h"
#include "sphparam/sphere/sphere_locator.h"

namespace sphparam {

namespace {

/// On the sphere, of unit length.
Points middles_of(const MappedMesh& source) {
  const Triangles& triangles = source.mesh().triangles;
  Points middles(triangles.rows(), 3);
  for (Face f = 0; f < triangles.rows(); ++f) {
    Vector3 sum = Vector3::Zero();
    for (const Vertex v : triangles.row(f)) sum += source.map().point(v);
    middles.row(f) = sum.normalized();
  }
  return middles;
}

VectorX relative_face_areas(const TriangleMesh& mesh) {
  const std::optional<Rescaled> unit = at_unit_size(mesh);
  VectorX areas(mesh.face_count());
  for (Face f = 0; f < mesh.face_count(); ++f) areas[f] = face_area(unit ? unit->mesh : mesh, f);
  return areas;
}

/// Which polygon each triangle of their fans is of.
std::vector<std::int64_t> polygons_of_fans(const Polygons& faces) {
  std::vector<std::int64_t> result;
  for (std::int64_t f = 0; f < faces.count(); ++f)
    result.insert(result.end(), static_cast<size_t>(faces.degree(f) - 2), f);
  return result;
}

/// For each face of the source that counts the grid's face that its middle lies in; else −1.
std::vector<std::int64_t> faces_of_grid(const MappedMesh& source, const VectorX& areas,
                                        const SphereGrid& grid, int threads) {
  const Topology topology(as_triangles(grid.faces), static_cast<int>(grid.directions.rows()),
                          threads);
  const std::vector<std::int64_t> polygons = polygons_of_fans(grid.faces);
  const SphereMap map{grid.directions};
  const std::vector<SurfacePoint> places =
      SphereLocator(topology, map, threads).locate_all(middles_of(source), threads);
  const FillerMarks& fillers = source.fillers();
  std::vector<std::int64_t> result(places.size(), -1);
  for (size_t f = 0; f < places.size(); ++f) {
    const bool counts = areas[static_cast<Face>(f)] > 0 && (fillers.empty() || fillers[f] == 0);
    if (counts) result[f] = polygons[static_cast<size_t>(places[f].face)];
  }
  return result;
}

void normalise(Gather& gather, size_t face) {
  const auto first = gather.weights.begin() + gather.starts[face];
  const auto last = gather.weights.begin() + gather.starts[face + 1];
  const double sum = std::accumulate(first, last, 0.0);
  for (auto weight = first; weight != last; ++weight) *weight /= sum;
}

}  // namespace

Gather gather_faces(const MappedMesh& source, const SphereGrid& grid,
                    const std::vector<SurfacePoint>& middles, int threads) {
  const VectorX areas = relative_face_areas(source.mesh());
  const std::vector<std::int64_t> of_grid = faces_of_grid(source, areas, grid, threads);
  std::vector<std::int64_t> held(middles.size(), 0);
  for (const std::int64_t to : of_grid)
    if (to >= 0) ++held[static_cast<size_t>(to)];
  const auto has_mean = [&held](size_t face) { return held[face] > 1; };
  Gather result;
  result.starts.assign(middles.size() + 1, 0);
  for (size_t g = 0; g < middles.size(); ++g)
    result.starts[g + 1] = result.starts[g] + (has_mean(g) ? held[g] : 1);
  result.vertices.resize(static_cast<size_t>(result.starts.back()));
  result.weights.resize(result.vertices.size(), 1);
  std::vector<std::int64_t> next(result.starts.begin(), result.starts.end() - 1);
  for (size_t f = 0; f < of_grid.size(); ++f) {
    if (of_grid[f] < 0 || !has_mean(static_cast<size_t>(of_grid[f]))) continue;
    const auto at = static_cast<size_t>(next[static_cast<size_t>(of_grid[f])]++);
    result.vertices[at] = static_cast<Face>(f);
    result.weights[at] = areas[static_cast<Face>(f)];
  }
  for (size_t g = 0; g < middles.size(); ++g) {
    if (has_mean(g))
      normalise(result, g);
    else
      result.vertices[static_cast<size_t>(result.starts[g])] = middles[g].face;
  }
  return result;
}

}  // namespace sphparam
