#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/mesh/topology.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

enum class DefectKind {
  // The mesh cannot be mapped to a sphere:
  Empty,                    // no faces at all
  IndexOutOfRange,          // faces that name a vertex that is not there
  NonFinitePosition,        // vertices with NaN or infinite coordinates
  RepeatedVertex,           // faces that name one vertex twice
  DuplicateFace,            // faces with the same three vertices as another
  BoundaryEdge,             // edges with one face
  NonManifoldEdge,          // edges with three or more faces
  InconsistentOrientation,  // edges whose two faces run through them the same way
  NonManifoldVertex,        // vertices where two or more fans of faces touch
  SeveralComponents,
  WrongGenus,
  // Odd, but harmless; the mesh is mapped all the same:
  UnusedVertex,  // but this, which readers of files drop: arrays with it are refused
  ZeroAreaFace,
  CoincidentVertices,
  InsideOut,  // negative volume
};

/// One kind of defect, all its places.
struct MeshDefect {
  DefectKind kind;
  bool fatal;                 // no map to the sphere exists while this stands
  long count;                 // how many places
  std::vector<int> elements;  // ids (0-based) of the first places: vertices or faces, see `message`
  std::string message;        // "12 boundary edges (open mesh): first at vertices 4–17, …"
  std::string hint;           // what the user can do about it; may be empty
};

/// What a mesh is and everything that is wrong with it.
struct MeshInspection {
  long vertices = 0;
  long used_vertices = 0;
  long edges = 0;
  long faces = 0;
  long components = 0;
  long boundary_loops = 0;
  long euler_characteristic = 0;  // of the used vertices
  long genus = -1;                // of the one component; -1 where it has no meaning
  double area = 0;
  double volume = 0;  // signed; positive when the faces are counter-clockwise from outside
  Vector3 lower = Vector3::Zero();  // of the box about the used vertices
  Vector3 upper = Vector3::Zero();
  std::vector<MeshDefect> defects;  // fatal ones first

  /// True when the mesh is a closed genus-0 manifold, so that a map to the sphere exists.
  bool is_sphere() const;
};

/// Lists all defects of a mesh, not only the first. Never throws on bad meshes, but
/// std::length_error on one of more than INT_MAX/3 faces or INT_MAX vertices, which have no
/// numbers. Cost: O(#V + #F) plus a sort of the vertices by position.
MeshInspection inspect_mesh(const TriangleMesh& mesh);

/// A mesh that cannot be used, with the reasons.
class MeshError : public std::runtime_error {
 public:
  explicit MeshError(std::vector<MeshDefect> defects);
  const std::vector<MeshDefect>& defects() const { return defects_; }

 private:
  std::vector<MeshDefect> defects_;
};

/// The gate in front of all arithmetic: the topology of a mesh that can be mapped to the sphere.
/// Throws: MeshError with every defect that stands in the way, unless the mesh is a closed genus-0
///         manifold with finite positions and no unused vertices; length_error as `Topology`.
/// Cost: that of `Topology`; the full inspection runs only for meshes that fail. `threads`, 0: all
/// cores.
Topology require_sphere(const TriangleMesh& mesh, int threads = 0);
/// The same for a mesh whose topology is there already. Requires: no unused vertices.
void require_sphere(const TriangleMesh& mesh, const Topology& topology);

}  // namespace sphparam
