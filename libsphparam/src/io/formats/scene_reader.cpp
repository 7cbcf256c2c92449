#include "io/formats/scene_reader.h"

#include "io/assimp/scene_module.h"
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

void append(void* context, const char* bytes, size_t size) {
  static_cast<std::string*>(context)->append(bytes, size);
}

MeshFile read_scene(const char* kind, const char* format, std::string_view bytes,
                    const std::string& name, const std::optional<std::filesystem::path>& folder,
                    const ReadOptions& options) try {
  std::string glb, error;
  if (scene_table().to_glb(kind, bytes.data(), bytes.size(), append, &glb, append, &error) != 0)
    throw ReadError(name, one_line(error.empty() ? "cannot be read" : error));
  MeshFile file = read_gltf(glb, name, folder, options);
  file.format = format;
  return file;
} catch (const ModuleError& error) {
  throw ReadError(name, error.what());
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
