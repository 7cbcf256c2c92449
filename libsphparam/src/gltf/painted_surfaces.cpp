#include "gltf/painted_surfaces.h"

#include "bake/bake_rows.h"
#include "bake/field_registry.h"
#include "io/attributes/source_attributes.h"
#include "srgb_curves.h"
#include "texture/test_images.h"

namespace sphparam {
namespace {

struct Look {
  const char* name;   // of the variant
  const char* label;  // on the page
  const char* map;    // what is baked for it
};

constexpr Look own_colours{"baked", "Own colours", "basecolor"};
constexpr Look directions{"baked", "Directions", "normal-object"};
constexpr Look area{"area", "Area", "area"}, angle{"angle", "Angle", "angle"};

bool has_colours(const BakeSource& source) {
  return !source.textures.empty() || linear_colours(source.file()).has_value();
}

/// Directions are stored as colours are: ½ + ½·n.
void copy_rows(const SurfaceField& field, int first_row, int rows, const float* values,
               Image& image) {
  const SrgbCurves& curves = SrgbCurves::get();
  float* out = image.pixel(0, first_row);
  const size_t texels = static_cast<size_t>(rows) * static_cast<size_t>(image.width);
  for (size_t i = 0; i < texels; ++i, values += field.channels, out += 3) {
    for (int c = 0; c < 3; ++c) {
      const float value = values[field.channels < 3 ? 0 : c];
      out[c] = field.kind == FieldKind::Colour      ? curves.to_srgb(value)
               : field.kind == FieldKind::Direction ? 0.5F + 0.5F * value
                                                    : value;
    }
  }
}

}  // namespace

std::vector<PaintedSurface> painted_surfaces(const BakeScene& scene, int width,
                                             const Progress& progress) {
  const bool coloured = has_colours(scene.source);
  std::vector<PaintedSurface> surfaces;
  std::vector<SurfaceField> fields;
  std::vector<size_t> places;  // of the fields among the surfaces
  const auto bake_look = [&](const Look& look) {
    fields.push_back(make_field(look.map, scene));
    places.push_back(surfaces.size());
    surfaces.push_back({look.name, look.label, Image(width, width / 2, 3)});
  };
  const auto draw = [&](TestImage image, const char* label) {
    surfaces.push_back({name_of(image), label,
                        make_test_image(image, width, Convention::Sphparam, scene.threads)});
  };
  if (coloured) bake_look(own_colours);
  draw(TestImage::Checker, "Checker");
  draw(TestImage::Axes, "Axes");
  bake_look(area);
  bake_look(angle);
  if (!coloured) bake_look(directions);
  bake(scene, fields,
       {.width = width,
        .height = width / 2,
        .samples = 2,
        .threads = scene.threads,
        .progress = progress},
       [&](size_t field, int first_row, int rows, const float* values) {
         copy_rows(fields[field], first_row, rows, values, surfaces[places[field]].image);
       });
  return surfaces;
}

}  // namespace sphparam
