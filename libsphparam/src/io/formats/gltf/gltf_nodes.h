#pragma once

#include <string>
#include <vector>

#include "io/formats/gltf/gltf_document.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// x ↦ linear x + shift.
struct Transform {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vector3 shift = Vector3::Zero();

  Transform operator*(const Transform& inner) const {
    return {linear * inner.linear, linear * inner.shift + shift};
  }
};

/// A mesh of a glTF file where a node puts it.
struct PlacedMesh {
  int mesh = 0;
  Transform transform;  // never singular
  bool skinned = false;
};

/// All meshes of the default scene (of the first one, where none is named; without scenes, of every
/// node that is no child), in the order of the trees.
///
/// `notes` gets a line where there are several scenes. Throws: ReadError when a node or mesh is not
/// there, a node has two parents, or a transform is malformed or singular.
std::vector<PlacedMesh> placed_meshes(const GltfDocument& document, const std::string& name,
                                      std::vector<std::string>& notes);

}  // namespace sphparam
