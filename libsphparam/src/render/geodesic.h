#pragma once

#include "render/render.h"

namespace sphparam {

/// The object as its map shows it: its triangles on the unit sphere, their sides as great circles.
///
/// Triangles with long sides are cut into smaller ones for the eye, with paint, lines and wireframe
/// of the whole: new points of the geodesic map f(Σ λᵢ vᵢ) = Σ λᵢ xᵢ / |Σ λᵢ xᵢ| carry Σ λᵢ of
/// their corners' colours and texture coordinates. The surface is lit as the sphere it is; only
/// triangles that fold are seen from behind, and darker. Requires: `rays` one a vertex, of unit
/// length. Cost: 0.1 µs a triangle; about 20,000 are added.
RenderObject on_sphere(const RenderObject& object, const Points& rays);

}  // namespace sphparam
