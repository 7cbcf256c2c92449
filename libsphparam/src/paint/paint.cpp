// What users call: a mapped mesh in, a file or an image out.

#include "sphparam/paint/paint.h"

#include <cmath>
#include <vector>

#include "bake/baked_chart.h"
#include "image/image_codec.h"
#include "io/attributes/texture_pages.h"
#include "option_domain.h"
#include "paint/paint_atlas.h"
#include "paint/paint_vertices.h"
#include "sphparam/io/sphere_file.h"
#include "texture/baked_texts.h"

namespace sphparam {
namespace {

Image without_alpha(const Image& image) {
  Image opaque(image.width, image.height, 3);
  for (size_t i = 0; i < opaque.pixels.size(); ++i) {
    opaque.pixels[i] = image.pixels[i / 3 * 4 + i % 3];
  }
  return opaque;
}

Property channel_of(const Image& colours, const std::string& name, size_t channel) {
  Property property = {name, ScalarType::Uint8, {}};
  for (int v = 0; v < colours.width; ++v) {
    property.values.push_back(std::round(255.0 * colours.pixel(v, 0)[channel]));
  }
  return property;
}

}  // namespace

std::string warning_of_map(const std::string& name, const EquirectangularImage& image,
                           const MappedMesh& mapped) {
  return warning_of_other_map(name, {{std::string(rays_text), image.rays()}}, mapped);
}

MeshFile paint_vertices(const MappedMesh& mapped, const EquirectangularImage& image,
                        const PaintOptions& options) {
  const Image colours =
      paint_vertices(mapped.topology(), mapped.map(), image, options.progress, options.threads);
  MeshFile file = mapped.mapped_here()
                      ? attach_map(mapped.file(), mapped.map(), mapped.provenance())
                      : mapped.file();
  const std::vector<std::string> names = {"red", "green", "blue", "alpha"};
  remove_properties(file.vertex_properties, names);
  remove_textures(file);
  const size_t channels = image.has_alpha() ? 4 : 3;
  for (size_t c = 0; c < channels; ++c) {
    file.set_vertex_property(channel_of(colours, names[c], c));
  }
  return file;
}

PaintedAtlas paint_atlas(const MappedMesh& mapped, const EquirectangularImage& image,
                         const AtlasOptions& options) {
  require_between("size", options.size, 1, 32768);
  require_between("padding", options.padding, 0, 254);
  return paint_atlas(mapped.file(), mapped.map(), image, options);
}

std::string overlap_warning(const PaintedAtlas& atlas, const MeshFile& file) {
  if (atlas.overlapping == 0) return "";
  const Property* source = file.find_face_property("source_face");
  const auto number = [&](Face face) {
    return source ? static_cast<long>(source->values[static_cast<size_t>(face)]) : long{face};
  };
  const long first = number(atlas.rivals[0]), second = number(atlas.rivals[1]);
  std::string other = first == second ? "itself" : std::to_string(second);
  if (atlas.rivals[0] == atlas.rivals[1]) other += " in another repetition of the image";
  return "its texture coordinates overlap: " + std::to_string(atlas.overlapping) + " of " +
         std::to_string(atlas.painted) + " texels belong to two triangles or more (" +
         std::to_string(first) + " and " + other + ", for one); the first has them";
}

std::string png_of(const PaintedAtlas& atlas, bool with_alpha) {
  const std::vector<char> png =
      encode_image(with_alpha ? atlas.image : without_alpha(atlas.image), ImageFormat::Png);
  return {png.data(), png.size()};
}

}  // namespace sphparam
