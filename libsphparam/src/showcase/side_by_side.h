#pragma once

#include <optional>
#include <vector>

#include "render/render.h"

namespace sphparam {

/// A line from a point of the left object to one of the right one.
struct Link {
  Vector3 from, to;
  Rgb colour;
};

struct PairLook {
  Vector3 view{1, -1.6, 0.5};                    // from the objects towards the eye
  Vector3 up{0, 0, 1};                           // not along `view`
  int size = 480;                                // pixels, the height of the picture
  std::optional<Rgb> background = Rgb(1, 1, 1);  // none: transparent
  int threads = 0;
};

/// Two objects in one picture, on the same scale and seen from the same side, with links before
/// them. It is twice as wide as high or wider, so that both are seen whole.
/// Ensures: the same pixels for any number of threads. Cost: that of `render`.
Image side_by_side(RenderObject left, RenderObject right, const std::vector<Link>& links,
                   const PairLook& look);

}  // namespace sphparam
