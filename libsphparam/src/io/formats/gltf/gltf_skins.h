#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/formats/gltf/gltf_accessors.h"
#include "io/formats/gltf/gltf_nodes.h"

namespace sphparam {

/// Where the joints of a skin take what was bound to them, in their order: the joint's node, after
/// the inverse of what that was when the skin was bound. `nodes` are as in `PlacedScene`. Throws:
/// ReadError when there is no such skin, a joint is not in the scene, or matrices are missing.
/// Source: glTF 2.0, Section 3.7.3.
std::vector<Transform> joint_transforms(const GltfDocument& document, int skin,
                                        const std::vector<std::optional<Transform>>& nodes,
                                        GltfAccessors& accessors, const std::string& name);

/// Where each vertex of a primitive goes: the mean of its joints' transforms by its weights, or
/// where these are zero its first joint's. Throws: ReadError when weights or joints are missing, or
/// name no joint.
std::vector<Transform> posed_vertices(const GltfDocument::Primitive& primitive,
                                      const std::vector<Transform>& joints,
                                      GltfAccessors& accessors, const std::string& name);

}  // namespace sphparam
