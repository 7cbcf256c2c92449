#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/formats/three_mf/three_mf_model.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// What triangles of a 3MF file are painted with, as a mesh file has it: base materials as
/// materials with their colour; colours as those of vertices where no vertex has two, else of
/// faces, of which those with several are their mean, and told.
class ThreeMfColours {
 public:
  /// The next triangle. Throws: ReadError for an entry that its group has not. A group that is not
  /// there, or of an extension that is not read, paints nothing.
  void add(const ThreeMfPaint& paint, const ThreeMfGroups& groups, const std::string& name);

  /// Requires: the mesh of the file has the triangles that were added.
  void attach_to(MeshFile& file) const;

 private:
  using Colour = std::array<std::uint8_t, 4>;  // sRGB and alpha

  int number_of(std::pair<std::string, Colour> material);
  std::size_t channels_used() const;
  void attach_materials(MeshFile& file) const;
  void attach_to_faces(MeshFile& file) const;
  bool attach_to_vertices(MeshFile& file) const;

  std::vector<std::array<Colour, 3>> corners_;  // white where nothing is said
  std::vector<char> is_painted_;                // a triangle, by colours
  std::vector<int> material_of_;                // a triangle; −1: none
  std::vector<std::pair<std::string, Colour>> materials_;
  std::map<std::pair<std::string, Colour>, int> numbers_;  // of materials
};

}  // namespace sphparam
