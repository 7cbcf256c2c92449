// The only code that knows assimp. Scenes become glTF, which our own reader takes: meshes where
// their nodes put them, posed as the joints of their skins stand, materials, pictures inside the
// file; pictures beside it by name.

#include "io/assimp/scene_module.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/matrix4x4.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

constexpr unsigned steps =
    aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType;

/// An axis of an FBX file by what it says of it: ±x, ±y or ±z.
aiVector3D axis_of(const aiMetadata& said, const std::string& which, int usual) {
  int axis = usual, sign = 1;
  said.Get(which, axis);
  said.Get(which + "Sign", sign);
  aiVector3D direction;
  if (axis >= 0 && axis < 3) direction[static_cast<unsigned>(axis)] = sign < 0 ? -1.F : 1.F;
  return direction;
}

/// To x, y and z from what points right, up and to who looks at it; where these are no turn, from
/// what is up, if that is z.
aiMatrix4x4 turn_of(const aiMetadata& said) {
  aiVector3D right = axis_of(said, "CoordAxis", 0), front = axis_of(said, "FrontAxis", 2);
  const aiVector3D up = axis_of(said, "UpAxis", 1), z(0, 0, 1);
  if ((right ^ up) != front || front.SquareLength() != 1) {
    if (up != z) return {};
    right = {1, 0, 0};
    front = {0, -1, 0};
  }
  return {right.x, right.y, right.z, 0, up.x, up.y, up.z, 0,
          front.x, front.y, front.z, 0, 0,    0,    0,    1};
}

/// FBX says which axes it has, and how many centimetres its unit; glTF has metres.
void turn_and_scale(const aiScene& scene) {
  if (!scene.mMetaData) return;
  float centimetres = 1;
  scene.mMetaData->Get("UnitScaleFactor", centimetres);
  if (!std::isfinite(centimetres) || centimetres <= 0) centimetres = 1;
  aiMatrix4x4 scale;
  aiMatrix4x4::Scaling(aiVector3D(centimetres / 100), scale);
  aiMatrix4x4& root = scene.mRootNode->mTransformation;
  root = scale * turn_of(*scene.mMetaData) * root;
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

/// Where a picture is, the colour beside it is not seen: in glTF it would be times the picture.
/// Where it is named and is not there, the colour is what is left.
void let_pictures_replace(const aiScene& scene, SphparamSceneFiles files) {
  const aiColor4D white(1, 1, 1, 1);
  for (unsigned m = 0; m < scene.mNumMaterials; ++m) {
    aiMaterial& material = *scene.mMaterials[m];
    const auto has = [&](aiTextureType type) {
      aiString path;
      if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS) return false;
      return scene.GetEmbeddedTexture(path.C_Str()) != nullptr ||
             files.has(files.context, path.C_Str()) != 0;
    };
    if (has(aiTextureType_DIFFUSE) || has(aiTextureType_BASE_COLOR)) {
      material.AddProperty(&white, 1, AI_MATKEY_COLOR_DIFFUSE);
      material.AddProperty(&white, 1, AI_MATKEY_BASE_COLOR);
    }
    float factor = 1;
    material.Get("$raw.EmissiveFactor", 0, 0, factor);
    if (has(aiTextureType_EMISSIVE) && factor > 0)
      material.AddProperty(&white, 1, AI_MATKEY_COLOR_EMISSIVE);
  }
}

aiMatrix4x4 place_of(const aiNode* node) {
  aiMatrix4x4 place;
  for (; node; node = node->mParent) place = node->mTransformation * place;
  return place;
}

aiMatrix4x4 inverse_of(aiMatrix4x4 matrix) { return matrix.Inverse(); }

bool is_finite(const aiMatrix4x4& matrix) {
  return std::all_of(matrix[0], matrix[0] + 16, [](float x) { return std::isfinite(x); });
}

/// What each bone does to the mesh of a node; empty where a bone has no node, or no place.
std::vector<aiMatrix4x4> bone_matrices(const aiScene& scene, const aiMesh& mesh,
                                       const aiNode& node) {
  const aiMatrix4x4 into_node = inverse_of(place_of(&node));
  std::vector<aiMatrix4x4> matrices;
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiNode* const bone = scene.mRootNode->FindNode(mesh.mBones[b]->mName);
    if (!bone) return {};
    matrices.push_back(into_node * place_of(bone) * mesh.mBones[b]->mOffsetMatrix);
    if (!is_finite(matrices.back())) return {};
  }
  return matrices;
}

/// Vertices without weights stay where they are.
void pose(aiMesh& mesh, const std::vector<aiMatrix4x4>& bones) {
  const aiMatrix4x4 zero = aiMatrix4x4() * 0.0F;
  std::vector<aiMatrix4x4> means(mesh.mNumVertices, zero);
  std::vector<float> weights(mesh.mNumVertices, 0);
  for (std::size_t b = 0; b < bones.size(); ++b) {
    for (unsigned i = 0; i < mesh.mBones[b]->mNumWeights; ++i) {
      const aiVertexWeight& weight = mesh.mBones[b]->mWeights[i];
      if (weight.mVertexId >= mesh.mNumVertices) continue;
      means[weight.mVertexId] = means[weight.mVertexId] + bones[b] * weight.mWeight;
      weights[weight.mVertexId] += weight.mWeight;
    }
  }
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    if (!(weights[v] > 0)) continue;
    const aiMatrix4x4 mean = means[v] * (1 / weights[v]);
    mesh.mVertices[v] *= mean;
    aiMatrix3x3 linear(mean);
    if (mesh.mNormals && linear.Determinant() != 0)
      mesh.mNormals[v] = linear.Inverse().Transpose() * mesh.mNormals[v];
  }
}

/// As many as there are. They go in any case: the exporter of glTF gives bones that meshes share
/// the place that the first mesh has them at, and does not look whether they have a node.
long pose_meshes(const aiScene& scene, const aiNode& node, std::vector<bool>& seen) {
  long skins = 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    if (seen[node.mMeshes[i]] || !mesh.HasBones()) continue;
    seen[node.mMeshes[i]] = true;
    pose(mesh, bone_matrices(scene, mesh, node));
    for (unsigned b = 0; b < mesh.mNumBones; ++b) delete mesh.mBones[b];
    delete[] std::exchange(mesh.mBones, nullptr);
    mesh.mNumBones = 0;
    ++skins;
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    skins += pose_meshes(scene, *node.mChildren[i], seen);
  return skins;
}

/// They are at rest, and the exporter of glTF fails where one has the name of a node.
long drop_animations(aiScene& scene) {
  const long dropped = scene.mNumAnimations;
  for (unsigned a = 0; a < scene.mNumAnimations; ++a) delete scene.mAnimations[a];
  delete[] std::exchange(scene.mAnimations, nullptr);
  scene.mNumAnimations = 0;
  return dropped;
}

/// What assimp puts right, or does not know, handed on while it lives.
class Warnings {
 public:
  explicit Warnings(SphparamSceneSink sink) {
    constexpr unsigned severe = Assimp::Logger::Warn | Assimp::Logger::Err;
    Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new Stream(sink), severe);  // which it owns
  }
  ~Warnings() { Assimp::DefaultLogger::kill(); }
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;

 private:
  struct Stream final : Assimp::LogStream {
    explicit Stream(SphparamSceneSink to) : sink(to) {}
    void write(const char* line) override {
      sink.take(sink.context, line, std::string_view(line).size());
    }
    SphparamSceneSink sink;
  };
};

int complain(SphparamSceneSink error, std::string_view why) {
  error.take(error.context, why.data(), why.size());
  return 1;
}

int to_glb(const char* kind, const char* bytes, size_t size, SphparamSceneFiles files,
           SphparamSceneSink glb, SphparamSceneCounts* counts, SphparamSceneSink warnings,
           SphparamSceneSink error) try {
  const Warnings told(warnings);
  Assimp::Importer importer;
  // A scene without meshes is not to show its nodes in their stead.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  // Later versions of assimp turn the root of an FBX by themselves unless they are told so.
  importer.SetPropertyBool("AI_CONFIG_IMPORT_FBX_IGNORE_UP_DIRECTION", true);
  const aiScene* const read = importer.ReadFileFromMemory(bytes, size, steps, kind);
  if (!read || !read->mRootNode) return complain(error, importer.GetErrorString());
  const std::unique_ptr<aiScene> scene(importer.GetOrphanedScene());
  if (std::string_view(kind) == "fbx") turn_and_scale(*scene);
  name_pictures(*scene);
  let_pictures_replace(*scene, files);
  std::vector<bool> seen(scene->mNumMeshes);
  counts->skins = pose_meshes(*scene, *scene->mRootNode, seen);
  counts->animations = drop_animations(*scene);
  Assimp::Exporter exporter;
  const aiExportDataBlob* const blob = exporter.ExportToBlob(scene.get(), "glb2");
  if (!blob) {
    const std::string why = exporter.GetErrorString();  // not always there
    return complain(error,
                    "assimp cannot make glTF of the scene" + (why.empty() ? "" : ": " + why));
  }
  glb.take(glb.context, static_cast<const char*>(blob->data), blob->size);
  return 0;
} catch (const std::bad_alloc&) {
  return complain(error, "it asks for more memory than it may take");
} catch (const std::exception& problem) {
  return complain(error, problem.what());
}

constexpr SphparamSceneTable table = {sphparam_scene_table_version, to_glb};

}  // namespace

extern "C" __attribute__((visibility("default"))) const SphparamSceneTable* sphparam_scene_table() {
  return &table;
}
