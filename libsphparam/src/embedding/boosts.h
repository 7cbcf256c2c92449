#pragma once

#include <functional>
#include <vector>

#include "embedding/image_point.h"

namespace sphparam {

/// Carries a whole map by the Möbius transformation that lowers its energy most, found by a Newton
/// step in the three boosts. Returns the energy. `before`: that of the image.
/// Cost: up to 15 energies.
/// Our own. The boosts are those of Baden, Crane and Kazhdan, "Möbius Registration" (2018).
double recentre(std::vector<ImagePoint>& image, double before,
                const std::function<double(const std::vector<ImagePoint>&)>& energy_of,
                int threads);

}  // namespace sphparam
