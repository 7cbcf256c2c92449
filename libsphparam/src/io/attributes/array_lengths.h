#pragma once

#include <optional>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/polygons.h"

namespace sphparam {

// What readers make has a value for every vertex, face and corner; what a program puts together
// may not, and all that uses it would read past its end. All throw std::invalid_argument, which
// names the array.

/// Properties have a value a vertex or face; what corners have, a row a corner; what materials say
/// is there for each or for none, and faces name none that is not there where it is.
void require_array_lengths(const MeshFile& file);

/// Triangles name vertices that are there, at finite places.
void require_places(const TriangleMesh& mesh);

/// Polygons have corners that are vertices, and as many triangles as the mesh.
void require_polygons_of(const TriangleMesh& mesh, const Polygons& polygons);

}  // namespace sphparam
