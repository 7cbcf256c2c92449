#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/formats/gltf/gltf_accessors.h"

namespace sphparam {

/// What the weights in a file do to the vertices of its primitives, one after the other.
class GltfMorphs {
 public:
  /// Requires: the accessors outlive it.
  explicit GltfMorphs(GltfAccessors& accessors) : accessors_(accessors) {}

  /// Goes on to a primitive, which stays until the next one. The weights of its node count; those
  /// of the mesh where that has none. `where`: the primitive in messages.
  void begin(const GltfDocument::Primitive& primitive, const GltfDocument::Node& node,
             const std::string& where);

  /// Whether the weights move anything of the primitive.
  bool is_morphed() const;

  /// The numbers of one of its attributes, `width` a vertex, with the first three of each moved.
  /// Valid until the next call; `rest` itself where nothing moves. Throws: ReadError.
  const std::vector<double>& moved(const std::string& attribute, const std::vector<double>& rest,
                                   std::size_t width = 3);

  /// Notes that vertices of the primitive are read.
  void count_targets();

  /// What is lost of all of them.
  void tell(std::vector<std::string>& notes) const;

 private:
  void note_unmoved(const std::map<std::string, int>& target);
  std::string how_morphed() const;

  GltfAccessors& accessors_;
  std::string where_;
  const std::vector<std::map<std::string, int>>* targets_ = nullptr;  // of the primitive
  std::vector<double> weights_;                                       // of these
  std::vector<double> moved_;
  std::ptrdiff_t most_targets_ = 0;
  bool any_morphed_ = false;
  std::set<std::string> unmoved_;  // attributes that weights in the file would move
};

}  // namespace sphparam
