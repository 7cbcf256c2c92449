#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"
#include "arguments/remesh_arguments.h"
#include "displace/displacement.h"
#include "sphparam/io/safe_file.h"
#include "remesh/remesh.h"
#include "remesh/subdivision_fit.h"

namespace sphparam::cli {

// `remesh --displace` and `--rebuild`: what the fitted surface leaves, and the proof that it is
// what was left.

void declare_displacement_options(CLI::App& command, RemeshArguments& arguments);

/// Throws UsageMistake: without a fit there is no limit surface to displace; for files and sizes
/// that are none.
void check_displacement(const RemeshArguments& arguments);

/// How far a surface is from the mesh, both ways.
struct RebuildError {
  double rms = 0, max = 0;
};

/// What became of it.
struct DisplacementReport {
  Displacement displacement;  // without its image
  double seconds = 0;
  struct Proof {
    std::int64_t vertices = 0, triangles = 0;
    bool certified = false;  // the directions of its vertices are a map of it
    RebuildError base, rebuilt;
    double seconds = 0;
    /// The image does harm, by RMS.
    bool farther_than_base() const { return rebuilt.rms > base.rms; }
  };
  std::optional<Proof> proof;
};

/// Adds the image, and the mesh that is rebuilt from it as it was read back from the disk.
/// Requires: options as `check_displacement` wants them; the fit on `result`'s grid.
/// Throws: UsageMistake where the depth cannot hold it; Cancelled; ImageError; WriteError.
DisplacementReport add_displacement(PendingFiles& files, const RemeshArguments& arguments,
                                    const MappedMesh& mapped, const Remeshed& result,
                                    const SubdivisionFit& fit, Console& console);

/// Lines for people.
std::string displacement_lines(const DisplacementReport& report, const TriangleMesh& source);
/// For --json.
nlohmann::ordered_json to_json(const DisplacementReport& report, const RemeshArguments& arguments);

}  // namespace sphparam::cli
