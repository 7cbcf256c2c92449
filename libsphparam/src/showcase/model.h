#pragma once

#include <string>
#include <vector>

#include "gltf/painted_surfaces.h"
#include "gltf/shape.h"
#include "showcase/page_entry.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The mesh as a .glb that changes into the sphere, with a material variant a surface. The sphere
/// has the mesh's middle and area, and is turned so that vertices move little.
/// Requires: a certified chart. Throws: std::range_error where a position is beyond float32,
/// UnmeasurableMesh where the mesh is too small for it.
std::string showcase_model(const std::string& name, const MeshFile& file,
                           const SphericalChart& chart, const Points& normals,
                           const std::vector<PaintedSurface>& surfaces, const UprightAxes& up,
                           int threads = 0);

}  // namespace sphparam
