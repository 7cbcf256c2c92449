#pragma once

// Private to the limit_*.cpp: OpenSubdiv's side of a limit surface.

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "sphparam/remesh/limit_surface.h"

namespace sphparam {

using BfrSurface = OpenSubdiv::Bfr::Surface<double>;
using BfrCache = OpenSubdiv::Bfr::SurfaceFactoryCacheThreaded<
    std::shared_mutex, std::shared_lock<std::shared_mutex>, std::unique_lock<std::shared_mutex>>;
using BfrFactory = OpenSubdiv::Bfr::RefinerSurfaceFactory<BfrCache>;

struct LimitTopology::Tables {
  Scheme scheme;
  int vertex_count;
  std::vector<int> first_patch;  // #faces + 1
  std::vector<int> face_of;      // empty where patch p is face p
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner;
  std::unique_ptr<BfrFactory> factory;
  mutable std::once_flag read;
  mutable Eigen::MatrixXd to_coefficients;  // from the control points of a regular patch
};

}  // namespace sphparam
