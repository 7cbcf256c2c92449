#include "io/formats/gltf/gltf_reader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "elementary.h"
#include "io/attributes/appearance.h"
#include "io/attributes/authorship.h"
#include "io/attributes/left_out_image.h"
#include "io/attributes/material_comments.h"
#include "io/files/non_finite_advice.h"
#include "io/formats/gltf/gltf_accessors.h"
#include "io/formats/gltf/gltf_document.h"
#include "io/formats/gltf/gltf_instances.h"
#include "io/formats/gltf/gltf_nodes.h"
#include "io/formats/gltf/gltf_skins.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/up_axis.h"

// Every placed mesh in turn: positions go through x ↦ Ax + b, normals through A⁻ᵀ; where det A < 0
// the triangles are turned over, as the specification says. With a skin each vertex has an A and b
// of its own, as the joints stand in the file. Primitives of one placed mesh that
// share their vertices share them here too, so that a mesh closed in the file is closed in memory.

namespace sphparam {
namespace {

/// What `export --theta-phi` writes: two angles a vertex.
constexpr std::string_view theta_phi = "_THETA_PHI";

enum Mode { ModePoints = 0, ModeTriangles = 4, ModeStrip = 5, ModeFan = 6 };

/// Second texture coordinates and tangents on their way to the corners. No attribute of a file has
/// a name with a blank.
const std::string corner_columns[] = {"second s",  "second t",  "tangent x",
                                      "tangent y", "tangent z", "tangent w"};

/// One file may name the same bytes over and over: what is made of them is bounded by their number.
constexpr std::uint64_t most_triangles_per_byte = 2;

/// Up to so many triangles harm nobody: a forest is a tree and a list of places, of few bytes.
constexpr std::uint64_t harmless_triangles = 1 << 20;

/// A vertex property under construction: primitives without it leave gaps.
struct Column {
  ScalarType type = ScalarType::Float32;
  double gap = 0;
  std::vector<double> values;
  std::size_t written = 0;
};

/// What has no COLOR_0 is white and opaque: its material is not tinted.
bool is_colour(const std::string& property) {
  return property == "red" || property == "green" || property == "blue" || property == "alpha";
}

/// COLOR_0 is linear light; colours of all other formats, and so those of `MeshFile`, are sRGB.
/// Source: IEC 61966-2-1.
double srgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * elementary::pow(x, 1 / 2.4) - 0.055;
  return static_cast<double>(static_cast<float>(encoded));
}

/// Where the vertices of a primitive go: one transform for all, or one each.
struct VertexTransforms {
  std::vector<Transform> all;

  bool is_one() const { return all.size() == 1; }
  const Transform& operator[](std::size_t vertex) const { return all[is_one() ? 0 : vertex]; }
};

/// Vertices of a mesh that are there already.
struct PlacedVertices {
  int first = 0;
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();  // of the first: its scale, and its side
};

class SceneReader {
 public:
  SceneReader(const GltfDocument& document, const std::string& name, const ReadOptions& options,
              const SceneOrigin& origin)
      : document_(document),
        name_(name),
        options_(options),
        accessors_(document, name),
        posed_skins_(origin.posed_skins) {}

  MeshFile read() {
    const PlacedScene scene = place_scene(document_, name_, file_.notes);
    for (const PlacedMesh& placed : scene.meshes)
      for (const PlacedMesh& instance : instances_of(placed)) add_mesh(instance, scene);
    if (triangles_.empty() && without_area_ > 0)
      fail(first_without_area_ + ", which are not supported; triangles are");
    if (triangles_.empty()) fail("holds no triangles");
    file_.mesh.positions = Eigen::Map<const Points>(positions_.data(), vertex_count(), 3);
    file_.mesh.triangles = Eigen::Map<const Triangles>(triangles_.data(), triangle_count(), 3);
    finish_columns();
    finish_corner_tables();
    finish_materials();
    add_notes();
    note_authorship(file_, document_.author);
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw ReadError(name_, message); }

  Eigen::Index vertex_count() const { return static_cast<Eigen::Index>(positions_.size() / 3); }
  Eigen::Index triangle_count() const { return static_cast<Eigen::Index>(triangles_.size() / 3); }

  const GltfDocument::Node& node_of(const PlacedMesh& placed) const {
    return document_.nodes[static_cast<std::size_t>(placed.node)];
  }

  /// The mesh once where it has no instances, or more or other ones than can be read.
  std::vector<PlacedMesh> instances_of(const PlacedMesh& placed) {
    if (node_of(placed).instances.empty()) return {placed};
    std::vector<PlacedMesh> instances;
    try {
      const std::vector<Transform> transforms =
          instance_transforms(node_of(placed).instances, accessors_, name_);
      make_room_for(transforms.size(), placed.mesh);
      for (const Transform& transform : transforms)
        instances.push_back({placed.mesh, placed.node, placed.transform * transform});
    } catch (const ReadError&) {
      ++read_once_;
      return {placed};
    }
    return instances;
  }

  void make_room_for(std::size_t instances, int mesh) {
    double triangles = 0, vertices = 0;
    for (const auto& primitive : document_.meshes[static_cast<std::size_t>(mesh)]) {
      const auto count = [&](int id) { return static_cast<double>(accessors_.accessor(id).count); };
      const double points = count(check_primitive(primitive));
      const double corners = primitive.indices >= 0 ? count(primitive.indices) : points;
      triangles += primitive.mode == ModeTriangles ? corners / 3 : corners;
      vertices += points;
    }
    const double more = std::max(triangles, vertices / 3) * static_cast<double>(instances);
    if (more > static_cast<double>(harmless_triangles - of_instances_))
      fail("more instances than are read");
    of_instances_ += static_cast<std::uint64_t>(std::ceil(more));
  }

  /// Also where nodes name one mesh over and over.
  std::uint64_t most_triangles() const {
    return most_triangles_per_byte * accessors_.buffer_bytes() + harmless_triangles + of_instances_;
  }

  /// As the joints stand, or where a skin is broken as the node stands.
  VertexTransforms transforms_of(const GltfDocument::Primitive& primitive, const PlacedMesh& placed,
                                 const PlacedScene& scene) {
    if (node_of(placed).skin < 0) return {{placed.transform}};
    try {
      const auto [joints, is_new] = joints_of_.try_emplace(node_of(placed).skin);
      if (is_new)
        joints->second =
            joint_transforms(document_, node_of(placed).skin, scene.nodes, accessors_, name_);
      return {posed_vertices(primitive, joints->second, accessors_, name_)};
    } catch (const ReadError&) {
      is_broken_ = true;
      return {{placed.transform}};
    }
  }

  void add_mesh(const PlacedMesh& placed, const PlacedScene& scene) {
    is_broken_ = false;
    // By the accessors of the vertices, the material that says where its image lies on them, and
    // the morphs that move them.
    using Attributes = std::map<std::string, int>;
    std::map<std::tuple<Attributes, int, std::vector<Attributes>>, PlacedVertices> already;
    const auto& primitives = document_.meshes[static_cast<std::size_t>(placed.mesh)];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const GltfDocument::Primitive& primitive = primitives[p];
      where_ = "mesh " + std::to_string(placed.mesh) + " primitive " + std::to_string(p);
      if (leave_out(primitive)) continue;
      const int position = check_primitive(primitive);
      transform_of_uv_ = transform_of(primitive);
      second_ = second_texcoords_of(primitive);
      const bool plain = transform_of_uv_ == GltfDocument::TextureTransform() && second_.empty();
      find_morphs(primitive, node_of(placed));
      const auto [vertices, is_new] =
          already.try_emplace({primitive.attributes, plain ? -1 : primitive.material,
                               is_morphed() ? primitive.targets : std::vector<Attributes>()});
      if (is_new) {
        const VertexTransforms transforms = transforms_of(primitive, placed, scene);
        vertices->second = {static_cast<int>(vertex_count()), transforms[0].linear};
        add_vertices(primitive, position, transforms);
      }
      const auto& [first, linear] = vertices->second;
      scale_of_.try_emplace(primitive.material, std::sqrt(linear.squaredNorm() / 3));
      add_triangles(primitive, accessors_.accessor(position).count, first,
                    linear.determinant() < 0);
    }
    if (node_of(placed).skin >= 0) ++(is_broken_ ? broken_skins_ : posed_skins_);
  }

  void find_morphs(const GltfDocument::Primitive& primitive, const GltfDocument::Node& node) {
    targets_ = &primitive.targets;
    weights_ = node.weights.empty() ? primitive.weights : node.weights;
    weights_.resize(targets_->size(), 0);
    any_morphed_ = any_morphed_ || is_morphed();
    for (std::size_t t = 0; t < weights_.size(); ++t)
      if (weights_[t] != 0) note_unmoved((*targets_)[t]);
  }

  /// What `morphed` is not asked for.
  void note_unmoved(const std::map<std::string, int>& target) {
    for (const auto& [attribute, accessor] : target)
      if (attribute != "POSITION" && attribute != "NORMAL" && attribute != "TANGENT")
        unmoved_.insert(one_line(attribute));
  }

  bool is_morphed() const {
    return std::ranges::any_of(weights_, [](double weight) { return weight != 0; });
  }

  /// The numbers of an attribute, `width` a vertex, as the weights in the file move the first
  /// three. Valid until the next call.
  const std::vector<double>& morphed(const std::string& attribute, const std::vector<double>& rest,
                                     std::size_t width = 3) {
    if (!is_morphed()) return rest;
    morphed_ = rest;
    for (std::size_t t = 0; t < weights_.size(); ++t) {
      const auto target = (*targets_)[t].find(attribute);
      if (weights_[t] == 0 || target == (*targets_)[t].end()) continue;
      require_components(target->second, {3});
      const std::vector<double>& moves = accessors_.numbers(target->second);
      if (moves.size() / 3 != rest.size() / width)
        accessors_.fail(target->second, where_ + " has " + std::to_string(rest.size() / width) +
                                            " vertices, its morph target another number");
      for (std::size_t i = 0; i < moves.size(); ++i)
        morphed_[i / 3 * width + i % 3] += weights_[t] * moves[i];
    }
    return morphed_;
  }

  GltfDocument::TextureTransform transform_of(const GltfDocument::Primitive& primitive) {
    const auto material = static_cast<std::size_t>(primitive.material);
    if (material >= document_.materials.size()) return {};
    const GltfDocument::TextureTransform& transform = document_.materials[material].transform;
    if (primitive.attributes.contains(texcoords_of(transform))) return transform;
    if (transform.texcoord != 0) without_texcoords_.insert(primitive.material);
    return {};
  }

  /// The attribute of its images on other coordinates than the first; empty: there are none.
  std::string second_texcoords_of(const GltfDocument::Primitive& primitive) {
    const auto material = static_cast<std::size_t>(primitive.material);
    if (material >= document_.materials.size()) return "";
    const int set = document_.materials[material].second_texcoord;
    if (set < 0) return "";
    const std::string attribute = texcoords_of({.texcoord = set});
    if (primitive.attributes.contains(attribute)) return attribute;
    without_second_.insert(primitive.material);
    return "";
  }

  bool has_normal_maps() const {
    return std::ranges::any_of(document_.materials, [](const GltfDocument::Material& material) {
      return !material.channels.normal.image.empty();
    });
  }

  static std::string texcoords_of(const GltfDocument::TextureTransform& transform) {
    return "TEXCOORD_" + std::to_string(transform.texcoord);
  }

  /// Points and lines are no surface.
  bool leave_out(const GltfDocument::Primitive& primitive) {
    if (primitive.mode < ModePoints || primitive.mode >= ModeTriangles) return false;
    if (without_area_++ == 0)
      first_without_area_ =
          where_ + " holds " + (primitive.mode == ModePoints ? "points" : "lines");
    return true;
  }

  /// The accessor of the positions.
  int check_primitive(const GltfDocument::Primitive& primitive) const {
    if (primitive.mode < ModePoints || primitive.mode > ModeFan)
      fail(where_ + " has the unknown mode " + std::to_string(primitive.mode));
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) fail(where_ + " has no positions");
    require_components(position->second, {3});
    if (accessors_.type(position->second) == ScalarType::Uint32)
      accessors_.fail(position->second, "positions of this type are not allowed");
    return position->second;
  }

  void require_components(int accessor, std::initializer_list<int> allowed) const {
    const int components = accessors_.accessor(accessor).components;
    if (std::find(allowed.begin(), allowed.end(), components) == allowed.end())
      accessors_.fail(accessor, where_ + " needs another number of components");
  }

  void add_vertices(const GltfDocument::Primitive& primitive, int position,
                    const VertexTransforms& transforms) {
    const std::vector<double>& xyz = morphed("POSITION", accessors_.any_numbers(position));
    const auto count = static_cast<std::int64_t>(xyz.size() / 3);
    const std::int64_t limit =
        std::min<std::int64_t>(options_.max_vertices, std::numeric_limits<int>::max());
    const std::int64_t in_bytes = static_cast<std::int64_t>(3 * most_triangles());
    if (count > std::min(limit, in_bytes) - vertex_count())
      fail(where_ + ": more vertices than the limit of " +
           std::to_string(std::min(limit, in_bytes)));
    const auto before = static_cast<std::size_t>(vertex_count());
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      const Transform& transform = transforms[i / 3];
      Vector3 x = transform.linear * Eigen::Map<const Vector3>(xyz.data() + i) + transform.shift;
      // Copies of a vertex that name its joints in another order are to stay copies.
      if (!transforms.is_one()) x = x.cast<float>().cast<double>();
      if (!options_.non_finite && !x.allFinite())
        accessors_.fail(position, "element " + std::to_string(i / 3) + " is no finite number as " +
                                      where_ + " places it" + non_finite_advice());
      positions_.insert(positions_.end(), x.begin(), x.end());
    }
    for (const auto& [attribute, accessor] : primitive.attributes)
      if (attribute != "POSITION")
        add_attribute(attribute, accessor, transforms, before, static_cast<std::size_t>(count));
    morph_targets_ = std::max(morph_targets_, std::ssize(primitive.targets));
  }

  void add_attribute(const std::string& attribute, int accessor, const VertexTransforms& transforms,
                     std::size_t before, std::size_t count) {
    if (!has_place(attribute, accessor)) {
      // Joints and weights belong to skins, which are told of.
      const bool of_skin = attribute.starts_with("JOINTS_") || attribute.starts_with("WEIGHTS_");
      if (!of_skin) not_carried_.insert(one_line(attribute));
      return;
    }
    carried_.insert(one_line(attribute));
    if (accessors_.accessor(accessor).count != count)
      accessors_.fail(accessor, where_ + " has " + std::to_string(count) + " vertices");
    if (attribute == "NORMAL") {
      add_normals(accessor, transforms, before);
    } else if (attribute == texcoords_of(transform_of_uv_)) {
      add_texcoords(accessor, before);
    } else if (attribute == second_) {
      add_second_texcoords(accessor, before);
    } else if (attribute == "TANGENT") {
      add_tangents(accessor, transforms, before);
    } else if (attribute == "COLOR_0") {
      add_colours(accessor, before);
    } else if (attribute == theta_phi) {
      add_column("theta", accessors_.type(accessor), accessor, 0, before);
      add_column("phi", accessors_.type(accessor), accessor, 1, before);
    } else {
      std::string property = one_line(attribute);
      std::replace(property.begin(), property.end(), ' ', '_');
      add_column(property, accessors_.type(accessor), accessor, 0, before);
    }
  }

  bool has_place(const std::string& attribute, int accessor) const {
    if (attribute == "NORMAL" || attribute == "COLOR_0") return true;
    if (attribute == texcoords_of(transform_of_uv_) || attribute == second_) return true;
    if (attribute == "TANGENT") return has_normal_maps_;
    const int components = accessors_.accessor(accessor).components;
    return attribute.starts_with("_") && components == (attribute == theta_phi ? 2 : 1);
  }

  template <class Change = std::identity>
  void add_column(const std::string& property, ScalarType type, int accessor, std::size_t component,
                  std::size_t before, Change change = {}) {
    const std::vector<double>& numbers = accessors_.numbers(accessor);
    const auto width = static_cast<std::size_t>(accessors_.accessor(accessor).components);
    std::vector<double> values;
    for (std::size_t i = component; i < numbers.size(); i += width)
      values.push_back(change(numbers[i]));
    append(property, type, before, values);
  }

  void append(const std::string& property, ScalarType type, std::size_t before,
              const std::vector<double>& values) {
    const auto [found, is_new] = columns_.try_emplace(property);
    Column& column = found->second;
    if (is_new) {
      order_.push_back(property);
      column = {type, is_colour(property) ? 1.0 : 0.0, {}};
    } else if (column.type != type) {
      column.type = ScalarType::Float64;
    }
    column.values.resize(before, column.gap);
    column.values.insert(column.values.end(), values.begin(), values.end());
    column.written += values.size();
  }

  void add_normals(int accessor, const VertexTransforms& transforms, std::size_t before) {
    require_components(accessor, {3});
    std::vector<Eigen::Matrix3d> cotransforms;
    for (const Transform& transform : transforms.all)
      cotransforms.push_back(transform.linear.inverse().transpose());
    const std::vector<double>& xyz = morphed("NORMAL", accessors_.numbers(accessor));
    std::vector<double> turned[3];
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      Vector3 normal = Eigen::Map<const Vector3>(xyz.data() + i);
      const bool as_written =
          !is_morphed() && transforms[i / 3].linear == Eigen::Matrix3d::Identity();
      if (!as_written)
        normal = (cotransforms[transforms.is_one() ? 0 : i / 3] * normal).stableNormalized();
      for (int axis = 0; axis < 3; ++axis)
        turned[axis].push_back(std::isfinite(normal[axis]) ? normal[axis] : 0);
    }
    const char* const names[] = {"nx", "ny", "nz"};
    for (int axis = 0; axis < 3; ++axis)
      append(names[axis], ScalarType::Float32, before, turned[axis]);
  }

  /// Where the image of the material lies; t upwards.
  void add_texcoords(int accessor, std::size_t before) {
    require_components(accessor, {2});
    const GltfDocument::TextureTransform& t = transform_of_uv_;
    const bool plain = t == GltfDocument::TextureTransform{.texcoord = t.texcoord};
    const double c = elementary::cos(t.rotation), s = elementary::sin(t.rotation);
    const std::vector<double>& numbers = accessors_.numbers(accessor);
    std::vector<double> columns[2];
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
      const double u = t.scale[0] * numbers[i], v = t.scale[1] * numbers[i + 1];
      columns[0].push_back(plain ? numbers[i] : c * u + s * v + t.offset[0]);
      columns[1].push_back(1 - (plain ? numbers[i + 1] : c * v - s * u + t.offset[1]));
    }
    const ScalarType type = plain ? ScalarType::Float32 : ScalarType::Float64;
    append("s", type, before, columns[0]);
    append("t", type, before, columns[1]);
  }

  void add_second_texcoords(int accessor, std::size_t before) {
    require_components(accessor, {2});
    add_column(corner_columns[0], ScalarType::Float64, accessor, 0, before);
    add_column(corner_columns[1], ScalarType::Float64, accessor, 1, before,
               [](double v) { return 1 - v; });
  }

  /// A tangent lies in the surface, and goes where that goes; where space is mirrored, w · N × T is
  /// not, but for w.
  void add_tangents(int accessor, const VertexTransforms& transforms, std::size_t before) {
    require_components(accessor, {4});
    const std::vector<double>& xyzw = morphed("TANGENT", accessors_.numbers(accessor), 4);
    const double turned = transforms[0].linear.determinant() < 0 ? -1 : 1;
    std::vector<double> columns[4];
    for (std::size_t i = 0; i < xyzw.size(); i += 4) {
      const Vector3 along = (transforms[i / 4].linear * Eigen::Map<const Vector3>(xyzw.data() + i))
                                .stableNormalized();
      const bool is_one = along.allFinite() && !along.isZero(0);
      for (int axis = 0; axis < 3; ++axis) columns[axis].push_back(is_one ? along[axis] : 0);
      columns[3].push_back(is_one ? (xyzw[i + 3] < 0 ? -turned : turned) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k)
      append(corner_columns[2 + k], ScalarType::Float64, before, columns[k]);
  }

  /// Whole numbers must be normalised; where a file forgets to say so, they are meant all the same.
  void add_colours(int accessor, std::size_t before) {
    require_components(accessor, {3, 4});
    const char* const names[] = {"red", "green", "blue"};
    const double most = brightest(accessors_.type(accessor));
    any_whole_colours_ = any_whole_colours_ || most != 1;
    for (std::size_t channel = 0; channel < 3; ++channel)
      add_column(names[channel], ScalarType::Float32, accessor, channel, before,
                 [most](double value) { return srgb(value / most); });
    if (accessors_.accessor(accessor).components == 4)
      add_column("alpha", ScalarType::Float32, accessor, 3, before,
                 [most](double value) { return value / most; });
  }

  void add_triangles(const GltfDocument::Primitive& primitive, std::uint64_t vertices, int first,
                     bool turn_over) {
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) indices = accessors_.indices(primitive.indices, vertices);
    const std::uint64_t corners = primitive.indices >= 0 ? indices.size() : vertices;
    const auto corner = [&](std::uint64_t i) {
      return first + static_cast<int>(primitive.indices >= 0 ? indices[i] : i);
    };
    const bool list = primitive.mode == ModeTriangles;
    if (corners < 3 || (list && corners % 3 != 0))
      fail(where_ + ": " + std::to_string(corners) + " corners make no whole triangles");
    const std::uint64_t count = list ? corners / 3 : corners - 2;
    require_room_for(count);
    for (std::uint64_t t = 0; t < count; ++t) {
      // A strip turns every other triangle over; a fan has its first corner in each.
      const std::uint64_t start = list ? 3 * t : t;
      const std::uint64_t odd = primitive.mode == ModeStrip ? t % 2 : 0;
      const bool fan = primitive.mode == ModeFan;
      const int a = fan ? corner(t + 1) : corner(start);
      const int b = fan ? corner(t + 2) : corner(start + 1 + odd);
      const int c = fan ? corner(0) : corner(start + 2 - odd);
      add_triangle(a, turn_over ? c : b, turn_over ? b : c, primitive.material);
    }
  }

  void require_room_for(std::uint64_t count) const {
    const auto limit = static_cast<std::uint64_t>(
        std::min<std::int64_t>(options_.max_faces, std::numeric_limits<int>::max() / 3));
    const std::uint64_t most = std::min(limit, most_triangles());
    if (count + static_cast<std::uint64_t>(triangle_count()) > most)
      fail(where_ + ": more triangles than the limit of " + std::to_string(most));
  }

  void add_triangle(int a, int b, int c, int material) {
    if (a == b || b == c || c == a) {
      ++degenerate_;
      return;
    }
    triangles_.insert(triangles_.end(), {a, b, c});
    material_of_.push_back(material);
  }

  void finish_columns() {
    const auto count = static_cast<std::size_t>(vertex_count());
    for (const std::string& name : order_) {
      Column& column = columns_.at(name);
      if (std::ranges::count(corner_columns, name) > 0) {
        column.values.resize(count, 0);
        continue;
      }
      if (column.written < count && !is_colour(name))
        file_.notes.push_back(std::to_string(count - column.written) + " vertices have no '" +
                              name + "': set to zero");
      column.values.resize(count, column.gap);
      file_.vertex_properties.push_back({name, column.type, std::move(column.values)});
    }
  }

  /// What no vertex property is: it would take part in welding, and be written.
  void finish_corner_tables() {
    const auto fill = [&](auto& table, std::size_t first) {
      if (!columns_.contains(corner_columns[first])) return;
      auto& rows = table.emplace();
      rows.resize(3 * triangle_count(), rows.cols());
      for (Eigen::Index i = 0; i < rows.rows(); ++i)
        for (Eigen::Index k = 0; k < rows.cols(); ++k)
          rows(i, k) =
              columns_.at(corner_columns[first + static_cast<std::size_t>(k)])
                  .values[static_cast<std::size_t>(triangles_[static_cast<std::size_t>(i)])];
    };
    fill(file_.second_texcoords, 0);
    fill(file_.corner_tangents, 2);
  }

  void finish_materials() {
    std::map<int, int> ids;  // in order of first use
    Property property{"material", ScalarType::Int32, {}};
    for (const int material : material_of_) {
      if (material < 0 || material >= static_cast<int>(document_.materials.size())) {
        property.values.push_back(-1);
        continue;
      }
      const auto [found, is_new] = ids.try_emplace(material, static_cast<int>(ids.size()));
      if (is_new) add_material(material);
      property.values.push_back(found->second);
    }
    if (!ids.empty()) file_.set_face_property(std::move(property));
  }

  void add_material(int id) {
    const auto& [name, words, base_colour, channels, unused, second, said_besides, nearest] =
        document_.materials[static_cast<std::size_t>(id)];
    std::vector<std::string> others = said_besides;
    file_.materials.push_back(name.empty() ? "material " + std::to_string(id) : name);
    file_.base_colours.push_back(base_colour);
    file_.channels.push_back(channels);
    file_.channels.back().finish.thickness *= scale_of_.at(id);
    if (without_texcoords_.contains(id)) {
      const std::string why = "its texture coordinates are not there";
      file_.base_colours.back().problem = why;
      for (MaterialTexture* texture : file_.channels.back().textures()) texture->problem = why;
    }
    if (without_second_.contains(id)) {
      for (MaterialTexture* texture : file_.channels.back().textures()) {
        if (!texture->second || texture->image.empty()) continue;
        leave_out_image(*texture, file_.channels.back());
        others.push_back("textures whose texture coordinates are not there");
      }
    }
    note_nearest(file_, file_.materials.size() - 1, nearest);
    if (!words.empty())
      file_.comments.push_back("base colour of " + file_.materials.back() + ": " + words);
    materials_with_others_ += !others.empty();
    for (const std::string& other : others)
      if (others_seen_.insert(other).second) others_.push_back(other);
  }

  void add_notes() {
    if (degenerate_ > 0)
      file_.notes.push_back(std::to_string(degenerate_) +
                            " triangles that name a vertex twice dropped");
    if (materials_with_others_ > 0)
      add_loss(file_.notes, enumerated(others_) + " of " + std::to_string(materials_with_others_) +
                                " of " +
                                counted(static_cast<long>(file_.materials.size()), "material"));
    if (without_area_ > 0)
      add_loss(file_.notes, counted(without_area_, "primitive") + " of points or lines");
    if (posed_skins_ > 0)
      add_loss(file_.notes,
               counted(posed_skins_, "skin") + ": the mesh is read as the joints stand");
    if (broken_skins_ > 0)
      add_loss(file_.notes, counted(broken_skins_, "broken skin") + ": the mesh is read unposed");
    if (read_once_ > 0)
      add_loss(file_.notes,
               "the instances of " + counted(read_once_, "mesh", "meshes") + ", read once");
    if (morph_targets_ > 0)
      add_loss(file_.notes, counted(morph_targets_, "morph target") + how_morphed());
    std::vector<std::string> not_carried;
    for (const std::string& attribute : not_carried_)
      not_carried.push_back(
          attribute + (carried_.contains(attribute) ? " where no material there uses it" : ""));
    if (!not_carried.empty()) add_loss(file_.notes, "of the vertices " + enumerated(not_carried));
    if (any_whole_colours_)
      file_.notes.push_back("COLOR_0 is of whole numbers not said to be normalised: taken as if");
    if (accessors_.misaligned() > 0)
      file_.notes.push_back(counted(accessors_.misaligned(), "accessor") +
                            " not aligned as glTF wants it: read all the same");
    for (const std::string& note : document_.notes) file_.notes.push_back(note);
  }

  std::string how_morphed() const {
    if (!any_morphed_) return "";
    const std::string read = ": the mesh is read as their weights stand";
    if (unmoved_.empty()) return read;
    return read + ", but for " + enumerated({unmoved_.begin(), unmoved_.end()}) +
           ", which are as without them";
  }

  const GltfDocument& document_;
  const std::string& name_;
  const ReadOptions& options_;
  GltfAccessors accessors_;
  GltfDocument::TextureTransform transform_of_uv_;  // of the primitive being read
  std::string second_;  // the attribute of its other texture coordinates; empty: none
  bool has_normal_maps_ = has_normal_maps();
  std::string where_;  // "mesh 0 primitive 1", for messages

  std::vector<double> positions_;
  std::vector<int> triangles_;
  std::vector<int> material_of_;  // of each triangle, as numbered in the file
  std::map<std::string, Column> columns_;
  std::vector<std::string> order_;   // of the columns, as first seen
  std::vector<std::string> others_;  // what of materials is not carried, each once
  std::set<std::string> others_seen_;
  long materials_with_others_ = 0;
  std::map<int, double> scale_of_;       // of materials, where they are first used
  std::set<int> without_second_;         // materials whose other coordinates some primitive lacks
  std::set<int> without_texcoords_;      // materials whose images some primitive has no place for
  std::set<std::string> not_carried_;    // attributes
  std::set<std::string> carried_;        // likewise, of some primitive
  long posed_skins_, broken_skins_ = 0;  // meshes placed with one
  std::map<int, std::vector<Transform>> joints_of_;  // of skins
  std::uint64_t of_instances_ = 0;                   // triangles, at most
  long read_once_ = 0;                               // meshes without their instances
  bool is_broken_ = false;                           // the skin of the mesh being read
  std::ptrdiff_t morph_targets_ = 0;
  bool any_morphed_ = false;
  std::set<std::string> unmoved_;  // attributes that weights in the file would move
  const std::vector<std::map<std::string, int>>* targets_ = nullptr;  // of the primitive being read
  std::vector<double> weights_;                                       // of these
  std::vector<double> morphed_;  // numbers that they have moved
  long degenerate_ = 0;
  bool any_whole_colours_ = false;
  long without_area_ = 0;           // primitives of points and lines
  std::string first_without_area_;  // the first of them, in words
  MeshFile file_;
};

}  // namespace

bool looks_like_gltf(std::string_view bytes) {
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return bytes.starts_with("glTF") || (start != std::string_view::npos && bytes[start] == '{');
}

MeshFile read_gltf(std::string_view bytes, const std::string& name,
                   const std::optional<std::filesystem::path>& folder, const ReadOptions& options,
                   const SceneOrigin& origin) {
  if (!looks_like_gltf(bytes)) throw ReadError(name, "is no glTF");
  const GltfDocument document = load_gltf(bytes, name, folder, options, origin);
  MeshFile file = SceneReader(document, name, options, origin).read();
  file.companions = document.files;
  file.format = bytes.starts_with("glTF") ? "glTF binary" : "glTF";
  file.position_type = ScalarType::Float32;
  note_up(file, {.direction = Vector3::UnitY()});
  return file;
}

}  // namespace sphparam
