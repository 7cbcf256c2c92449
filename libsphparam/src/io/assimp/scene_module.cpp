// The only code that knows assimp. Scenes become glTF, which our own reader takes: meshes where
// their nodes put them, materials, pictures inside the file; pictures beside it by name.

#include "io/assimp/scene_module.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/matrix4x4.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <exception>
#include <new>
#include <string>
#include <string_view>

namespace {

constexpr unsigned steps =
    aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType;

/// FBX says which axis is up; glTF has y.
void turn_up(const aiScene& scene) {
  int axis = 1;
  if (!scene.mMetaData || !scene.mMetaData->Get("UpAxis", axis) || axis != 2) return;
  const aiMatrix4x4 z_to_y(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
  scene.mRootNode->mTransformation = z_to_y * scene.mRootNode->mTransformation;
}

/// Where a picture is beside the scene: paths of other machines are of no use but for their end.
std::string place_here(std::string path) {
  std::ranges::replace(path, '\\', '/');
  const bool is_absolute = path.starts_with('/') || path.find(':') != std::string::npos;
  if (is_absolute || path.starts_with("../")) path.erase(0, path.rfind('/') + 1);
  return path;
}

void name_pictures(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMaterials; ++m) {
    for (unsigned kind = 0; kind <= AI_TEXTURE_TYPE_MAX; ++kind) {
      aiString path;
      const auto type = static_cast<aiTextureType>(kind);
      if (scene.mMaterials[m]->GetTexture(type, 0, &path) != aiReturn_SUCCESS) continue;
      if (path.C_Str()[0] == '*') continue;  // inside the file
      const aiString here(place_here(path.C_Str()));
      scene.mMaterials[m]->AddProperty(&here, AI_MATKEY_TEXTURE(type, 0));
    }
  }
}

void tell(SphparamSceneSink sink, void* context, std::string_view text) {
  sink(context, text.data(), text.size());
}

int to_glb(const char* kind, const char* bytes, size_t size, SphparamSceneSink glb,
           void* glb_context, SphparamSceneSink error, void* error_context) try {
  Assimp::Importer importer;
  // A scene without meshes is not to show its nodes in their stead.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* const scene = importer.ReadFileFromMemory(bytes, size, steps, kind);
  if (!scene || !scene->mRootNode) {
    tell(error, error_context, importer.GetErrorString());
    return 1;
  }
  turn_up(*scene);
  name_pictures(*scene);
  Assimp::Exporter exporter;
  const aiExportDataBlob* const blob = exporter.ExportToBlob(scene, "glb2");
  if (!blob) {
    tell(error, error_context, exporter.GetErrorString());
    return 1;
  }
  glb(glb_context, static_cast<const char*>(blob->data), blob->size);
  return 0;
} catch (const std::bad_alloc&) {
  tell(error, error_context, "it asks for more memory than it may take");
  return 1;
} catch (const std::exception& problem) {
  tell(error, error_context, problem.what());
  return 1;
}

constexpr SphparamSceneTable table = {sphparam_scene_table_version, to_glb};

}  // namespace

extern "C" __attribute__((visibility("default"))) const SphparamSceneTable* sphparam_scene_table() {
  return &table;
}
