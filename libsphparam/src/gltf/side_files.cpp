// Files beside an export, which are called by its name. One that is there is replaced only where an
// export wrote it: the .gltf, .mtl, .ply or .usda of that name is as we write it, and names it.
// Whatever else is there may be somebody's texture or buffer.

#include "gltf/side_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "gltf/textured_mesh.h"
#include "io/files/file_bytes.h"
#include "io/shell_word.h"
#include "io/uri.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t head_size = 65'536;  // generators and comments come first

/// What one of our files looks like that names files beside it: words of its head, and how it
/// names one.
struct OwnFile {
  const char* extension;
  std::string mark;
  std::string (*naming)(const std::string& name);
};

std::array<OwnFile, 4> own_files() {
  return {{{".gltf", "\"generator\": \"sphparam ",
            [](const std::string& name) { return "\"" + uri_of_file(name) + "\""; }},
           {".mtl", own_library_head(), [](const std::string& name) { return " " + name + "\n"; }},
           {".ply", "\ncomment sphparam material sphparam\n",
            [](const std::string& name) { return "\ncomment TextureFile " + name + "\n"; }},
           {".usda", "string creator = \"sphparam ",
            [](const std::string& name) { return "@./" + name + "@"; }}}};
}

bool is_there(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// Whether an export of this path's name wrote the file `owner`, and says in it that `name` belongs
/// to it.
bool names(const OwnFile& owner, const std::string& path, const std::string& name) try {
  const std::string file = path_beside(path, stem_of_export(path) + owner.extension);
  if (!is_there(file)) return false;
  const FileBytes bytes(file, std::numeric_limits<std::uint64_t>::max());
  return bytes.view().substr(0, head_size).find(owner.mark) != std::string_view::npos &&
         bytes.view().find(owner.naming(name)) != std::string_view::npos;
} catch (const ReadError&) {
  return false;
}

bool is_own_library(const std::string& file) try {
  const FileBytes bytes(file, std::numeric_limits<std::uint64_t>::max());
  return bytes.view().starts_with(own_library_head());
} catch (const ReadError&) {
  return false;
}

bool holds(const std::string& file, std::string_view bytes) try {
  return FileBytes(file, std::numeric_limits<std::uint64_t>::max()).view() == bytes;
} catch (const ReadError&) {
  return false;
}

bool is_own(const std::string& path, const std::string& file) {
  if (extension_of(file) == ".mtl") return is_own_library(file);
  const std::string name = fs::path(file).filename().string();
  return std::ranges::any_of(own_files(),
                             [&](const OwnFile& owner) { return names(owner, path, name); });
}

/// What is said of a file that is not ours.
std::string word_of(const std::string& file) {
  const std::string kind = extension_of(file);
  return kind == ".mtl" ? "library" : kind == ".bin" ? "buffer" : "image";
}

bool is_blank(char byte) { return byte == ' '; }

/// Line breaks and the like, and what readers take for the end of a folder's name.
bool ends_names(char byte) {
  return static_cast<unsigned char>(byte) < ' ' || byte == '\x7F' || byte == '\\';
}

}  // namespace

std::string path_beside(const std::string& path, const std::string& name) {
  return (fs::path(path).parent_path() / name).string();
}

std::string stem_of_export(const std::string& path) { return fs::path(path).stem().string(); }

std::string library_of(const std::string& obj) {
  return path_beside(obj, stem_of_export(obj) + ".mtl");
}

void require_own_file(const std::string& path, const std::string& file, std::string_view bytes) {
  if (!is_there(file) || is_own(path, file) || holds(file, bytes)) return;
  const std::string other =
      path_beside(path, stem_of_export(path) + "_sphparam" + fs::path(path).extension().string());
  throw WriteError(file, "is there, and is no " + word_of(file) + " of an export: -o " +
                             shell_file(other) + " leaves it as it is");
}

void require_name_of_line(const std::string& path) {
  const std::string stem = stem_of_export(path);
  const std::string kind = extension_of(path);
  if (stem.empty() || (kind != ".obj" && kind != ".ply" && kind != ".usda")) return;
  const bool ends_quotes = kind == ".usda" && stem.find("@@@") != std::string::npos;
  if (std::ranges::any_of(stem, ends_names) || is_blank(stem.front()) || ends_quotes)
    throw WriteError(path,
                     "the files beside a " + kind +
                         " are named in lines of text, where names have no line breaks or "
                         "other control characters, no backslash, no @@@, and no blank first");
}

}  // namespace sphparam
