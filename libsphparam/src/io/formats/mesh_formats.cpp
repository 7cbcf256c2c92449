// The one place that knows all formats. A new one is a reader and a writer in this folder, and a
// line in the table below.

#include "io/formats/mesh_formats.h"

#include <algorithm>

#include "io/formats/gifti/gifti_reader.h"
#include "io/formats/gifti/gifti_writer.h"
#include "io/formats/gltf/gltf_reader.h"
#include "io/formats/obj_reader.h"
#include "io/formats/obj_writer.h"
#include "io/formats/off_reader.h"
#include "io/formats/off_writer.h"
#include "io/formats/ply_reader.h"
#include "io/formats/ply_writer.h"
#include "io/formats/polygon_ply.h"
#include "io/formats/stl_reader.h"

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

std::string write_ply(const MeshFile& file, const WriteOptions& options) {
  const Polygons* const faces = options.faces;
  const bool has_polygons = faces && std::ssize(faces->corners) != 3 * faces->count();
  return has_polygons ? serialise_polygon_ply(file, *faces) : serialise_ply(file);
}

std::string write_obj(const MeshFile& file, const WriteOptions& options) {
  return options.faces ? serialise_polygon_obj(file, *options.faces) : serialise_obj(file);
}

std::string write_off(const MeshFile& file, const WriteOptions&) { return serialise_off(file); }

std::string write_gifti(const MeshFile& file, const WriteOptions& options) {
  return serialise_gifti(file, {.geometric_type = options.is_sphere ? "Spherical" : ""});
}

constexpr bool with_map = true, without_map = false;

constexpr MeshFormat formats[] = {
    {"OBJ", {".obj"}, Evidence::Text, looks_like_obj, read<read_obj>, write_obj, without_map},
    {"PLY", {".ply"}, Evidence::MagicWord, looks_like_ply, read<read_ply>, write_ply, with_map},
    {"OFF", {".off"}, Evidence::MagicWord, looks_like_off, read<read_off>, write_off, without_map},
    {"STL", {".stl"}, Evidence::Layout, looks_like_stl, read<read_stl>, nullptr, without_map},
    {"glTF, GLB",
     {".gltf", ".glb"},
     Evidence::MagicWord,
     looks_like_gltf,
     read_gltf_files,
     nullptr,
     without_map},
    {"GIFTI",
     {".gii"},
     Evidence::MagicWord,
     looks_like_gifti,
     read<read_gifti>,
     write_gifti,
     without_map},
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
