#pragma once

#include <cstddef>

// The door between our programs and the module that reads scenes by assimp: plain C, so that
// nothing of assimp is linked into them. Both sides are built together; the version guards against
// a stale module.

extern "C" {

/// Receives bytes; `context` is the caller's own.
struct SphparamSceneSink {
  void (*take)(void* context, const char* bytes, size_t size);
  void* context;
};

/// What of a scene is not in its GLB.
struct SphparamSceneCounts {
  long skins;  // of meshes that were posed as their joints stand
  long animations;
};

/// The files beside the scene; `has` is 0 for a name that none has.
struct SphparamSceneFiles {
  int (*has)(void* context, const char* name);
  void* context;
};

struct SphparamSceneTable {
  int version;
  /// A scene in memory as the bytes of a GLB: `kind` is "fbx", "dae", "3ds" or "x3d". Opens no
  /// other file. Meshes with a skin are posed as their joints stand at rest, whatever is animated.
  /// Colours beside pictures that are there are white, as they are not seen.
  /// `warnings`: a line each. Returns 0, or 1 after telling `error` why.
  int (*to_glb)(const char* kind, const char* bytes, size_t size, SphparamSceneFiles files,
                SphparamSceneSink glb, SphparamSceneCounts* counts, SphparamSceneSink warnings,
                SphparamSceneSink error);
};

/// The module's one exported name.
typedef const SphparamSceneTable* (*SphparamSceneTableFunction)();
}

constexpr int sphparam_scene_table_version = 6;
constexpr char sphparam_scene_table_name[] = "sphparam_scene_table";
