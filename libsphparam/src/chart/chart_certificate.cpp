#include "sphparam/chart/chart_certificate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <compare>
#include <span>
#include <utility>

#include "chart/longitude.h"
#include "chart/one_to_one.h"
#include "sphere/planar_orientation.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// Theorem. Let R = [0, 1]², and let each face be a piece: the triangle of its wedges' points, or,
// where one wedge is on a rim (v = 0 or 1), the trapezoid between the other two and the rim. If
//   (a) every point is in R, and only pole corners are on rims,
//   (b) every piece is strictly positive (a trapezoid: u runs the right way along its link edge),
//   (c) the two faces of an edge see each end alike, or both as copies at u = 0 and u = 1 with the
//       same v, or both at the same rim, and
//   (d) one trapezoid starts at u = 0 of the rim v = 0,
// then every point of R that is on no edge is in exactly one piece.
//
// Proof. Sum the boundaries of all pieces as chains of the plane. By (c) the sides of an edge
// cancel (the vertical sides of neighbouring trapezoids too), but for edges along u = 0 and u = 1
// and the trapezoids' sides on the rims. So the sum is a cycle in ∂R, that is k·∂R, and a generic
// point of R has winding number k. By (b) that is the number of pieces it is in. All sides on v = 0
// run the same way and k of them start at u = 0: by (d), k = 1.  ∎
//
// Nothing else is needed of the surface. That (u, v) are those of its points is another matter:
// `max_shift`; and another yet, that the points are a map: `inverted`.

namespace sphparam {
namespace {

constexpr std::int64_t chunk_size = 8192;
constexpr double largest_coordinate = 0x1p64;  // what the predicate promises to be exact for

class ChartCertifier {
 public:
  enum class Question { Everything, OneToOne };

  ChartCertifier(const SphericalChart& chart, const TextureCoordinates& uv, Question question,
                 std::span<const ChartPoint> places = {})
      : chart_(chart),
        uv_(uv),
        places_(places),
        wedge_count_(static_cast<int>(uv.rows())),
        everything_(question == Question::Everything) {}

  ChartCertificate run(int threads) {
    if (!well_formed()) return std::move(result_);
    const auto topology =
        Topology::try_build(chart_.triangles, static_cast<int>(chart_.points.rows()), threads);
    if (topology) examine_closed(&*topology, threads);
    return std::move(result_);
  }

  /// Of a chart that was certified with other (u, v): its tables and how its triangles meet are
  /// known.
  ChartCertificate run_again(int threads) {
    if (static_cast<Eigen::Index>(chart_.wedge_vertices.size()) == uv_.rows())
      examine_closed(nullptr, threads);
    return std::move(result_);
  }

 private:
  struct Findings {
    std::vector<Face> malformed, folded, inverted;
    int north_turns = 0, south_turns = 0;
  };

  /// Of tables that fit together and triangles that are closed.
  void examine_closed(const Topology* topology, int threads) {
    result_.closed = true;
    find_outside(threads);
    if (!usable_) return;
    examine_faces(threads);
    examine_edges(topology);
  }

  ChartPoint point(int wedge) const { return {uv_(wedge, 0), uv_(wedge, 1)}; }
  ChartPoint corner(Halfedge h) const { return point(wedge(h)); }
  bool exists(Vertex v) const { return v >= 0 && v < chart_.points.rows(); }
  Vertex origin(Halfedge h) const {
    return chart_.triangles(Topology::face(h), Topology::corner(h));
  }
  int wedge(Halfedge h) const { return chart_.wedges(Topology::face(h), Topology::corner(h)); }
  static bool on_rim(const ChartPoint& p) { return p.v == 0 || p.v == 1; }

  /// Do the tables fit together? Lists the faces whose wedges are not those of their vertices.
  bool well_formed() {
    if (chart_.wedges.rows() != chart_.triangles.rows() ||
        static_cast<Eigen::Index>(chart_.wedge_vertices.size()) != uv_.rows() ||
        chart_.triangles.rows() == 0)
      return false;
    for (Face f = 0; f < static_cast<Face>(chart_.triangles.rows()); ++f) {
      for (int k = 0; k < 3; ++k) {
        const Vertex v = chart_.triangles(f, k);
        const int w = chart_.wedges(f, k);
        const bool fits = exists(v) && w >= 0 && w < wedge_count_ &&
                          chart_.wedge_vertices[static_cast<size_t>(w)] == v;
        if (fits) continue;
        result_.malformed.push_back(f);
        break;
      }
    }
    return result_.malformed.empty();
  }

  void find_outside(int threads) {
    const auto chunks = static_cast<size_t>((wedge_count_ + chunk_size - 1) / chunk_size);
    std::vector<std::vector<int>> outside(chunks);
    std::vector<double> shift(chunks, 0);
    parallel_for(wedge_count_, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
      const auto chunk = static_cast<size_t>(first / chunk_size);
      for (auto w = static_cast<int>(first); w < static_cast<int>(last); ++w) {
        const ChartPoint p = point(w);
        const bool inside = p.u >= 0 && p.u <= 1 && p.v >= 0 && p.v <= 1;
        if (!inside) outside[chunk].push_back(w);
        if (!(std::abs(p.u) <= largest_coordinate && std::abs(p.v) <= largest_coordinate))
          usable_ = false;
      }
      if (everything_) shift[chunk] = farthest_from_map(first, last);
    });
    for (size_t i = 0; i < chunks; ++i) {
      result_.outside.insert(result_.outside.end(), outside[i].begin(), outside[i].end());
      result_.max_shift = std::max(result_.max_shift, shift[i]);
    }
  }

  /// Of wedges first … last − 1.
  double farthest_from_map(std::int64_t first, std::int64_t last) const {
    double farthest = 0;
    std::vector<int> asked;  // those whose rays have no known place
    for (auto w = static_cast<int>(first); w < static_cast<int>(last); ++w) {
      const auto v = static_cast<size_t>(chart_.wedge_vertices[static_cast<size_t>(w)]);
      if (v < places_.size())
        farthest = farther(farthest, w, places_[v]);
      else if (exists(static_cast<Vertex>(v)))
        asked.push_back(w);
      else
        farthest = std::max(farthest, 1.0);
    }
    return asked.empty() ? farthest : farthest_of(asked, farthest);
  }

  /// Of some wedges and what was found so far.
  double farthest_of(const std::vector<int>& wedges, double farthest) const {
    std::vector<Vector3> rays;
    for (const int w : wedges) rays.emplace_back(ray(w));
    std::vector<ChartPoint> there(rays.size());
    chart_points(rays, there);
    for (size_t i = 0; i < wedges.size(); ++i) farthest = farther(farthest, wedges[i], there[i]);
    return farthest;
  }

  Vector3 ray(int w) const {
    return chart_.points.row(chart_.wedge_vertices[static_cast<size_t>(w)]);
  }

  /// The greater of a distance and that of a wedge from where its ray is.
  double farther(double than, int w, const ChartPoint& there) const {
    const ChartPoint p = point(w);
    if (p.u == there.u && p.v == there.v) return than;
    return std::max(than, distance_beyond(than, p, ray(w), there));
  }

  /// From a wedge to where its ray is, as far as that says something on the sphere; where it is no
  /// more than `least`, that will do.
  static double distance_beyond(double least, const ChartPoint& p, const Vector3& ray,
                                const ChartPoint& there) {
    const double along_v = std::abs(p.v - there.v);
    if (on_rim(p)) return along_v;
    const double turns = std::abs(p.u - there.u), along_u = std::min(turns, std::abs(turns - 1));
    if (along_v <= least && along_u <= least) return least;
    const double parallel = ray.head<2>().stableNorm();
    return std::max(along_v, along_u * parallel / ray.stableNorm());
  }

  void examine_faces(int threads) {
    const auto faces = static_cast<Face>(chart_.triangles.rows());
    std::vector<Findings> chunks(static_cast<size_t>((faces + chunk_size - 1) / chunk_size));
    parallel_for(faces, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
      Findings& findings = chunks[static_cast<size_t>(first / chunk_size)];
      for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
        examine_piece(f, findings);
        if (everything_ && !positive_on_sphere(f)) findings.inverted.push_back(f);
      }
    });
    for (const Findings& chunk : chunks) {
      const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
      };
      append(result_.malformed, chunk.malformed);
      append(result_.folded, chunk.folded);
      append(result_.inverted, chunk.inverted);
      result_.north_turns += chunk.north_turns;
      result_.south_turns += chunk.south_turns;
    }
  }

  /// (c). Where both ends of an edge have one wedge each, its sides see the same; the others are
  /// those of seam, poles and, in files, of hard edges.
  void examine_edges(const Topology* topology) {
    const std::vector<Halfedge> sides = sides_at_copies();
    if (!topology) return examine_pairs(paired(sides));
    for (const Halfedge h : sides) {
      if (h < topology->twin(h) && !fits(h, topology->twin(h))) result_.torn.push_back(h);
    }
  }

  using Pairs = std::vector<std::pair<Halfedge, Halfedge>>;

  void examine_pairs(const Pairs& edges) {
    for (const auto& [h, twin] : edges) {
      if (!fits(h, twin)) result_.torn.push_back(h);
    }
    std::ranges::sort(result_.torn);
  }

  /// Half-edges with an end that has several wedges.
  std::vector<Halfedge> sides_at_copies() const {
    std::vector<char> wedges(static_cast<size_t>(chart_.points.rows()), 0);  // of each, up to 2
    for (const Vertex v : chart_.wedge_vertices) {
      if (!exists(v)) continue;  // of a wedge that no triangle has
      char& count = wedges[static_cast<size_t>(v)];
      count = static_cast<char>(std::min(count + 1, 2));
    }
    const auto is_copied = [&](Vertex v) { return wedges[static_cast<size_t>(v)] == 2; };
    std::vector<Halfedge> sides;
    for (Face f = 0; f < static_cast<Face>(chart_.triangles.rows()); ++f) {
      const bool copied[] = {is_copied(chart_.triangles(f, 0)), is_copied(chart_.triangles(f, 1)),
                             is_copied(chart_.triangles(f, 2))};
      if (!(copied[0] | copied[1] | copied[2])) continue;
      for (int k = 0; k < 3; ++k) {
        if (copied[k] || copied[(k + 1) % 3]) sides.push_back(3 * f + k);
      }
    }
    return sides;
  }

  /// The two sides of each edge. Requires: both are there, of a closed surface.
  Pairs paired(const std::vector<Halfedge>& sides) const {
    struct Side {
      Vertex low, high;
      Halfedge h;
      auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sorted;
    sorted.reserve(sides.size());
    for (const Halfedge h : sides) {
      const Vertex a = origin(h), b = origin(Topology::next(h));
      sorted.push_back({std::min(a, b), std::max(a, b), h});
    }
    std::ranges::sort(sorted);
    Pairs pairs;
    for (size_t i = 0; i + 1 < sorted.size(); i += 2)
      pairs.emplace_back(sorted[i].h, sorted[i + 1].h);
    return pairs;
  }

  /// (a) and (b), and counts for (d).
  void examine_piece(Face f, Findings& findings) const {
    const ChartPoint p[] = {corner(3 * f), corner(3 * f + 1), corner(3 * f + 2)};
    const int rims = on_rim(p[0]) + on_rim(p[1]) + on_rim(p[2]);
    if (rims > 1) {
      findings.malformed.push_back(f);
    } else if (rims == 0) {
      if (planar_orientation(p[0], p[1], p[2]) <= 0) findings.folded.push_back(f);
    } else {
      const int k = on_rim(p[0]) ? 0 : on_rim(p[1]) ? 1 : 2;
      const bool north = p[k].v == 0;
      const double from = p[(k + 1) % 3].u, to = p[(k + 2) % 3].u;
      const double west = north ? from : to, east = north ? to : from;
      if (!(west < east)) findings.folded.push_back(f);
      if (p[k].u < west || p[k].u > east) findings.malformed.push_back(f);
      if (west == 0) ++(north ? findings.north_turns : findings.south_turns);
    }
  }

  bool positive_on_sphere(Face f) const {
    const Vector3 rays[] = {chart_.points.row(chart_.triangles(f, 0)),
                            chart_.points.row(chart_.triangles(f, 1)),
                            chart_.points.row(chart_.triangles(f, 2))};
    for (const Vector3& ray : rays) {
      if (!(ray.array().abs() <= largest_coordinate).all()) return false;
    }
    const FilteredSum det = filtered_determinant(rays[0], rays[1], rays[2]);  // as orientation's
    if (det.size > 1e-270 && det.size < 1e300 && det.sign(0x1p-50) > 0) return true;
    return orientation(rays[0], rays[1], rays[2]) > 0;
  }

  /// (c), for h from a to b and its twin from b to a.
  bool fits(Halfedge h, Halfedge twin) const {
    const int a = wedge(h), b = wedge(Topology::next(h));
    const int other_a = wedge(Topology::next(twin)), other_b = wedge(twin);
    if (on_same_rim(a, other_a)) return at_same_place(b, other_b) || seam_copies(b, other_b);
    if (on_same_rim(b, other_b)) return at_same_place(a, other_a) || seam_copies(a, other_a);
    if (at_same_place(a, other_a) && at_same_place(b, other_b)) return true;
    return seam_copies(a, other_a) && seam_copies(b, other_b) && point(a).u == point(b).u;
  }

  /// Wedges of a vertex may differ in what else they have, a normal for one.
  bool at_same_place(int w, int other) const {
    return w == other || (point(w).u == point(other).u && point(w).v == point(other).v);
  }

  bool on_same_rim(int w, int other) const {
    return on_rim(point(w)) && point(w).v == point(other).v;
  }

  bool seam_copies(int w, int other) const {
    const ChartPoint p = point(w), q = point(other);
    return p.v == q.v && ((p.u == 0 && q.u == 1) || (p.u == 1 && q.u == 0));
  }

  const SphericalChart& chart_;
  const TextureCoordinates& uv_;
  const std::span<const ChartPoint> places_;  // of the rays of the first vertices
  const int wedge_count_;
  const bool everything_;
  std::atomic<bool> usable_{true};  // by the exact predicate
  ChartCertificate result_;
};

}  // namespace

ChartCertificate certify_chart(const SphericalChart& chart, int threads) {
  return ChartCertifier(chart, chart.uv, ChartCertifier::Question::Everything).run(threads);
}

ChartCertificate certify_chart(const SphericalChart& chart, std::span<const ChartPoint> places,
                               int threads) {
  return ChartCertifier(chart, chart.uv, ChartCertifier::Question::Everything, places).run(threads);
}

bool is_one_to_one(const SphericalChart& chart, const TextureCoordinates& uv, int threads) {
  ChartCertifier certifier(chart, uv, ChartCertifier::Question::OneToOne);
  return (chart.certificate.one_to_one() ? certifier.run_again(threads) : certifier.run(threads))
      .one_to_one();
}

}  // namespace sphparam
