#pragma once

#include "lanes.h"
#include "sphparam/mesh/triangle_mesh.h"

// The energy of one triangle, seen from its corner x. With rest edges a, b from x (capital: the
// image edges A = p − x, B = q − x), t = a·b/|a|², area ½|a × b| = F:
//   the squared Frobenius norm of the linear map is |A|²/|a|² + |B − tA|² |a|²/4F²,
//   so   F² d = α|A|² + β|B − tA|²   with α = F²/2|a|², β = |a|²/8,
// a sum of squares that no rounding makes negative, and S = F s = ½ det(x, A, B). Four numbers a
// corner, no division when it is evaluated.

namespace sphparam {

/// One triangle of the ring of each of a pack's vertices: the neighbour that begins it and what
/// the energy needs of the rest triangle (v, neighbour, next neighbour).
struct alignas(32) RingSlot {
  Vertex neighbour[pack_width];
  float alpha[pack_width];  // F² / 2|a|²; negative where the triangle is pressed
  float beta[pack_width];   // |a|² / 8; zero marks a slot beyond the vertex's valence
  float shear[pack_width];  // a·b / |a|²
};

}  // namespace sphparam
