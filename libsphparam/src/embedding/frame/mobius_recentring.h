#pragma once

#include <functional>
#include <vector>

#include "embedding/energy/image_point.h"

namespace sphparam {

/// Carries a whole map by a Möbius transformation that lowers its energy: one Newton step in the
/// three recentrings, halved until it does. Where it does not the map stays. Returns the
/// energy; `before` is that of the image. Cost: up to 15 energies. Our own. The transformations are
/// those of Baden, Crane and Kazhdan, "Möbius Registration" (2018).
double recentre(std::vector<ImagePoint>& image, double before,
                const std::function<double(const std::vector<ImagePoint>&)>& energy_of,
                int threads);

}  // namespace sphparam
