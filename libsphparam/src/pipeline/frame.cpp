#include "pipeline/frame.h"

#include <vector>

#include "embedding/frame/landmarks.h"
#include "pipeline/held_pins.h"
#include "pipeline/meridian.h"
#include "pipeline/poles_on_map.h"

// Given poles and pins are held while the mesh is embedded anew; automatic poles are chosen on the
// finished map, and its meridian.

namespace sphparam {

void place_frame(MapInProgress& work) {
  const std::vector<Pin> pins = wanted_pins(work);
  if (work.options.method == Method::Paper && !work.options.pins.empty()) {
    work.warn("the paper's method has no pins: they are where it puts them");
    if (!note_residuals(work, pins))
      work.warn("the repair has moved the poles: they are not at ±z");
  } else if (!pins.empty()) {
    hold(work, pins);
  }
  const bool free = pins.empty() && !work.options.poles && !work.result.poles;
  if (free && work.options.automatic_poles) {
    choose_poles_on_map(work);
  } else if (work.options.meridian) {
    turn(work, work.result.map, *work.options.meridian);
  }
}

}  // namespace sphparam
