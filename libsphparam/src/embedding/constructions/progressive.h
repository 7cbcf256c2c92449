#pragma once

#include <optional>

#include "embedding/frame/landmarks.h"
#include "embedding/sweeps/relaxation.h"
#include "mesh/mesh_hierarchy.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/embedding/quality.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/progress.h"

namespace sphparam {

struct ProgressiveOptions {
  DistortionEnergy energy = {};  // ε is not used: the map is valid at every moment
  Quality quality = Quality::Normal;
  double sweeps = 1.4;   // on the finest level; a level of n vertices gets √(N/n) times that,
                         // without protrusions (N/n)^0.3; ≥ 0
  int most_sweeps = 60;  // on any level; ≥ 0
  double over_relaxation = 1.7;  // first step tried, in Newton steps; 0 to `most_over_relaxation`
  int retries = 5;               // of a level whose vertices found no room; 0 to `most_retries`
  std::vector<Pin> pins = {};    // vertices that lie at given points; no vertex twice
  const SphereMap* free_map = nullptr;  // borrowed: of the mesh, bijective, made without the pins
  // Vertices of the level where pins are placed, 20 a pin if that is more; ≥ 0.
  int pin_level = 400;
  /// Triangles that are no surface, and what they may take of the sphere, 0 to 1: from some level
  /// on they are pressed (see `press_fillers`). The finest level gets sweeps alone of that: such a
  /// map is to be settled, and where sweeps do not suffice compared with one made without fillers.
  FillerMarks fillers = {};
  double filler_share = 1;
  /// Of the mean area, 0 to 1: smaller triangles count as equilateral ones of that size.
  double least_area = 1e-9;
  int threads = 0;  // 0: all cores
  Progress progress = {};
};

constexpr int most_retries = 20;  // each sweeps twice as often as the one before

struct ProgressiveReport {
  int levels = 0;
  int retries = 0;             // levels that had to be relaxed again before vertices found room
  long kernel_placements = 0;  // vertices that had no room in their ring where they belong
  std::vector<double> pin_residuals = {};  // radians from the point asked for; 0 is exact
  /// Estimated on the finest level: share of the energy that steps to come would take, and at least
  /// how far two other starts ended from each other, where they were needed. Nothing
  /// where the quality is Draft and coarser levels said that sweeps suffice.
  std::optional<double> energy_left = std::nullopt;
  double pressure = 0;  // that fillers needed on the last level where they were pressed, or 0
  bool sweeps_sufficed = false;  // no protrusions that sweeps creep along
  bool limbs = false;  // such protrusions on coarser levels too, or there were none to look at
  bool left_slivers = false;  // steps on the finest level ended where slivers cut them short
  bool demanding = false;     // has great energy, and has not had the finest level's steps
};

struct ProgressiveEmbedding {
  std::optional<SphereMap> map;  // nothing, when a vertex found no room although retried
  ProgressiveReport report;
};

/// Embeds a mesh on the sphere from coarse to fine: a tetrahedron first, then level by level the
/// removed vertices inside the kernels of their rings, then guarded relaxation of the level.
///
/// In exact arithmetic a kernel is never empty, so the method cannot fail; in doubles protrusions
/// of extreme length can run out of room, hence the retries and the optional result. Every
/// triangle's orientation is certain at every moment, none is ever folded. Pinned vertices stay in
/// the hierarchy down to a few hundred vertices; `place_landmarks` puts them there, and from there
/// on up nothing moves them, so that the rest is optimal around them. Requires: genus 0, finite
/// positions. Ensures: unit points; same bits for any number of threads
///           and any vector width of the machine. Throws: Cancelled; std::invalid_argument naming
///           an option outside of its domain.
/// Cost: O(#F). Sweeps solve no linear system; where they stall, on long protrusions, around
/// slivers and with Quality::Best, a bounded number of Newton steps does, each O(#F) by multigrid.
/// A shape with protrusions whose energy is much more than an isometry's is embedded once more, or
/// twice, by a nearly conformal energy that is led to the one asked for; one that ends far from its
/// energy up to three times more; with Quality::Best from less energy on, and where only the finest
/// level needs steps, up to three times more. Where a mesh has slivers (rest_floors.h), and they
/// cut steps short or left no room, or much is left in the end, all that is done as if they were
/// fatter, and they are slimmed in the end. A map with pressed fillers has one start. With a free
/// map its pins are led to their points where sweeps do not suffice, on all the mesh, and the rest
/// is done only if that comes no nearer to the pins and is higher, or the best is wanted.
/// Of the maps that come nearest to the pins the one of least energy is returned; where more than
/// 0.5 % of its energy is left (by Quality::Draft 3 %), or two starts end 1 % apart, after up to
/// 1200 steps (300; slimmed maps 60) as Quality::Best makes them. Paper: Praun and Hoppe,
/// "Spherical parametrization and remeshing" (2003); whole levels instead of single vertices, the
/// energy, the guard and the over-relaxed sweeps are our own.
ProgressiveEmbedding embed_progressively(const TriangleMesh& mesh, const Topology& topology,
                                         const ProgressiveOptions& options = {});

}  // namespace sphparam
