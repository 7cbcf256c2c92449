#include "io/formats/gltf/gltf_skins.h"

#include <string>

namespace sphparam {
namespace {

constexpr int in_matrix = 16, in_set = 4;

Transform affine(const double* column_major) {
  const Eigen::Map<const Eigen::Matrix4d> matrix(column_major);
  return {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
}

/// The inverse bind matrices, or nothing where all are the identity.
const std::vector<double>* bind_matrices(const GltfDocument::Skin& skin, GltfAccessors& accessors) {
  const int id = skin.inverse_bind_matrices;
  if (id < 0) return nullptr;
  const GltfDocument::Accessor& described = accessors.accessor(id);
  if (described.components != in_matrix || described.count < skin.joints.size())
    accessors.fail(id, "holds no matrix for each joint");
  return &accessors.numbers(id);
}

/// Of the transforms of a vertex's joints.
class WeightedMean {
 public:
  void add(const Transform& joint, double weight) {
    if (!first_) first_ = &joint;
    sum_.linear += weight * joint.linear;
    sum_.shift += weight * joint.shift;
    weights_ += weight;
  }
  /// Without weights that of the first.
  Transform value() const {
    if (!(weights_ > 0)) return *first_;
    return {sum_.linear / weights_, sum_.shift / weights_};
  }

 private:
  const Transform* first_ = nullptr;
  Transform sum_ = {Eigen::Matrix3d::Zero(), Vector3::Zero()};
  double weights_ = 0;
};

/// A set of four numbers a vertex; null where there is none.
const std::vector<double>* set_of(const GltfDocument::Primitive& primitive, const char* name,
                                  int set, GltfAccessors& accessors) {
  const auto found = primitive.attributes.find(name + std::to_string(set));
  if (found == primitive.attributes.end()) return nullptr;
  const GltfDocument::Accessor& described = accessors.accessor(found->second);
  const int positions = primitive.attributes.at("POSITION");
  if (described.components != in_set || described.count != accessors.accessor(positions).count)
    accessors.fail(found->second, "holds no four numbers for each vertex");
  return &accessors.numbers(found->second);
}

}  // namespace

std::vector<Transform> joint_transforms(const GltfDocument& document, int id,
                                        const std::vector<std::optional<Transform>>& nodes,
                                        GltfAccessors& accessors, const std::string& name) {
  const auto number = static_cast<std::size_t>(id);
  if (number >= document.skins.size() || document.skins[number].joints.empty())
    throw ReadError(name, "skin " + std::to_string(id) + " is not there, or has no joints");
  const GltfDocument::Skin& skin = document.skins[number];
  const std::vector<double>* const bound = bind_matrices(skin, accessors);
  std::vector<Transform> transforms;
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const auto node = static_cast<std::size_t>(skin.joints[i]);
    if (node >= nodes.size() || !nodes[node])
      throw ReadError(name, "joint " + std::to_string(i) + " of skin " + std::to_string(id) +
                                " is not in the scene");
    transforms.push_back(bound ? *nodes[node] * affine(bound->data() + in_matrix * i)
                               : *nodes[node]);
  }
  return transforms;
}

std::vector<Transform> posed_vertices(const GltfDocument::Primitive& primitive,
                                      const std::vector<Transform>& joints,
                                      GltfAccessors& accessors, const std::string& name) {
  std::vector<WeightedMean> means;
  for (int set = 0;; ++set) {
    const std::vector<double>* const named = set_of(primitive, "JOINTS_", set, accessors);
    const std::vector<double>* const weights = set_of(primitive, "WEIGHTS_", set, accessors);
    if (set == 0 && !(named && weights))
      throw ReadError(name, "a skinned primitive has no joints or no weights");
    if (!named || !weights) break;
    means.resize(named->size() / in_set);
    for (std::size_t i = 0; i < named->size(); ++i) {
      const double joint = (*named)[i];
      if (!(joint >= 0 && joint < static_cast<double>(joints.size())))
        throw ReadError(name, "a vertex names a joint that its skin has not");
      means[i / in_set].add(joints[static_cast<std::size_t>(joint)], (*weights)[i]);
    }
  }
  std::vector<Transform> posed;
  posed.reserve(means.size());
  for (const WeightedMean& mean : means) posed.push_back(mean.value());
  return posed;
}

}  // namespace sphparam
