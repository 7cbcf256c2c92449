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
#include "io/files/non_finite_advice.h"
#include "io/formats/gltf/gltf_accessors.h"
#include "io/formats/gltf/gltf_columns.h"
#include "io/formats/gltf/gltf_document.h"
#include "io/formats/gltf/gltf_instances.h"
#include "io/formats/gltf/gltf_morphs.h"
#include "io/formats/gltf/gltf_nodes.h"
#include "io/formats/gltf/gltf_skins.h"
#include "io/formats/gltf/gltf_used_materials.h"
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

/// One file may name the same bytes over and over: what is made of them is bounded by their number.
constexpr std::uint64_t most_triangles_per_byte = 2;

/// Up to so many triangles harm nobody: a forest is a tree and a list of places, of few bytes.
constexpr std::uint64_t harmless_triangles = 1 << 20;

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
    columns_.finish(file_);
    materials_.finish(file_);
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
      transform_of_uv_ = materials_.transform_of(primitive);
      second_ = materials_.second_texcoords_of(primitive);
      const bool plain = transform_of_uv_ == GltfDocument::TextureTransform() && second_.empty();
      morphs_.begin(primitive, node_of(placed), where_);
      const auto [vertices, is_new] = already.try_emplace(
          {primitive.attributes, plain ? -1 : primitive.material,
           morphs_.is_morphed() ? primitive.targets : std::vector<Attributes>()});
      if (is_new) {
        const VertexTransforms transforms = transforms_of(primitive, placed, scene);
        vertices->second = {static_cast<int>(vertex_count()), transforms[0].linear};
        add_vertices(primitive, position, transforms);
      }
      const auto& [first, linear] = vertices->second;
      materials_.note_scale(primitive.material, std::sqrt(linear.squaredNorm() / 3));
      add_triangles(primitive, accessors_.accessor(position).count, first,
                    linear.determinant() < 0);
    }
    if (node_of(placed).skin >= 0) ++(is_broken_ ? broken_skins_ : posed_skins_);
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
    accessors_.require_components(position->second, {3}, where_);
    if (accessors_.type(position->second) == ScalarType::Uint32)
      accessors_.fail(position->second, "positions of this type are not allowed");
    return position->second;
  }

  void add_vertices(const GltfDocument::Primitive& primitive, int position,
                    const VertexTransforms& transforms) {
    const std::vector<double>& xyz = morphs_.moved("POSITION", accessors_.any_numbers(position));
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
    morphs_.count_targets();
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
    } else if (attribute == gltf_texcoords(transform_of_uv_)) {
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
    if (attribute == gltf_texcoords(transform_of_uv_) || attribute == second_) return true;
    if (attribute == "TANGENT") return materials_.has_normal_maps();
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
    columns_.append(property, type, before, values);
  }

  void add_normals(int accessor, const VertexTransforms& transforms, std::size_t before) {
    accessors_.require_components(accessor, {3}, where_);
    std::vector<Eigen::Matrix3d> cotransforms;
    for (const Transform& transform : transforms.all)
      cotransforms.push_back(transform.linear.inverse().transpose());
    const std::vector<double>& xyz = morphs_.moved("NORMAL", accessors_.numbers(accessor));
    std::vector<double> turned[3];
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      Vector3 normal = Eigen::Map<const Vector3>(xyz.data() + i);
      const bool as_written =
          !morphs_.is_morphed() && transforms[i / 3].linear == Eigen::Matrix3d::Identity();
      if (!as_written)
        normal = (cotransforms[transforms.is_one() ? 0 : i / 3] * normal).stableNormalized();
      for (int axis = 0; axis < 3; ++axis)
        turned[axis].push_back(std::isfinite(normal[axis]) ? normal[axis] : 0);
    }
    const char* const names[] = {"nx", "ny", "nz"};
    for (int axis = 0; axis < 3; ++axis)
      columns_.append(names[axis], ScalarType::Float32, before, turned[axis]);
  }

  /// Where the image of the material lies; t upwards.
  void add_texcoords(int accessor, std::size_t before) {
    accessors_.require_components(accessor, {2}, where_);
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
    columns_.append("s", type, before, columns[0]);
    columns_.append("t", type, before, columns[1]);
  }

  void add_second_texcoords(int accessor, std::size_t before) {
    accessors_.require_components(accessor, {2}, where_);
    add_column(GltfColumns::second_texcoord[0], ScalarType::Float64, accessor, 0, before);
    add_column(GltfColumns::second_texcoord[1], ScalarType::Float64, accessor, 1, before,
               [](double v) { return 1 - v; });
  }

  /// A tangent lies in the surface, and goes where that goes; where space is mirrored, w · N × T is
  /// not, but for w.
  void add_tangents(int accessor, const VertexTransforms& transforms, std::size_t before) {
    accessors_.require_components(accessor, {4}, where_);
    const std::vector<double>& xyzw = morphs_.moved("TANGENT", accessors_.numbers(accessor), 4);
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
      columns_.append(GltfColumns::tangent[k], ScalarType::Float64, before, columns[k]);
  }

  /// Whole numbers must be normalised; where a file forgets to say so, they are meant all the same.
  void add_colours(int accessor, std::size_t before) {
    accessors_.require_components(accessor, {3, 4}, where_);
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
    materials_.add_triangle(material);
  }

  void add_notes() {
    if (degenerate_ > 0)
      file_.notes.push_back(std::to_string(degenerate_) +
                            " triangles that name a vertex twice dropped");
    materials_.tell(file_.notes);
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
    morphs_.tell(file_.notes);
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

  const GltfDocument& document_;
  const std::string& name_;
  const ReadOptions& options_;
  GltfAccessors accessors_;
  GltfMorphs morphs_{accessors_};
  GltfUsedMaterials materials_{document_};
  GltfDocument::TextureTransform transform_of_uv_;  // of the primitive being read
  std::string second_;  // the attribute of its other texture coordinates; empty: none
  std::string where_;   // "mesh 0 primitive 1", for messages

  std::vector<double> positions_;
  std::vector<int> triangles_;
  GltfColumns columns_;
  std::set<std::string> not_carried_;                // attributes
  std::set<std::string> carried_;                    // likewise, of some primitive
  long posed_skins_, broken_skins_ = 0;              // meshes placed with one
  std::map<int, std::vector<Transform>> joints_of_;  // of skins
  std::uint64_t of_instances_ = 0;                   // triangles, at most
  long read_once_ = 0;                               // meshes without their instances
  bool is_broken_ = false;                           // the skin of the mesh being read
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
