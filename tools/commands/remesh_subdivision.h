#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"
#include "arguments/remesh_arguments.h"
#include "remesh/remesh.h"
#include "remesh/sphere_grid.h"
#include "remesh/subdivision_fit.h"

namespace sphparam::cli {

// `remesh --subdiv-fit` and `--limit-mesh`.

void declare_subdivision_options(CLI::App& command, RemeshArguments& arguments);

/// `grid`: none for a file's, whose faces are triangles. Throws UsageMistake for a scheme that the
/// grid's faces are not for, and for outputs that need a fit where there is none.
void check_subdivision(const RemeshArguments& arguments, const std::optional<GridSpec>& grid);

/// The words of the command line: "loop", "catmark".
std::string name_of(Scheme scheme);

/// Fits, and makes the new mesh the control mesh: the control points are its positions, the limit's
/// normals and curvatures at its vertices the properties nx ny nz, mean_curvature and
/// gauss_curvature. Throws: UsageMistake where the grid has vertices of too many faces; Cancelled.
SubdivisionFit fit_subdivision(const MappedMesh& mapped, Remeshed& result,
                               const RemeshArguments& arguments, Console& console);

/// The same mesh with its vertices on the limit surface.
Remeshed limit_mesh(Remeshed control, const SubdivisionFit& fit, int threads);

/// One line for people.
std::string fit_line(const SubdivisionFit& fit, const TriangleMesh& source);
/// For --json.
nlohmann::ordered_json fit_report(const SubdivisionFit& fit, const TriangleMesh& source);

}  // namespace sphparam::cli
