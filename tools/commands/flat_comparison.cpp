// A smooth surface on too few control points is farther from a mesh than flat faces on them.

#include "commands/flat_comparison.h"

#include "commands/measurable.h"

namespace sphparam::cli {

namespace {

constexpr std::int64_t comparing_samples = 50'000;  // on each side

}  // namespace

void compare_with_flat(RemeshLevel& level, const TriangleMesh& flat, const MappedMesh& mapped,
                       Console& console) {
  const auto rms = [&](const TriangleMesh& mesh) {
    return distance_on_grid(
               mapped.file().mesh, mesh, level.arguments.grid,
               {.samples = comparing_samples,
                .threads = level.arguments.threads,
                .progress = [&](std::string_view s, double f) { return console.progress(s, f); }})
        .rms();
  };
  SubdivisionFit& fit = level.fit.value();
  fit.two_sided_rms = rms(shown_mesh(level));
  fit.flat_rms = rms(flat);
  if (fit.two_sided_rms <= fit.flat_rms) return;
  console.warning(level.arguments.grid +
                  " is too coarse for a smooth surface: flat faces on it are nearer to the mesh "
                  "than what was fitted");
}

}  // namespace sphparam::cli
