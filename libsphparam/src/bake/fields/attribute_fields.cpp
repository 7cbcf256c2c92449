// Properties are interpolated linearly over faces, those of faces are constant on them; whole
// numbers are labels and never mixed, as where meshes are resampled.

#include "bake/fields/attribute_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "bake/connected_faces.h"
#include "bake/fields/far_values.h"
#include "bake/fields/linear_field.h"
#include "io/attributes/source_attributes.h"
#include "io/attributes/weightiest_label.h"
#include "mesh/float32_size.h"
#include "number_text.h"

namespace sphparam {
namespace {

std::string names_of(const std::vector<Property>& properties) {
  std::string names;
  for (const Property& property : properties) names += (names.empty() ? "" : ", ") + property.name;
  return names;
}

/// Of those that are numbers; 0 without any.
std::pair<double, double> range_of(const std::vector<double>& values) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double least = infinity, greatest = -infinity;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  return least <= greatest ? std::pair(least, greatest) : std::pair(0.0, 0.0);
}

/// Texels are float32: beyond its greatest number all would be infinite, and where the greatest one
/// is below its normal ones, digits are lost.
void require_float32(const std::string& field, const std::pair<double, double>& range) {
  using Float = std::numeric_limits<float>;
  const double size = std::max(std::abs(range.first), std::abs(range.second));
  const auto refuse = [&](const char* how, const char* bound, float most) {
    throw FieldError(field + ": its values are too " + how +
                     " for numbers of 32 bits, the greatest is " + short_number(size) +
                     " and not at " + bound + " " + short_number(static_cast<double>(most)) +
                     "; scale them");
  };
  if (size > static_cast<double>(Float::max())) refuse("large", "most", Float::max());
  if (size > 0 && size < static_cast<double>(Float::min())) refuse("small", "least", Float::min());
}

/// A range would cut labels to others.
void require_measure(const Property& property) {
  if (is_floating(property.type)) return;
  throw FieldError("scalar:" + property.name +
                   ": its whole numbers are labels, of which no range leaves some out");
}

/// Mixes the lower 24 bits one to one; 0 stays 0. Our own: each step, x ^ x >> 12 and a product
/// with an odd number modulo 2^24, has an inverse.
std::uint32_t mixed(std::uint32_t x) {
  constexpr std::uint32_t low_bits = (1 << 24) - 1;
  x &= low_bits;
  for (const std::uint32_t odd : {0x9e3779U, 0x5bd1e9U}) {
    x = (x ^ x >> 12) * odd & low_bits;
  }
  return x ^ x >> 12;
}

/// What a property's values are counted from: the least of those whose digits float32 has not.
double origin_of(const Property& property, const std::pair<double, double>& range) {
  constexpr double whole = 1 << 24;  // numbers up to it are whole in float32
  // Sums of samples lose some roundings: 2^-20 of the extent, a sixteenth of a step of 16 bits. And
  // what float32 holds is again what it was, once the origin is added.
  constexpr double some = 8;
  const double size = std::max(std::abs(range.first), std::abs(range.second));
  const double most = is_floating(property.type) ? some * (range.second - range.first) : whole;
  return size > most ? range.first : 0;
}

/// A field of labels: `label(face, weights)` is that of a point. Requires: what it refers to
/// outlives the field.
template <class LabelAt>
SurfaceField label_field(SurfaceField described, LabelAt label) {
  described.kind = FieldKind::Label;
  described.evaluate_runs = [label, origin = described.origin[0]](std::span<const SurfaceRun> runs,
                                                                  float* values) {
    for (const SurfaceRun& run : runs) {
      for (int i = 0; i < run.count; ++i) {
        const double here = label(run.face, Vector3(run.first + i * run.step));
        *values++ = static_cast<float>(here - origin);
      }
    }
  };
  return described;
}

/// A field of numbers that measure, of the property's values at corners.
template <class ValueAt>
SurfaceField number_field(SurfaceField described, ValueAt value_at) {
  const double origin = described.origin[0];
  return linear_field<1>(std::move(described),
                         [value_at, origin](Face f, int k, std::array<double, 1>& value) {
                           value[0] = value_at(f, k) - origin;
                         });
}

/// A property of vertices: of numbers that measure, or that name something.
SurfaceField vertex_field(SurfaceField described, const Triangles& triangles,
                          const Property& property) {
  const auto corner = [&triangles, &property](Face f, int k) {
    return property.values[static_cast<size_t>(triangles(f, k))];
  };
  if (is_floating(property.type)) return number_field(std::move(described), corner);
  return label_field(std::move(described), [corner](Face f, const Vector3& weights) {
    std::array<std::pair<double, double>, 3> labelled;
    for (int k = 0; k < 3; ++k) labelled[static_cast<size_t>(k)] = {corner(f, k), weights[k]};
    return weightiest_label(labelled);
  });
}

SurfaceField face_field(SurfaceField described, const Property& property) {
  const auto value_of = [&property](Face f) { return property.values[static_cast<size_t>(f)]; };
  if (!is_floating(property.type)) {
    return label_field(std::move(described),
                       [value_of](Face f, const Vector3&) { return value_of(f); });
  }
  return number_field(std::move(described), [value_of](Face f, int) { return value_of(f); });
}

/// Whose texel it is: a label, one a face, as its number or as a colour.
SurfaceField owner_field(const BakeScene& scene, std::string name, std::vector<int> labels) {
  SurfaceField field{.name = std::move(name), .kind = FieldKind::Label};
  const int greatest = *std::ranges::max_element(labels);
  if (!scene.ids_as_colours) {
    field.about = "numbers from 0, -1 for none";
    field.range = std::pair<double, double>(0, greatest);
    field.evaluate_runs = [labels = std::move(labels)](std::span<const SurfaceRun> runs,
                                                       float* values) {
      for (const SurfaceRun& run : runs) {
        values = std::fill_n(values, run.count,
                             static_cast<float>(labels[static_cast<size_t>(run.face)]));
      }
    };
    return field;
  }
  field.channels = 3;
  field.about = "a colour each, without meaning; black for none";
  field.range = std::pair<double, double>(0, 1);
  field.evaluate_runs = [labels = std::move(labels)](std::span<const SurfaceRun> runs,
                                                     float* values) {
    for (const SurfaceRun& run : runs) {
      const int label = labels[static_cast<size_t>(run.face)];
      const std::uint32_t bits = label < 0 ? 0 : mixed(static_cast<std::uint32_t>(label) + 1);
      for (int i = 0; i < run.count; ++i) {
        for (int c = 0; c < 3; ++c) {
          *values++ = static_cast<float>(bits >> (8 * c) & 255) / 255;
        }
      }
    }
  };
  return field;
}

std::shared_ptr<const CornerLight> light_of(const BakeScene& scene) {
  auto light = corner_light(scene.source.file());
  if (!light) {
    throw FieldError("vcolor: the mesh has no colours at its vertices (red, green, blue)");
  }
  return std::make_shared<const CornerLight>(std::move(*light));
}

template <int channels>
SurfaceField light_field(const BakeScene& scene, std::shared_ptr<const CornerLight> light) {
  return linear_field<channels>(
      {.name = "vcolor", .kind = FieldKind::Colour, .about = "colours of the vertices"},
      [light = std::move(light), &triangles = scene.source.mesh().triangles](
          Face f, int k, std::array<double, channels>& value) {
        const Eigen::Index row = light->row(triangles, f, k);
        for (int c = 0; c < channels; ++c) value[static_cast<size_t>(c)] = light->rows(row, c);
      });
}

std::vector<int> materials_of(const MeshFile& file) {
  const Property* material = file.find_face_property("material");
  if (!material) {
    throw FieldError("id:material: the mesh has no materials; id:face gives every triangle one");
  }
  return {material->values.begin(), material->values.end()};
}

}  // namespace

SurfaceField make_position(const BakeScene& scene, const std::string&) {
  const TriangleMesh& mesh = scene.source.mesh();
  require_float32_size(mesh.positions, "position");
  SurfaceField field = {
      .name = "position",
      .about = "x y z of the mesh, its own unit and axes; one range for all three",
      .unit = unit_of_lengths(scene.options),
      .range = std::pair(mesh.positions.minCoeff(), mesh.positions.maxCoeff())};
  const Box box = box_of(mesh.positions);
  if (is_far(mesh.positions.cwiseAbs().maxCoeff(), box)) {
    field.origin = {box.lower[0], box.lower[1], box.lower[2]};
    field.range = std::pair(0.0, box.longest_side());
  }
  const std::array<double, 3> origin = field.origin;
  return linear_field<3>(std::move(field),
                         [&mesh, origin](Face f, int k, std::array<double, 3>& value) {
                           const int v = mesh.triangles(f, k);
                           for (size_t c = 0; c < 3; ++c)
                             value[c] = mesh.positions(v, static_cast<int>(c)) - origin[c];
                         });
}

SurfaceField make_vertex_colour(const BakeScene& scene, const std::string&) {
  const auto light = light_of(scene);
  return light->has_alpha() ? light_field<4>(scene, light) : light_field<3>(scene, light);
}

SurfaceField make_opaque_vertex_colour(const BakeScene& scene) {
  return light_field<3>(scene, light_of(scene));
}

SurfaceField make_texcoords(const BakeScene& scene, const std::string&) {
  const auto corners = texcoords_of(scene.source.file());
  if (!corners) throw FieldError("uv: the mesh has no texture coordinates");
  return linear_field<3>(
      {.name = "uv",
       .about = "texture coordinates s t of the source, t upwards; the third channel is 0",
       .range = std::pair(std::min(0.0, corners->minCoeff()), std::max(1.0, corners->maxCoeff()))},
      [corners](Face f, int k, std::array<double, 3>& value) {
        value = {(*corners)(3 * f + k, 0), (*corners)(3 * f + k, 1), 0};
      });
}

SurfaceField make_scalar(const BakeScene& scene, const std::string& name) {
  const MeshFile& file = scene.source.file();
  const auto described = [&](const Property& property) {
    SurfaceField field{
        .name = "scalar:" + name, .about = "property " + name, .range = range_of(property.values)};
    require_float32(field.name, *field.range);
    if (const auto& wanted = scene.options.scalar_range; wanted && !scene.options.heat) {
      require_measure(property);
      field.range = wanted;
    }
    const double origin = origin_of(property, *field.range);
    field.origin[0] = origin;
    field.range = std::pair(field.range->first - origin, field.range->second - origin);
    return field;
  };
  if (const Property* property = file.find_vertex_property(name)) {
    return vertex_field(described(*property), file.mesh.triangles, *property);
  }
  if (const Property* property = file.find_face_property(name)) {
    return face_field(described(*property), *property);
  }
  const std::string vertices = names_of(file.vertex_properties),
                    faces = names_of(file.face_properties);
  std::vector<std::string> known;
  for (const Property& property : file.vertex_properties) known.push_back(property.name);
  for (const Property& property : file.face_properties) known.push_back(property.name);
  throw FieldError("scalar:" + name + ": the mesh has no such property; its vertices have " +
                       (vertices.empty() ? "none" : vertices) + ", its faces " +
                       (faces.empty() ? "none" : faces),
                   name, std::move(known));
}

SurfaceField make_mask(const BakeScene& scene, const std::string&) {
  SurfaceField field{.name = surface_mask,
                     .about = "1 on the surface, 0 on what closes its holes",
                     .range = std::pair(0.0, 1.0)};
  const FillerMarks& fillers = scene.source.fillers();
  field.evaluate_runs = [&fillers](std::span<const SurfaceRun> runs, float* values) {
    for (const SurfaceRun& run : runs) {
      const bool surface = fillers.empty() || !fillers[static_cast<size_t>(run.face)];
      values = std::fill_n(values, run.count, surface ? 1.0F : 0.0F);
    }
  };
  return field;
}

SurfaceField make_found(const BakeScene& scene, const std::string&) {
  if (!scene.source.surface) throw FieldError("found: is of a bake from another surface");
  SurfaceField field{.name = "found",
                     .kind = FieldKind::Label,
                     .about =
                         "0: along the normal; 1: on the back of the surface; 2: only the "
                         "nearest point",
                     .range = std::pair(0.0, 2.0)};
  field.evaluate_runs = [](std::span<const SurfaceRun> runs, float* values) {
    for (const SurfaceRun& run : runs) {
      const float how = is_nearest(run.found) ? 2 : is_back(run.found) ? 1 : 0;
      values = std::fill_n(values, run.count, how);
    }
  };
  return field;
}

SurfaceField make_id(const BakeScene& scene, const std::string& what) {
  const MeshFile& file = scene.source.file();
  const auto count = static_cast<size_t>(file.mesh.face_count());
  const std::string chosen = !what.empty()                         ? what
                             : file.find_face_property("material") ? "material"
                                                                   : "face";
  std::vector<int> labels(count, 0);  // of a closed surface of genus 0 there is one component
  if (chosen == "face") {
    const Property* polygons = file.find_face_property("source_face");
    for (size_t f = 0; f < count; ++f) {
      labels[f] = polygons ? static_cast<int>(polygons->values[f]) : static_cast<int>(f);
    }
  } else if (chosen == "material") {
    labels = materials_of(file);
  } else if (chosen != "component") {
    throw FieldError("id:" + chosen + ": there are id:face, id:material and id:component");
  } else if (!scene.source.mapped) {
    labels = parts_of_faces(file.mesh);
  }
  return owner_field(scene, "id:" + chosen, std::move(labels));
}

}  // namespace sphparam
