#include "io/formats/gltf/gltf_morphs.h"

#include <algorithm>

#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

void GltfMorphs::begin(const GltfDocument::Primitive& primitive, const GltfDocument::Node& node,
                       const std::string& where) {
  where_ = where;
  targets_ = &primitive.targets;
  weights_ = node.weights.empty() ? primitive.weights : node.weights;
  weights_.resize(targets_->size(), 0);
  any_morphed_ = any_morphed_ || is_morphed();
  for (std::size_t t = 0; t < weights_.size(); ++t)
    if (weights_[t] != 0) note_unmoved((*targets_)[t]);
}

/// What `moved` is not asked for.
void GltfMorphs::note_unmoved(const std::map<std::string, int>& target) {
  for (const auto& [attribute, accessor] : target)
    if (attribute != "POSITION" && attribute != "NORMAL" && attribute != "TANGENT")
      unmoved_.insert(one_line(attribute));
}

bool GltfMorphs::is_morphed() const {
  return std::ranges::any_of(weights_, [](double weight) { return weight != 0; });
}

const std::vector<double>& GltfMorphs::moved(const std::string& attribute,
                                             const std::vector<double>& rest, std::size_t width) {
  if (!is_morphed()) return rest;
  moved_ = rest;
  for (std::size_t t = 0; t < weights_.size(); ++t) {
    const auto target = (*targets_)[t].find(attribute);
    if (weights_[t] == 0 || target == (*targets_)[t].end()) continue;
    accessors_.require_components(target->second, {3}, where_);
    const std::vector<double>& moves = accessors_.numbers(target->second);
    if (moves.size() / 3 != rest.size() / width)
      accessors_.fail(target->second, where_ + " has " + std::to_string(rest.size() / width) +
                                          " vertices, its morph target another number");
    for (std::size_t i = 0; i < moves.size(); ++i)
      moved_[i / 3 * width + i % 3] += weights_[t] * moves[i];
  }
  return moved_;
}

void GltfMorphs::count_targets() { most_targets_ = std::max(most_targets_, std::ssize(*targets_)); }

void GltfMorphs::tell(std::vector<std::string>& notes) const {
  if (most_targets_ > 0) add_loss(notes, counted(most_targets_, "morph target") + how_morphed());
}

std::string GltfMorphs::how_morphed() const {
  if (!any_morphed_) return "";
  const std::string read = ": the mesh is read as their weights stand";
  if (unmoved_.empty()) return read;
  return read + ", but for " + enumerated({unmoved_.begin(), unmoved_.end()}) +
         ", which are as without them";
}

}  // namespace sphparam
