#include "io/formats/scene_reader.h"

#include "io/assimp/scene_module.h"
#include "io/files/child_process.h"
#include "io/files/modules.h"
#include "io/formats/gltf/gltf_reader.h"

namespace sphparam {
namespace {

constexpr ModuleWords words = {"sphparam_scene_assimp.so", "module for FBX and COLLADA",
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
  std::string glb;
};

/// In a process of its own: broken files make assimp crash.
Scene scene_of(const char* kind, std::string_view bytes) {
  const SphparamSceneTable& scenes = scene_table();
  const std::string answer = result_of_child(
      [&] {
        std::string glb, complaint(1, '!');
        SphparamSceneCounts counts = {};
        const int code =
            scenes.to_glb(kind, bytes.data(), bytes.size(), into(glb), &counts, into(complaint));
        if (code != 0) return complaint;
        return std::to_string(counts.skins) + ' ' + std::to_string(counts.animations) + ' ' + glb;
      },
      limits_for(bytes));
  if (answer.starts_with('!'))
    throw SceneError(answer.size() > 1 ? answer.substr(1) : "cannot be read");
  const std::size_t second = answer.find(' ') + 1, glb = answer.find(' ', second) + 1;
  return {
      {.skins = std::stol(answer), .animations = std::stol(answer.substr(second, glb - second))},
      answer.substr(glb)};
}

MeshFile read_scene(const char* kind, const char* format, std::string_view bytes,
                    const std::string& name, const std::optional<std::filesystem::path>& folder,
                    const ReadOptions& options) try {
  const Scene scene = scene_of(kind, bytes);
  MeshFile file = read_gltf(scene.glb, name, folder, options,
                            {.posed_skins = scene.counts.skins,
                             .animations = scene.counts.animations,
                             .specular_glossiness = "specular colour and shininess",
                             .has_own_extras = false});
  file.format = format;
  return file;
} catch (const ModuleError& error) {
  throw ReadError(name, error.what());
} catch (const ChildEnded& error) {
  throw ReadError(name, std::string("assimp cannot read it: it ") + error.what());
} catch (const SceneError& error) {
  throw ReadError(name, one_line(error.what()));
}

}  // namespace

bool looks_like_fbx(std::string_view bytes) {
  return bytes.starts_with("Kaydara FBX Binary") || bytes.starts_with("; FBX ");
}

bool looks_like_collada(std::string_view bytes) {
  constexpr size_t far_enough = 1024;
  return bytes.substr(0, far_enough).find("<COLLADA") != std::string_view::npos;
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

}  // namespace sphparam
