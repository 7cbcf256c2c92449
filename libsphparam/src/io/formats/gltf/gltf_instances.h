#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/formats/gltf/gltf_accessors.h"
#include "io/formats/gltf/gltf_nodes.h"

namespace sphparam {

/// Where a node's instances put its mesh, before the node does: translation · rotation · scale,
/// each from an accessor of numbers or not at all. Throws: ReadError where accessors disagree in
/// length, hold other numbers, or make nothing of the mesh. Source: EXT_mesh_gpu_instancing.
std::vector<Transform> instance_transforms(const std::map<std::string, int>& attributes,
                                           GltfAccessors& accessors, const std::string& name);

}  // namespace sphparam
