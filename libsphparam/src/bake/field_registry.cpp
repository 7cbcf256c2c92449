// The list of all fields that can be baked. To add one: its file in fields/, a line here.

#include "bake/field_registry.h"

#include <algorithm>

#include "bake/fields/attribute_fields.h"
#include "bake/fields/base_colour.h"
#include "bake/fields/body_fields.h"
#include "bake/fields/curvature_field.h"
#include "bake/fields/distortion_fields.h"
#include "bake/fields/heat_field.h"
#include "bake/fields/height_field.h"
#include "bake/fields/material_fields.h"
#include "bake/fields/normal_fields.h"
#include "bake/fields/ray_fields.h"
#include "texture/test_images.h"

namespace sphparam {

const std::vector<FieldMaker>& field_makers() {
  static const std::vector<FieldMaker> kinds = {
      {"basecolor", "the texture of the mesh, or the colours of its vertices", make_base_colour},
      {"vcolor", "the colours of its vertices", make_vertex_colour},
      {"orm", "occlusion, roughness, metallic of its materials, in red, green, blue", make_orm},
      {"emissive", "the light that its materials give", make_emissive},
      {"roughness", "of its materials, 0 to 1", make_roughness},
      {"metallic", "of its materials, 0 to 1", make_metallic},
      {"occlusion", "of its materials, 0 to 1; `ao` casts rays for it", make_material_occlusion},
      {"normal-object", "unit normals in the axes of the mesh, normal maps in them",
       make_object_normal},
      {"normal-tangent", "the same in the tangent frame of the chart", make_tangent_normal},
      {"position", "x y z", make_position},
      {"height", "height over the mesh it is for, or (radial) distance from the origin",
       height_field, true},
      {"lon", "planetocentric longitude, degrees", make_longitude},
      {"lat", "planetocentric latitude, degrees", make_latitude},
      {"lonlat", "both, in the first two channels", make_longitude_latitude},
      {"radius", "distance from the centre of the body", make_radius},
      {"slope", "degrees between normal and direction from the centre", make_slope},
      {"elevation", "radius above the sphere or ellipsoid of the body", make_elevation},
      {"ao", "ambient occlusion: how much of the sky is seen", make_occlusion},
      {"bent", "mean direction of the sky that is seen", make_bent_normal},
      {"thickness", "mean way inwards to the other side", make_thickness},
      {"curvature", "mean or gauss curvature (curvature:gauss)", curvature_field, true},
      {"area", "log2 of the ratio of areas, sphere to mesh", area_field},
      {"angle", "log2 of the factor by which angles are off", angle_field},
      {"stretch", "log2 of the stretch of lengths, mean of squares", stretch_field},
      {"id", "id:face, id:material or id:component", make_id, true},
      {"mask", "1 on the surface, 0 on what closes its holes", make_mask},
      {"found", "0 where a mesh met the surface baked from, 1 its back, 2 only its nearest point",
       make_found},
      {"uv", "the texture coordinates of the mesh", make_texcoords},
      {"scalar", "scalar:NAME, a property of vertices or faces", make_scalar_or_heat, true},
  };
  return kinds;
}

std::vector<FieldInfo> all_fields() {
  std::vector<FieldInfo> fields;
  for (const FieldMaker& maker : field_makers()) {
    fields.push_back({maker.name, maker.about, maker.takes_argument});
  }
  return fields;
}

std::vector<std::string> test_image_names() {
  std::vector<std::string> names;
  for (const TestImage image : {TestImage::Axes, TestImage::Checker, TestImage::Graticule}) {
    names.emplace_back(name_of(image));
  }
  return names;
}

namespace {

/// A name as the user wrote it, in two.
struct FieldName {
  std::string kind, argument;
  bool has_argument;

  explicit FieldName(const std::string& name) {
    const size_t colon = name.find(':');
    has_argument = colon != std::string::npos;
    kind = name.substr(0, colon);
    if (has_argument) argument = name.substr(colon + 1);
  }
};

const FieldMaker* maker_of(const std::string& kind) {
  const auto& makers = field_makers();
  const auto found = std::ranges::find_if(makers, [&](const auto& m) { return kind == m.name; });
  return found == makers.end() ? nullptr : &*found;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names = test_image_names();
  for (const FieldMaker& maker : field_makers()) names.emplace_back(maker.name);
  return names;
}

}  // namespace

void require_field_name(const std::string& name) {
  const FieldName asked(name);
  const FieldMaker* const maker = maker_of(asked.kind);
  const bool is_drawn = test_image_named(asked.kind).has_value();
  if (asked.has_argument && (is_drawn || (maker && !maker->takes_argument))) {
    throw FieldError(name + ": nothing can follow " + asked.kind);
  }
  if (!maker && !is_drawn) {
    throw FieldError("there is no field " + asked.kind, asked.kind, all_names());
  }
}

SurfaceField make_field(const std::string& name, const BakeScene& scene) {
  require_field_name(name);
  const FieldName asked(name);
  const FieldMaker* const maker = maker_of(asked.kind);
  if (!maker) throw FieldError(name + " is drawn, not baked");
  return maker->make(scene, asked.argument);
}

}  // namespace sphparam
