#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Properties of vertices that are one normal.
constexpr const char* normal_names[] = {"nx", "ny", "nz"};

/// Which of a source's values are to be carried, by the words of `RemeshOptions::transfer`.
class WantedValues {
 public:
  /// Throws: NoSuchProperty for a word that names nothing the source has.
  WantedValues(const std::vector<std::string>& words, const MeshFile& source);

  /// Of vertices or faces. Not what belongs to the source's own vertices: numbers in a file, its
  /// map, points that a match has for them.
  bool property(const std::string& name) const;

  /// Throws: NoSuchProperty where the new vertices will not have what a geometry image is to show,
  /// as `add_geometry_image` has it.
  void require_image(const std::string& what, const MeshFile& source) const;

  bool corner_texcoords() const;
  bool corner_normals() const;

 private:
  std::vector<std::string> words_;
  bool is_matched_;
};

}  // namespace sphparam
