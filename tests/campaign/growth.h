#pragma once

#include "random.h"

namespace sphparam::campaign {

/// Replaces the star of v by a limb: `rings` copies of its link, each moved by `step` from the one
/// before and `taper` times as wide, v at the tip.
TriangleMesh with_limb(const TriangleMesh& mesh, Vertex v, int rings, const Vector3& step,
                       double taper);

/// Which face the next vertex goes into, of the three that the last one made.
enum class Stacking { Random, Fan, Spiral };

/// A vertex in a face, another one in one of the three faces that makes, and so on.
TriangleMesh with_stack(const TriangleMesh& mesh, Face face, int depth, Stacking stacking,
                        Random& random);

}  // namespace sphparam::campaign
