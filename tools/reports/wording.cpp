#include "reports/wording.h"

#include <cstdio>

namespace sphparam::cli {

std::string defect_list(const std::vector<MeshDefect>& defects) {
  std::string lines;
  for (const MeshDefect& defect : defects) {
    lines += "  " + defect.message + "\n";
    if (!defect.hint.empty()) lines += "    hint: " + defect.hint + "\n";
  }
  return lines;
}

std::string distortion_line(const DistortionSummary& distortion) {
  return "angle " + short_number(distortion.mean_abs_ln_angle) + " area " +
         short_number(distortion.mean_abs_ln_area);
}

std::string short_number(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace sphparam::cli
