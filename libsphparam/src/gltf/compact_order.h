#pragma once

#include "sphparam/gltf/asset.h"

namespace sphparam {

/// The same surfaces with triangles and vertices in an order that compresses well: neighbours
/// follow each other, vertices come in the order of first use, unused ones go. Nothing else
/// changes; which corner of a triangle is first may.
/// Source: meshoptimizer, which EXT_meshopt_compression is made for.
Asset in_compact_order(Asset asset);

}  // namespace sphparam
