#pragma once

#include <vector>

#include "embedding/pack_kernel.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/embedding/quality.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Newton steps on some levels of a progressive embedding, for shapes with long limbs: sweeps creep
/// along the curved valley of their energy, Newton steps do not. On other shapes one cheap step on
/// the coarse levels finds that out, and nothing else is done.
/// Our own. Cost: see finish.cpp.
class Finish {
 public:
  Finish(Quality quality, const DistortionEnergy& energy, int finest_vertices, int threads);

  /// Is a level with so many vertices to be improved?
  bool due(int vertices) const;
  /// Lowers the energy of the image, as far as it pays. `pinned` vertices stay.
  void improve(const TriangleMesh& mesh, const Topology& topology,
               const std::vector<Vertex>& pinned, std::vector<ImagePoint>& image);

 private:
  Quality quality_;
  DistortionEnergy energy_;
  int finest_, threads_;
  int next_;          // vertices of the next level to be improved, at least
  double last_gain_;  // on the level improved last, by the first step
};

}  // namespace sphparam
