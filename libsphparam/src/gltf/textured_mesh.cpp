#include "gltf/textured_mesh.h"

#include <algorithm>
#include <cmath>

#include "io/attributes/corner_colours.h"
#include "io/attributes/shading_normals.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/chart/tangent_frame.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/up_axis.h"

// Attributes are carried one by one. What belongs to the map or is given by it (rays, angles,
// normals, texture coordinates of the source) is left out or made anew.

namespace sphparam {
namespace {

constexpr char material_name[] = "sphparam";

bool is_made_anew(const std::string& name) {
  static const std::vector<std::string> names = {
      "sx", "sy", "sz", "theta",    "phi",           "nx",         "ny",
      "nz", "s",  "t",  "material", "source_vertex", "source_face"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

Property rounded(Property property) {
  if (is_floating(property.type)) return property;
  for (double& value : property.values) value = std::round(value);
  return property;
}

template <class Carry>
void carry(const std::vector<Property>& properties, std::vector<Property>& to, Carry&& carried) {
  for (const Property& property : properties) {
    if (is_made_anew(property.name) || is_corner_colour(property.name)) continue;
    const Attributes values = Eigen::Map<const VectorX>(
        property.values.data(), static_cast<Eigen::Index>(property.values.size()));
    const Attributes refined = carried(values);
    to.push_back(rounded({property.name, property.type,
                          std::vector<double>(refined.data(), refined.data() + refined.size())}));
  }
}

void add_normals(MeshFile& file, const Points& normals) {
  int axis = 0;
  for (const char* name : {"nx", "ny", "nz"}) {
    const VectorX column = normals.col(axis++);
    file.set_vertex_property({name, ScalarType::Float64,
                              std::vector<double>(column.data(), column.data() + column.size())});
  }
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
  const bool is_sphere = shape == ShapeKind::Sphere;
  file.mesh.positions = is_sphere ? chart.points : Points(of_vertices(source.mesh.positions));
  carry(source.vertex_properties, file.vertex_properties, of_vertices);
  carry(source.face_properties, file.face_properties,
        [&](const Attributes& values) { return carry_face_attribute(chart, triangles, values); });
  add_normals(file, is_sphere ? chart.points
                              : carry_normals(chart, triangles, shading_normals(source), threads));
  if (exported.wedge_normals && !is_sphere) {
    file.corner_normals = CornerNormals(chart.triangles.size(), 3);
    for (Eigen::Index corner = 0; corner < chart.wedges.size(); ++corner)
      file.corner_normals->row(corner) = exported.wedge_normals->row(chart.wedges.data()[corner]);
  }
  CornerTexcoords texcoords(chart.triangles.size(), 2);
  for (Eigen::Index corner = 0; corner < texcoords.rows(); ++corner) {
    const auto uv = chart.uv.row(chart.wedges.data()[corner]);
    texcoords.row(corner) << (exported.mirrored ? 1 - uv[0] : uv[0]), 1 - uv[1];
  }
  file.corner_texcoords = std::move(texcoords);
  if (!is_sphere) take_up(file, source), note_up(file, up);
  file.materials = {material_name};
  file.set_face_property({"material", ScalarType::Int32,
                          std::vector<double>(static_cast<size_t>(chart.triangles.rows()), 0)});
  return file;
}

std::string obj_with_library(const MeshFile& mesh, const std::string& library) {
  std::string obj = serialise_obj(mesh);
  std::size_t comments = 0;  // readers take those that come first
  while (comments < obj.size() && obj[comments] == '#') comments = obj.find('\n', comments) + 1;
  return obj.insert(comments, "mtllib " + library + "\n");
}

std::string material_library(const std::string& image) {
  return std::string("newmtl ") + material_name +
         "\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " + image + "\n";
}

}  // namespace sphparam
