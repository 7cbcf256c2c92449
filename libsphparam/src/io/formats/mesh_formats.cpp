// The one place that knows all formats. A new one is a reader and a writer in this folder, and a
// line in the table below.

#include "io/formats/mesh_formats.h"

#include <algorithm>
#include <filesystem>

#include "io/files/temporary_file.h"
#include "io/formats/freesurfer_reader.h"
#include "io/formats/freesurfer_writer.h"
#include "io/formats/gifti/gifti_reader.h"
#include "io/formats/gifti/gifti_writer.h"
#include "io/formats/gltf/gltf_reader.h"
#include "io/formats/mz3_reader.h"
#include "io/formats/mz3_writer.h"
#include "io/formats/obj/obj_reader.h"
#include "io/formats/obj/obj_writer.h"
#include "io/formats/off_reader.h"
#include "io/formats/off_writer.h"
#include "io/formats/ply/ply_reader.h"
#include "io/formats/ply/ply_writer.h"
#include "io/formats/ply/polygon_ply.h"
#include "io/formats/scene_reader.h"
#include "io/formats/shapes/icq_reader.h"
#include "io/formats/shapes/plate_reader.h"
#include "io/formats/stl_reader.h"
#include "io/formats/stl_writer.h"
#include "io/formats/three_mf/three_mf_reader.h"
#include "io/formats/vtk/legacy_vtk_reader.h"
#include "io/formats/vtk/legacy_vtk_writer.h"
#include "io/formats/vtk/xml_vtk_reader.h"
#include "io/formats/vtk/xml_vtk_writer.h"
#include "lower_case.h"
#include "sphparam/io/brain_names.h"

namespace sphparam {
namespace {

using Reader = MeshFile(std::string_view, const std::string&, const ReadOptions&);

/// For formats that need no other files.
template <Reader& reader>
MeshFile read(const MeshBytes& bytes, const ReadOptions& options) {
  return reader(bytes.bytes, bytes.name, options);
}

MeshFile read_gltf_files(const MeshBytes& bytes, const ReadOptions& options) {
  return read_gltf(bytes.bytes, bytes.name, bytes.folder, options);
}

MeshFile read_obj_files(const MeshBytes& bytes, const ReadOptions& options) {
  return read_obj(bytes.bytes, bytes.name, bytes.folder, options);
}

using SceneReader = MeshFile(std::string_view, const std::string&,
                             const std::optional<std::filesystem::path>&, const ReadOptions&);

/// For formats that may have pictures beside them.
template <SceneReader& reader>
MeshFile read_scene_files(const MeshBytes& bytes, const ReadOptions& options) {
  return reader(bytes.bytes, bytes.name, bytes.folder, options);
}

/// For formats that are told nothing but the mesh.
template <std::string (&writer)(const MeshFile&)>
std::string write(const MeshFile& file, const WriteOptions&, const std::string&) {
  return writer(file);
}

template <std::string (&writer)(const MeshFile&, const WriteOptions&)>
std::string write(const MeshFile& file, const WriteOptions& options, const std::string&) {
  return writer(file, options);
}

std::string write_ply(const MeshFile& file, const WriteOptions& options) {
  const Polygons* const faces = options.faces;
  const bool has_polygons = faces && std::ssize(faces->corners) != 3 * faces->count();
  return has_polygons ? serialise_polygon_ply(file, *faces) : serialise_ply(file);
}

/// A file as it is called from a folder: a link keeps its name, what it names lies beside it.
std::string name_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path way = std::filesystem::relative(folder_of(file), folder, error);
  if (error || way.empty()) return file.string();
  return (way / file.filename()).lexically_normal().generic_string();
}

/// The material libraries that a mesh was read with, as they are called from beside `path`: those
/// of what its materials look like still.
std::vector<std::string> libraries_from(const std::string& path, const MeshFile& file) {
  std::vector<std::string> names;
  if (file.base_colours.empty()) return names;
  for (const std::string& companion : file.companions)
    if (in_lower_case(companion).ends_with(".mtl"))
      names.push_back(name_from(folder_of(path), companion));
  return names;
}

std::string write_obj(const MeshFile& file, const WriteOptions& options, const std::string& path) {
  return serialise_obj(file, options.faces, libraries_from(path, file));
}

/// What the comments do not say of a brain's surface, its names do: its own, else that of the file
/// it is made of.
std::string write_gifti(const MeshFile& file, const WriteOptions& options,
                        const std::string& path) {
  GiftiOptions told;
  const auto is_said = [&](std::string_view key) {
    return std::ranges::any_of(file.comments, [&](const std::string& comment) {
      return comment.starts_with("gifti " + std::string(key) + " ");
    });
  };
  if (!is_said("AnatomicalStructurePrimary")) {
    told.anatomical_structure = structure_of_name(path);
    if (told.anatomical_structure.empty())
      told.anatomical_structure = structure_of_name(options.origin);
  }
  if (options.is_sphere) {
    told.geometric_type = "Spherical";
  } else if (!is_said("GeometricType")) {
    SurfaceWords words = surface_words_of_name(path);
    if (words.geometric_type.empty()) words = surface_words_of_name(options.origin);
    told.geometric_type = words.geometric_type;
    if (!is_said("AnatomicalStructureSecondary"))
      told.secondary_structure = words.secondary_structure;
  }
  return serialise_gifti(file, told);
}

constexpr bool with_map = true, without_map = false;
constexpr bool spheres_in_floats = true, spheres_in_doubles = false;
constexpr bool with_data_beside = true, without_data_beside = false;
constexpr bool with_own_corners = true;
constexpr auto magic = Evidence::MagicWord;

constexpr MeshFormat formats[] = {
    {"OBJ",
     {".obj"},
     Evidence::Text,
     looks_like_obj,
     read_obj_files,
     write_obj,
     without_map,
     spheres_in_doubles},
    {"PLY",
     {".ply"},
     magic,
     looks_like_ply,
     read_scene_files<read_ply>,
     write<write_ply>,
     with_map,
     spheres_in_doubles},
    {"OFF",
     {".off"},
     magic,
     looks_like_off,
     read<read_off>,
     write<serialise_off>,
     without_map,
     spheres_in_doubles},
    {"STL",
     {".stl"},
     Evidence::Layout,
     looks_like_stl,
     read<read_stl>,
     write<serialise_stl>,
     without_map,
     spheres_in_doubles,
     without_data_beside,
     with_own_corners},
    {"3MF",
     {".3mf"},
     magic,
     looks_like_three_mf,
     read<read_three_mf>,
     nullptr,
     without_map,
     spheres_in_doubles},
    {"glTF, GLB",
     {".gltf", ".glb"},
     magic,
     looks_like_gltf,
     read_gltf_files,
     nullptr,
     without_map,
     spheres_in_doubles},
    {"FBX",
     {".fbx"},
     magic,
     looks_like_fbx,
     read_scene_files<read_fbx>,
     nullptr,
     without_map,
     spheres_in_doubles},
    {"COLLADA",
     {".dae"},
     magic,
     looks_like_collada,
     read_scene_files<read_collada>,
     nullptr,
     without_map,
     spheres_in_doubles},
    {"3DS",
     {".3ds"},
     Evidence::Layout,
     looks_like_3ds,
     read_scene_files<read_3ds>,
     nullptr,
     without_map,
     spheres_in_doubles},
    {"X3D",
     {".x3d"},
     magic,
     looks_like_x3d,
     read_scene_files<read_x3d>,
     nullptr,
     without_map,
     spheres_in_doubles},
    {"VTK",
     {".vtk"},
     magic,
     looks_like_legacy_vtk,
     read<read_legacy_vtk>,
     write<serialise_legacy_vtk>,
     with_map,
     spheres_in_doubles},
    {"VTP",
     {".vtp"},
     magic,
     looks_like_xml_vtk,
     read<read_xml_vtk>,
     write<serialise_xml_vtk>,
     with_map,
     spheres_in_doubles},
    {"GIFTI",
     {".gii"},
     magic,
     looks_like_gifti,
     read<read_gifti>,
     write_gifti,
     without_map,
     spheres_in_floats,
     with_data_beside},
    {"FreeSurfer",
     {".white", ".pial", ".inflated", ".sphere", ".orig", ".smoothwm", ".reg", ".surf",
      ".midthickness", ".graymid"},
     magic,
     looks_like_freesurfer,
     read<read_freesurfer>,
     write<serialise_freesurfer>,
     without_map,
     spheres_in_floats,
     with_data_beside},
    {"MZ3",
     {".mz3"},
     Evidence::Layout,
     looks_like_mz3,
     read<read_mz3>,
     write<serialise_mz3>,
     without_map,
     spheres_in_floats},
    {"ICQ",
     {".icq"},
     Evidence::Text,
     looks_like_icq,
     read<read_icq>,
     nullptr,
     without_map,
     spheres_in_doubles},
    {"PDS plate table",
     {".plt", ".tab", ".ver"},
     Evidence::Text,
     looks_like_plates,
     read<read_plates>,
     nullptr,
     without_map,
     spheres_in_doubles},
};

}  // namespace

std::span<const MeshFormat> mesh_formats() { return formats; }

const MeshFormat* format_of_extension(std::string_view extension) {
  if (extension.empty()) return nullptr;
  const auto found = std::ranges::find_if(formats, [&](const MeshFormat& format) {
    return std::ranges::find(format.extensions, extension) != format.extensions.end();
  });
  return found == std::end(formats) ? nullptr : found;
}

}  // namespace sphparam
