#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace sphparam {

/// What a material says outside [0, 1] of its texture, in the direction of s or t.
enum class Wrapping { Repeat, Mirror, Clamp };

/// (s, t) of a mesh → those of an image, t upwards: a row a coordinate, the last number is added.
using TexturePlacement = std::array<std::array<double, 3>, 2>;

struct SpecularGlossiness;

/// Something that a material says, as glTF has it: factor · image, channel by channel, or the
/// factor alone. Images are not decoded here.
struct MaterialTexture {
  std::array<double, 4> factor = {1, 1, 1, 1};  // of red, green, blue, alpha; of colours linear
  std::string image = {};                       // its name, for people; empty: the factor alone
  std::shared_ptr<const std::vector<char>> bytes = nullptr;  // of an image inside the mesh's file
  std::string folder = {}, path = {};  // of one in a file of its own, below the folder
  Wrapping wrap_s = Wrapping::Repeat, wrap_t = Wrapping::Repeat;
  std::string problem = {};  // why the image cannot be used; empty: nothing is known against it
  int channel = 0;           // of the image, where the material wants one number of it
  TexturePlacement placement = {{{1, 0, 0}, {0, 1, 0}}};  // on the mesh's texture coordinates
  bool second = false;                                    // on the second ones that its file has
  /// Of a normal map that may be one of heights, which are grey: how high white is, in texels; of
  /// colours, what x and y are times. 0: normals, whatever their colours.
  double bump = 0;
  /// Of a material by specular colour and glossiness: what its base colour (channel 0), roughness
  /// (1) and metallic (2) are made of, factors and all, instead of `bytes` or `path`.
  std::shared_ptr<const SpecularGlossiness> made_of = nullptr;
};

/// A material by KHR_materials_pbrSpecularGlossiness. Both images are in the same place.
struct SpecularGlossiness {
  MaterialTexture diffuse = {};
  MaterialTexture specular = {};  // alpha: glossiness
};

/// What alpha means. Source: glTF 2.0, Section 3.9.4.
enum class AlphaMode { Opaque, Mask, Blend };

/// What a surface is like beyond the model of glTF 2.0: factors of its KHR_materials_* extensions,
/// by the same names. What is here at first says nothing.
struct MaterialFinish {
  using Colour = std::array<double, 3>;  // linear

  double clearcoat = 0, clearcoat_roughness = 0;
  Colour sheen = {0, 0, 0};
  double sheen_roughness = 0;
  double transmission = 0;
  double ior = 1.5;  // 0: as specular workflows have it
  double specular = 1;
  Colour specular_colour = {1, 1, 1};
  double iridescence = 0, iridescence_ior = 1.3;
  double iridescence_thickness = 400;  // nanometres
  double thickness = 0;                // of the volume, in units of the mesh; 0: none
  double attenuation_distance = 0;     // in units of the world; 0: nothing is absorbed
  Colour attenuation_colour = {1, 1, 1};
  double dispersion = 0;

  bool operator==(const MaterialFinish&) const = default;
};

/// What a material says beside its base colour, in the model of glTF 2.0, Section 3.9. Numbers are
/// factor[0] · the texture's channel.
struct MaterialChannels {
  MaterialTexture roughness = {};                       // perceptual, in [0, 1]
  MaterialTexture metallic = {};                        // in [0, 1]
  MaterialTexture occlusion = {};                       // 1 + factor[0]·(image − 1)
  MaterialTexture normal = {};                          // red, green 2·x − 1 times factor[0]
  MaterialTexture emission = {.factor = {0, 0, 0, 1}};  // sRGB image; its factor may be above 1
  MaterialTexture opacity = {};                         // times the alpha of the base colour
  AlphaMode alpha_mode = AlphaMode::Opaque;
  double alpha_cutoff = 0.5;  // of Mask: what is below is not there
  bool double_sided = false;
  bool unlit = false;  // the base colour is seen as it is
  MaterialFinish finish = {};

  std::array<const MaterialTexture*, 6> textures() const {
    return {&roughness, &metallic, &occlusion, &normal, &emission, &opacity};
  }
  std::array<MaterialTexture*, 6> textures() {
    return {&roughness, &metallic, &occlusion, &normal, &emission, &opacity};
  }
};

}  // namespace sphparam
