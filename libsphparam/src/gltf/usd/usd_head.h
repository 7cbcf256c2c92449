#pragma once

#include "gltf/usd/layer_text.h"

namespace sphparam {

/// What a layer says of itself: who wrote it, what the extras of an asset say, which prim it is of,
/// metres, y up.
void put_head(LayerText& text, const Asset& asset);

/// Where positions begin, of a mesh that is far from the origin.
void put_origin(LayerText& text, const Eigen::RowVector3d& origin);

/// v counted from the other end.
FloatRows upward(FloatRows uv);

}  // namespace sphparam
