#include "io/formats/scene_reader.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include "io/assimp/scene_module.h"
#include "io/attributes/named_file.h"
#include "io/files/child_process.h"
#include "io/files/modules.h"
#include "io/formats/gltf/gltf_reader.h"

namespace sphparam {
namespace {

constexpr ModuleWords words = {"sphparam_scene_assimp.so", "module for FBX, COLLADA, 3DS and X3D",
                               "the Debian package libassimp5 has assimp, which it opens"};

const SphparamSceneTable& scene_table() {
  static const auto* const table = [] {
    const auto function = reinterpret_cast<SphparamSceneTableFunction>(
        function_of_module(words, sphparam_scene_table_name));
    if (!function || function()->version != sphparam_scene_table_version)
      throw ModuleError(std::string(words.file) + " belongs to another version of this program");
    return function();
  }();
  return *table;
}

SphparamSceneSink into(std::string& all) {
  return {[](void* context, const char* bytes, size_t size) {
            static_cast<std::string*>(context)->append(bytes, size);
          },
          &all};
}

/// What assimp complains of.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Broken files make assimp go round and round. What is packed in a file may be some times as much.
ChildLimits limits_for(std::string_view bytes) {
  constexpr std::uint64_t seconds = 5, seconds_per_megabyte = 10;
  constexpr std::uint64_t memory = std::uint64_t{256} << 20, memory_per_byte = 200;
  return {.seconds = seconds + seconds_per_megabyte * (bytes.size() >> 20),
          .bytes = memory + memory_per_byte * bytes.size()};
}

struct Scene {
  SphparamSceneCounts counts = {};
  std::string warnings;  // a line each
  std::string glb;
};

using Folder = std::optional<std::filesystem::path>;

/// Whether pictures are beside the scene; of a scene without a folder nobody knows, and all are.
SphparamSceneFiles files_in(const Folder& folder) {
  return {[](void* context, const char* name) -> int {
            const auto& place = *static_cast<const Folder*>(context);
            std::error_code hidden;
            return !place ||
                   std::filesystem::exists(*place / file_below(*place, "", name).path, hidden);
          },
          const_cast<Folder*>(&folder)};
}

/// In a process of its own: broken files make assimp crash.
Scene scene_of(const char* kind, std::string_view bytes, const Folder& folder) {
  const SphparamSceneTable& scenes = scene_table();
  const std::string answer = result_of_child(
      [&] {
        std::string glb, warnings, complaint(1, '!');
        SphparamSceneCounts counts = {};
        const int code = scenes.to_glb(kind, bytes.data(), bytes.size(), files_in(folder),
                                       into(glb), &counts, into(warnings), into(complaint));
        if (code != 0) return complaint;
        return std::to_string(counts.skins) + ' ' + std::to_string(counts.animations) + ' ' +
               std::to_string(warnings.size()) + ' ' + warnings + glb;
      },
      limits_for(bytes));
  if (answer.starts_with('!'))
    throw SceneError(answer.size() > 1 ? answer.substr(1) : "cannot be read");
  std::size_t at = 0;
  const auto next = [&] {
    const std::size_t start = std::exchange(at, answer.find(' ', at) + 1);
    return std::stol(answer.substr(start, at - start));
  };
  const SphparamSceneCounts counts = {.skins = next(), .animations = next()};
  const auto length = static_cast<std::size_t>(next());
  return {counts, answer.substr(at, length), answer.substr(at + length)};
}

/// What it says of every file of today, or of how it works.
bool is_idle(std::string_view warning) {
  constexpr std::array<std::string_view, 2> idle = {"newer format version",
                                                    "No hierarchy information"};
  return std::ranges::any_of(
      idle, [&](std::string_view words) { return warning.find(words) != std::string_view::npos; });
}

/// What assimp warned of, each once and no more than some.
std::vector<std::string> notes_of(std::string_view warnings) {
  constexpr std::size_t most = 8;
  std::vector<std::string> notes;
  std::size_t more = 0;
  while (!warnings.empty()) {
    const std::size_t end = std::min(warnings.find('\n'), warnings.size());
    const std::string_view line = warnings.substr(0, end);
    warnings.remove_prefix(std::min(end + 1, warnings.size()));
    const std::size_t words = line.find(": ");  // "Warn,  T0: …"
    if (words == std::string_view::npos || is_idle(line)) continue;
    std::string note = "assimp: " + one_line(line.substr(words + 2));
    note.erase(note.find_last_not_of(' ') + 1);
    if (std::ranges::find(notes, note) != notes.end()) continue;
    if (notes.size() < most)
      notes.push_back(note);
    else
      ++more;
  }
  if (more > 0) notes.push_back("assimp: " + std::to_string(more) + " warnings more");
  return notes;
}

/// What assimp calls a file that lies in memory.
std::string without_name_of_memory(std::string text) {
  const std::size_t at = text.find(": $$$___magic___$$$");
  return text.substr(0, at);
}

MeshFile read_scene(const char* kind, const char* format, std::string_view bytes,
                    const std::string& name, const std::optional<std::filesystem::path>& folder,
                    const ReadOptions& options) try {
  const Scene scene = scene_of(kind, bytes, folder);
  MeshFile file = read_gltf(scene.glb, name, folder, options,
                            {.posed_skins = scene.counts.skins,
                             .animations = scene.counts.animations,
                             .specular_glossiness = "specular colour and shininess",
                             .has_own_extras = false});
  file.format = format;
  std::ranges::move(notes_of(scene.warnings), std::back_inserter(file.notes));
  return file;
} catch (const ModuleError& error) {
  throw ReadError(name, error.what());
} catch (const ChildEnded& error) {
  throw ReadError(name, std::string("assimp cannot read it: it ") + error.what());
} catch (const SceneError& error) {
  throw ReadError(name, one_line(without_name_of_memory(error.what())));
}

bool begins_with_element(std::string_view bytes, std::string_view element) {
  constexpr size_t far_enough = 1024;
  return bytes.substr(0, far_enough).find(element) != std::string_view::npos;
}

}  // namespace

bool looks_like_fbx(std::string_view bytes) {
  return bytes.starts_with("Kaydara FBX Binary") || bytes.starts_with("; FBX ");
}

bool looks_like_collada(std::string_view bytes) { return begins_with_element(bytes, "<COLLADA"); }
bool looks_like_x3d(std::string_view bytes) { return begins_with_element(bytes, "<X3D"); }

// A chunk that is the file, which begins with another: its version, what is edited, or a material.
bool looks_like_3ds(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::array first = {"\x02\0"sv, "\x3D\x3D"sv, "\xFF\xAF"sv};
  constexpr size_t header = 6;  // what it is, and its length
  if (bytes.size() < 2 * header || !bytes.starts_with("MM")) return false;
  return std::ranges::find(first, bytes.substr(header, 2)) != first.end();
}

MeshFile read_fbx(std::string_view bytes, const std::string& name,
                  const std::optional<std::filesystem::path>& folder, const ReadOptions& options) {
  return read_scene("fbx", "FBX", bytes, name, folder, options);
}

MeshFile read_collada(std::string_view bytes, const std::string& name,
                      const std::optional<std::filesystem::path>& folder,
                      const ReadOptions& options) {
  return read_scene("dae", "COLLADA", bytes, name, folder, options);
}

MeshFile read_3ds(std::string_view bytes, const std::string& name,
                  const std::optional<std::filesystem::path>& folder, const ReadOptions& options) {
  return read_scene("3ds", "3DS", bytes, name, folder, options);
}

MeshFile read_x3d(std::string_view bytes, const std::string& name,
                  const std::optional<std::filesystem::path>& folder, const ReadOptions& options) {
  return read_scene("x3d", "X3D", bytes, name, folder, options);
}

}  // namespace sphparam
