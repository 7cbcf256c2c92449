#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"
#include "arguments/remesh_arguments.h"
#include "commands/remesh_level.h"
#include "remesh/sphere_grid.h"

namespace sphparam::cli {

// `remesh --lods`: the same mesh on coarser grids of the same family. Their vertices are the first
// ones of the finer grid's; plain samples of both are the same points. With --subdiv-fit each level
// is a fit of its own: nested in vertices and directions, as near to the mesh as each can be.

void declare_lod_options(CLI::App& command, RemeshArguments& arguments);

/// The command line of each level, finest first, as if it had been asked for alone: its grid, its
/// file. Throws UsageMistake where the grid has no such levels, or there is no file to name after.
std::vector<RemeshArguments> levels_asked_for(const RemeshArguments& arguments,
                                              const std::optional<GridSpec>& grid);

/// Measures all levels. Throws: Cancelled.
void measure_levels(std::vector<RemeshLevel>& levels, const MappedMesh& mapped, Console& console);

/// Lines for people.
std::string level_lines(const std::vector<RemeshLevel>& levels, const TriangleMesh& source);
/// For --json.
nlohmann::ordered_json to_json(const std::vector<RemeshLevel>& levels);

}  // namespace sphparam::cli
