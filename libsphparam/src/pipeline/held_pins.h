#pragma once

#include <vector>

#include "embedding/frame/landmarks.h"
#include "pipeline/map_in_progress.h"

namespace sphparam {

/// Given poles, unless they cannot be opposite, or the map has them and stays as it is, and the
/// given pins. Poles come first.
std::vector<Pin> wanted_pins(MapInProgress& work);

/// Tells how far the given pins are from their points. Are the poles, if they are among these pins,
/// at theirs? Then the map has them. Requires: pins, as `wanted_pins` gives them.
bool note_residuals(MapInProgress& work, const std::vector<Pin>& pins);

/// Embeds the mesh anew around the pins. The map so far says what they cost, and comes back where
/// that fails or poles alone are not reached. Pins of three corners that fold their triangle are in
/// no map: then no pin and no pole is tried, the map stays, and a warning names the three.
/// Requires: pins, as `wanted_pins` gives them.
void hold(MapInProgress& work, const std::vector<Pin>& pins);

}  // namespace sphparam
