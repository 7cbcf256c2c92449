#pragma once

namespace sphparam {

/// What a scene was before it was made glTF, as far as that is told of it.
struct SceneOrigin {
  long posed_skins = 0;  // of meshes that were posed on the way
  long animations = 0;   // that were left out on the way
  /// Its words for what came to be KHR_materials_pbrSpecularGlossiness and is no more than a hint
  /// of that, so that it is not carried; null: it is glTF's own.
  const char* specular_glossiness = nullptr;
  bool has_own_extras = true;  // else extras are what the way there left in them
};

}  // namespace sphparam
