#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bake/field_registry.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

// What the materials of the source say beside their base colour, factors multiplied in. Faces
// without a material have what glTF says of those. All throw FieldError where the file has no
// materials, or textures without texture coordinates; ImageError for images that cannot be read.

/// Occlusion, roughness and metallic in red, green and blue, as glTF's textures have them.
SurfaceField make_orm(const BakeScene& scene, const std::string&);
SurfaceField make_roughness(const BakeScene& scene, const std::string&);
SurfaceField make_metallic(const BakeScene& scene, const std::string&);
SurfaceField make_material_occlusion(const BakeScene& scene, const std::string&);

/// Emitted light, divided by the greatest factor of the materials where that is above 1, so that
/// integers hold it: metadata sphparam:strength is what it was.
SurfaceField make_emissive(const BakeScene& scene, const std::string&);
inline constexpr char strength_text[] = "sphparam:strength";

/// What helps a mesh whose materials have images, and which has no place for them.
inline constexpr char leaves_images_out[] =
    "; `sphparam asset` leaves such images out, and its materials keep their factors";

/// What images of the base colour say of alpha and sides, as metadata: "mask 0.5" or "blend" below
/// sphparam:alpha, "1" below sphparam:double_sided; nothing of what is opaque and one-sided. Of
/// alpha, finish and light what `one_material` has: factors below sphparam:finish, "1" below
/// sphparam:unlit.
std::vector<std::pair<std::string, std::string>> texts_of_material(const MeshFile& file);
inline constexpr char alpha_text[] = "sphparam:alpha", sides_text[] = "sphparam:double_sided";
inline constexpr char finish_text[] = "sphparam:finish", unlit_text[] = "sphparam:unlit";

}  // namespace sphparam
