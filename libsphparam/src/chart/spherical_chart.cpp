#include "sphparam/chart/spherical_chart.h"

#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "chart/flat_mesh.h"
#include "chart/one_to_one.h"
#include "chart/settle.h"
#include "chart/split_at_poles_and_meridian.h"
#include "chart/unfold.h"
#include "option_domain.h"
#include "sphparam/parallel.h"

// 1. ±z become vertices, the meridian edges (pole_and_meridian).  2. Every vertex gets its (u, v).
// 3. What folds is split (unfold).  4. Corners get wedges: a vertex's own number, or, where a face
// sees it a turn further west, or as a pole, a copy.  5. The certificate, of the data returned.

namespace sphparam {
namespace {

constexpr std::int64_t chunk_size = 8192;
constexpr std::int64_t some_splits = 4096;  // small meshes may need many a vertex
constexpr std::int64_t some_few = 16;       // that are no matter however small the mesh
constexpr int most_doublings = 4;           // of twice the vertices, before they need not move
constexpr double far = 0x1p-7;              // of a turn: moves that more splits are better than

/// What lies in no direction has no (u, v) that a certificate of these could miss.
void require_map(const TriangleMesh& mesh, const Topology& topology, const SphereMap& map) {
  if (map.points.rows() != topology.vertex_count() || mesh.face_count() != topology.face_count())
    throw std::invalid_argument("spherical_chart: the map is of another mesh");
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    if (map.points.row(v).allFinite() && !map.points.row(v).isZero(0)) continue;
    throw std::invalid_argument("spherical_chart: the ray of vertex " + std::to_string(v) +
                                " is zero or not finite");
  }
}

void lay_out(FlatMesh& flat, int threads) {
  flat.uv.resize(static_cast<size_t>(flat.mesh.vertex_count()));
  parallel_for(
      flat.mesh.vertex_count(), chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
        const auto begin = static_cast<size_t>(first), count = static_cast<size_t>(last) - begin;
        chart_points(flat.mesh.rays().subspan(begin, count),
                     std::span(flat.uv).subspan(begin, count));
      });
}

/// Wedges of a flat mesh, face by face.
class WedgeBuilder {
 public:
  explicit WedgeBuilder(const FlatMesh& flat)
      : flat_(flat), copy_(static_cast<size_t>(flat.mesh.vertex_count()), -1) {}

  /// Requires: `turned(f)` says whether corners of f that are not in the west have u + 1.
  template <class Turned>
  void build(SphericalChart& chart, Turned&& turned) {
    chart.wedges = chart.triangles;
    begin(chart);
    for (Face f = 0; f < flat_.mesh.face_count(); ++f) {
      if (turned(f)) turn(chart, f);
    }
    for (Face f = 0; f < flat_.mesh.face_count(); ++f) {
      const Halfedge pole = flat_.pole_halfedge(f);
      if (pole >= 0) fan(chart, pole);
    }
    finish(chart);
  }

 private:
  void begin(SphericalChart& chart) {
    uv_ = flat_.uv;
    chart.wedge_kinds.assign(uv_.size(), WedgeKind::Ordinary);
    chart.wedge_vertices.resize(uv_.size());
    for (size_t v = 0; v < uv_.size(); ++v) {
      chart.wedge_vertices[v] = static_cast<Vertex>(v);
      if (flat_.on_seam(static_cast<Vertex>(v))) chart.wedge_kinds[v] = WedgeKind::Seam;
    }
  }

  int add(SphericalChart& chart, Vertex v, ChartPoint uv, WedgeKind kind) {
    uv_.push_back(uv);
    chart.wedge_vertices.push_back(v);
    chart.wedge_kinds.push_back(kind);
    return static_cast<int>(uv_.size()) - 1;
  }

  void turn(SphericalChart& chart, Face f) {
    for (int k = 0; k < 3; ++k) {
      const Vertex v = flat_.mesh.vertex(f, k);
      if (flat_.is_pole(v) || in_west(flat_.mesh.point(v))) continue;
      int& copy = copy_[static_cast<size_t>(v)];
      const ChartPoint p = flat_.uv[static_cast<size_t>(v)];
      if (copy < 0) copy = add(chart, v, {p.u + 1, p.v}, WedgeKind::SeamCopy);
      chart.wedges(f, k) = copy;
    }
  }

  /// A pole's own wedge serves its first face, copies the others.
  void fan(SphericalChart& chart, Halfedge pole) {
    const Face f = Topology::face(pole);
    const int corner = Topology::corner(pole);
    const Vertex v = flat_.mesh.origin(pole);
    const auto u = [&](Halfedge h) {
      return uv_[static_cast<size_t>(chart.wedges(f, Topology::corner(h)))].u;
    };
    const double middle = 0.5 * (u(Topology::next(pole)) + u(Topology::previous(pole)));
    const ChartPoint apex{middle, v == flat_.north ? 0.0 : 1.0};
    if (std::exchange(chart.wedge_kinds[static_cast<size_t>(v)], WedgeKind::PoleFan) !=
        WedgeKind::PoleFan) {
      uv_[static_cast<size_t>(v)] = apex;
    } else {
      chart.wedges(f, corner) = add(chart, v, apex, WedgeKind::PoleFan);
    }
  }

  void finish(SphericalChart& chart) const {
    chart.uv.resize(static_cast<Eigen::Index>(uv_.size()), 2);
    for (size_t w = 0; w < uv_.size(); ++w)
      chart.uv.row(static_cast<Eigen::Index>(w)) << uv_[w].u, uv_[w].v;
  }

  const FlatMesh& flat_;
  std::vector<int> copy_;  // of each vertex, a turn further; −1: none yet
  std::vector<ChartPoint> uv_;
};

SphericalChart surface_of(const FlatMesh& flat) {
  SphericalChart chart;
  chart.triangles = flat.mesh.triangles();
  chart.points = flat.mesh.points();
  chart.surface_points = flat.mesh.surface_points();
  chart.source_faces = flat.mesh.source_faces();
  chart.north = flat.north;
  chart.south = flat.south;
  return chart;
}

bool touches_seam_from_west(const FlatMesh& flat, Face f) {
  for (int k = 0; k < 3; ++k) {
    if (flat.on_seam(flat.mesh.vertex(f, k))) return flat.in_west(f);
  }
  return false;
}

/// The stages of a chart, the splits of folds as often as it takes.
class ChartMaker {
 public:
  ChartMaker(const TriangleMesh& mesh, const Topology& topology, const SphereMap& map, int threads,
             const Progress& progress)
      : mesh_(mesh), topology_(topology), map_(map), threads_(threads), progress_(progress) {}

  /// Splits, in the order in which folds are found. Where that would give the chart more than twice
  /// the vertices of the mesh, few splits where they mend most, and moves for the rest; where these
  /// were far, all the splits.
  SphericalChart make(std::int64_t most) {
    most_ = most;
    begin();
    unfold(FoldOrder::AsFound, twice_as_many());
    if (!counts_.at_limit) return chart();
    begin();
    for (int i = 0; i < most_doublings; ++i) {
      unfold(FoldOrder::DeepestFirst, twice_as_many() << i);
      SphericalChart moved = chart();
      if (is_near(moved.certificate)) return moved;
    }
    begin();
    unfold(FoldOrder::AsFound, most);
    return chart();
  }

 private:
  void begin() {
    flat_ = std::make_unique<FlatMesh>(
        FlatMesh{RefinedMesh(topology_, map_, mesh_.triangles, threads_)});
    const PolarFrame frame = split_at_poles_and_meridian(flat_->mesh, threads_);
    flat_->north = frame.north;
    flat_->south = frame.south;
    lay_out(*flat_, threads_);
    laid_out_ = flat_->uv;
    counts_ = {.pole_splits = frame.pole_splits,
               .meridian_splits = frame.meridian_splits,
               .snapped_vertices = frame.snapped_vertices};
  }

  /// Splits of folds that make the vertices of the chart twice those of its mesh.
  std::int64_t twice_as_many() const {
    return std::max<std::int64_t>(
        some_few, topology_.vertex_count() - counts_.pole_splits - counts_.meridian_splits);
  }

  void unfold(FoldOrder order, std::int64_t allowed) {
    const std::int64_t left = std::min(allowed, most_) - counts_.fold_splits;
    const Unfolding done = sphparam::unfold(*flat_, left, order, threads_, [&](auto, double share) {
      return tell(static_cast<double>(counts_.fold_splits) + share * static_cast<double>(left));
    });
    if (counts_.fold_splits == 0) counts_.folded_faces = done.folded_faces;
    counts_.fold_splits += done.splits;
    counts_.nudged_vertices = done.nudged_vertices;
    counts_.at_limit = done.at_limit;
  }

  /// Has every vertex a place, on the map and in (u, v), near that of the mesh's?
  static bool is_near(const ChartCertificate& certificate) {
    return certificate.one_to_one() && certificate.inverted.empty() && certificate.max_shift < far;
  }

  /// The share never falls, though splits may begin again.
  bool tell(double splits) {
    told_ = std::max(told_, std::min(1.0, splits / static_cast<double>(most_)));
    return !progress_ || progress_("chart", told_);
  }

  SphericalChart chart() {
    SphericalChart chart = surface_of(*flat_);
    WedgeBuilder(*flat_).build(chart, [&](Face f) { return touches_seam_from_west(*flat_, f); });
    chart.counts = counts_;
    chart.certificate = certify_chart(chart, laid_out_, threads_);
    if (!chart.certificate.one_to_one()) {
      chart = settled(std::move(chart), threads_, [&] {
        if (!tell(static_cast<double>(counts_.fold_splits))) throw Cancelled();
      });
    }
    if (chart.certificate.one_to_one()) chart.counts.at_limit = false;
    return chart;
  }

  const TriangleMesh& mesh_;
  const Topology& topology_;
  const SphereMap& map_;
  const int threads_;
  const Progress& progress_;
  std::int64_t most_ = 0;
  double told_ = 0;
  std::unique_ptr<FlatMesh> flat_;
  std::vector<ChartPoint> laid_out_;  // of the vertices there are before folds are split
  ChartCounts counts_;
};

/// For a mesh that was not split: does the face reach over the meridian, or up to it from the west?
bool reaches_meridian_from_west(const FlatMesh& flat, Face f) {
  if (touches_seam_from_west(flat, f)) return true;
  for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
    if (crosses_meridian(flat.mesh.point(flat.mesh.origin(h)),
                         flat.mesh.point(flat.mesh.target(h))))
      return true;
  }
  return false;
}

/// The first vertex of the faces given that is exactly at the pole; −1: none.
Vertex find_pole(const RefinedMesh& mesh, const std::vector<Face>& faces, double z) {
  for (const Face f : faces) {
    for (int k = 0; k < 3; ++k) {
      const Vector3& x = mesh.point(mesh.vertex(f, k));
      if (at_pole(x) && x.z() * z > 0) return mesh.vertex(f, k);
    }
  }
  return -1;
}

}  // namespace

SphericalChart spherical_chart(const TriangleMesh& mesh, const Topology& topology,
                               const SphereMap& map, int threads, const Progress& progress,
                               int splits_a_vertex) {
  require_map(mesh, topology, map);
  require_at_least("splits_a_vertex", splits_a_vertex, 0);
  report(progress, "chart", 0);
  const std::int64_t most = std::int64_t{splits_a_vertex} * topology.vertex_count() + some_splits;
  SphericalChart chart = ChartMaker(mesh, topology, map, threads, progress).make(most);
  report(progress, "chart", 1);
  return chart;
}

SphericalChart wrapped_chart(const TriangleMesh& mesh, const Topology& topology,
                             const SphereMap& map, int threads) {
  require_map(mesh, topology, map);
  FlatMesh flat{RefinedMesh(topology, map, mesh.triangles, threads)};
  const std::vector<Face> around = faces_around_meridian(flat.mesh, threads);
  flat.north = find_pole(flat.mesh, around, 1);
  flat.south = find_pole(flat.mesh, around, -1);
  lay_out(flat, threads);

  SphericalChart chart = surface_of(flat);
  WedgeBuilder(flat).build(chart, [&](Face f) { return reaches_meridian_from_west(flat, f); });
  chart.certificate = certify_chart(chart, threads);
  for (const Face f : around) {
    const bool north = flat.north < 0 && holds(flat.mesh, f, Vector3::UnitZ());
    const bool south = flat.south < 0 && holds(flat.mesh, f, -Vector3::UnitZ());
    if (north || south) chart.certificate.around_pole.push_back(f);
  }
  return chart;
}

}  // namespace sphparam
