#include "sphparam/io/mesh_reader.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>

#include "io/attributes/named_file.h"
#include "io/files/file_bytes.h"
#include "io/files/gzip.h"
#include "io/files/text_scanner.h"
#include "io/formats/mesh_formats.h"
#include "io/formats/shapes/plain_table.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "sphparam/io/coarse_coordinates.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam {
namespace {

struct ForeignFormat {
  std::string_view mark;  // magic bytes, or extension
  const char* name;
};

// Formats that are recognised to be refused by name.
constexpr ForeignFormat foreign_magic[] = {
    {"PK\x03\x04", "a ZIP archive (unpack it first)"},
    {"\xfd"
     "7zXZ",
     "xz-compressed data (unpack it first)"},
    {"BZh", "bzip2-compressed data (unpack it first)"},
    {"Kaydara FBX", "FBX"},
    {"<?xml", "XML other than GIFTI and VTP (COLLADA?)"},
    {"\x89PNG", "a PNG image"},
    {"\xff\xd8\xff", "a JPEG image"},
    {"DAS/DSK",
     "a DSK of SPICE (NAIF's `dskexp -dsk FILE -text FILE.obj -format obj` turns it into OBJ)"},
    {"PDS_VERSION_ID",
     "a PDS label (its table is a file of its own, where it has one; one that comes after the "
     "label's END begins with the numbers of its vertices and plates)"},
};

constexpr ForeignFormat foreign_extensions[] = {
    {".fbx", "FBX"}, {".dae", "COLLADA"}, {".vtu", "VTK other than polydata"},
    {".msh", "MSH"}, {".stp", "STEP"},    {".step", "STEP"},
};

// Of those in ZIP or XML, which is all that their first bytes say.
constexpr ForeignFormat foreign_wrapped[] = {{".amf", "AMF"}, {".usdz", "USDZ"}};

std::string supported() { return readable_formats("and") + " files are"; }

[[noreturn]] void refuse(const std::string& name, const char* format) {
  throw ReadError(name,
                  std::string("this is ") + format + ", which is not supported; " + supported());
}

void refuse_foreign_name(std::span<const ForeignFormat> formats, const std::string& extension,
                         const std::string& name) {
  for (const auto& [foreign, format] : formats)
    if (extension == foreign) refuse(name, format);
}

void refuse_foreign_content(std::string_view bytes, const std::string& name) {
  for (const auto& [magic, format] : foreign_magic)
    if (bytes.starts_with(magic)) refuse(name, format);
}

[[noreturn]] void refuse_volume(const std::string& name) {
  throw ReadError(name,
                  "this is a volume (NIfTI), not a mesh: make a surface of it first, as marching "
                  "cubes does; see docs/neuroimaging.md");
}

/// By the magic word of either version's header, a volume or what CIFTI has in its place.
void refuse_nifti(std::string_view bytes, const std::string& name) {
  constexpr std::size_t first = 344, second = 4, intent = 504;
  const auto has = [&](std::size_t at, std::string_view word) {
    return bytes.size() >= 348 && bytes.substr(at, word.size()) == word;
  };
  using namespace std::string_view_literals;
  const bool is_second = has(second, "n+2\0"sv) || has(second, "ni2\0"sv);
  if (!is_second && !has(first, "n+1\0"sv) && !has(first, "ni1\0"sv)) return;
  if (is_second && bytes.size() >= intent + 4) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
    const int little = byte(intent) | byte(intent + 1) << 8;
    const int big = byte(intent + 3) | byte(intent + 2) << 8;
    for (const int code : {little, big})  // either byte order
      if (code >= 3000 && code < 3100) refuse(name, "CIFTI-2 (data of a surface, not a mesh)");
  }
  refuse_volume(name);
}

/// What the bytes look like, by evidence of this kind.
const MeshFormat* recognised(std::string_view bytes, Evidence evidence) {
  for (const MeshFormat& format : mesh_formats())
    if (format.evidence == evidence && format.looks_so(bytes)) return &format;
  return nullptr;
}

/// A table of numbers behind a label of its own.
const MeshFormat* labelled(std::string_view bytes) {
  if (!has_pds_label(bytes)) return nullptr;
  for (const char* extension : {".plt", ".icq"}) {
    const MeshFormat* const format = format_of_extension(extension);
    if (format && format->looks_so(bytes)) return format;
  }
  return nullptr;
}

/// The format that a file is to be read as. Texts without a magic word are believed last; one that
/// looks like its name, before others.
/// Throws: ReadError, with the name of a format that is not read where it is known.
const MeshFormat& format_of(std::string_view bytes, const std::string& name) {
  for (const Evidence evidence : {Evidence::MagicWord, Evidence::Layout})
    if (const MeshFormat* format = recognised(bytes, evidence)) return *format;
  const std::string extension = inner_extension_of(name);
  refuse_foreign_name(foreign_wrapped, extension, name);
  if (const MeshFormat* format = labelled(bytes)) return *format;
  refuse_foreign_content(bytes, name);
  refuse_nifti(bytes, name);
  const MeshFormat* const named = format_of_extension(extension);
  if (named && named->looks_so(bytes)) return *named;
  if (const MeshFormat* format = recognised(bytes, Evidence::Text)) return *format;
  if (named) return *named;
  if (extension == ".nii") refuse_volume(name);
  refuse_foreign_name(foreign_extensions, extension, name);
  throw ReadError(name, "the format is not recognised; " + supported());
}

/// `folder` is where the buffers of a glTF may be, if anywhere.
MeshFile read_unpacked(std::string_view bytes, const std::string& name,
                       const std::optional<std::filesystem::path>& folder,
                       const ReadOptions& options) {
  bytes = without_byte_order_mark(bytes);  // which no format knows its files by
  if (bytes.empty()) throw ReadError(name, "the file is empty");
  return format_of(bytes, name).read({bytes, name, folder}, options);
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

/// A name that only the components of a mesh bear, each with its number.
/// Throws: ReadError, with the names that are there.
void refuse_name_of_parts(const std::string& path) {
  constexpr int most = 9999;  // the numbers have four digits
  std::error_code error;
  if (path == "-" || std::filesystem::exists(path, error)) return;
  std::vector<std::string> found;
  for (int part = 1; part <= most; ++part) {
    std::string name = path_of_part(path, part);
    if (std::filesystem::exists(name, error)) found.push_back(std::move(name));
  }
  if (found.empty()) return;
  const std::string last = found.size() > 1 ? " to " + found.back() : "";
  throw ReadError(path, "there is no such file, but its " +
                            counted(static_cast<long>(found.size()), "component", "components") +
                            ": name one, " + found.front() + last);
}

MeshFile read_bytes(std::string_view bytes, const std::string& name,
                    const std::optional<std::filesystem::path>& folder,
                    const ReadOptions& options) {
  if (bytes.size() > options.max_file_bytes)
    throw ReadError(name, "is larger than " + file_limit(options.max_file_bytes));
  MeshFile file = looks_like_gzip(bytes) ? read_gzip(bytes, name, folder, options)
                                         : read_unpacked(bytes, name, folder, options);
  std::string coarse = options.only_map ? "" : coarse_coordinates(file.mesh);
  if (!coarse.empty()) file.notes.push_back(std::move(coarse));
  return file;
}

/// Numbers of a surface's vertices, which people name in the place of the surface.
/// Throws: ReadError where it is such a file.
void refuse_values(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  VertexData data;
  try {
    data = read_vertex_data(bytes, name, any_vertices, options);
  } catch (const ReadError&) {
    return;
  }
  throw ReadError(name, "this is a file of values (" + data.format + "), numbers of " +
                            counted(data.vertex_count(), "vertex", "vertices") +
                            ", and no mesh: name its surface, and this beside it, as --data " +
                            shell_file(name) + "; `sphparam info` says what it holds");
}

/// Whether files that it names are not where they were looked for.
bool lacks_companions(const MeshFile& file) {
  const auto is_gone = [](const MaterialTexture& texture) {
    std::error_code hidden;
    return !texture.path.empty() &&
           !std::filesystem::exists(std::filesystem::path(texture.folder) / texture.path, hidden);
  };
  const bool no_library =
      file.format.starts_with("OBJ") && !file.materials.empty() && file.base_colours.empty();
  return no_library || std::ranges::any_of(file.base_colours, is_gone);
}

/// Reads by a link: what the file names is beside the link, or else beside the file itself.
MeshFile read_linked(const FileBytes& bytes, const std::filesystem::path& own,
                     const std::filesystem::path& target, const ReadOptions& options) {
  const auto from_target = [&]() -> std::optional<MeshFile> {
    try {
      return read_bytes(bytes.view(), bytes.name(), target, options);
    } catch (const ReadError&) {
      return std::nullopt;
    }
  };
  try {
    MeshFile file = read_bytes(bytes.view(), bytes.name(), own, options);
    if (!lacks_companions(file)) return file;
    std::optional<MeshFile> other = from_target();
    return other && !lacks_companions(*other) ? *std::move(other) : file;
  } catch (const ReadError&) {
    if (std::optional<MeshFile> other = from_target()) return *std::move(other);
    throw;
  }
}

}  // namespace

std::string readable_formats(const std::string& conjunction) {
  std::string names;
  for (const MeshFormat& format : mesh_formats())
    names += (names.empty() ? "" : ", ") + std::string(format.names);
  return names.replace(names.rfind(", "), 2, " " + conjunction + " ");
}

bool is_mesh_name(const std::string& path) {
  return format_of_extension(inner_extension_of(path)) || is_packed_name(path);
}

MeshFile read_mesh(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return read_bytes(bytes, name, std::nullopt, options);
}

MeshFile read_mesh(const std::string& path, const ReadOptions& options) {
  refuse_name_of_parts(path);
  const FileBytes bytes(path, options);
  if (path == "-") return read_bytes(bytes.view(), bytes.name(), std::nullopt, options);
  try {
    const std::filesystem::path own = std::filesystem::path(path).parent_path();
    if (const auto target = folder_behind(path)) return read_linked(bytes, own, *target, options);
    return read_bytes(bytes.view(), bytes.name(), own, options);
  } catch (const ReadError&) {
    refuse_values(bytes.view(), bytes.name(), options);
    throw;
  }
}

}  // namespace sphparam
