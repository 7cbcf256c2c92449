#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/polygons.h"

namespace sphparam {

// Meshes are written in the format that the name asks for: .ply, .obj, .off, .stl, .vtk, .vtp,
// .gii, .mz3, or a name of FreeSurfer (.white, .pial, .inflated, .sphere, .orig, .smoothwm,
// .midthickness, .graymid, .reg, .surf). ".gz" after it asks for gzip. A name without an extension,
// and "-", standard output, ask for PLY.
//
// All are lossless in what they carry, but for float32, and reading gives it back. PLY: everything.
// OBJ: positions, colours, texture coordinates, normals, materials, comments. OFF: what vertices
// have of these, and colours of faces. VTK, VTP: all but what corners have. GIFTI: positions as
// float32, comments as metadata. MZ3: positions as float32, colours as bytes, properties of
// vertices without their names. FreeSurfer: positions as float32, comments of its own. STL: binary,
// float32 corners of triangles, vertices without numbers. `losses_of_writing` tells.

struct WriteOptions {
  /// The polygons that the triangles are cut of, in their order; the formats that have polygons,
  /// PLY, OBJ, VTK and VTP, write these for faces. Null: triangles are.
  const Polygons* faces = nullptr;
  /// The positions are points of a sphere, in no space but its own. GIFTI says so.
  bool is_sphere = false;
  /// The file that the mesh is made of. GIFTI says by its name which hemisphere it is, and which
  /// surface, where neither comments nor the new name do (brain_names.h).
  std::string origin = {};
};

/// Whether there is a format that is written under this name.
bool is_written(const std::string& path);

/// What names may end in: ".ply, .obj or .gii", with another last word if wanted.
std::string written_extensions(const std::string& conjunction = "or");

/// Whether spheres get coordinates of 32 bits and the radius 100 under this name, as GIFTI,
/// FreeSurfer and MZ3 have them.
bool has_float_spheres(const std::string& path);

/// Whether numbers a vertex lie in files of their own beside a mesh of this name (vertex_data.h),
/// as beside GIFTI and FreeSurfer's.
bool has_data_beside(const std::string& path);

/// Whether that format has a place for a map, the vertex properties sx sy sz.
bool keeps_map(const std::string& path);

/// The bytes of a mesh file. Where the format has no place for a map, what the comments say of it
/// goes too, but on a sphere, which is the map. Requires: finite numbers; names of properties
/// without blanks. Throws: WriteError for a name of no format that is written; for GIFTI, where
/// libgiftiio fails; for GIFTI, FreeSurfer, MZ3, STL, of coordinates beyond float32. Cost: near a
/// copy of the bytes for PLY, 0.2 µs a number of text.
std::string serialise_mesh(const std::string& path, const MeshFile& file,
                           const WriteOptions& options = {});

/// Writes them, all or nothing. Throws: WriteError.
void write_mesh(const std::string& path, const MeshFile& file, const WriteOptions& options = {});

// By format:

/// Reading it gives the same mesh file, with all properties in their own types.
std::string serialise_ply(const MeshFile& file);
std::string serialise_obj(const MeshFile& file);
std::string serialise_polygon_obj(const MeshFile& file, const Polygons& faces);
std::string serialise_off(const MeshFile& file);

}  // namespace sphparam
