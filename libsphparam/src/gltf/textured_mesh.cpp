#include "gltf/textured_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/attributes/corner_colours.h"
#include "io/attributes/mixed_colour.h"
#include "io/attributes/remarks.h"
#include "io/attributes/shading_normals.h"
#include "io/attributes/weightiest_label.h"
#include "io/attributes/whole_vector.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/chart/tangent_frame.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/up_axis.h"

// Attributes are carried one by one, as remesh carries them: numbers and colours are interpolated,
// other whole numbers are labels. What belongs to the map or is given by it (rays, angles, normals,
// texture coordinates of the source) is left out or made anew.

namespace sphparam {
namespace {

constexpr char material_name[] = "sphparam";

/// Of a normal and of texture coordinates all components: a "t" alone is a number like others.
bool is_made_anew(const std::string& name, const std::vector<Property>& properties) {
  static const std::vector<std::string> names = {
      "sx", "sy", "sz", "theta", "phi", "material", "source_vertex", "source_face", "texnumber"};
  static const std::vector<std::string> components = {"nx", "ny", "nz", "s", "t"};
  return std::ranges::count(names, name) > 0 ||
         (std::ranges::count(components, name) > 0 && is_of_whole_vector(name, properties));
}

Property rounded(Property property) {
  if (is_floating(property.type)) return property;
  for (double& value : property.values) value = std::round(value);
  return property;
}

/// A new vertex gets the colour between its corners, or the label of those which weigh most, never
/// a mean.
std::vector<double> carry_mixed(const SphericalChart& chart, const Triangles& source,
                                const Property& property, bool is_colour) {
  std::vector<double> carried;
  for (const SurfacePoint& point : chart.surface_points) {
    std::array<std::pair<double, double>, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[static_cast<size_t>(k)] = {
          property.values[static_cast<size_t>(source(point.face, k))], point.barycentric[k]};
    carried.push_back(is_colour ? mixed_colour(property.name, property.type, corners)
                                : weightiest_label(corners));
  }
  return carried;
}

/// values(property) are those of what is left.
template <class Carry>
void carry(const std::vector<Property>& properties, std::vector<Property>& to, Carry&& values) {
  for (const Property& property : properties) {
    if (is_made_anew(property.name, properties) || is_corner_colour(property.name)) continue;
    to.push_back(rounded({property.name, property.type, values(property)}));
  }
}

Attributes column_of(const Property& property) {
  return Eigen::Map<const VectorX>(property.values.data(),
                                   static_cast<Eigen::Index>(property.values.size()));
}

std::vector<double> as_list(const Attributes& column) {
  return {column.data(), column.data() + column.size()};
}

void add_normals(MeshFile& file, const Points& normals) {
  int axis = 0;
  for (const char* name : {"nx", "ny", "nz"}) {
    const VectorX column = normals.col(axis++);
    file.set_vertex_property({name, ScalarType::Float64,
                              std::vector<double>(column.data(), column.data() + column.size())});
  }
}

/// One a corner, as the wedges have them.
CornerNormals corner_normals(const SphericalChart& chart, const Points& of_wedges) {
  CornerNormals normals(chart.wedges.size(), 3);
  for (Eigen::Index corner = 0; corner < normals.rows(); ++corner)
    normals.row(corner) = of_wedges.row(chart.wedges.data()[corner]);
  return normals;
}

/// One a corner; t runs upwards.
CornerTexcoords corner_texcoords(const SphericalChart& chart, bool mirrored) {
  CornerTexcoords texcoords(chart.wedges.size(), 2);
  for (Eigen::Index corner = 0; corner < texcoords.rows(); ++corner) {
    const auto uv = chart.uv.row(chart.wedges.data()[corner]);
    texcoords.row(corner) << (mirrored ? 1 - uv[0] : uv[0]), 1 - uv[1];
  }
  return texcoords;
}

}  // namespace

MeshFile textured_mesh(const ExportChart& exported, const MeshFile& source, ShapeKind shape,
                       const Up& up, int threads) {
  const SphericalChart& chart = exported.chart;
  const Triangles& triangles = source.mesh.triangles;
  const auto of_vertices = [&](const Attributes& values) {
    return carry_vertex_attribute(chart, triangles, values, threads);
  };
  MeshFile file;
  file.mesh.triangles = chart.triangles;
  file.comments = remarks_of(source);
  const bool is_sphere = shape == ShapeKind::Sphere;
  file.mesh.positions = is_sphere ? chart.points : Points(of_vertices(source.mesh.positions));
  carry(source.vertex_properties, file.vertex_properties, [&](const Property& property) {
    const bool is_colour = is_of_colour(property, source.vertex_properties);
    return is_floating(property.type) && !is_colour
               ? as_list(of_vertices(column_of(property)))
               : carry_mixed(chart, triangles, property, is_colour);
  });
  carry(source.face_properties, file.face_properties, [&](const Property& property) {
    return as_list(carry_face_attribute(chart, triangles, column_of(property)));
  });
  add_normals(file, is_sphere ? chart.points
                              : carry_normals(chart, triangles, shading_normals(source), threads));
  if (exported.wedge_normals && !is_sphere)
    file.corner_normals = corner_normals(chart, *exported.wedge_normals);
  file.corner_texcoords = corner_texcoords(chart, exported.mirrored);
  if (!is_sphere) take_up(file, source), note_up(file, up);
  file.materials = {material_name};
  file.set_face_property({"material", ScalarType::Int32,
                          std::vector<double>(static_cast<size_t>(chart.triangles.rows()), 0)});
  return file;
}

std::string obj_with_library(const MeshFile& mesh, const std::string& library) {
  std::string obj = serialise_obj(mesh);
  std::size_t comments = 0;  // they come first
  while (comments < obj.size() && obj[comments] == '#') comments = obj.find('\n', comments) + 1;
  return obj.insert(comments, "mtllib " + library + "\n");
}

std::string own_library_head() {
  return std::string("newmtl ") + material_name +
         "\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd ";
}

std::string material_library(const std::string& image) { return own_library_head() + image + "\n"; }

}  // namespace sphparam
