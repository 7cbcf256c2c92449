#include "sphparam/chart/refine_poles.h"

#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

// Points are put on every link edge first; then every face with points on edges is cut into fans,
// one edge after the other, from the corner opposite to it. No link edge lies on the meridian, so
// each point has one wedge. Wedges of vertices come before copies, which move up to make room.

namespace sphparam {
namespace {

constexpr int next_corner(int k) { return (k + 1) % 3; }

/// A face to be cut, with the new vertices on its edges; edge k runs from corner k to the next.
struct Cut {
  std::array<Vertex, 3> vertices;
  std::array<int, 3> wedges;
  std::array<std::vector<Vertex>, 3> on_edges;
};

class PoleRefiner {
 public:
  PoleRefiner(SphericalChart& chart, const Triangles& source, int wedges, int threads)
      : chart_(chart),
        source_(source),
        wedges_(wedges),
        threads_(threads),
        faces_(rows_of(chart.triangles)),
        vertices_(rows_of(chart.points)),
        points_of_(static_cast<size_t>(3 * faces_)) {}

  void refine() {
    const std::vector<Halfedge> links = find_links();
    require_room(static_cast<std::int64_t>(links.size()));
    make_room(static_cast<int>(links.size()) * (wedges_ - 1));
    for (const Halfedge h : links) put_points(h);
    for (Face f = 0; f < faces_; ++f) cut_face(f);
    append();
  }

 private:
  template <class Matrix>
  static int rows_of(const Matrix& matrix) {
    return static_cast<int>(matrix.rows());
  }

  Vertex vertex(Halfedge h) const { return chart_.triangles(h / 3, h % 3); }
  int wedge(Halfedge h) const { return chart_.wedges(h / 3, h % 3); }

  bool is_link(Halfedge h) const {
    return chart_.pole_corner(Topology::face(h)) == next_corner(next_corner(Topology::corner(h)));
  }

  /// The edges opposite to a pole; one of both poles once.
  std::vector<Halfedge> find_links() {
    const Topology topology(chart_.triangles, vertices_, threads_);
    std::vector<Halfedge> links;
    for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
      if (!is_link(h) || (is_link(topology.twin(h)) && topology.twin(h) < h)) continue;
      links.push_back(h);
      twins_.push_back(topology.twin(h));
    }
    return links;
  }

  /// Each point of a link adds a vertex, two triangles and at most two wedges.
  void require_room(std::int64_t links) const {
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    const std::int64_t added = links * (wedges_ - 1);
    if (3 * (faces_ + 2 * added) > most || chart_.wedge_count() + 3 * added > most) {
      throw std::invalid_argument("refine_poles: " + std::to_string(wedges_) +
                                  " wedges a pole triangle are more than 2^31 numbers can tell");
    }
  }

  void make_room(int added) {
    for (Face f = 0; f < faces_; ++f) {
      for (int k = 0; k < 3; ++k) {
        if (chart_.wedges(f, k) >= vertices_) chart_.wedges(f, k) += added;
      }
    }
    const auto at = static_cast<std::ptrdiff_t>(vertices_);
    const auto count = static_cast<size_t>(added);
    for (Eigen::Index w = 0; w < chart_.uv.rows(); ++w) uv_.push_back(chart_.uv.row(w));
    uv_.insert(uv_.begin() + at, count, Eigen::RowVector2d::Zero());
    chart_.wedge_kinds.insert(chart_.wedge_kinds.begin() + at, count, WedgeKind::Ordinary);
    chart_.wedge_vertices.insert(chart_.wedge_vertices.begin() + at, count, -1);
    chart_.points.conservativeResize(vertices_ + added, 3);
  }

  void put_points(Halfedge h) {
    const Halfedge end = Topology::next(h);
    const Eigen::RowVector2d a = uv_[static_cast<size_t>(wedge(h))],
                             b = uv_[static_cast<size_t>(wedge(end))];
    const Face face = chart_.source_faces[static_cast<size_t>(Topology::face(h))];
    const Vector3 first = weights(vertex(h), face), last = weights(vertex(end), face);
    std::vector<Vertex>& points = points_of_[static_cast<size_t>(h)];
    for (int i = 1; i < wedges_; ++i) {
      const double t = static_cast<double>(i) / wedges_;
      points.push_back(add_vertex({face, (1 - t) * first + t * last}, (1 - t) * a + t * b));
    }
    const Halfedge twin = twins_[next_link_++];
    points_of_[static_cast<size_t>(twin)].assign(points.rbegin(), points.rend());
  }

  Vector3 weights(Vertex v, Face face) const {
    return barycentric_in(face, chart_.surface_points[static_cast<size_t>(v)], source_);
  }

  Vertex add_vertex(const SurfacePoint& at, const Eigen::RowVector2d& uv) {
    Vector3 ray = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      ray += at.barycentric[k] * chart_.points.row(source_(at.face, k)).transpose();
    }
    chart_.points.row(vertices_) = ray.normalized();
    chart_.surface_points.push_back(at);
    uv_[static_cast<size_t>(vertices_)] = uv;
    chart_.wedge_vertices[static_cast<size_t>(vertices_)] = vertices_;
    return vertices_++;
  }

  void cut_face(Face f) {
    Cut cut;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<size_t>(k);
      cut.vertices[at] = chart_.triangles(f, k);
      cut.wedges[at] = chart_.wedges(f, k);
      cut.on_edges[at] = std::move(points_of_[static_cast<size_t>(3 * f + k)]);
    }
    in_place_ = f;
    emit(std::move(cut), chart_.source_faces[static_cast<size_t>(f)]);
  }

  void emit(Cut cut, Face source) {
    for (int k = 0; k < 3; ++k) {
      if (!cut.on_edges[static_cast<size_t>(k)].empty()) return emit_fan(std::move(cut), k, source);
    }
    if (in_place_ >= 0) {
      for (int k = 0; k < 3; ++k) {
        chart_.triangles(in_place_, k) = cut.vertices[static_cast<size_t>(k)];
        chart_.wedges(in_place_, k) = cut.wedges[static_cast<size_t>(k)];
      }
      in_place_ = -1;
      return;
    }
    new_triangles_.push_back(cut.vertices);
    new_wedges_.push_back(cut.wedges);
    chart_.source_faces.push_back(source);
  }

  /// Cuts along lines from the corner opposite to an edge with points.
  void emit_fan(Cut cut, int edge, Face source) {
    const auto from = static_cast<size_t>(edge), to = static_cast<size_t>(next_corner(edge)),
               apex = static_cast<size_t>(next_corner(next_corner(edge)));
    std::vector<Vertex> points = std::move(cut.on_edges[from]);
    points.push_back(cut.vertices[to]);
    Vertex last = cut.vertices[from];
    int last_wedge = cut.wedges[from];
    for (size_t i = 0; i < points.size(); ++i) {
      const bool at_end = i + 1 == points.size();
      const int wedge = at_end ? cut.wedges[to] : points[i];
      Cut child{{last, points[i], cut.vertices[apex]},
                {last_wedge, wedge, apex_wedge(cut, apex, i, last_wedge, wedge)},
                {}};
      if (i == 0) child.on_edges[2] = cut.on_edges[apex];
      if (at_end) child.on_edges[1] = cut.on_edges[to];
      emit(std::move(child), source);
      last = points[i];
      last_wedge = wedge;
    }
  }

  /// An ordinary corner's wedge serves all; a pole's the first, with its u in the middle.
  int apex_wedge(const Cut& cut, size_t apex, size_t child, int from, int to) {
    const Vertex v = cut.vertices[apex];
    const int w = cut.wedges[apex];
    if (v != chart_.north && v != chart_.south) return w;
    const double middle =
        0.5 * (uv_[static_cast<size_t>(from)][0] + uv_[static_cast<size_t>(to)][0]);
    const Eigen::RowVector2d uv(middle, uv_[static_cast<size_t>(w)][1]);
    if (child == 0) {
      uv_[static_cast<size_t>(w)] = uv;
      return w;
    }
    uv_.push_back(uv);
    chart_.wedge_kinds.push_back(WedgeKind::PoleFan);
    chart_.wedge_vertices.push_back(v);
    return static_cast<int>(uv_.size()) - 1;
  }

  void append() {
    const auto added = static_cast<Eigen::Index>(new_triangles_.size());
    chart_.triangles.conservativeResize(faces_ + added, 3);
    chart_.wedges.conservativeResize(faces_ + added, 3);
    for (Eigen::Index i = 0; i < added; ++i) {
      for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<size_t>(k);
        chart_.triangles(faces_ + i, k) = new_triangles_[static_cast<size_t>(i)][at];
        chart_.wedges(faces_ + i, k) = new_wedges_[static_cast<size_t>(i)][at];
      }
    }
    chart_.uv.resize(static_cast<Eigen::Index>(uv_.size()), 2);
    for (size_t w = 0; w < uv_.size(); ++w) chart_.uv.row(static_cast<Eigen::Index>(w)) = uv_[w];
  }

  SphericalChart& chart_;
  const Triangles& source_;
  int wedges_, threads_;
  Face faces_;
  Vertex vertices_;
  std::vector<std::vector<Vertex>> points_of_;  // of each half-edge, in its direction
  std::vector<Halfedge> twins_;                 // of the links
  size_t next_link_ = 0;
  Face in_place_ = -1;  // whose row the next triangle takes
  std::vector<Eigen::RowVector2d> uv_;
  std::vector<std::array<int, 3>> new_triangles_, new_wedges_;
};

}  // namespace

SphericalChart refine_poles(SphericalChart chart, const Triangles& source, int wedges,
                            int threads) {
  if (!chart.certificate.one_to_one())
    throw std::invalid_argument("refine_poles: the chart is not certified");
  if (wedges <= 1) return chart;
  PoleRefiner(chart, source, wedges, threads).refine();
  chart.certificate = certify_chart(chart, threads);
  return chart;
}

}  // namespace sphparam
