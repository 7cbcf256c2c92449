#include "mesh_io/mesh_reader.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "mesh_io/file_bytes.h"
#include "mesh_io/obj_reader.h"
#include "mesh_io/off_reader.h"
#include "mesh_io/ply_reader.h"

namespace sphparam::tools {
namespace {

struct ForeignFormat {
  std::string_view mark;  // magic bytes, or extension
  const char* name;
};

// Formats that are recognised to be refused by name.
constexpr ForeignFormat kForeignMagic[] = {
    {"\x1f\x8b", "gzip-compressed data (unpack it first)"},
    {"PK\x03\x04", "a ZIP archive (unpack it first)"},
    {"\xfd"
     "7zXZ",
     "xz-compressed data (unpack it first)"},
    {"BZh", "bzip2-compressed data (unpack it first)"},
    {"glTF", "binary glTF (GLB)"},
    {"MZ", "MZ3"},
    {"\xff\xff\xfe", "a FreeSurfer surface"},
    {"Kaydara FBX", "FBX"},
    {"solid", "STL"},
    {"<?xml", "XML (GIFTI, COLLADA or VTK)"},
    {"# vtk DataFile", "legacy VTK"},
    {"\x89PNG", "a PNG image"},
    {"\xff\xd8\xff", "a JPEG image"},
};

constexpr ForeignFormat kForeignExtensions[] = {
    {"gz", "gzip-compressed data (unpack it first)"},
    {"stl", "STL"},
    {"glb", "binary glTF (GLB)"},
    {"gltf", "glTF"},
    {"gii", "GIFTI"},
    {"mz3", "MZ3"},
    {"fbx", "FBX"},
    {"dae", "COLLADA"},
    {"3ds", "3DS"},
    {"vtk", "legacy VTK"},
    {"vtp", "VTK"},
    {"msh", "MSH"},
    {"stp", "STEP"},
    {"step", "STEP"},
};

std::string extension_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || name.find('/', dot) != std::string::npos) return {};
  std::string extension = name.substr(dot + 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool looks_like_ply(std::string_view bytes) {
  return bytes.starts_with("ply") &&
         (bytes.size() == 3 || std::isspace(static_cast<unsigned char>(bytes[3])));
}

// Binary STL: 80 bytes of anything, a count n, 50 bytes a triangle.
bool looks_like_binary_stl(std::string_view bytes) {
  constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50;
  if (bytes.size() < kHeaderBytes) return false;
  std::uint32_t count = 0;
  for (int i = 3; i >= 0; --i) count = count << 8 | static_cast<unsigned char>(bytes[80 + i]);
  return bytes.size() == kHeaderBytes + kTriangleBytes * std::uint64_t{count} &&
         bytes.find('\0') != std::string_view::npos;
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

[[noreturn]] void refuse(const std::string& name, const char* format) {
  throw ReadError(name, std::string("this is ") + format +
                            ", which is not supported; OBJ, PLY and OFF files are");
}

void refuse_foreign_content(std::string_view bytes, const std::string& name) {
  for (const auto& [magic, format] : kForeignMagic)
    if (bytes.starts_with(magic)) refuse(name, format);
  if (looks_like_binary_stl(bytes)) refuse(name, "binary STL");
}

}  // namespace

MeshFile read_mesh(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (bytes.size() > options.max_file_bytes)
    throw ReadError(
        name, "is larger than the limit of " + std::to_string(options.max_file_bytes) + " bytes");
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  if (bytes.empty()) throw ReadError(name, "the file is empty");

  if (looks_like_ply(bytes)) return read_ply(bytes, name, options);
  if (looks_like_off(bytes)) return read_off(bytes, name, options);
  refuse_foreign_content(bytes, name);

  const std::string extension = extension_of(name);
  if (extension == "obj" || looks_like_obj(bytes)) return read_obj(bytes, name, options);
  if (extension == "ply") throw ReadError::at_line(name, 1, "expected the magic word 'ply'");
  if (extension == "off") return read_off(bytes, name, options);
  for (const auto& [foreign, format] : kForeignExtensions)
    if (extension == foreign) refuse(name, format);
  throw ReadError(name, "the format is not recognised; OBJ, PLY and OFF files are");
}

MeshFile read_mesh(const std::string& path, const ReadOptions& options) {
  const FileBytes bytes(path, options.max_file_bytes);
  return read_mesh(bytes.view(), bytes.name(), options);
}

}  // namespace sphparam::tools
