#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Why a method that others published ended.
enum class BaselineEnd {
  Converged,       // by its own rule
  IterationLimit,  // not converged; the map is what it had by then
  Stalled,         // no step makes it better; the map is what it had by then
  NoResult,        // it does not apply, or a system could not be solved: there is no map
};

struct BaselineStage {
  std::string name;
  double seconds;  // wall time
  int iterations;  // 0: not iterative
};

/// What a method of others made of a mesh: as it came out, folded or not. Nothing is repaired.
///
/// The methods of this room are those the paper measures itself against (Sections 1, 2, 6), each
/// built from its authors' description, so that the comparison can be made again. They do not
/// promise a one-to-one map: `certify` tells. All throw std::invalid_argument for an option outside
/// of its domain, by name.
struct BaselineResult {
  std::optional<SphereMap> map;  // unit rays, finite; nothing exactly if `end` is NoResult
  BaselineEnd end = BaselineEnd::NoResult;
  int iterations = 0;     // of all stages
  std::string statement;  // why it ended, one sentence for people
  std::vector<BaselineStage> stages;
};

/// What a method of others says of itself, without its map.
struct BaselineAccount {
  BaselineEnd end = BaselineEnd::NoResult;
  int iterations = 0;     // of all stages
  std::string statement;  // why it ended
  std::string citation;
};

}  // namespace sphparam
