#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam {

// What was found, in words for people. `verdict` and `complaint` of a certificate are beside it.

/// Several lines: every defect with its hint, indented by two.
std::string defect_list(const std::vector<MeshDefect>& defects);

/// "kept 99.7 % of the area and 98 % of the faces, lost 0.3 % and 2 %", with "; 420 faces had no
/// area that can be measured" where vertices without a place took faces with them; empty where
/// nothing was dropped. actions: of the same repair.
std::string kept_line(const KeptParts& parts, const std::vector<RepairAction>& actions = {});

/// "cut along 5 edges, 2.13 long (1.2 % of the diagonal), about (1, 2, 3): area 0.31 added"; also
/// "closed along …".
std::string handle_line(const HandleLoop& loop);

/// Such lines for the first of them, then how many more there are; each ends with a line break.
std::string handle_lines(const std::vector<HandleLoop>& loops, const std::string& indent);

/// " (but for 3 triangles too thin on the sphere)": what a mean of angles leaves out; empty:
/// nothing.
std::string flat_images_words(const DistortionSummary& distortion);

/// "angle 0.55 area 0.59": the paper's means of |ln ratio|.
std::string distortion_line(const DistortionSummary& distortion);

/// "planetocentric: the surface is star-shaped about (0, 0, 0)", or what folds there and how far
/// the map had to go from these directions. A centre that is farther from the origin than the
/// body is long has as many digits as its places want; a length of 0: three.
std::string radial_line(const RadialRecord& radial, double length = 0);

/// "harmonic: 0.12 s, 3 folds, angle 0.55 area 0.59"
std::string stage_line(const StageRecord& stage);

}  // namespace sphparam
