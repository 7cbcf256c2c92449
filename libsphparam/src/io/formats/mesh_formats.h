#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// How surely bytes are of a format when they look like it. What is surer is asked first: a magic
/// word; a layout that cannot be chance; a text that could be of no other format that we read.
enum class Evidence { MagicWord, Layout, Text };

/// A file in memory, unpacked.
struct MeshBytes {
  std::string_view bytes;
  const std::string& name;                      // for messages
  std::optional<std::filesystem::path> folder;  // where files next to it may be, if anywhere
};

/// A format of mesh files.
struct MeshFormat {
  const char* names;                            // for people: "glTF, GLB"
  std::array<std::string_view, 10> extensions;  // in lower case, with their dots; then empty ones
  Evidence evidence;                            // that `looks_so` gives
  bool (*looks_so)(std::string_view bytes);
  /// Also of bytes that do not look so, where a file is named so: the reader says what is wrong.
  MeshFile (*read)(const MeshBytes& bytes, const ReadOptions& options);
  /// Null: it is only read. Where a format has no polygons, the triangles are written. The path
  /// says nothing but what the file is named.
  std::string (*write)(const MeshFile& file, const WriteOptions& options, const std::string& path);
  bool keeps_map;            // what is written has a place for the rays
  bool float_spheres;        // spheres are written with coordinates of 32 bits, of radius 100
  bool data_beside = false;  // numbers a vertex lie beside, in files of their own
  bool own_corners = false;  // of each triangle: a reader numbers vertices as they come
};

/// All formats, in the order in which they are named to people.
std::span<const MeshFormat> mesh_formats();

/// By an extension, in lower case, with its dot; null where there is none.
const MeshFormat* format_of_extension(std::string_view extension);

}  // namespace sphparam
