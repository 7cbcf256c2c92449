#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/materials.h"
#include "sphparam/io/scalar_type.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// One named number per vertex or per triangle, kept as doubles (exact for every ScalarType, of
/// Int64 up to 2^53). Whole types make labels, which are never mixed.
struct Property {
  std::string name;
  ScalarType type = ScalarType::Float64;
  std::vector<double> values;
};

/// #F·3 rows, one per corner (row 3·face + corner).
using CornerTexcoords = RowTable<double, 2>;
using CornerNormals = RowTable<double, 3>;
using CornerTangents = RowTable<double, 4>;

/// A triangle mesh with everything its file carried. Polygons are triangulated on reading.
///
/// Conventional names: normals nx ny nz, colours red green blue [alpha] (Uint8 0–255 or Float32
/// 0–1), per-vertex texture coordinates s t, `source_vertex` (0-based id in the file; only where
/// vertices were welded or dropped; a comment says how many there were: file_numbers.h). Faces:
/// `material` (index into `materials`, −1 for none), `source_face` (polygon of the file, 0-based;
/// only where a polygon was split), `filler` (1: closes a hole and is no surface, see fillers.h).
struct MeshFile {
  TriangleMesh mesh;
  ScalarType position_type = ScalarType::Float64;  // what the file held; see `lossless_type`
  std::vector<Property> vertex_properties;
  std::vector<Property> face_properties;
  std::optional<CornerTexcoords> corner_texcoords;
  ScalarType corner_texcoord_type = ScalarType::Float64;
  std::optional<CornerNormals> corner_normals;
  ScalarType corner_normal_type = ScalarType::Float64;
  /// (s, t) of images that lie on other coordinates than the first: `MaterialTexture::second`.
  std::optional<CornerTexcoords> second_texcoords = {};
  /// The frame of normal maps, where the file says it: unit x y z along growing s, and 1, or −1
  /// where (s, t) are mirrored; a row of zeros where it does not.
  std::optional<CornerTangents> corner_tangents = {};
  std::vector<std::string> materials;              // names, in order of first use
  std::vector<MaterialTexture> base_colours = {};  // one a material, or none
  std::vector<MaterialChannels> channels = {};     // what they say besides; likewise
  std::vector<std::string> companions = {};        // files beside it that it was read from, too
  std::vector<std::string> comments;               // of the header, without the keyword
  std::vector<std::string> notes;                  // what was odd about the file but harmless
  std::string format;                              // "PLY binary little-endian", "OBJ", …
  long polygons = 0;                               // faces of the file that were not triangles

  const Property* find_vertex_property(const std::string& name) const;
  const Property* find_face_property(const std::string& name) const;

  /// Adds a property, or replaces the one of that name where it stands.
  void set_vertex_property(Property property);
  void set_face_property(Property property);
};

/// Takes the properties of these names away, whichever are there.
void remove_properties(std::vector<Property>& properties, const std::vector<std::string>& names);

/// The text as it can stand in a comment or a name of any format: line ends become blanks.
std::string one_line(std::string_view text);

}  // namespace sphparam
