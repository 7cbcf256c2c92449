#include "chart/unfold.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <iterator>
#include <numbers>
#include <queue>
#include <utility>

#include "chart/nudge.h"
#include "elementary.h"
#include "mesh/faces_where.h"

// A triangle that is positive on the sphere folds in (u, v) because the chords of its edges are not
// the images of its edges. Its edges run monotonely in u; so, if the edge that spans its u is split
// at the meridian of the third corner, the two pieces share a side of constant u, and are positive
// because that side runs the right way. The other face of the edge is split with it. If that would
// fold by it, as where long flat triangles lie on each other like tiles, the fold would only move
// from strip to strip, once for every corner; there the edge is split where it meets a line
// u = n / 2ᵏ, k least. Strips share these lines, so their pieces lie between the same meridians,
// and soon corners' meridians can end within them. What neither cut mends is folded by rounding;
// but for faces beside ones so thin that no point of their edge lies between its apexes: where such
// a fold is deep, its edge is cut all the same, and the points there are no map.

namespace sphparam {
namespace {

// Of what an edge spans in u, at either end: a line there would leave the long piece as it is.
constexpr double margin = 0x1p-3;
constexpr double least_depth = 0x1p-20;  // of a turn: a fold that textures show
constexpr size_t faces_a_report = 4096;

/// The number n / 2ᵏ between two, k least.
double simplest_between(double low, double high) {
  double step = 0.5;
  while (std::floor(high / step) <= std::floor(low / step)) step /= 2;
  return std::floor(high / step) * step;
}

class Unfolder {
 public:
  Unfolder(FlatMesh& flat, std::int64_t most_splits, FoldOrder order)
      : flat_(flat), most_splits_(most_splits), order_(order) {}

  Unfolding run(int threads, const Progress& progress) {
    const std::vector<Face> folded = folded_faces(threads);
    result_.folded_faces = static_cast<int>(folded.size());
    cut(folded, progress);
    const std::vector<Face> deep = deep_ones(result_.left);
    if (!deep.empty() && !result_.at_limit) {
      points_must_fit_ = false;
      cut(deep, progress);
    }
    if (result_.at_limit) return std::move(result_);  // the rest folds: nothing is worth mending
    result_.nudged_vertices = nudge(flat_, result_.left);
    return std::move(result_);
  }

 private:
  /// A point of an edge to split it at.
  struct Cut {
    Halfedge halfedge = -1;
    Crossing crossing = {0, Vector3::Zero()};
    ChartPoint uv = {0, 0};
  };

  /// A face that may be folded, and how urgent it is.
  struct Fold {
    double urgency;
    Face face;
    auto operator<=>(const Fold&) const = default;
  };

  void add(Face f) { waiting_.push({order_ == FoldOrder::DeepestFirst ? depth(f) : -found_++, f}); }

  void cut(const std::vector<Face>& folded, const Progress& progress) {
    for (const Face f : folded) add(f);
    for (size_t i = 0; !waiting_.empty() && !result_.at_limit; ++i) {
      if (i % faces_a_report == 0) report(progress, "chart", share_of_limit());
      const Face f = waiting_.top().face;
      waiting_.pop();
      if (flat_.positive(f)) continue;
      const Cut cut = choose_cut(f);
      if (cut.halfedge < 0) {
        result_.left.push_back(f);
      } else if (result_.splits < most_splits_) {
        split(cut);
      } else {
        result_.at_limit = true;
      }
    }
    keep_folded(result_.left);
  }

  /// Twice the area of a folded face by the longer side of its box, in turns; 0: at ±z. Negative:
  /// not folded.
  double depth(Face f) const {
    if (flat_.pole_halfedge(f) >= 0) return 0;
    const ChartPoint a = flat_.corner(3 * f), b = flat_.corner(3 * f + 1),
                     c = flat_.corner(3 * f + 2);
    const double along_u = std::max({a.u, b.u, c.u}) - std::min({a.u, b.u, c.u}),
                 along_v = std::max({a.v, b.v, c.v}) - std::min({a.v, b.v, c.v});
    const double longer = std::max(along_u, along_v);
    return longer > 0 ? -planar_area(a, b, c) / longer : 0;
  }

  /// Of folded faces, those that are seen: their edges pass triangles that are as thin as rounding.
  std::vector<Face> deep_ones(const std::vector<Face>& faces) const {
    std::vector<Face> deep;
    std::ranges::copy_if(faces, std::back_inserter(deep),
                         [&](Face f) { return depth(f) > least_depth; });
    return deep;
  }

  std::vector<Face> folded_faces(int threads) const {
    return faces_where(flat_.mesh.face_count(), threads,
                       [&](Face f) { return !flat_.positive(f); });
  }

  /// Where to split a folded face; no half-edge if that cannot help.
  Cut choose_cut(Face f) const {
    const Halfedge h = spanning_halfedge(f);
    if (h < 0) return {};
    const Cut corner = cut_at_corner(h);
    const bool mends = is_above(h, corner.uv) && fits(corner);
    if (mends && stays_positive(flat_.mesh.twin(h), corner.uv)) return corner;
    const Cut line = cut_at_line(h);
    if (fits(line)) return line;
    return mends ? corner : Cut{};
  }

  /// The half-edge opposite to the corner between the others in u; −1: no u is between the others.
  Halfedge spanning_halfedge(Face f) const {
    if (flat_.pole_halfedge(f) >= 0) return -1;
    for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
      const auto [low, high] = std::minmax({from(h).u, to(h).u});
      if (low < apex(h).u && apex(h).u < high) return h;
    }
    return -1;
  }

  Cut cut_at_corner(Halfedge h) const {
    return cut(h, flat_.mesh.point(flat_.mesh.apex(h)), apex(h).u);
  }

  Cut cut_at_line(Halfedge h) const {
    const auto [low, high] = std::minmax({from(h).u, to(h).u});
    const double u = simplest_between(low + margin * (high - low), high - margin * (high - low));
    const double theta = 2 * std::numbers::pi * u;
    return cut(h, {elementary::cos(theta), elementary::sin(theta), 0}, u);
  }

  Cut cut(Halfedge h, const Vector3& through, double u) const {
    const Crossing crossing = meridian_crossing(flat_.mesh.point(flat_.mesh.origin(h)),
                                                flat_.mesh.point(flat_.mesh.target(h)), through);
    return {h, crossing, {u, chart_point(crossing.point).v}};
  }

  bool fits(const Cut& cut) const {
    return !points_must_fit_ || flat_.mesh.fits(cut.halfedge, cut.crossing.point);
  }

  /// Is a point with the apex's u on its right side, so that both pieces are positive?
  bool is_above(Halfedge h, const ChartPoint& p) const {
    return from(h).u < to(h).u ? p.v > apex(h).v : p.v < apex(h).v;
  }

  /// Are both pieces of the face of h positive if its edge is split there?
  bool stays_positive(Halfedge h, const ChartPoint& p) const {
    if (flat_.pole_halfedge(Topology::face(h)) >= 0) return true;
    return planar_orientation(from(h), p, apex(h)) > 0 && planar_orientation(p, to(h), apex(h)) > 0;
  }

  ChartPoint from(Halfedge h) const { return flat_.corner(h); }
  ChartPoint to(Halfedge h) const { return flat_.corner(Topology::next(h)); }
  ChartPoint apex(Halfedge h) const { return flat_.corner(Topology::previous(h)); }

  void split(const Cut& cut) {
    const Halfedge h = cut.halfedge;
    const Face first_new = flat_.mesh.face_count();
    const Face other = Topology::face(flat_.mesh.twin(h));
    flat_.mesh.split_edge(h, cut.crossing.t, cut.crossing.point);
    flat_.uv.push_back(cut.uv);
    for (const Face f : {Topology::face(h), other, first_new, first_new + 1}) add(f);
    ++result_.splits;
  }

  /// Of the faces given up, those that no later split has mended, once each.
  void keep_folded(std::vector<Face>& faces) const {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    std::erase_if(faces, [&](Face f) { return flat_.positive(f); });
  }

  double share_of_limit() const {
    return static_cast<double>(result_.splits) / static_cast<double>(most_splits_);
  }

  FlatMesh& flat_;
  const std::int64_t most_splits_;
  const FoldOrder order_;
  double found_ = 0;  // so many faces so far
  std::priority_queue<Fold> waiting_;
  bool points_must_fit_ = true;
  Unfolding result_;
};

}  // namespace

Unfolding unfold(FlatMesh& flat, std::int64_t most_splits, FoldOrder order, int threads,
                 const Progress& progress) {
  return Unfolder(flat, most_splits, order).run(threads, progress);
}

}  // namespace sphparam
