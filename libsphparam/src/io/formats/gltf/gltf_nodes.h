#pragma once

#include <optional>
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

/// Translation · rotation · scale. Requires: the rotation is not zero.
Transform composed(const Vector3& translation, const Eigen::Quaterniond& rotation,
                   const Vector3& scale);

/// A mesh of a glTF file where a node puts it.
struct PlacedMesh {
  int mesh = 0, node = 0;
  Transform transform;  // never singular
};

/// What the nodes of a scene are for.
struct PlacedScene {
  std::vector<PlacedMesh> meshes;               // in the order of the trees
  std::vector<std::optional<Transform>> nodes;  // of each of the file, where it is in the scene
};

/// The default scene (the first one, where none is named; without scenes, every node that is no
/// child).
///
/// `notes` gets a line where there are several scenes, and one each where meshes are left out
/// because their nodes scale them to nothing or hide them (KHR_node_visibility). Throws: ReadError
/// when a node or mesh is not there, a node has two parents, a transform is malformed or not
/// finite, or all meshes are left out.
PlacedScene place_scene(const GltfDocument& document, const std::string& name,
                        std::vector<std::string>& notes);

}  // namespace sphparam
