#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_source.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/self_crossings.h"
#include "sphparam/progress.h"

namespace sphparam {

/// What a mesh file holds, and all that is wrong with it. The reference is to a value that outlives
/// the record.
struct InspectionRecord {
  const MeshSource& source;
  std::optional<RepairTrial> repair = {};  // of a mesh that cannot be mapped as it is
  double seconds = 0;
  std::optional<PartsTrial> parts = {};         // where components must be chosen from
  std::optional<SelfCrossings> crossings = {};  // of what is surface; nothing: nobody looked
};

/// Counts the pairs of triangles of a mesh that cross, but for its fillers; of a soup it ends early
/// (`usual_looks`). Throws: Cancelled. Cost: as `find_self_crossings`.
SelfCrossings crossings_of(const MeshFile& file, int threads = 0, const Progress& progress = {});

/// Why a subcommand made nothing of a mesh.
struct RefusalRecord {
  std::string command;  // "map"
  std::string file;     // empty: nobody knows
  int code = 0;         // as the program exits
  std::string message;
  std::vector<MeshDefect> defects = {};    // none: it is no matter of these
  std::vector<RepairAction> repairs = {};  // done before it was refused
};

/// As --json of any subcommand tells it, in the place of its own report.
std::string to_json(const RefusalRecord& record);

/// As `sphparam info --json` tells it.
std::string to_json(const InspectionRecord& record);

/// Several lines for people.
std::string to_text(const InspectionRecord& record);

}  // namespace sphparam
