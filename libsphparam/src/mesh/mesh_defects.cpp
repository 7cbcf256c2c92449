#include "sphparam/mesh/mesh_defects.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iomanip>
#include <optional>
#include <sstream>

#include "mesh/box.h"
#include "mesh/defect_places.h"
#include "mesh/face_sides.h"
#include "mesh/flat_face.h"
#include "mesh/index_range.h"
#include "mesh/triangle_geometry.h"
#include "mesh/union_find.h"
#include "number_text.h"

// A mesh that Topology accepts has no defect of connectivity: counting is all that is left, and the
// cost is that of the map's own first step. Otherwise everything is found by sorting: edges by
// their two vertices, faces by their three, so the cost is the same however bad the mesh is, and no
// half-edge structure (which bad meshes do not have) is needed. Fans of faces are counted by
// union-find.

namespace sphparam {
namespace {

constexpr size_t listed = 10;  // how many ids of a defect are kept

/// Collects the places of one kind of defect; keeps the first few.
struct Places {
  long count = 0;
  std::vector<int> elements;

  void add(std::initializer_list<int> ids) {
    ++count;
    if (elements.size() + ids.size() <= listed * ids.size()) {
      elements.insert(elements.end(), ids.begin(), ids.end());
    }
  }
};

std::string list_of(RepairPlace place, const Places& places) {
  return place_list(place, places.elements, places.count);
}

class Inspector {
 public:
  explicit Inspector(const TriangleMesh& mesh)
      : mesh_(mesh),
        vertices_(static_cast<int>(mesh.vertex_count())),
        faces_(static_cast<int>(mesh.face_count())),
        sound_(static_cast<size_t>(faces_), true) {}

  MeshInspection run() {
    result_.vertices = vertices_;
    result_.faces = faces_;
    if (faces_ == 0) {
      add_fatal(DefectKind::Empty, 1, {},
                "the mesh has no faces (of points alone a surface has to be made first, as by "
                "Poisson reconstruction in MeshLab or CloudCompare)",
                "");
    }
    check_indices();
    check_positions();
    if (const auto topology = closed_manifold()) {
      result_.edges = topology->edge_count();
    } else {
      sides_ = sorted_sides(mesh_.triangles, [this](Face f) { return is_sound(f); });
      check_edges();
      check_duplicate_faces();
      check_fans();
    }
    count_components();
    check_usage();
    check_shape();
    check_coincident();
    std::stable_partition(result_.defects.begin(), result_.defects.end(),
                          [](const MeshDefect& defect) { return defect.fatal; });
    return std::move(result_);
  }

 private:
  Vertex corner(Face f, int k) const { return mesh_.triangles(f, k); }
  bool is_sound(Face f) const { return sound_[static_cast<size_t>(f)]; }

  void add_fatal(DefectKind kind, long count, std::vector<int> elements, std::string message,
                 std::string hint) {
    result_.defects.push_back(
        {kind, true, count, std::move(elements), std::move(message), std::move(hint)});
  }
  void add_remark(DefectKind kind, const Places& places, std::string message, std::string hint) {
    result_.defects.push_back(
        {kind, false, places.count, places.elements, std::move(message), std::move(hint)});
  }

  /// Faces with bad indices are reported and then left out of everything else.
  void check_indices() {
    Places out_of_range, repeated;
    for (Face f = 0; f < faces_; ++f) {
      const int a = corner(f, 0), b = corner(f, 1), c = corner(f, 2);
      const bool inside = std::min({a, b, c}) >= 0 && std::max({a, b, c}) < vertices_;
      if (!inside) out_of_range.add({f});
      if (inside && (a == b || b == c || c == a)) repeated.add({f});
      sound_[static_cast<size_t>(f)] = inside && a != b && b != c && c != a;
    }
    if (out_of_range.count > 0) {
      add_fatal(DefectKind::IndexOutOfRange, out_of_range.count, out_of_range.elements,
                counted(out_of_range.count, "face names a vertex that does not exist",
                        "faces name vertices that do not exist") +
                    list_of(RepairPlace::Faces, out_of_range),
                counts_from_one(mesh_) ? "the indices count from 1: faces - 1" : "");
    }
    if (repeated.count > 0) {
      add_fatal(DefectKind::RepeatedVertex, repeated.count, repeated.elements,
                counted(repeated.count, "face names", "faces name") + " one vertex twice" +
                    list_of(RepairPlace::Faces, repeated),
                "remove degenerate faces");
    }
  }

  /// The topology, if there is nothing wrong with it at all.
  std::optional<Topology> closed_manifold() const {
    if (faces_ < 4) return std::nullopt;  // two faces back to back are closed, but no surface
    return Topology::try_build(mesh_.triangles, vertices_);
  }

  void check_positions() {
    Places places;
    for (Vertex v = 0; v < vertices_; ++v) {
      if (!mesh_.positions.row(v).allFinite()) places.add({v});
    }
    finite_ = places.count == 0;
    if (finite_ && faces_ > 0 && vertices_ > 0) measure_box();
    if (finite_) return;
    add_fatal(DefectKind::NonFinitePosition, places.count, places.elements,
              counted(places.count, "vertex has", "vertices have") +
                  " a coordinate that is not a finite number" +
                  list_of(RepairPlace::Vertices, places),
              "");
  }

  void measure_box() {
    const Box box = surface_box(mesh_);
    result_.lower = box.lower;
    result_.upper = box.upper;
    centre_ = 0.5 * result_.lower + 0.5 * result_.upper;
    const double extent = (result_.upper / 2 - result_.lower / 2).maxCoeff();
    if (extent > 0) scale_ = extent;
  }

  /// From −1 to 1, so that 1e±300 neither overflows nor vanishes.
  Vector3 scaled_corner(Face f, int k) const {
    return (mesh_.position(corner(f, k)) - centre_) / scale_;
  }

  /// Of sides as they are: a small face in a large box keeps its digits.
  double scaled_area(Face f) const {
    const Vector3 half = mesh_.position(corner(f, 0)) / 2;
    const auto side = [&](int k) -> Vector3 {
      return 2 * ((mesh_.position(corner(f, k)) / 2 - half) / scale_);
    };
    return triangle_area(Vector3::Zero(), side(1), side(2));
  }

  struct BadEdges {
    Places boundary, crowded, misoriented;
  };

  /// Edges by how many faces they have, and which way those run through them.
  BadEdges count_edges() {
    BadEdges bad;
    UnionFind loops(static_cast<size_t>(vertices_));  // boundary edges that meet are of one loop
    std::vector<Vertex> on_boundary;
    for_each_edge(sides_, [&](size_t i, size_t j) {
      ++result_.edges;
      const FaceSide& side = sides_[i];
      if (j - i == 1) {
        bad.boundary.add({side.low, side.high});
        loops.unite(side.low, side.high);
        on_boundary.push_back(side.low);
      }
      if (j - i > 2) bad.crowded.add({side.low, side.high});
      if (j - i == 2 && side.forward == sides_[i + 1].forward)
        bad.misoriented.add({side.low, side.high});
    });
    std::vector<int> roots;
    for (const Vertex v : on_boundary) roots.push_back(loops.find(v));
    std::sort(roots.begin(), roots.end());
    result_.boundary_loops = std::unique(roots.begin(), roots.end()) - roots.begin();
    return bad;
  }

  void check_edges() {
    const auto [boundary, crowded, misoriented] = count_edges();
    if (boundary.count > 0) {
      add_fatal(DefectKind::BoundaryEdge, boundary.count, boundary.elements,
                "not closed: " + counted(boundary.count, "boundary edge", "boundary edges") +
                    " in " + counted(result_.boundary_loops, "loop", "loops") +
                    list_of(RepairPlace::Edges, boundary),
                "fill the holes, or weld vertices that lie at the same place");
    }
    if (crowded.count > 0) {
      add_fatal(DefectKind::NonManifoldEdge, crowded.count, crowded.elements,
                counted(crowded.count, "edge has", "edges have") + " three or more faces" +
                    list_of(RepairPlace::Edges, crowded),
                "remove inner or duplicate faces");
    }
    if (misoriented.count > 0) tell_misoriented(misoriented);
  }

  void tell_misoriented(const Places& edges) {
    const bool one_sided = is_one_sided();
    add_fatal(DefectKind::InconsistentOrientation, edges.count, edges.elements,
              counted(edges.count, "edge is", "edges are") +
                  " run through the same way by both faces" +
                  (one_sided ? " of a one-sided (non-orientable) surface" : "") +
                  list_of(RepairPlace::Edges, edges),
              one_sided ? "however its faces are turned, some edge is run through the same way"
                        : "orient the faces consistently");
  }

  /// Each face as it is, and turned over: joined across edges where they agree. One-sided is what
  /// comes back to a face the other way round.
  bool is_one_sided() const {
    UnionFind ways(static_cast<size_t>(faces_) * 2);
    for_each_edge(sides_, [&](size_t i, size_t j) {
      if (j - i != 2) return;
      const Face f = sides_[i].halfedge / 3, g = sides_[i + 1].halfedge / 3;
      const int turned = sides_[i].forward == sides_[i + 1].forward ? 1 : 0;
      ways.unite(2 * f, 2 * g + turned);
      ways.unite(2 * f + 1, 2 * g + 1 - turned);
    });
    for (Face f = 0; f < faces_; ++f) {
      if (ways.find(2 * f) == ways.find(2 * f + 1)) return true;
    }
    return false;
  }

  void check_duplicate_faces() {
    std::vector<std::array<int, 4>> keys;  // three sorted vertices, the face
    keys.reserve(static_cast<size_t>(faces_));
    for (Face f = 0; f < faces_; ++f) {
      if (!is_sound(f)) continue;
      std::array<int, 4> key{corner(f, 0), corner(f, 1), corner(f, 2), f};
      std::sort(key.begin(), key.begin() + 3);
      keys.push_back(key);
    }
    std::sort(keys.begin(), keys.end());
    Places places;
    for (size_t i = 1; i < keys.size(); ++i) {
      if (std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin())) {
        places.add({keys[i][3]});
      }
    }
    if (places.count == 0) return;
    add_fatal(DefectKind::DuplicateFace, places.count, places.elements,
              counted(places.count, "face has", "faces have") +
                  " the same three vertices as another" + list_of(RepairPlace::Faces, places),
              "remove duplicate faces");
  }

  /// Corners of one vertex are joined when an edge connects their faces; a vertex whose corners
  /// fall into several classes is where fans touch.
  void check_fans() {
    UnionFind fans(static_cast<size_t>(faces_) * 3);
    for_each_edge(sides_, [&](size_t i, size_t j) {
      for (size_t s = i + 1; s < j; ++s) {
        for (const Vertex v : {sides_[i].low, sides_[i].high}) {
          fans.unite(corner_at(sides_[i], v), corner_at(sides_[s], v));
        }
      }
    });
    std::vector<int> fan_of(static_cast<size_t>(vertices_), -1);
    std::vector<char> touching(static_cast<size_t>(vertices_), 0);
    for (Face f = 0; f < faces_; ++f) {
      for (int k = 0; is_sound(f) && k < 3; ++k) {
        const auto v = static_cast<size_t>(corner(f, k));
        const int fan = fans.find(3 * f + k);
        if (fan_of[v] >= 0 && fan_of[v] != fan) touching[v] = 1;
        fan_of[v] = fan;
      }
    }
    Places places;
    for (Vertex v = 0; v < vertices_; ++v) {
      if (touching[static_cast<size_t>(v)]) places.add({v});
    }
    if (places.count == 0) return;
    add_fatal(DefectKind::NonManifoldVertex, places.count, places.elements,
              counted(places.count, "vertex joins", "vertices join") +
                  " separate fans of faces (non-manifold)" + list_of(RepairPlace::Vertices, places),
              "split the vertex, one copy for each fan");
  }

  void count_components() {
    UnionFind parts(static_cast<size_t>(vertices_));
    used_.assign(static_cast<size_t>(vertices_), 0);
    long joined = 0;
    for (Face f = 0; f < faces_; ++f) {
      if (!is_sound(f)) continue;
      for (int k = 0; k < 3; ++k) {
        used_[static_cast<size_t>(corner(f, k))] = 1;
        joined += parts.unite(corner(f, k), corner(f, (k + 1) % 3));
      }
    }
    result_.used_vertices = std::count(used_.begin(), used_.end(), 1);
    result_.components = result_.used_vertices - joined;
    const long sound_faces = std::count(sound_.begin(), sound_.end(), true);
    result_.euler_characteristic = result_.used_vertices - result_.edges + sound_faces;
    if (result_.components > 1) {
      add_fatal(DefectKind::SeveralComponents, result_.components, {},
                std::to_string(result_.components) + " separate components; the largest has " +
                    words_of_largest(parts),
                "keep one of them");
    }
    if (result_.defects.empty() && result_.components == 1) check_genus();
  }

  /// Requires: one closed manifold.
  void check_genus() {
    result_.genus = (2 - result_.euler_characteristic) / 2;
    if (result_.genus != 0) {
      add_fatal(DefectKind::WrongGenus, result_.genus, {},
                "genus " + std::to_string(result_.genus) + " (Euler characteristic " +
                    std::to_string(result_.euler_characteristic) +
                    "): only surfaces without handles map to the sphere",
                "cut each handle open and close both ends");
    }
  }

  /// "33104 faces and 99.2 % of the area"; the largest by area, where there is any.
  std::string words_of_largest(UnionFind& parts) const {
    struct Size {
      double area = 0;
      long faces = 0;
      auto operator<=>(const Size&) const = default;
    };
    std::vector<Size> sizes(static_cast<size_t>(vertices_));
    double all = 0;
    for (Face f = 0; f < faces_; ++f) {
      if (!is_sound(f)) continue;
      Size& size = sizes[static_cast<size_t>(parts.find(corner(f, 0)))];
      const double area = finite_ ? scaled_area(f) : 0;
      size.area += area;
      all += area;
      ++size.faces;
    }
    const Size largest = *std::max_element(sizes.begin(), sizes.end());
    std::ostringstream text;
    text << counted(largest.faces, "face", "faces");
    if (all > 0)
      text << " and " << std::setprecision(3) << 100 * largest.area / all << " % of the area";
    return text.str();
  }

  void check_usage() {
    Places places;
    for (Vertex v = 0; v < vertices_; ++v) {
      if (!used_[static_cast<size_t>(v)]) places.add({v});
    }
    if (places.count == 0) return;
    add_remark(DefectKind::UnusedVertex, places,
               counted(places.count, "vertex is", "vertices are") + " used by no face" +
                   list_of(RepairPlace::Vertices, places),
               "who reads a file need do nothing: they are dropped; in arrays remove them first");
  }

  void check_shape() {
    if (!finite_ || faces_ == 0) return;
    Places flat;
    for (Face f = 0; f < faces_; ++f) {
      if (!is_sound(f)) continue;
      const Vector3 a = scaled_corner(f, 0), b = scaled_corner(f, 1), c = scaled_corner(f, 2);
      result_.area += scaled_area(f);
      result_.volume += a.dot(b.cross(c)) / 6;
      if (has_no_area(mesh_.position(corner(f, 0)), mesh_.position(corner(f, 1)),
                      mesh_.position(corner(f, 2)))) {
        flat.add({f});
      }
    }
    result_.area *= scale_ * scale_;
    result_.volume *= scale_ * scale_ * scale_;
    if (flat.count > 0) {
      add_remark(DefectKind::ZeroAreaFace, flat,
                 counted(flat.count, "face has", "faces have") + " no area" +
                     list_of(RepairPlace::Faces, flat),
                 "");
    }
    if (result_.volume < 0 && result_.boundary_loops == 0) {
      add_remark(DefectKind::InsideOut, {}, "inside out: the volume is negative",
                 "the map is made all the same, with the faces as they are");
    }
  }

  void check_coincident() {
    if (!finite_) return;
    // Open addressing: each vertex is looked up among those before it.
    const size_t slots = std::bit_ceil(2 * static_cast<size_t>(vertices_) + 1);
    std::vector<Vertex> table(slots, -1);
    Places places;
    for (Vertex v = 0; v < vertices_; ++v) {
      if (!used_[static_cast<size_t>(v)]) continue;
      size_t slot = hash_of_position(v) & (slots - 1);
      while (table[slot] >= 0 && mesh_.position(table[slot]) != mesh_.position(v)) {
        slot = (slot + 1) & (slots - 1);
      }
      if (table[slot] >= 0) {
        places.add({v});
      } else {
        table[slot] = v;
      }
    }
    if (places.count == 0) return;
    add_remark(DefectKind::CoincidentVertices, places,
               counted(places.count, "vertex lies", "vertices lie") + " exactly on another" +
                   list_of(RepairPlace::Vertices, places),
               "");
  }

  size_t hash_of_position(Vertex v) const {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) {
      const double x = mesh_.positions(v, k) + 0.0;  // −0 and 0 are the same place
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return static_cast<size_t>(hash);
  }

  const TriangleMesh& mesh_;
  const int vertices_;
  const int faces_;
  std::vector<bool> sound_;      // per face: indices in range and different
  std::vector<char> used_;       // per vertex
  std::vector<FaceSide> sides_;  // sorted by edge
  bool finite_ = true;
  Vector3 centre_ = Vector3::Zero();  // of the bounding box
  double scale_ = 1;                  // half its longest side, where it has one
  MeshInspection result_;
};

}  // namespace

bool MeshInspection::is_sphere() const {
  return std::none_of(defects.begin(), defects.end(),
                      [](const MeshDefect& defect) { return defect.fatal; });
}

MeshInspection inspect_mesh(const TriangleMesh& mesh) {
  require_numbered(mesh.face_count(), mesh.vertex_count());
  return Inspector(mesh).run();
}

}  // namespace sphparam
