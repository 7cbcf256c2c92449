#include "io/formats/vtk/vtk_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "free_name.h"
#include "io/files/float32_digits.h"
#include "io/files/non_finite_advice.h"
#include "io/formats/lossless_type.h"
#include "io/formats/non_finite_numbers.h"
#include "number_text.h"
#include "sphparam/io/losses.h"

// An array is known by its role, which the file says or its name does, as VTK's own writers name
// them. All others become one property a component.

namespace sphparam {
namespace {

constexpr std::size_t most_properties = 256;

struct KnownArray {
  VtkRole role;
  std::vector<std::string> names;  // what VTK and others call it
  std::vector<std::string> properties;
  const char* what;  // for people
};

const std::vector<KnownArray>& known_arrays() {
  static const std::vector<KnownArray> known = {
      {VtkRole::Normals, {"Normals", "normals"}, {"nx", "ny", "nz"}, "normals"},
      {VtkRole::Texcoords,
       {"TCoords", "Texture Coordinates", "TextureCoordinates"},
       {"s", "t"},
       "texture coordinates"},
      {VtkRole::Colours,
       {"RGB", "RGBA", "Colors", "colors", "rgb", "rgba", "Color", "color"},
       {"red", "green", "blue", "alpha"},
       "colours"}};
  return known;
}

/// Bytes, or fractions.
bool may_be_colours(const VtkArray& array) {
  if (array.type == ScalarType::Uint8) return true;
  return is_floating(array.type) && std::all_of(array.values.begin(), array.values.end(),
                                                [](double v) { return v >= 0 && v <= 1; });
}

/// Null where the array is none of them, or has another width.
const KnownArray* known_array(const VtkArray& array) {
  for (const KnownArray& known : known_arrays()) {
    const bool is_it =
        array.role == known.role ||
        (array.role == VtkRole::Plain &&
         std::find(known.names.begin(), known.names.end(), array.name) != known.names.end());
    if (!is_it) continue;
    const auto width = static_cast<std::size_t>(array.width);
    const bool fits = width == known.properties.size() ||
                      (known.role == VtkRole::Colours && width == 3) ||
                      (known.role == VtkRole::Texcoords && width == 3);
    const bool good = known.role != VtkRole::Colours || may_be_colours(array);
    return fits && good ? &known : nullptr;
  }
  return nullptr;
}

/// What the components of the known arrays among these are called.
std::vector<std::string> component_names(const std::vector<VtkArray>& arrays) {
  std::vector<std::string> names;
  for (const VtkArray& array : arrays)
    if (const KnownArray* const known = known_array(array))
      names.insert(names.end(), known->properties.begin(), known->properties.end());
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A name that every format can keep, unlike those that are there and those that are kept free.
std::string new_property_name(const std::vector<Property>& properties, const std::string& wanted,
                              const std::vector<std::string>& kept_free) {
  constexpr std::size_t longest_allowed = 64;
  const std::string name = printable_name(wanted.substr(0, longest_allowed));
  return free_name(name.empty() ? "array" : name, [&](const std::string& candidate) {
    return candidate == "x" || candidate == "y" || candidate == "z" ||
           contains(kept_free, candidate) ||
           std::any_of(properties.begin(), properties.end(),
                       [&](const Property& property) { return property.name == candidate; });
  });
}

/// Arrays that are called otherwise now, a line each.
struct Renamed {
  std::vector<std::string> lines;

  void add(const VtkArray& array, const std::vector<std::string>& names) {
    lines.push_back(quoted(array.name) + " is " + enumerated(names));
  }
  void tell(const std::string& whose, std::vector<std::string>& notes) const {
    if (!lines.empty()) add_loss(notes, "names of arrays of " + whose + ": " + enumerated(lines));
  }
};

std::string component_name(const VtkArray& array, std::size_t k, const KnownArray* known) {
  if (known) return known->properties[k];
  if (array.width == 1) return array.name;
  const bool named = array.component_names.size() == static_cast<std::size_t>(array.width) &&
                     !array.component_names[k].empty();
  return array.name + "_" + (named ? array.component_names[k] : std::to_string(k));
}

/// Whether what it is known as says so, or the file alone: then its name goes.
bool is_named_so(const VtkArray& array, const KnownArray& known) {
  return std::find(known.names.begin(), known.names.end(), array.name) != known.names.end();
}

/// Puts an array among the properties of points or cells, `count` of them, or notes why not.
/// `of_vectors`: what components of known arrays are called; no other array gets such a name.
void adopt(const VtkArray& array, std::int64_t count, const std::vector<std::string>& of_vectors,
           std::vector<Property>& properties, Renamed& renamed, std::vector<std::string>& notes) {
  const auto leave = [&](const std::string& why) {
    add_loss(notes, "array " + quoted(array.name) + ": " + why);
  };
  if (array.count() != count)
    return leave("it has " + std::to_string(array.count()) + " tuples, not " +
                 std::to_string(count));
  if (const std::string why = non_finite_words(array.values); !why.empty()) return leave(why);
  const KnownArray* const known = known_array(array);
  std::size_t kept = static_cast<std::size_t>(array.width);
  if (known && known->role == VtkRole::Texcoords && kept == 3) {
    kept = 2;
    add_loss(notes, "the third texture coordinates");
  }
  if (properties.size() + kept > most_properties)
    return leave("only " + std::to_string(most_properties) + " numbers each are kept");
  std::vector<std::string> names;  // that are not what one expects
  for (std::size_t k = 0; k < kept; ++k) {
    const std::string expected = component_name(array, k, known);
    const std::vector<std::string> kept_free = known ? std::vector<std::string>() : of_vectors;
    Property property{new_property_name(properties, expected, kept_free), array.type, {}};
    if (property.name != expected || (known && !is_named_so(array, *known)))
      names.push_back(property.name);
    property.values.reserve(static_cast<std::size_t>(count));
    for (std::size_t i = k; i < array.values.size(); i += static_cast<std::size_t>(array.width))
      property.values.push_back(array.values[i]);
    properties.push_back(std::move(property));
  }
  if (!names.empty()) renamed.add(array, names);
}

/// But for rounding, as of normals in bytes.
bool are_unit_vectors(const std::vector<const VtkArray*>& components) {
  constexpr double rounding = 0.01;
  for (std::size_t i = 0; i < components.front()->values.size(); ++i) {
    double square = 0;
    for (const VtkArray* component : components)
      square += component->values[i] * component->values[i];
    if (std::abs(std::sqrt(square) - 1) > rounding) return false;
  }
  return true;
}

/// Whether single numbers are the vector that their names say, as where a .ply was converted.
bool are_meant(VtkRole role, const std::vector<const VtkArray*>& components) {
  if (role == VtkRole::Normals) return are_unit_vectors(components);
  return role == VtkRole::Colours &&
         std::ranges::all_of(components, [](const VtkArray* one) { return may_be_colours(*one); });
}

/// The arrays of single numbers that have these names; null for those that are not there.
std::vector<const VtkArray*> single_numbers(const std::vector<VtkArray>& arrays,
                                            const std::vector<std::string>& names,
                                            std::int64_t count) {
  std::vector<const VtkArray*> found;
  for (const std::string& name : names) {
    const auto at = std::ranges::find_if(arrays, [&](const VtkArray& array) {
      return array.name == name && array.width == 1 && array.count() == count;
    });
    found.push_back(at == arrays.end() ? nullptr : &*at);
  }
  return found;
}

/// Tells of arrays of single numbers (entropy s, temperature t) that all else takes for a vector by
/// their names. `of_vectors`: names that are not theirs any more.
void tell_taken_names(const std::vector<VtkArray>& arrays, std::int64_t count,
                      const std::vector<std::string>& of_vectors, std::vector<std::string>& notes) {
  constexpr std::size_t most = 3;  // whether there is an alpha does not matter
  for (const KnownArray& known : known_arrays()) {
    std::vector<std::string> names = known.properties;
    names.resize(std::min(names.size(), most));
    const std::vector<const VtkArray*> components = single_numbers(arrays, names, count);
    const bool is_taken =
        !contains(of_vectors, names.front()) && std::ranges::count(components, nullptr) == 0;
    if (is_taken && !are_meant(known.role, components))
      add_loss(notes, enumerated(names) +
                          " of points as numbers: arrays of these names are taken for " +
                          known.what + ", others are not");
  }
}

/// Properties of vertices and of faces that have one name: where it is asked for, those of vertices
/// are meant.
void tell_shared_names(MeshFile& file) {
  static const std::vector<std::string> known = {"nx", "ny", "nz", "red", "green", "blue", "alpha"};
  std::vector<std::string> shared;
  for (const Property& property : file.face_properties)
    if (file.find_vertex_property(property.name) &&
        std::find(known.begin(), known.end(), property.name) == known.end())
      shared.push_back(property.name);
  if (shared.empty()) return;
  const bool one = shared.size() == 1;
  file.notes.push_back(enumerated(shared) + (one ? ": an array" : ": arrays") +
                       " of points and one of cells" + (one ? "" : " each") +
                       "; where the name is asked for, it is that of points");
}

/// Of arrays of all cells the part of the polygons, which come after vertices and lines.
void adopt_cells(const VtkSurface& surface, MeshFile& file) {
  Renamed renamed;
  const std::int64_t faces = surface.polygons.count(), before = surface.other_cells;
  const std::vector<std::string> of_vectors = component_names(surface.cell_arrays);
  for (const VtkArray& array : surface.cell_arrays) {
    if (surface.has_strips) {
      add_loss(file.notes, "array " + quoted(array.name) + " of cells that are strips");
      continue;
    }
    VtkArray of_faces = array;
    if (before > 0 && array.count() == before + faces)
      of_faces.values.erase(of_faces.values.begin(),
                            of_faces.values.begin() + before * array.width);
    adopt(of_faces, faces, of_vectors, file.face_properties, renamed, file.notes);
  }
  renamed.tell("cells", file.notes);
}

Points positions_of(const VtkSurface& surface, const std::string& name,
                    const ReadOptions& options) {
  if (!surface.points) throw ReadError(name, "holds no points");
  const VtkArray& points = *surface.points;
  if (points.width != 3) throw ReadError(name, "points do not have three coordinates");
  for (std::size_t i = 0; i < points.values.size(); ++i)
    if (!std::isfinite(points.values[i]) && !options.non_finite)
      throw ReadError(name, "a coordinate of point " + std::to_string(i / 3) + " is not finite" +
                                non_finite_advice());
  return Eigen::Map<const Points>(points.values.data(), points.count(), 3);
}

/// How many properties from `at` on are the components of a known array; 0 where they are none.
std::size_t known_width(const std::vector<Property>& properties, std::size_t at,
                        const KnownArray& known) {
  std::size_t width = 0;
  while (width < known.properties.size() && at + width < properties.size() &&
         properties[at + width].name == known.properties[width] &&
         properties[at + width].type == properties[at].type)
    ++width;
  if (width == known.properties.size()) return width;
  return known.role == VtkRole::Colours && width == 3 ? width : 0;
}

VtkArray gathered(const std::vector<Property>& properties, std::size_t at, std::size_t width) {
  VtkArray array;
  array.width = static_cast<std::int64_t>(width);
  const std::size_t count = properties[at].values.size();
  array.values.resize(count * width);
  for (std::size_t k = 0; k < width; ++k)
    for (std::size_t i = 0; i < count; ++i)
      array.values[i * width + k] = properties[at + k].values[i];
  array.type = lossless_type(properties[at].type, array.values.data(),
                             static_cast<Eigen::Index>(array.values.size()));
  return array;
}

}  // namespace

std::size_t size_in_bytes(VtkType type) {
  return with_vtk_type(type, [](auto scalar) { return sizeof scalar; });
}

void Float32Texts::look_at(std::string_view text, double value) {
  exceed_ = exceed_ || (digits_ == TextDigits::AllThatMatter && exceeds_float32(text, value));
}

void Float32Texts::settle(VtkType& type, std::vector<double>& values) const {
  if (type != VtkType::Float32) return;
  if (exceed_)
    type = VtkType::Float64;
  else
    for (double& value : values) value = rounded_to_float32(value);
}

ScalarType kept_type(VtkType type, const VtkArray& array, std::vector<std::string>& notes) {
  static constexpr std::pair<VtkType, ScalarType> same[] = {
      {VtkType::Int8, ScalarType::Int8},       {VtkType::Uint8, ScalarType::Uint8},
      {VtkType::Int16, ScalarType::Int16},     {VtkType::Uint16, ScalarType::Uint16},
      {VtkType::Int32, ScalarType::Int32},     {VtkType::Uint32, ScalarType::Uint32},
      {VtkType::Float32, ScalarType::Float32}, {VtkType::Float64, ScalarType::Float64}};
  for (const auto& [written, kept] : same)
    if (type == written) return kept;
  constexpr double most_exact = 9007199254740992.0;  // 2⁵³
  const auto all = [&](auto holds) {
    return std::all_of(array.values.begin(), array.values.end(), holds);
  };
  if (all([](double v) { return holds_exactly(ScalarType::Int32, v); })) return ScalarType::Int32;
  if (!all([](double v) { return std::abs(v) < most_exact; }))
    add_loss(notes, "array " + quoted(array.name) + ": the last digits of numbers from 2^53 on");
  return all([](double v) { return holds_exactly(ScalarType::Int64, v); }) ? ScalarType::Int64
                                                                           : ScalarType::Float64;
}

ScalarType common_type(ScalarType first, ScalarType second) {
  if (first == second) return first;
  return is_floating(first) || is_floating(second) ? ScalarType::Float64 : ScalarType::Int64;
}

std::string add_strip(VtkSurface& surface, const std::vector<int>& strip,
                      const ReadOptions& options) {
  surface.has_strips = true;
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const int a = strip[i - 2], b = strip[i - 1], c = strip[i];
    if (a == b || b == c || c == a) {
      ++surface.turns;
      continue;
    }
    const bool turned = i % 2 == 1;
    for (const int v : {turned ? b : a, turned ? a : b, c}) surface.polygons.add_corner(v);
    const std::string problem = surface.polygons.close_polygon(options);
    if (!problem.empty()) return problem;
  }
  return {};
}

bool take_strings(VtkSurface& surface, const std::string& name, std::vector<std::string> strings) {
  std::vector<std::string>* const taken = name == "comments"    ? &surface.comments
                                          : name == "materials" ? &surface.materials
                                                                : nullptr;
  if (!taken) return false;
  for (const std::string& text : strings) taken->push_back(one_line(text));
  return true;
}

MeshFile as_mesh_file(VtkSurface surface, const std::string& name, const ReadOptions& options) {
  MeshFile file;
  file.mesh.positions = positions_of(surface, name, options);
  file.position_type =
      surface.points->type == ScalarType::Float32 ? ScalarType::Float32 : ScalarType::Float64;
  file.notes = std::move(surface.notes);
  if (surface.other_cells > 0)
    add_loss(file.notes,
             counted(static_cast<long>(surface.other_cells), "cell") + " that are points or lines");
  if (surface.turns > 0)
    file.notes.push_back(counted(surface.turns, "triangle") +
                         " of strips with a vertex twice: left out, as strips turn so");
  static constexpr std::array<std::string_view, 3> rays = {"sx", "sy", "sz"};
  Renamed renamed;
  const std::vector<std::string> of_vectors = component_names(surface.point_arrays);
  for (const VtkArray& array : surface.point_arrays) {
    const bool wanted =
        !options.only_map || std::find(rays.begin(), rays.end(), array.name) != rays.end();
    if (wanted)
      adopt(array, file.mesh.vertex_count(), of_vectors, file.vertex_properties, renamed,
            file.notes);
  }
  renamed.tell("points", file.notes);
  if (!options.only_map)
    tell_taken_names(surface.point_arrays, file.mesh.vertex_count(), of_vectors, file.notes);
  if (!options.only_map) {
    adopt_cells(surface, file);
    tell_shared_names(file);
  }
  adopt_triangulation(file, triangulate(file.mesh.positions, surface.polygons));
  file.comments = std::move(surface.comments);
  file.materials = std::move(surface.materials);
  return file;
}

std::vector<VtkArray> vtk_arrays(const std::vector<Property>& properties) {
  std::vector<VtkArray> arrays;
  for (std::size_t at = 0; at < properties.size();) {
    std::size_t width = 0;
    const KnownArray* found = nullptr;
    for (const KnownArray& known : known_arrays()) {
      width = known_width(properties, at, known);
      if (width > 0) found = &known;
      if (found) break;
    }
    if (!found) width = 1;
    VtkArray array = gathered(properties, at, width);
    if (found && found->role == VtkRole::Colours && !may_be_colours(array)) {
      found = nullptr;  // nor would reading take it for that: each number keeps its own name
      width = 1;
      array = gathered(properties, at, width);
    }
    array.role = found ? found->role : VtkRole::Plain;
    array.name = found ? found->names[found->role == VtkRole::Colours && width == 4]
                       : one_line(properties[at].name);
    arrays.push_back(std::move(array));
    at += width;
  }
  return arrays;
}

ScalarType point_type(const MeshFile& file) {
  const Points& positions = file.mesh.positions;
  return file.position_type == ScalarType::Float32
             ? lossless_type(ScalarType::Float32, positions.data(), positions.size())
             : ScalarType::Float64;
}

VtkFaces vtk_faces(const MeshFile& file, const WriteOptions& options) {
  VtkFaces faces;
  const bool has_polygons =
      options.faces && std::ssize(options.faces->corners) != 3 * options.faces->count();
  faces.polygons = has_polygons ? *options.faces : triangles_as_polygons(file.mesh.triangles);
  if (!has_polygons) {
    faces.arrays = vtk_arrays(file.face_properties);
    return faces;
  }
  const std::vector<int> corners = corners_in(file.mesh.triangles, faces.polygons);
  std::vector<Property> properties;
  for (const Property& property : file.face_properties) {
    if (property.name == "source_face") continue;
    Property of_polygons{property.name, property.type, {}};
    for (std::int64_t p = 0; p < faces.polygons.count(); ++p)
      of_polygons.values.push_back(property.values[corners[faces.polygons.starts[p]] / 3]);
    properties.push_back(std::move(of_polygons));
  }
  faces.arrays = vtk_arrays(properties);
  return faces;
}

}  // namespace sphparam
