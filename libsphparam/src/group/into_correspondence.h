#pragma once

#include <string>
#include <vector>

#include "sphparam/correspondence/match.h"
#include "sphparam/group/group.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// What shapes are brought to: the template, or their mean.
struct GroupTarget {
  MappedMesh mapped;
  Functions signals = {};       // what turns are judged by, where rotations are looked for
  bool symmetric = false;       // these look the same in several positions: any of them is right
  Functions aligned = {};       // its harmonics on its axes, where ellipsoids are,
  Eigen::Matrix3d sphere = {};  // and how its sphere was turned for them
};

/// Cost: a fit of harmonics, unless `start` is Maps.
GroupTarget group_target(const MappedMesh& mapped, GroupStart start, bool alike, int threads);

/// A shape in correspondence.
struct Brought {
  MappedMesh mapped;
  std::string start;
  double energy = 0, confidence = 1;
  std::vector<std::string> doubts = {}, warnings = {};  // of the start, of the last minimisation
  bool mirrored = false;
};

/// Moves the map of a shape to that of the target: from `start` on, then, unless that is to be
/// held, to the least energy of shape → target. Throws: NotCertifiedError where the turned map
/// folds by rounding; as `match_surfaces`.
Brought bring_to(const GroupTarget& target, const MappedMesh& shape, GroupStart start, bool hold,
                 const MatchOptions& options);

/// The same of the shape, or of its mirror image where that fits clearly better: see
/// `GroupOptions::mirror`. Cost: twice that, and a pass.
Brought bring_either_to(const GroupTarget& target, const MappedMesh& shape, GroupStart start,
                        bool hold, const MatchOptions& options);

}  // namespace sphparam
