// The list of all maps. Fields are made in fields/, one file an idea.

#include "bake/map_kinds.h"

#include <algorithm>

#include "bake/fields/attribute_fields.h"
#include "bake/fields/base_colour.h"
#include "bake/fields/curvature_field.h"
#include "bake/fields/distortion_fields.h"
#include "bake/fields/height_field.h"
#include "bake/fields/normal_fields.h"
#include "bake/fields/ray_fields.h"

namespace sphparam {

const std::vector<MapKind>& map_kinds() {
  static const std::vector<MapKind> kinds = {
      {"basecolor", "the texture of the mesh, or the colours of its vertices", make_base_colour},
      {"vcolor", "the colours of its vertices", make_vertex_colour},
      {"normal-object", "unit normals in the axes of the mesh", make_object_normal},
      {"normal-tangent", "unit normals in the tangent frame of the chart", make_tangent_normal},
      {"position", "x y z", make_position},
      {"height", "height over the mesh of --for, or (radial) distance from the origin",
       height_field, true},
      {"ao", "ambient occlusion: how much of the sky is seen", make_occlusion},
      {"bent", "mean direction of the sky that is seen", make_bent_normal},
      {"thickness", "mean way inwards to the other side", make_thickness},
      {"curvature", "mean or gauss curvature (curvature:gauss)", curvature_field, true},
      {"area", "log2 of the ratio of areas, sphere to mesh", area_field},
      {"angle", "log2 of the factor by which angles are off", angle_field},
      {"stretch", "log2 of the stretch of lengths, mean of squares", stretch_field},
      {"id", "id:face, id:material or id:component", make_id, true},
      {"uv", "the texture coordinates of the mesh", make_texcoords},
      {"scalar", "scalar:NAME, a property of vertices or faces", make_scalar, true},
  };
  return kinds;
}

void require_no_idle_argument(const std::string& name) {
  const size_t colon = name.find(':');
  const auto takes_none = [kind = name.substr(0, colon)](const MapKind& k) {
    return kind == k.name && !k.takes_argument;
  };
  if (colon == std::string::npos || !std::ranges::any_of(map_kinds(), takes_none)) return;
  throw MapError(name + ": nothing can follow " + name.substr(0, colon));
}

SurfaceField make_field(const std::string& name, const BakeScene& scene) {
  const size_t colon = name.find(':');
  const std::string kind = name.substr(0, colon),
                    argument = colon == std::string::npos ? "" : name.substr(colon + 1);
  const auto& kinds = map_kinds();
  const auto found = std::ranges::find_if(kinds, [&](const MapKind& k) { return kind == k.name; });
  if (found == kinds.end()) throw MapError("there is no map " + kind);
  require_no_idle_argument(name);
  return found->make(scene, argument);
}

}  // namespace sphparam
