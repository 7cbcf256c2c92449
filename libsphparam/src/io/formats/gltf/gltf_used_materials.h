#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/formats/gltf/gltf_document.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The attribute of the texture coordinates that images lie on.
std::string gltf_texcoords(const GltfDocument::TextureTransform& transform);

/// The materials of a file that its triangles use, numbered as they are met.
class GltfUsedMaterials {
 public:
  /// Requires: the document outlives it.
  explicit GltfUsedMaterials(const GltfDocument& document);

  /// Whether some material has a map of normals, for which alone tangents are carried.
  bool has_normal_maps() const { return has_normal_maps_; }

  /// Where the images of the primitive's material lie. As they are written where there is no
  /// material, or its coordinates are not there: that is noted.
  GltfDocument::TextureTransform transform_of(const GltfDocument::Primitive& primitive);
  /// The attribute of its images on other coordinates than the first; empty: there are none, or the
  /// coordinates are not there, which is noted.
  std::string second_texcoords_of(const GltfDocument::Primitive& primitive);

  /// By how much the mesh is scaled where the material is used: the first time counts.
  void note_scale(int material, double scale) { scale_of_.try_emplace(material, scale); }

  /// The material of the next triangle, as numbered in the document; any other number: none.
  /// Requires: its scale is noted.
  void add_triangle(int material) { material_of_.push_back(material); }

  /// Gives the file its materials and which its faces have. To be called once.
  void finish(MeshFile& file);
  /// What of them is not carried. Requires: finished.
  void tell(std::vector<std::string>& notes) const;

 private:
  const GltfDocument::Material* find(int material) const;
  void add_material(int id, MeshFile& file);

  const GltfDocument& document_;
  const bool has_normal_maps_;
  std::vector<int> material_of_;  // of each triangle, as numbered in the document
  std::map<int, double> scale_of_;
  std::set<int> without_texcoords_;  // materials whose images some primitive has no place for
  std::set<int> without_second_;     // materials whose other coordinates some primitive lacks
  std::vector<std::string> others_;  // what is not carried, each once
  long with_others_ = 0, used_ = 0;  // materials
};

}  // namespace sphparam
