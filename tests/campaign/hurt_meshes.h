#pragma once

#include <string>
#include <vector>

#include "random.h"

namespace sphparam::campaign {

/// A small mesh whose positions have been hurt, as files carry it.
struct HurtMesh {
  std::string story;  // "box of quads, one vertex at 1e160"
  TriangleMesh mesh;
  std::vector<std::vector<Vertex>> polygons;  // empty: the triangles
  Eigen::MatrixX2d texcoords;                 // a row a vertex; none: no rows
};

/// A closed genus-0 manifold of 4 to some 200 vertices, its positions finite and anything else:
/// coincident, on a line, in a plane, slivers, one far away, of every size that doubles have.
HurtMesh make_hurt_mesh(Random& random);

/// In a format that keeps doubles, told by the ending: .off, .obj (with polygons and texture
/// coordinates) or .ply (with colours and a property `depth`).
std::string as_file(const HurtMesh& mesh, const std::string& extension);

}  // namespace sphparam::campaign
