#include "chart/unfold.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chart/nudge.h"
#include "sphparam/parallel.h"

// A triangle that is positive on the sphere folds in (u, v) because the chords of its edges are not
// the images of its edges. Small triangles fold only if they are flat, so it is split at its
// longest edge (which keeps angles: Rivara 1984): where the opposite corner stands above the edge,
// at its foot, which makes two right angles of a flat one; else where the edge is furthest from its
// chord. Near ±z an edge bends over many scales: that point is looked for by halving the distance
// to one end. The other face of the edge is split with it, so the mesh stays conforming. Where no
// chord takes anything away from the triangle, it is folded by rounding alone, and splitting stops.

namespace sphparam {
namespace {

constexpr std::int64_t chunk_size = 8192;
constexpr int most_halvings = 40;  // 2⁻⁴⁰ of an edge
// What a chord takes from a triangle must be more than what rounding (u, v) to 2⁻⁵³ of them does.
constexpr double least_taken = 0x1p-50;
// Lower triangles are rounded out of shape: more pieces of them would fold as well.
constexpr double least_height = 0x1p-46;
constexpr std::int64_t most_splits_a_fold = 64, most_splits_at_all = 4096;  // guards, not targets

class Unfolder {
 public:
  explicit Unfolder(FlatMesh& flat) : flat_(flat) {}

  Unfolding run(int threads) {
    waiting_ = folded_faces(threads);
    result_.folded_faces = static_cast<int>(waiting_.size());
    const std::int64_t most = most_splits_a_fold * result_.folded_faces + most_splits_at_all;
    for (size_t i = 0; i < waiting_.size(); ++i) {
      const Face f = waiting_[i];
      if (flat_.positive(f)) continue;
      const Bend bend = choose_split(f);
      if (bend.halfedge < 0 || result_.splits >= most) {
        result_.left.push_back(f);
      } else {
        split(bend);
      }
    }
    keep_folded(result_.left);
    result_.nudged_vertices = nudge(flat_, result_.left);
    return std::move(result_);
  }

 private:
  struct Bend {
    Halfedge halfedge = -1;
    double t = 0;
    double area = 0;  // twice what the chord cuts off, as seen from the half-edge's face
    Vector3 point = Vector3::Zero();
    ChartPoint uv = {0, 0};
  };

  std::vector<Face> folded_faces(int threads) const {
    const Face faces = flat_.mesh.face_count();
    std::vector<std::vector<Face>> found(
        static_cast<size_t>((faces + chunk_size - 1) / chunk_size));
    parallel_for(faces, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
      for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
        if (!flat_.positive(f)) found[static_cast<size_t>(first / chunk_size)].push_back(f);
      }
    });
    std::vector<Face> all;
    for (const auto& chunk : found) all.insert(all.end(), chunk.begin(), chunk.end());
    return all;
  }

  /// Where to split a folded face; no half-edge if that cannot help.
  Bend choose_split(Face f) const {
    if (flat_.pole_halfedge(f) >= 0) return {};
    Bend longest;
    double length = 0;
    bool bent = false;
    for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
      const Bend bend = furthest_point(h);
      bent |= bend.area > least_taken * rounding(h);
      const double edge = (end(h) - start(h)).squaredNorm();
      if (edge <= length) continue;
      length = edge;
      longest = bend;
    }
    if (!bent) return {};
    const Halfedge h = longest.halfedge;
    const double foot = foot_of_apex(h);
    const Vector3 below = start(h) + foot * (end(h) - start(h));
    const double height = (flat_.mesh.point(flat_.mesh.apex(h)) - below).norm();
    const bool stands_above = std::min(foot, 1 - foot) * std::sqrt(length) > height;
    if (!stands_above && height < least_height) return {};
    const Bend split = stands_above ? at(h, foot) : longest;
    return flat_.mesh.fits(h, split.point) ? split : Bend{};
  }

  /// An area that the chord of the edge sweeps when its ends move by as much as themselves.
  double rounding(Halfedge h) const {
    const ChartPoint a = flat_.corner(h), b = flat_.corner(Topology::next(h));
    return std::abs(a.v - b.v) * std::max(a.u, b.u) + std::abs(a.u - b.u) * std::max(a.v, b.v);
  }

  const Vector3& start(Halfedge h) const { return flat_.mesh.point(flat_.mesh.origin(h)); }
  const Vector3& end(Halfedge h) const { return flat_.mesh.point(flat_.mesh.target(h)); }

  /// The point of the edge below its opposite corner: (1 − t)·a + t·b.
  double foot_of_apex(Halfedge h) const {
    const Vector3 &a = start(h), &b = end(h), &c = flat_.mesh.point(flat_.mesh.apex(h));
    const Vector3 normal = a.cross(b);
    const double alpha = c.dot(b.cross(normal)), beta = c.dot(normal.cross(a));
    return alpha > 0 && beta > 0 ? beta / (alpha + beta) : 0;
  }

  Bend at(Halfedge h, double t) const {
    Bend bend{h, t, 0, flat_.mesh.along(h, t), {}};
    bend.uv = chart_point(bend.point);
    const ChartPoint a = flat_.corner(h), b = flat_.corner(Topology::next(h));
    // On the seam edge u is 0 or 1 as its ends have it.
    if (on_meridian(bend.point)) bend.uv.u = a.u;
    bend.area = planar_area(b, a, bend.uv);
    return bend;
  }

  /// The point of an edge where its chord cuts off most, to within a factor of two in the distance
  /// from the nearer end.
  Bend furthest_point(Halfedge h) const {
    Bend best = at(h, 0.5);
    for (const bool towards_end : {false, true}) {
      double distance = 0.5;
      for (int i = 0; i < most_halvings; ++i) {
        distance /= 2;
        const Bend bend = at(h, towards_end ? 1 - distance : distance);
        if (std::abs(bend.area) <= std::abs(best.area)) break;
        best = bend;
      }
    }
    return best;
  }

  void split(const Bend& bend) {
    const Halfedge h = bend.halfedge;
    const Face first_new = flat_.mesh.face_count();
    waiting_.insert(waiting_.end(), {Topology::face(h), Topology::face(flat_.mesh.twin(h)),
                                     first_new, first_new + 1});
    flat_.mesh.split_edge(h, bend.t, bend.point);
    flat_.uv.push_back(on_meridian(bend.point) ? ChartPoint{0, bend.uv.v} : bend.uv);
    ++result_.splits;
  }

  /// Of the faces given up, those that no later split has mended, once each.
  void keep_folded(std::vector<Face>& faces) const {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    std::erase_if(faces, [&](Face f) { return flat_.positive(f); });
  }

  FlatMesh& flat_;
  std::vector<Face> waiting_;
  Unfolding result_;
};

}  // namespace

Unfolding unfold(FlatMesh& flat, int threads) { return Unfolder(flat).run(threads); }

}  // namespace sphparam
