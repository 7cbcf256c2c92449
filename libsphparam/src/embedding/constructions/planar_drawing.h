#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// A triangulated sphere drawn with straight edges inside one of its faces, on an integer grid.
struct PlanarDrawing {
  using Coordinates = RowTable<std::int64_t, 3>;

  Coordinates coordinates;  // #V×3 barycentric: none negative, every row adds up to `total`
  std::int64_t total = 0;   // weight of all faces but the outer one
};

/// Schnyder's drawing: coordinate i of a vertex is the weight of the faces in its i-th region.
///
/// Ensures: the outer face's corners are at the unit vectors times `total`; every other face has a
///          determinant of the sign opposite to the outer face's, exactly and whatever the weights.
///          So the drawing is one-to-one on all of the sphere but the outer face.
/// Requires: genus 0, at least three vertices, no two of them joined twice; weights: #F positive
///           integers, their sum below 2⁶¹ (that of `outer` is not read).
/// Cost: O(#V + #F), no recursion; 100 bytes a vertex.
/// Paper: Schnyder, "Embedding planar graphs on the grid" (1990); any positive weights: Dhandapani,
/// "Greedy drawings of triangulations" (2010).
PlanarDrawing draw_inside(const Topology& topology, Face outer,
                          const std::vector<std::int64_t>& weights);

}  // namespace sphparam
