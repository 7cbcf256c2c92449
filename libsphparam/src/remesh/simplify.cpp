// A queue of half-edge collapses by cost, as in wrap/simplification: entries that are older than
// their ends are passed over. Places and points on the sphere are one point of six dimensions, and
// the quadric of a triangle is the squared distance from its plane there: what is flat in space
// keeps the vertices without which an image would slide on it.

#include "sphparam/remesh/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "edge_collapse.h"
#include "mesh/triangle_geometry.h"
#include "mesh/unit_size.h"
#include "sphparam/io/fillers.h"
#include "sphparam/sphere/orientation.h"

namespace sphparam {

namespace {

constexpr double weight_of_sphere = 0.2;  // of its radius, where it has the area of the mesh
constexpr long fewest = 20;               // triangles of a level: of an icosahedron
constexpr int steps_a_look = 4096;

using Place = Eigen::Matrix<double, 6, 1>;  // in space, and on the sphere
using Places = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// xᵀAx − 2 bᵀx + c, of A its upper triangle.
struct Quadric {
  Eigen::Matrix<double, 21, 1> a = Eigen::Matrix<double, 21, 1>::Zero();
  Place b = Place::Zero();
  double c = 0;

  /// weight · (what of x − p lies across the unit vectors, squared).
  static Quadric across(const Place& p, std::initializer_list<Place> along, double weight) {
    Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Identity();
    for (const Place& unit : along) a -= unit * unit.transpose();
    a *= weight;
    Quadric made;
    for (int i = 0, at = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) made.a[at++] = a(i, j);
    }
    made.b = a * p;
    made.c = p.dot(made.b);
    return made;
  }

  void operator+=(const Quadric& other) {
    a += other.a;
    b += other.b;
    c += other.c;
  }

  double at(const Place& x) const {
    double sum = c - 2 * b.dot(x);
    for (int i = 0, at = 0; i < 6; ++i) {
      sum += a[at++] * x[i] * x[i];
      for (int j = i + 1; j < 6; ++j) sum += 2 * a[at++] * x[i] * x[j];
    }
    return sum;
  }
};

/// Of the plane through three points, weighted by the area; of none where they have no area.
Quadric of_triangle(const Place& p, const Place& q, const Place& r) {
  const Place first = (q - p).stableNormalized();
  const Place height = (r - p) - first.dot(r - p) * first;
  const double area = (q - p).norm() * height.norm() / 2;
  return area > 0 ? Quadric::across(p, {first, height.stableNormalized()}, area) : Quadric();
}

/// Of the line through two points: of a rim, which is to stay where it is.
Quadric of_rim(const Place& p, const Place& q) {
  const double length = (q - p).norm();
  return length > 0 ? Quadric::across(p, {(q - p) / length}, length * length) : Quadric();
}

/// What a triangle that stays must be in space after a collapse.
struct Wanted {
  double least_cosine;   // of its normals before and after
  double least_quality;  // unless it was no better before; 1: equilateral
};

/// In this order, as long as there are too many triangles. The last wants nothing.
constexpr std::array<Wanted, 3> wanted_in_turn = {{{0.5, 0.1}, {0, 0}, {-2, 0}}};

class Simplifier {
 public:
  explicit Simplifier(const MappedMesh& source)
      : rays_(source.map().points),
        fillers_(source.fillers()),
        triangles_(source.mesh().triangles),
        places_(places_of(source)),
        faces_(static_cast<size_t>(places_.rows())),
        quadrics_(faces_.size()),
        ages_(faces_.size(), 0),
        stays_(faces_.size(), 0),
        on_rim_(faces_.size(), 0),
        stamps_(faces_.size(), 0),
        left_(triangles_.rows()) {
    for (Face f = 0; f < left_; ++f) add_triangle(f);
    for (Vertex v = 0; v < rays_.rows(); ++v)
      stays_[at(v)] = rays_(v, 0) == 0 && rays_(v, 1) == 0;  // a pole
    if (!fillers_.empty()) find_rims(source.topology());
  }

  /// Down to so many triangles, where they can go.
  void run(long triangles, const Progress& progress) {
    for (const Wanted& wanted : wanted_in_turn) {
      long before = left_ + 1;
      while (left_ > triangles && left_ < before) {
        before = left_;
        fill_queue();
        empty_queue(triangles, wanted, progress);
      }
    }
  }

  long left() const { return left_; }

  MappedMesh result(const MappedMesh& source, int threads) const {
    MeshFile file;
    file.position_type = source.file().position_type;
    file.comments = source.file().comments;
    file.format = source.file().format;
    const std::vector<Vertex> kept = kept_vertices();
    file.mesh.positions = source.mesh().positions(kept, Eigen::all);
    FillerMarks fillers;
    file.mesh.triangles = renumbered(kept, fillers);
    for (const Property& property : source.file().vertex_properties)
      if (!is_normal(property.name)) file.vertex_properties.push_back(of_kept(property, kept));
    if (!fillers_.empty()) mark_fillers(file, fillers);
    return MappedMesh({.file = std::move(file),
                       .map = {rays_(kept, Eigen::all)},
                       .provenance = source.provenance(),
                       .name = source.name()},
                      threads);
  }

 private:
  static size_t at(Vertex v) { return static_cast<size_t>(v); }

  static bool is_normal(const std::string& name) {
    return name == "nx" || name == "ny" || name == "nz";
  }

  static Property of_kept(Property property, const std::vector<Vertex>& kept) {
    std::vector<double> values;
    values.reserve(kept.size());
    for (const Vertex v : kept) values.push_back(property.values[at(v)]);
    property.values = std::move(values);
    return property;
  }

  /// About the middle of the mesh, so that quadrics lose no digits, at a size whose powers are
  /// numbers; the sphere's radius is its share of that of a ball of the mesh's area.
  static Places places_of(const MappedMesh& source) {
    const std::optional<Rescaled> unit = at_unit_size(source.mesh());
    const TriangleMesh& mesh = unit ? unit->mesh : source.mesh();
    const Eigen::RowVector3d middle =
        (mesh.positions.colwise().minCoeff() + mesh.positions.colwise().maxCoeff()) / 2;
    Places places(mesh.vertex_count(), 6);
    places.leftCols(3) = mesh.positions.rowwise() - middle;
    places.rightCols(3) = weight_of_sphere *
                          std::sqrt(surface_area(mesh) / (4 * std::numbers::pi)) *
                          source.map().points;
    return places;
  }

  Place place(Vertex v) const { return places_.row(v); }
  Vector3 in_space(Vertex v) const { return places_.row(v).head<3>(); }
  Vector3 ray(Vertex v) const { return rays_.row(v); }
  bool is_gone(Face f) const { return triangles_(f, 0) < 0; }
  bool has(Face f, Vertex v) const {
    return triangles_(f, 0) == v || triangles_(f, 1) == v || triangles_(f, 2) == v;
  }

  void add_triangle(Face f) {
    const Quadric plane =
        of_triangle(place(triangles_(f, 0)), place(triangles_(f, 1)), place(triangles_(f, 2)));
    for (int k = 0; k < 3; ++k) {
      faces_[at(triangles_(f, k))].push_back(f);
      quadrics_[at(triangles_(f, k))] += plane;
    }
  }

  bool is_filler(Face f) const {
    return !fillers_.empty() && fillers_[static_cast<size_t>(f)] != 0;
  }

  /// Vertices where rims meet stay; others of rims go along them alone.
  void find_rims(const Topology& topology) {
    for (Face f = 0; f < triangles_.rows(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const Vertex a = triangles_(f, k), b = triangles_(f, (k + 1) % 3);
        if (!is_filler(f) || is_filler(topology.twin(3 * f + k) / 3)) continue;
        const Quadric line = of_rim(place(a), place(b));
        for (const Vertex v : {a, b}) {
          quadrics_[at(v)] += line;
          ++on_rim_[at(v)];
        }
      }
    }
    for (size_t v = 0; v < on_rim_.size(); ++v) stays_[v] |= on_rim_[v] > 2;
  }

  /// Each neighbour once.
  template <class Visit>
  void for_each_neighbour(Vertex v, const Visit& visit) {
    const int stamp = ++last_stamp_;
    for (const Face f : faces_[at(v)]) {
      for (int k = 0; k < 3; ++k) {
        const Vertex w = triangles_(f, k);
        if (w != v && std::exchange(stamps_[at(w)], stamp) != stamp) visit(w);
      }
    }
  }

  void push(Vertex from, Vertex to) {
    if (stays_[at(from)] || (on_rim_[at(from)] > 0 && on_rim_[at(to)] == 0)) return;
    const Place there = place(to);
    queue_.push_back({quadrics_[at(from)].at(there) + quadrics_[at(to)].at(there), from, to,
                      ages_[at(from)] + ages_[at(to)]});
  }

  void fill_queue() {
    queue_.clear();
    for (Vertex v = 0; v < places_.rows(); ++v)
      for_each_neighbour(v, [&](Vertex w) { push(v, w); });
    std::make_heap(queue_.begin(), queue_.end());
  }

  void empty_queue(long triangles, const Wanted& wanted, const Progress& progress) {
    const long all = left_;
    for (long step = 0; left_ > triangles && !queue_.empty(); ++step) {
      if (step % steps_a_look == 0)
        report(progress, "simplify",
               static_cast<double>(all - left_) / static_cast<double>(all - triangles));
      std::pop_heap(queue_.begin(), queue_.end());
      const EdgeCollapse next = queue_.back();
      queue_.pop_back();
      if (is_current(next) && keeps_topology(next) && keeps_faces(next, wanted)) collapse(next);
    }
  }

  bool is_current(const EdgeCollapse& edge) const {
    return !faces_[at(edge.from)].empty() && !faces_[at(edge.to)].empty() &&
           ages_[at(edge.from)] + ages_[at(edge.to)] == edge.age;
  }

  /// The link condition; along a rim the edge must be of it. A tetrahedron stays.
  bool keeps_topology(const EdgeCollapse& edge) {
    if (left_ <= 4) return false;
    for_each_neighbour(edge.from, [](Vertex) {});
    const int of_from = last_stamp_;
    int common = 0;
    for_each_neighbour_of_other(edge.to, of_from, common);
    return common == 2 && (on_rim_[at(edge.from)] == 0 || (is_of_rim(edge) && !ends_rim(edge)));
  }

  /// Whether a triangle that goes is all there is within a rim of three edges: a hole, which would
  /// close, or all of the surface between holes.
  bool ends_rim(const EdgeCollapse& edge) const {
    return std::ranges::any_of(faces_[at(edge.from)],
                               [&](Face f) { return has(f, edge.to) && is_alone(f); });
  }

  /// Whether none of the three triangles beside a triangle is of its kind.
  bool is_alone(Face f) const {
    for (int k = 0; k < 3; ++k) {
      const Vertex a = triangles_(f, k), b = triangles_(f, (k + 1) % 3);
      for (const Face g : faces_[at(a)])
        if (g != f && has(g, b) && is_filler(g) == is_filler(f)) return false;
    }
    return true;
  }

  /// Each neighbour of a vertex of a closed surface is once the next corner of a face.
  void for_each_neighbour_of_other(Vertex v, int stamp, int& common) const {
    for (const Face f : faces_[at(v)]) {
      const int k = triangles_(f, 0) == v ? 0 : triangles_(f, 1) == v ? 1 : 2;
      common += stamps_[at(triangles_(f, (k + 1) % 3))] == stamp;
    }
  }

  bool is_of_rim(const EdgeCollapse& edge) const {
    int fillers = 0, faces = 0;
    for (const Face f : faces_[at(edge.from)]) {
      if (!has(f, edge.to)) continue;
      ++faces;
      fillers += is_filler(f);
    }
    return faces == 2 && fillers == 1;
  }

  bool keeps_faces(const EdgeCollapse& edge, const Wanted& wanted) const {
    return std::ranges::all_of(faces_[at(edge.from)], [&](Face f) {
      return has(f, edge.to) || keeps_face(f, edge, wanted);
    });
  }

  bool keeps_face(Face f, const EdgeCollapse& edge, const Wanted& wanted) const {
    std::array<Vertex, 3> now = {triangles_(f, 0), triangles_(f, 1), triangles_(f, 2)};
    const std::array<Vertex, 3> old = now;
    std::ranges::replace(now, edge.from, edge.to);
    return orientation(ray(now[0]), ray(now[1]), ray(now[2])) > 0 && looks_well(old, now, wanted);
  }

  bool looks_well(const std::array<Vertex, 3>& old, const std::array<Vertex, 3>& now,
                  const Wanted& wanted) const {
    const Vector3 a = in_space(old[0]), b = in_space(old[1]), c = in_space(old[2]);
    const Vector3 p = in_space(now[0]), q = in_space(now[1]), r = in_space(now[2]);
    const Vector3 before = (b - a).cross(c - a), after = (q - p).cross(r - p);
    const double good = triangle_quality(p, q, r);
    return before.dot(after) >= wanted.least_cosine * before.norm() * after.norm() &&
           (good >= wanted.least_quality || good >= triangle_quality(a, b, c));
  }

  void collapse(const EdgeCollapse& edge) {
    quadrics_[at(edge.to)] += quadrics_[at(edge.from)];
    std::vector<Face>& faces = faces_[at(edge.to)];
    for (const Face f : faces_[at(edge.from)]) {
      if (has(f, edge.to)) {
        remove(f, edge.from);
        continue;
      }
      for (int k = 0; k < 3; ++k)
        if (triangles_(f, k) == edge.from) triangles_(f, k) = edge.to;
      faces.push_back(f);
    }
    std::vector<Face>().swap(faces_[at(edge.from)]);
    ++ages_[at(edge.to)];
    push_edges(edge.to);
  }

  void remove(Face f, Vertex from) {
    for (int k = 0; k < 3; ++k)
      if (triangles_(f, k) != from) std::erase(faces_[at(triangles_(f, k))], f);
    triangles_.row(f).setConstant(-1);
    --left_;
  }

  void push_edges(Vertex v) {
    for_each_neighbour(v, [&](Vertex w) {
      for (const auto& [from, to] : {std::pair{v, w}, std::pair{w, v}}) {
        const size_t before = queue_.size();
        push(from, to);
        if (queue_.size() > before) std::push_heap(queue_.begin(), queue_.end());
      }
    });
    if (std::ssize(queue_) <= 6 * left_) return;  // twice as many as there are half-edges
    std::erase_if(queue_, [&](const EdgeCollapse& edge) { return !is_current(edge); });
    std::make_heap(queue_.begin(), queue_.end());
  }

  std::vector<Vertex> kept_vertices() const {
    std::vector<Vertex> kept;
    for (Vertex v = 0; v < places_.rows(); ++v)
      if (!faces_[at(v)].empty()) kept.push_back(v);
    return kept;
  }

  Triangles renumbered(const std::vector<Vertex>& kept, FillerMarks& fillers) const {
    std::vector<Vertex> number(faces_.size(), -1);
    for (size_t i = 0; i < kept.size(); ++i) number[at(kept[i])] = static_cast<Vertex>(i);
    Triangles triangles(left_, 3);
    Face count = 0;
    for (Face f = 0; f < triangles_.rows(); ++f) {
      if (is_gone(f)) continue;
      for (int k = 0; k < 3; ++k) triangles(count, k) = number[at(triangles_(f, k))];
      fillers.push_back(is_filler(f));
      ++count;
    }
    return triangles;
  }

  const Points& rays_;
  const FillerMarks& fillers_;
  Triangles triangles_;  // −1: gone
  Places places_;
  std::vector<std::vector<Face>> faces_;  // about each vertex; none: gone
  std::vector<Quadric> quadrics_;
  std::vector<int> ages_;  // how often a vertex took another in
  std::vector<char> stays_;
  std::vector<int> on_rim_;  // how many edges of rims it has
  std::vector<int> stamps_;  // of the visit of neighbours that came to a vertex last
  int last_stamp_ = 0;
  long left_;
  std::vector<EdgeCollapse> queue_;  // a heap
};

void require_falling(std::span<const long> triangles) {
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] < 4 || (i > 0 && triangles[i] >= triangles[i - 1]))
      throw std::invalid_argument("triangles: numbers that fall, of at least 4");
  }
}

}  // namespace

std::vector<MappedMesh> simplified_meshes(const MappedMesh& source, std::span<const long> triangles,
                                          const SimplifyOptions& options) {
  require_falling(triangles);
  std::vector<MappedMesh> meshes;
  if (triangles.empty()) return meshes;
  Simplifier simplifier(source);
  for (const long wanted : triangles) {
    const long before = simplifier.left();
    if (wanted >= before) continue;
    simplifier.run(wanted, options.progress);
    if (simplifier.left() >= before) break;
    meshes.push_back(simplifier.result(source, options.threads));
  }
  return meshes;
}

std::vector<long> quarters(long triangles, int count) {
  std::vector<long> wanted;
  for (long before = triangles; std::ssize(wanted) < count && before > fewest;) {
    before = std::max(before / 4, fewest);
    wanted.push_back(before);
  }
  return wanted;
}

}  // namespace sphparam
