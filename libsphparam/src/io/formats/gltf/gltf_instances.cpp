#include "io/formats/gltf/gltf_instances.h"

#include <cmath>
#include <optional>

namespace sphparam {
namespace {

/// The numbers of an attribute, a row an instance; null where it is not said.
const std::vector<double>* rows_of(const std::map<std::string, int>& attributes, const char* name,
                                   int components, std::optional<std::uint64_t>& count,
                                   GltfAccessors& accessors) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return nullptr;
  const GltfDocument::Accessor& described = accessors.accessor(found->second);
  if (described.components != components || count.value_or(described.count) != described.count)
    accessors.fail(found->second, "is not of all instances");
  count = described.count;
  return &accessors.numbers(found->second);
}

}  // namespace

std::vector<Transform> instance_transforms(const std::map<std::string, int>& attributes,
                                           GltfAccessors& accessors, const std::string& name) {
  std::optional<std::uint64_t> count;
  const auto* const moved = rows_of(attributes, "TRANSLATION", 3, count, accessors);
  const auto* const turned = rows_of(attributes, "ROTATION", 4, count, accessors);
  const auto* const scaled = rows_of(attributes, "SCALE", 3, count, accessors);
  if (!count) throw ReadError(name, "a node has instances without a place");
  std::vector<Transform> transforms;
  for (std::size_t i = 0; i < *count; ++i) {
    const double* const r = turned ? turned->data() + 4 * i : nullptr;
    transforms.push_back(composed(
        moved ? Vector3(Eigen::Map<const Vector3>(moved->data() + 3 * i)) : Vector3(0, 0, 0),
        r ? Eigen::Quaterniond(r[3], r[0], r[1], r[2]) : Eigen::Quaterniond::Identity(),
        scaled ? Vector3(Eigen::Map<const Vector3>(scaled->data() + 3 * i)) : Vector3(1, 1, 1)));
    const double determinant = transforms.back().linear.determinant();
    if (!(std::abs(determinant) > 0) || !std::isfinite(determinant))
      throw ReadError(name, "instance " + std::to_string(i) + " makes nothing of its mesh");
  }
  return transforms;
}

}  // namespace sphparam
