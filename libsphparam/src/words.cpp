#include "sphparam/words.h"

#include <algorithm>
#include <numbers>

#include "mesh/repair/repair_kinds.h"
#include "number_text.h"
#include "place_text.h"

namespace sphparam {

std::string defect_list(const std::vector<MeshDefect>& defects) {
  std::string lines;
  for (const MeshDefect& defect : defects) {
    lines += "  " + defect.message + "\n";
    if (!defect.hint.empty()) lines += "    hint: " + defect.hint + "\n";
  }
  return lines;
}

std::string kept_line(const KeptParts& parts, const std::vector<RepairAction>& actions) {
  const long unmeasured = count_of(actions, RepairKind::NonFiniteFaceRemoved);
  if (parts.refused || (parts.count == 0 && unmeasured == 0)) return "";
  const std::string kept = "kept " + percent(parts.area_share, 5) + " of the area and " +
                           percent(parts.face_share, 5) + " of the faces, lost " +
                           percent(1 - parts.area_share, 2) + " and " +
                           percent(1 - parts.face_share, 2);
  if (unmeasured == 0) return kept;
  return kept + "; " + counted(unmeasured, "face", "faces") + " had no area that can be measured";
}

std::string handle_line(const HandleLoop& loop) {
  return std::string(loop.filled ? "closed" : "cut") + " along " +
         counted(std::ssize(loop.vertices), "edge", "edges") + ", " + short_number(loop.length) +
         " long (" + percent(loop.share) + " of the diagonal), about (" +
         place_text(loop.centre, loop.length) + "): area " + short_number(loop.area_added) +
         " added" + (loop.crossings > 0 ? ", passing through the surface" : "");
}

std::string handle_lines(const std::vector<HandleLoop>& loops, const std::string& indent) {
  constexpr size_t told = 10;
  std::string lines;
  for (size_t i = 0; i < std::min(loops.size(), told); ++i) {
    lines += indent + handle_line(loops[i]) + "\n";
  }
  if (loops.size() <= told) return lines;
  double longest = 0;
  long crossing = 0;
  for (const HandleLoop& loop : loops) {
    longest = std::max(longest, loop.share);
    crossing += loop.crossings > 0;
  }
  return lines + indent + "and " + std::to_string(loops.size() - told) +
         " more; the longest of all has " + percent(longest) + " of the diagonal; " +
         (crossing == 0 ? "none passes" : std::to_string(crossing) + " of all pass") +
         " through the surface\n";
}

std::string flat_images_words(const DistortionSummary& distortion) {
  if (distortion.flat_images == 0) return "";
  return " (but for " + counted(distortion.flat_images, "triangle") + " too thin on the sphere)";
}

std::string distortion_line(const DistortionSummary& distortion) {
  return "angle " + short_number(distortion.mean_abs_ln_angle) + flat_images_words(distortion) +
         " area " + short_number(distortion.mean_abs_ln_area) +
         (distortion.flat_faces == 0
              ? ""
              : " (without " + counted(distortion.flat_faces, "triangle") + " of no area)");
}

std::string radial_line(const RadialRecord& radial, double length) {
  const Vector3& c = radial.centre;
  const bool is_far = length > 0 && c.cwiseAbs().maxCoeff() > length;
  const std::string centre = is_far ? "(" + place_text(c, length) + ")"
                                    : "(" + short_number(c.x()) + ", " + short_number(c.y()) +
                                          ", " + short_number(c.z()) + ")";
  if (radial.folds == 0 && radial.moved == 0) {
    return "planetocentric: the surface is star-shaped about " + centre;
  }
  constexpr double degrees = 180 / std::numbers::pi;
  const std::string folds =
      radial.folds == 0 ? "star-shaped about " + centre + ", but what closes its holes folds"
                        : "not star-shaped about " + centre + ": " +
                              counted(radial.folds, "triangle folds", "triangles fold") + ", " +
                              percent(radial.folded_area) + " of the area";
  if (radial.moved == 0) return folds;
  const std::string most = ", by " + short_number(radial.largest_movement * degrees) + "° at most";
  if (radial.moved == 1) return folds + "; all vertices moved" + most + ": none is planetocentric";
  return folds + "; " + percent(radial.moved) + " of the vertices moved" + most +
         ", the others are planetocentric";
}

std::string stage_line(const StageRecord& stage) {
  std::string line = stage.name + ": " + short_number(stage.seconds) + " s";
  if (stage.planar_folds >= 0) line += ", " + std::to_string(stage.planar_folds) + " planar folds";
  if (stage.folds >= 0) line += ", " + std::to_string(stage.folds) + " folds";
  if (stage.distortion) line += ", " + distortion_line(*stage.distortion);
  return line;
}

}  // namespace sphparam
