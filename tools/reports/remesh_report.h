#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arguments/remesh_arguments.h"
#include "arguments/remesh_checks.h"
#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/displacement.h"
#include "sphparam/remesh/levels_of_detail.h"

namespace sphparam::cli {

/// What a run of `remesh` has to tell.
struct RemeshReport {
  const RemeshArguments& arguments;
  const RemeshRequests& requests;
  std::optional<Adaptation> adaptation = {};  // with --adaptive
  std::vector<LevelOfDetail> levels = {};     // the finest first; told where there are several
  std::optional<WrittenDisplacement> displacement = {};
  double grid_seconds = 0, seconds = 0;
};

inline constexpr char farther_warning[] =
    "--displace makes it worse: surface and image together are farther from the mesh than the "
    "surface alone";

/// For --json. The keys never change their meaning.
std::string to_json(const RemeshReport& report, const MappedMesh& source);

/// Lines for people.
void tell(const RemeshReport& report, const TriangleMesh& source, Console& console);

}  // namespace sphparam::cli
