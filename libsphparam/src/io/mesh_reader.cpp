#include "sphparam/io/mesh_reader.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <optional>

#include "io/files/file_bytes.h"
#include "io/formats/gifti/gifti_reader.h"
#include "io/formats/gltf/gltf_reader.h"
#include "io/files/gzip.h"
#include "io/formats/obj_reader.h"
#include "io/formats/off_reader.h"
#include "io/formats/ply_reader.h"
#include "io/formats/stl_reader.h"

namespace sphparam {
namespace {

struct ForeignFormat {
  std::string_view mark;  // magic bytes, or extension
  const char* name;
};

// Formats that are recognised to be refused by name.
constexpr ForeignFormat kForeignMagic[] = {
    {"PK\x03\x04", "a ZIP archive (unpack it first)"},
    {"\xfd"
     "7zXZ",
     "xz-compressed data (unpack it first)"},
    {"BZh", "bzip2-compressed data (unpack it first)"},
    {"MZ", "MZ3"},
    {"\xff\xff\xfe", "a FreeSurfer surface"},
    {"Kaydara FBX", "FBX"},
    {"<?xml", "XML other than GIFTI (COLLADA or VTK)"},
    {"# vtk DataFile", "legacy VTK"},
    {"\x89PNG", "a PNG image"},
    {"\xff\xd8\xff", "a JPEG image"},
};

constexpr ForeignFormat kForeignExtensions[] = {
    {"mz3", "MZ3"}, {"fbx", "FBX"}, {"dae", "COLLADA"}, {"3ds", "3DS"},   {"vtk", "legacy VTK"},
    {"vtp", "VTK"}, {"msh", "MSH"}, {"stp", "STEP"},    {"step", "STEP"},
};

/// In lower case; of "statue.obj.gz" the one of what is in it.
std::string extension_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || name.find('/', dot) != std::string::npos) return {};
  std::string extension = name.substr(dot + 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == "gz" ? extension_of(name.substr(0, dot)) : extension;
}

bool looks_like_ply(std::string_view bytes) {
  return bytes.starts_with("ply") &&
         (bytes.size() == 3 || std::isspace(static_cast<unsigned char>(bytes[3])));
}

bool looks_like_gltf(std::string_view bytes) {
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return bytes.starts_with("glTF") || (start != std::string_view::npos && bytes[start] == '{');
}

// OBJ has no magic word: the first line that is no comment must start with a statement.
bool looks_like_obj(std::string_view bytes) {
  static constexpr std::string_view kStatements[] = {"v", "vn", "vt",     "f",     "g",
                                                     "o", "s",  "mtllib", "usemtl"};
  constexpr std::string_view kBlanks = " \t\r\n";
  for (;;) {
    const std::size_t start = bytes.find_first_not_of(kBlanks);
    if (start == std::string_view::npos) return false;
    bytes.remove_prefix(start);
    if (bytes.front() != '#') break;
    bytes.remove_prefix(std::min(bytes.find_first_of("\r\n"), bytes.size()));
  }
  const std::string_view word = bytes.substr(0, bytes.find_first_of(kBlanks));
  return std::find(std::begin(kStatements), std::end(kStatements), word) != std::end(kStatements);
}

constexpr const char* kSupported = "OBJ, PLY, OFF, STL, glTF, GLB and GIFTI files are";

[[noreturn]] void refuse(const std::string& name, const char* format) {
  throw ReadError(name,
                  std::string("this is ") + format + ", which is not supported; " + kSupported);
}

void refuse_foreign_content(std::string_view bytes, const std::string& name) {
  if (extension_of(name) == "mz3") refuse(name, "MZ3");
  for (const auto& [magic, format] : kForeignMagic) {
    // An OBJ may open with any comment, also with "# vtk DataFile".
    if (bytes.starts_with(magic) && !(magic.front() == '#' && looks_like_obj(bytes)))
      refuse(name, format);
  }
}

/// `folder` is where the buffers of a glTF may be, if anywhere.
MeshFile read_unpacked(std::string_view bytes, const std::string& name,
                       const std::optional<std::filesystem::path>& folder,
                       const ReadOptions& options) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  if (bytes.empty()) throw ReadError(name, "the file is empty");

  if (looks_like_ply(bytes)) return read_ply(bytes, name, options);
  if (looks_like_off(bytes)) return read_off(bytes, name, options);
  if (looks_like_gltf(bytes)) return read_gltf(bytes, name, folder, options);
  if (looks_like_gifti(bytes)) return read_gifti(bytes, name, options);
  if (looks_like_binary_stl(bytes) || looks_like_ascii_stl(bytes))
    return read_stl(bytes, name, options);
  refuse_foreign_content(bytes, name);

  const std::string extension = extension_of(name);
  if (extension == "obj" || looks_like_obj(bytes)) return read_obj(bytes, name, options);
  if (extension == "ply") throw ReadError::at_line(name, 1, "expected the magic word 'ply'");
  if (extension == "off") return read_off(bytes, name, options);
  if (extension == "stl") return read_stl(bytes, name, options);
  if (extension == "glb" || extension == "gltf") throw ReadError(name, "is no glTF");
  if (extension == "gii") return read_gifti(bytes, name, options);
  for (const auto& [foreign, format] : kForeignExtensions)
    if (extension == foreign) refuse(name, format);
  throw ReadError(name, std::string("the format is not recognised; ") + kSupported);
}

MeshFile read_gzip(std::string_view bytes, const std::string& name,
                   const std::optional<std::filesystem::path>& folder, const ReadOptions& options) {
  const Unzipped unzipped = unzip(bytes, name, options.max_file_bytes);
  if (looks_like_gzip(unzipped.bytes)) refuse(name, "gzip-compressed data within gzip");
  MeshFile file = read_unpacked(unzipped.bytes, name, folder, options);
  file.format += ", gzip";
  if (unzipped.trailing_data) file.notes.push_back("data after the end of the gzip data ignored");
  return file;
}

MeshFile read_bytes(std::string_view bytes, const std::string& name,
                    const std::optional<std::filesystem::path>& folder,
                    const ReadOptions& options) {
  if (bytes.size() > options.max_file_bytes)
    throw ReadError(
        name, "is larger than the limit of " + std::to_string(options.max_file_bytes) + " bytes");
  const bool packed = looks_like_gzip(bytes) && extension_of(name) != "mz3";  // which is gzip too
  return packed ? read_gzip(bytes, name, folder, options)
                : read_unpacked(bytes, name, folder, options);
}

}  // namespace

MeshFile read_mesh(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return read_bytes(bytes, name, std::nullopt, options);
}

MeshFile read_mesh(const std::string& path, const ReadOptions& options) {
  const FileBytes bytes(path, options.max_file_bytes);
  const bool is_file = path != "-";
  return read_bytes(
      bytes.view(), bytes.name(),
      is_file ? std::optional(std::filesystem::path(path).parent_path()) : std::nullopt, options);
}

}  // namespace sphparam
