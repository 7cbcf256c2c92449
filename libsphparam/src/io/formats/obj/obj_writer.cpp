#include "io/formats/obj/obj_writer.h"

#include <array>
#include <numeric>
#include <optional>

#include "io/attributes/appearance.h"
#include "io/files/text_buffer.h"
#include "io/formats/obj/obj_materials.h"
#include "io/polygons/distinct_rows.h"
#include "sphparam/io/polygons.h"

// OBJ: what it numbers (vt, vn) is numbered in the order of first use, so that reading and writing
// again changes nothing. A face, of whatever degree, is a run of corners of the triangles.

namespace sphparam {
namespace {

constexpr int corner_count = 3;

/// The faces as they are written: face f has corners[starts[f]] … corners[starts[f + 1] − 1], each
/// one of the triangles (3·triangle + corner).
struct WrittenFaces {
  std::vector<int> corners, starts;

  std::size_t count() const { return starts.size() - 1; }
};

WrittenFaces triangles_of(const MeshFile& file) {
  WrittenFaces faces;
  faces.corners.resize(static_cast<std::size_t>(file.mesh.triangles.size()));
  std::iota(faces.corners.begin(), faces.corners.end(), 0);
  faces.starts.reserve(static_cast<std::size_t>(file.mesh.face_count()) + 1);
  for (int f = 0; f <= file.mesh.face_count(); ++f) faces.starts.push_back(corner_count * f);
  return faces;
}

/// Numbers of every corner, `Width` each, gathered into distinct rows.
template <int Width>
struct NumberedCorners {
  DistinctRows<double, Width> distinct;
  std::vector<int> of_corner;  // rows of `distinct`, one a corner of the faces that are written;
                               // empty when the mesh has no such numbers
};

/// Numbers what every corner has: from the table of corners, else from vertex properties.
template <int Width, class Table>
NumberedCorners<Width> number_corners(const Triangles& triangles, const WrittenFaces& faces,
                                      const std::optional<Table>& table,
                                      const std::vector<const Property*>& of_vertex) {
  NumberedCorners<Width> result;
  if (!table && of_vertex.empty()) return result;
  result.of_corner.reserve(faces.corners.size());
  for (const int corner : faces.corners) {
    std::array<double, Width> row;
    for (int k = 0; k < Width; ++k)
      row[k] = table ? (*table)(corner, k) : of_vertex[k]->values[triangles.data()[corner]];
    result.of_corner.push_back(result.distinct.insert(row));
  }
  return result;
}

template <int Width>
void put_rows(TextBuffer& text, std::string_view keyword,
              const DistinctRows<double, Width>& distinct) {
  for (const auto& row : distinct.rows()) {
    text << keyword;
    for (const double value : row) text << ' ' << value;
    text << '\n';
  }
}

/// OBJ colours are fractions; whole numbers become the nearest float, as n / 255 of bytes.
float fraction(const Property& colour, Eigen::Index v) {
  return static_cast<float>(colour.values[v] / brightest(colour.type));
}

void put_vertices(TextBuffer& text, const MeshFile& file) {
  const auto colours = find_all(file.vertex_properties, std::array{"red", "green", "blue"});
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    text << 'v';
    for (int axis = 0; axis < 3; ++axis) text << ' ' << file.mesh.positions(v, axis);
    for (const Property* colour : colours) text << ' ' << fraction(*colour, v);
    text << '\n';
  }
}

constexpr int no_material = -1;

int material_of(const MeshFile& file, const Property* materials, int corner) {
  if (!materials) return no_material;
  const double material = materials->values[corner / corner_count];
  const bool is_one = material >= 0 && material < static_cast<double>(file.materials.size());
  return is_one ? static_cast<int>(material) : no_material;
}

void put_faces(TextBuffer& text, const MeshFile& file, const WrittenFaces& faces,
               const std::vector<int>& texcoords, const std::vector<int>& normals) {
  const Property* const materials = file.find_face_property("material");
  int current = no_material;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const int material = material_of(file, materials, faces.corners[faces.starts[f]]);
    if (material != current) {
      const bool is_one = material != no_material;
      text << "usemtl " << (is_one ? one_line(file.materials[material]) : obj_no_material) << '\n';
      current = material;
    }
    text << 'f';
    for (int i = faces.starts[f]; i < faces.starts[f + 1]; ++i) {
      text << ' ' << file.mesh.triangles.data()[faces.corners[i]] + 1;
      if (!texcoords.empty()) text << '/' << texcoords[i] + 1;
      if (!normals.empty()) text << (texcoords.empty() ? "//" : "/") << normals[i] + 1;
    }
    text << '\n';
  }
}

std::string serialise(const MeshFile& file, const WrittenFaces& faces,
                      const std::vector<std::string>& libraries) {
  const Triangles& triangles = file.mesh.triangles;
  const auto texcoords = number_corners<2>(triangles, faces, file.corner_texcoords,
                                           find_all(file.vertex_properties, std::array{"s", "t"}));
  const auto normals =
      number_corners<3>(triangles, faces, file.corner_normals,
                        find_all(file.vertex_properties, std::array{"nx", "ny", "nz"}));
  TextBuffer text(expected_text_bytes(file));
  put_comments(text, file);
  for (const std::string& library : libraries) text << "mtllib " << one_line(library) << '\n';
  put_vertices(text, file);
  put_rows(text, "vt", texcoords.distinct);
  put_rows(text, "vn", normals.distinct);
  put_faces(text, file, faces, texcoords.of_corner, normals.of_corner);
  return text.take();
}

}  // namespace

std::string serialise_obj(const MeshFile& file) { return serialise_obj(file, nullptr, {}); }

std::string serialise_polygon_obj(const MeshFile& file, const Polygons& faces) {
  return serialise_obj(file, &faces, {});
}

std::string serialise_obj(const MeshFile& file, const Polygons* faces,
                          const std::vector<std::string>& libraries) {
  if (!faces) return serialise(file, triangles_of(file), libraries);
  return serialise(file, {corners_in(file.mesh.triangles, *faces), faces->starts}, libraries);
}

}  // namespace sphparam
