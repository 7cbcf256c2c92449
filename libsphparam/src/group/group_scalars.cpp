#include "group/group_scalars.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace sphparam {
namespace {

/// Numbers that are means of one another; labels and coordinates of images are not.
bool is_scalar(const Property& property) {
  constexpr std::array<std::string_view, 6> others{"red", "green", "blue", "alpha", "s", "t"};
  return is_floating(property.type) && std::ranges::find(others, property.name) == others.end();
}

Eigen::Map<const VectorX> values_of(const Property& property) {
  return {property.values.data(), std::ssize(property.values)};
}

/// Which shapes have it; the rest is still to be measured.
std::vector<GroupScalar> names_of(const std::vector<GroupMember>& members) {
  std::vector<GroupScalar> scalars;
  for (size_t i = 0; i < members.size(); ++i) {
    for (const Property& property : members[i].resampled.file().vertex_properties) {
      if (!is_scalar(property)) continue;
      auto found = std::ranges::find(scalars, property.name, &GroupScalar::name);
      if (found == scalars.end())
        found = scalars.insert(found, {property.name, {}, VectorX(), VectorX()});
      found->shapes.push_back(i);
    }
  }
  std::erase_if(scalars, [](const GroupScalar& scalar) { return scalar.shapes.size() < 2; });
  return scalars;
}

void measure(GroupScalar& scalar, const std::vector<GroupMember>& members) {
  const auto of = [&](size_t i) {
    return values_of(*members[i].resampled.file().find_vertex_property(scalar.name));
  };
  const auto count = static_cast<double>(scalar.shapes.size());
  const Eigen::Index vertices = of(scalar.shapes.front()).size();
  VectorX sum = VectorX::Zero(vertices), squares = sum;
  for (const size_t i : scalar.shapes) sum += of(i);
  scalar.mean = sum / count;
  for (const size_t i : scalar.shapes) squares += (of(i) - scalar.mean).cwiseAbs2();
  scalar.deviation = (squares / (count - 1)).cwiseSqrt();
}

}  // namespace

std::vector<GroupScalar> group_scalars(const std::vector<GroupMember>& members) {
  std::vector<GroupScalar> scalars = names_of(members);
  for (GroupScalar& scalar : scalars) measure(scalar, members);
  return scalars;
}

}  // namespace sphparam
