#pragma once

#include <ostream>
#include <vector>

#include "mapping/source_meshes.h"
#include "mapping/task_trial.h"

namespace sphparam::campaign {

/// Tables of Markdown: the tasks by everything that makes one, by the stage that made the map, and
/// by folder; then all that did not end with a certified map, and what was no mesh to map, by why.
void print_tables(const std::vector<SourceMesh>& meshes, const TaskRecords& records,
                  std::ostream& out);

/// There are tasks, all are certified, and no mesh was lost while it was read.
bool all_well(const std::vector<SourceMesh>& meshes, const TaskRecords& records);

}  // namespace sphparam::campaign
