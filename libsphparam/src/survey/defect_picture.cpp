// Vertices get colours, which the renderer blends across faces. Defects are small: each gets a bead
// that is seen at the picture's size, and beads in one place are one.

#include "survey/defect_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "mesh/defect_places.h"
#include "mesh/face_sides.h"
#include "mesh/triangle_geometry.h"
#include "mesh/union_find.h"
#include "render/drawing_size.h"
#include "sphparam/errors.h"
#include "sphparam/render/picture.h"

namespace sphparam {
namespace {

using Colour = std::array<double, 3>;
constexpr Colour sound = {205, 205, 200}, beside = {240, 160, 60}, bad = {214, 30, 30};
constexpr double bead_size = 0.011;  // radius, in diagonals of the bounding box
constexpr std::size_t most_beads = 5000;

/// The faces that can be drawn: their vertices are there and have a place.
TriangleMesh drawable(const TriangleMesh& mesh) {
  TriangleMesh result;
  result.positions = mesh.positions;
  std::vector<char> has_place(static_cast<std::size_t>(mesh.vertex_count()));
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const bool finite = mesh.positions.row(v).allFinite();
    has_place[static_cast<std::size_t>(v)] = finite;
    if (!finite) result.positions.row(v).setZero();
  }
  std::vector<Face> kept;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    bool all = true;
    for (int k = 0; k < 3; ++k) {
      const Vertex v = mesh.triangles(f, k);
      all = all && v >= 0 && v < mesh.vertex_count() && has_place[static_cast<std::size_t>(v)];
    }
    if (all) kept.push_back(f);
  }
  result.triangles = mesh.triangles(kept, Eigen::all);
  for (Vertex v = 0; v < mesh.vertex_count() && !kept.empty(); ++v)
    if (!has_place[static_cast<std::size_t>(v)])  // not to widen the box
      result.positions.row(v) = result.positions.row(result.triangles(0, 0));
  return result;
}

using Edge = std::pair<Vertex, Vertex>;

/// Of defects: vertices, which are edges without length, and edges. Those that name no vertex of
/// the mesh, or one that has no place, are left out.
std::set<Edge> places_of(const MeshSource& source) {
  const TriangleMesh& mesh = source.file.mesh;
  std::set<Edge> places;
  const auto has_place = [&](int v) {
    return v >= 0 && v < mesh.vertex_count() && mesh.positions.row(v).allFinite();
  };
  const auto add = [&](int a, int b) {
    if (has_place(a) && has_place(b)) places.insert({a, b});
  };
  // Those of the source have the numbers of the file.
  for (const MeshDefect& defect : inspect_mesh(mesh).defects) {
    if (!defect.fatal || defect.kind == DefectKind::SeveralComponents) continue;
    for (const int id : defect.elements) {
      if (place_of(defect.kind) != RepairPlace::Faces) {
        add(id, id);
      } else if (id >= 0 && id < mesh.face_count()) {
        for (int k = 0; k < 3; ++k) add(mesh.triangles(id, k), mesh.triangles(id, (k + 1) % 3));
      }
    }
  }
  // About what has no place, others end: their rim is where it was.
  const auto is_drawn = [&](Face f) {
    const auto corners = mesh.triangles.row(f);
    return has_place(corners[0]) && has_place(corners[1]) && has_place(corners[2]);
  };
  const std::vector<FaceSide> sides = sorted_sides(mesh.triangles, is_drawn);
  for_each_edge(sides, [&](std::size_t i, std::size_t j) {
    if (j - i == 2 && sides[i].forward != sides[i + 1].forward) return;
    add(sides[i].low, sides[i].high);
  });
  return places;
}

std::string drawn(const MeshFile& file, const DrawingOptions& drawing) try {
  return draw_png(file, std::nullopt, drawing);
} catch (const Cancelled&) {
  throw;
} catch (const std::runtime_error& error) {
  throw PictureError(error.what());
}

class Scene {
 public:
  Scene(const MeshSource& source, const std::vector<HandleLoop>& handles)
      : source_(source), mesh_(drawable(source.file.mesh)) {
    if (mesh_.face_count() == 0) return;
    std::vector<Vector3> loops;
    for (const HandleLoop& loop : handles)
      loops.insert(loops.end(), loop.points.begin(), loop.points.end());
    const Eigen::Index own = mesh_.positions.rows();
    Points all(own + std::ssize(loops), 3);
    all.topRows(own) = mesh_.positions;
    for (std::size_t i = 0; i < loops.size(); ++i)
      all.row(own + static_cast<Eigen::Index>(i)) = loops[i].transpose();
    mesh_.positions = std::move(all);
    mesh_ = at_drawing_size(std::move(mesh_));
    colour_components(own);
    const Vector3 lower = mesh_.positions.colwise().minCoeff();
    const Vector3 upper = mesh_.positions.colwise().maxCoeff();
    centre_ = (lower + upper) / 2;
    diagonal_ = (upper - lower).norm();
    for (const auto& [a, b] : places_of(source)) add_beads(mesh_.position(a), mesh_.position(b));
    for (Eigen::Index i = own; i < mesh_.positions.rows(); ++i)
      add_bead(mesh_.positions.row(i).transpose());
    colours_.resize(static_cast<std::size_t>(mesh_.positions.rows()), bad);
  }

  std::string draw(const SurveyOptions& options) const {
    if (mesh_.face_count() == 0) return {};
    MeshFile file;
    file.mesh = with_beads();
    file.comments = source_.file.comments;  // which axis is up
    const char* const names[] = {"red", "green", "blue"};
    for (std::size_t k = 0; k < 3; ++k) {
      Property channel{names[k], ScalarType::Uint8, {}};
      for (const Colour& colour : colours_) channel.values.push_back(colour[k]);
      channel.values.resize(static_cast<std::size_t>(file.mesh.vertex_count()), bad[k]);
      file.vertex_properties.push_back(std::move(channel));
    }
    DrawingOptions drawing{.view = View::Mesh, .legend = false};
    drawing.size = options.picture_size;
    drawing.threads = options.threads;
    drawing.from = side();
    return drawn(file, drawing);
  }

  /// Where the eye is: on the side of the beads, and a little above. Nothing: they are all about.
  std::optional<Vector3> side() const {
    Vector3 sum = Vector3::Zero();
    for (const Vector3& bead : beads_) sum += bead - centre_;
    if (beads_.empty() || sum.norm() < 0.05 * diagonal_ * static_cast<double>(beads_.size()))
      return std::nullopt;
    const Vector3 raised = sum.normalized() + Vector3(0.31, 0.17, 0.23);  // along no axis
    return raised.norm() > 0.5 ? std::optional(raised) : std::nullopt;
  }

 private:
  /// Area decides which component is the largest.
  void colour_components(Eigen::Index own) {
    colours_.assign(static_cast<std::size_t>(own), sound);
    if (source_.inspection.components < 2) return;
    UnionFind classes(static_cast<std::size_t>(own));
    for (Face f = 0; f < mesh_.face_count(); ++f)
      for (int k = 1; k < 3; ++k) classes.unite(mesh_.triangles(f, 0), mesh_.triangles(f, k));
    std::map<int, double> areas;
    for (Face f = 0; f < mesh_.face_count(); ++f)
      areas[classes.find(mesh_.triangles(f, 0))] += face_area(mesh_, f);
    const auto largest = std::max_element(areas.begin(), areas.end(),
                                          [](auto& x, auto& y) { return x.second < y.second; });
    for (Vertex v = 0; v < own; ++v)
      if (classes.find(v) != largest->first) colours_[static_cast<std::size_t>(v)] = beside;
  }

  /// As a string of them.
  void add_beads(const Vector3& a, const Vector3& b) {
    add_bead(a);
    const double count = std::floor((b - a).norm() / (2 * bead_size * diagonal_));
    for (double i = 1; i < count; ++i) add_bead(a + i / count * (b - a));
    add_bead(b);
  }

  void add_bead(const Vector3& point) {
    const Eigen::Array3d cell = ((point - centre_) / (bead_size * diagonal_)).array().round();
    if (beads_.size() >= most_beads || !(diagonal_ > 0)) return;
    if (cells_.insert({cell[0], cell[1], cell[2]}).second) beads_.push_back(point);
  }

  TriangleMesh with_beads() const {
    static const Eigen::Matrix<double, 6, 3> corners{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                                     {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    static const Eigen::Matrix<int, 8, 3> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    const Eigen::Index vertices = mesh_.positions.rows(), triangles = mesh_.triangles.rows();
    const Eigen::Index count = std::ssize(beads_);
    TriangleMesh all;
    all.positions.resize(vertices + 6 * count, 3);
    all.positions.topRows(vertices) = mesh_.positions;
    all.triangles.resize(triangles + 8 * count, 3);
    all.triangles.topRows(triangles) = mesh_.triangles;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index first = vertices + 6 * i;
      all.positions.middleRows(first, 6) = (bead_size * diagonal_ * corners).rowwise() +
                                           beads_[static_cast<std::size_t>(i)].transpose();
      all.triangles.middleRows(triangles + 8 * i, 8) =
          (faces.array() + static_cast<int>(first)).matrix();
    }
    return all;
  }

  const MeshSource& source_;
  TriangleMesh mesh_;  // at drawing size; the points of loops are vertices of no face
  std::vector<Colour> colours_;
  Vector3 centre_ = Vector3::Zero();
  double diagonal_ = 0;
  std::set<std::tuple<double, double, double>> cells_;
  std::vector<Vector3> beads_;
};

}  // namespace

DefectPicture picture_of_defects(const MeshSource& source, const std::vector<HandleLoop>& handles,
                                 const SurveyOptions& options) {
  const Scene scene(source, handles);
  return {scene.draw(options), scene.side()};
}

std::string picture_of_mended(const MeshFile& file, const std::optional<Vector3>& from,
                              const SurveyOptions& options) {
  if (file.mesh.face_count() == 0 || !file.mesh.positions.allFinite()) return {};
  MeshFile shown = file;
  shown.mesh = at_drawing_size(std::move(shown.mesh));
  DrawingOptions drawing{.view = View::Mesh, .colouring = Colouring::Plain, .legend = false};
  drawing.from = from;
  drawing.repairs = true;
  drawing.size = options.picture_size;
  drawing.threads = options.threads;
  return drawn(shown, drawing);
}

}  // namespace sphparam
