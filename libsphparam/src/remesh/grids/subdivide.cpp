// OpenSubdiv refines the topology; per level it knows which vertices, edges and faces of the level
// before each vertex comes from. Child vertices of vertices keep their numbers, so all levels share
// one array of points, filled level by level.

#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "elementary.h"
#include "remesh/grids/polyhedron.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr std::int64_t grain = 8192;

std::unique_ptr<Far::TopologyRefiner> refine(const Polyhedron& polyhedron, int levels) {
  const std::vector<int> degrees(polyhedron.faces.size() / polyhedron.degree, polyhedron.degree);
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(polyhedron.corners.size());
  descriptor.numFaces = static_cast<int>(degrees.size());
  descriptor.numVertsPerFace = degrees.data();
  descriptor.vertIndicesPerFace = polyhedron.faces.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const auto scheme = polyhedron.degree == 3 ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(descriptor, Factory::Options(scheme, Sdc::Options())));
  if (!refiner) throw std::logic_error("OpenSubdiv refuses a polyhedron");
  // The last level is asked for its faces only; what a level's edges become, the level knows.
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
  return refiner;
}

template <class Indices>
Vector3 middle(const Points& points, const Indices& corners) {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < corners.size(); ++i) sum += points.row(corners[i]);
  return sum / corners.size();
}

template <class Indices>
std::array<int, 4> as_parents(const Indices& corners) {
  std::array<int, 4> parents = {-1, -1, -1, -1};
  for (int i = 0; i < corners.size(); ++i) parents[static_cast<size_t>(i)] = corners[i];
  return parents;
}

class Filling {
 public:
  Filling(SphereGrid& grid, Placement placement, const GridOptions& options)
      : grid_(grid), placement_(placement), options_(options) {}

  /// Points of the level below, from those of `level`.
  void descend(const Far::TopologyLevel& level, bool faces_too) {
    for_all(level.GetNumEdges(),
            [&](int e) { put(level.GetEdgeChildVertex(e), level.GetEdgeVertices(e)); });
    if (!faces_too) return;
    for_all(level.GetNumFaces(),
            [&](int f) { put(level.GetFaceChildVertex(f), level.GetFaceVertices(f)); });
  }

 private:
  template <class Visit>
  void for_all(int count, const Visit& visit) const {
    parallel_for(count, grain, options_.threads, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<int>(first); i < static_cast<int>(last); ++i) visit(i);
    });
  }

  template <class Indices>
  void put(int vertex, const Indices& corners) const {
    const Vector3 point = middle(grid_.directions, corners);
    grid_.directions.row(vertex) = placement_ == Placement::Halved ? point.normalized() : point;
    if (options_.ancestry) grid_.parents[static_cast<size_t>(vertex)] = as_parents(corners);
  }

  SphereGrid& grid_;
  Placement placement_;
  const GridOptions& options_;
};

Polygons faces_of(const Far::TopologyLevel& level, int degree) {
  Polygons faces;
  const int count = level.GetNumFaces();
  faces.corners.resize(static_cast<size_t>(count) * static_cast<size_t>(degree));
  faces.starts.resize(static_cast<size_t>(count) + 1);
  for (int f = 0; f < count; ++f) {
    const auto corners = level.GetFaceVertices(f);
    const int start = f * degree;
    for (int k = 0; k < degree; ++k) faces.corners[static_cast<size_t>(start + k)] = corners[k];
    faces.starts[static_cast<size_t>(f) + 1] = start + degree;
  }
  return faces;
}

}  // namespace

Polyhedron icosahedron() {
  Polyhedron result{{Vector3::UnitZ()}, 3, {}};
  const double height = 1 / std::sqrt(5.0), radius = 2 / std::sqrt(5.0);
  for (int i = 0; i < 10; ++i) {  // five to the north, then five to the south between them
    const double angle = (i < 5 ? 2 * i : 2 * i + 1) * std::numbers::pi / 5;
    result.corners.push_back({radius * elementary::cos(angle), radius * elementary::sin(angle),
                              i < 5 ? height : -height});
  }
  result.corners.push_back(-Vector3::UnitZ());
  for (int i = 0; i < 5; ++i) {
    const int north = 1 + i, east = 1 + (i + 1) % 5, south = 6 + i, south_east = 6 + (i + 1) % 5;
    for (const int corner :
         {0, north, east, north, south, east, east, south, south_east, south, 11, south_east}) {
      result.faces.push_back(corner);
    }
  }
  return result;
}

Polyhedron octahedron() {
  Polyhedron result{{}, 3, {}};
  for (const int sign : {1, -1}) {
    for (int axis = 0; axis < 3; ++axis) result.corners.push_back(sign * Vector3::Unit(axis));
  }
  for (int octant = 0; octant < 8; ++octant) {
    const int x = octant & 1 ? 3 : 0, y = octant & 2 ? 4 : 1, z = octant & 4 ? 5 : 2;
    const bool mirrored = (octant & 1) ^ (octant >> 1 & 1) ^ (octant >> 2 & 1);
    for (const int corner : {x, mirrored ? z : y, mirrored ? y : z}) result.faces.push_back(corner);
  }
  return result;
}

Polyhedron cube() {
  Polyhedron result{{}, 4, {}};
  for (int i = 0; i < 8; ++i) {
    result.corners.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  }
  result.faces = {1, 3, 7, 5, 0, 4, 6, 2, 2, 6, 7, 3, 0, 1, 5, 4, 4, 5, 7, 6, 0, 2, 3, 1};
  return result;
}

SphereGrid subdivide(const Polyhedron& polyhedron, int levels, Placement placement,
                     const GridOptions& options) {
  const auto refiner = refine(polyhedron, levels);
  SphereGrid grid;
  const int count = refiner->GetLevel(levels).GetNumVertices();
  grid.directions.resize(count, 3);
  for (size_t v = 0; v < polyhedron.corners.size(); ++v) {
    grid.directions.row(static_cast<Eigen::Index>(v)) = polyhedron.corners[v];
  }
  if (options.ancestry) {
    grid.parents.resize(static_cast<size_t>(count));
    for (size_t v = 0; v < polyhedron.corners.size(); ++v) {
      grid.parents[v] = {static_cast<int>(v), -1, -1, -1};
    }
  }
  Filling filling(grid, placement, options);
  for (int l = 0; l <= levels; ++l) {
    const Far::TopologyLevel& level = refiner->GetLevel(l);
    grid.level_vertices.push_back(level.GetNumVertices());
    if (l < levels) filling.descend(level, polyhedron.degree == 4);
  }
  grid.faces = faces_of(refiner->GetLevel(levels), polyhedron.degree);
  return grid;
}

}  // namespace sphparam
