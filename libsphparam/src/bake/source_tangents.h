#pragma once

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The frame in which a mesh's own normal map is written: at every corner the tangent along growing
/// s, unit and orthogonal to the normal, and whether (s, t) are mirrored there: the bitangent is
/// w · N × T and points to growing t. Zero where (s, t) grow in no direction: an image has no
/// slopes there.
struct SourceTangents {
  Points normals;                // #F·3 rows, unit
  RowTable<double, 4> tangents;  // #F·3 rows: T, w
};

/// Tangents of a mesh by its texture coordinates, as most programs that bake normal maps take them:
/// at each vertex, the faces with one normal, one (s, t) and one handedness there share the mean of
/// their tangents, each projected to the normal's plane and weighted by the angle there.
/// `vertex_normals` #V×3, unit: those of the corners where the file has none.
/// Requires: a row of `texcoords` a corner. Cost: one pass and a hash table.
/// Source: M. Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008, Section 4.
SourceTangents source_tangents(const MeshFile& file, const Points& vertex_normals,
                               const CornerTexcoords& texcoords);

}  // namespace sphparam
