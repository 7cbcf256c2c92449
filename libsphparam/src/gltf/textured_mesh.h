#pragma once

#include "gltf/export_chart.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The chart as a mesh file, for formats with texture coordinates at corners: the refined mesh, the
/// (u, 1 − v) of its wedges at the corners, v upwards as these formats have it; vertex and face
/// properties of the source, colours mixed as light, other whole numbers taken as labels,
/// normals interpolated, those of corners at corners too; one material; what comments say of the
/// object (remarks.h). `shape`: the mesh or its sphere. Axes stay as they are; comments of the mesh
/// say which are up and in front, those of `up` where it says so.
MeshFile textured_mesh(const ExportChart& chart, const MeshFile& source, ShapeKind shape,
                       const Up& up = {}, int threads = 0);

/// An OBJ that names its material library, and that library: one material with an image.
std::string obj_with_library(const MeshFile& mesh, const std::string& library);
std::string material_library(const std::string& image);
/// What each such library begins with.
std::string own_library_head();

}  // namespace sphparam
