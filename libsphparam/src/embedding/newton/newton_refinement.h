#pragma once

#include <optional>
#include <vector>

#include "embedding/energy/image_point.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/embedding/quality.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

/// What Quality::Best may take on the finest level.
struct Budget {
  double work = 2e6;                         // steps × vertices
  int least_steps = 300, most_steps = 3000;  // however large or small the mesh
};

struct RefinementOptions {
  Quality quality = Quality::Normal;
  DistortionEnergy energy = {};
  int threads = 0;  // 0: all cores
  Progress progress = {};
  Budget budget = {};
  double fatness = 0;     // μ of rest_floors.h
  int finest_steps = 60;  // at most, but by Quality::Best
  // Steps on the finest level of a mesh with slivers end where so many in a row were cut short; 0:
  // no matter.
  int most_blocked = 0;
};

/// Which part of the progress of a whole embedding a level's steps are: fractions.
struct ProgressShare {
  double begin = 0, end = 1;
};

/// Newton steps on some levels of a progressive embedding, for shapes with long protrusions or
/// slivers: sweeps creep along the curved valley of their energy, Newton steps do not. On other
/// shapes one cheap step on the coarse levels and a sample of the finest find that out, and nothing
/// else is done. Our own. Cost: see newton_refinement.cpp.
class NewtonRefinement {
 public:
  NewtonRefinement(int finest_vertices, RefinementOptions options);

  /// Is it left to `note_sampled_decrement` whether the finest level is due?
  bool finest_is_open() const;
  /// Something else has shown that sweeps do not suffice.
  void note_protrusions() { protrusions_ = true; }
  /// What `sampled_decrement` says of the finest level: more than a little makes it due.
  void note_sampled_decrement(double share);
  /// Is a level with so many vertices to be improved?
  bool due(int vertices) const;
  /// Has it found that sweeps do all there is to do? False as long as it does not know.
  bool sweeps_suffice() const;
  /// Lowers the energy of the image, as far as it pays. `pinned` vertices stay. Reports after
  /// every step, within its share of the progress. Throws: Cancelled; then the image is lost.
  void improve(const TriangleMesh& mesh, const Topology& topology,
               const std::vector<Vertex>& pinned, std::vector<ImagePoint>& image,
               ProgressShare share = {});
  /// Estimate of the share of the finest level's energy that more steps would take; nothing as long
  /// as nobody has looked.
  std::optional<double> energy_left() const { return energy_left_; }
  /// Steps on the finest level were left because of slivers; `energy_left` is 1 then.
  bool left_slivers() const { return left_slivers_; }

 private:
  RestTriangles source_of(const TriangleMesh& mesh) const;
  /// Steps alone.
  void descend(const TriangleMesh& mesh, const Topology& topology,
               const std::vector<Vertex>& pinned, std::vector<ImagePoint>& image,
               ProgressShare share);

  RefinementOptions options_;
  int finest_;
  int next_;          // vertices of the next level to be improved, at least
  double last_gain_;  // on the level improved last: of the first step, or what it promised
  std::optional<double> energy_left_;
  bool protrusions_ = false;
  bool left_slivers_ = false;
  bool slivers_ = false;  // a sample of the finest level says that sweeps did not suffice
};

}  // namespace sphparam
