#include "sphparam/words.h"

#include "number_text.h"

namespace sphparam {

std::string defect_list(const std::vector<MeshDefect>& defects) {
  std::string lines;
  for (const MeshDefect& defect : defects) {
    lines += "  " + defect.message + "\n";
    if (!defect.hint.empty()) lines += "    hint: " + defect.hint + "\n";
  }
  return lines;
}

std::string kept_line(const KeptParts& parts) {
  if (parts.count == 0 || parts.refused) return "";
  return "kept " + percent(parts.area_share, 5) + " of the area and " +
         percent(parts.face_share, 5) + " of the faces, lost " + percent(1 - parts.area_share, 2) +
         " and " + percent(1 - parts.face_share, 2);
}

std::string distortion_line(const DistortionSummary& distortion) {
  return "angle " + short_number(distortion.mean_abs_ln_angle) + " area " +
         short_number(distortion.mean_abs_ln_area);
}

std::string stage_line(const StageRecord& stage) {
  std::string line = stage.name + ": " + short_number(stage.seconds) + " s";
  if (stage.planar_folds >= 0) line += ", " + std::to_string(stage.planar_folds) + " planar folds";
  if (stage.folds >= 0) line += ", " + std::to_string(stage.folds) + " folds";
  if (stage.distortion) line += ", " + distortion_line(*stage.distortion);
  return line;
}

}  // namespace sphparam
