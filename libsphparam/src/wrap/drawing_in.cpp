// Along the normals of the wrap, not towards the nearest points, which part where two sides of what
// is enclosed meet at an angle: normals there lead into the corner. Corners of small triangles may
// pass one another on their ways: those go to the middle of their neighbours, and to the gap from
// there.

#include "wrap/drawing_in.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/vertex_normals.h"
#include "rays/interpolation.h"
#include "rays/ray_scene.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

// Beyond the distance, in voxels: at it still, and at a wall.
constexpr double strays = 0.5, wall_begins = 1.5;
constexpr double farthest = 1.5;      // distances that a vertex goes: into a right angle
constexpr double close = 1.05;        // gaps, at which a vertex is there
constexpr double on_soup = 1e-6;      // gaps, up to rounding
constexpr double least_cosine = 0.2;  // between a triangle's normal and the ways out at its corners
constexpr int steps = 12, rounds = 10;
constexpr std::int64_t grain = 1024;

/// What of its way in a vertex at this distance goes.
double share_of_way(double distance, const DrawIn& how) {
  const double beyond = (distance - how.distance) / how.voxel;
  return std::clamp((wall_begins - beyond) / (wall_begins - strays), 0.0, 1.0);
}

class Drawer {
 public:
  Drawer(TriangleMesh& wrap, const TriangleMesh& soup, const DrawIn& how)
      : wrap_(wrap),
        soup_(soup),
        scene_(soup),
        how_(how),
        normals_(angle_weighted_normals(wrap)),
        outward_(wrap.vertex_count(), 3),
        goes_all_its_way_(static_cast<size_t>(wrap.vertex_count())),
        turned_(goes_all_its_way_.size()) {}

  void run() {
    for_each_vertex([&](Vertex v) { go_in(v); });
    for (int round = 0; round < rounds && find_turned(); ++round) {
      report(how_.progress, "draw in", 1.0 * round / rounds);
      const Points middles = middles_of_neighbours();
      for_each_vertex([&](Vertex v) {
        if (turned_[static_cast<size_t>(v)]) settle(v, middles.row(v));
      });
    }
  }

 private:
  template <class Visit>
  void for_each_vertex(const Visit& visit) {
    parallel_for(wrap_.vertex_count(), grain, how_.threads,
                 [&](std::int64_t from, std::int64_t to) {
                   for (auto v = static_cast<Vertex>(from); v < to; ++v) visit(v);
                 });
  }

  Vector3 from_soup(const Vector3& p) const {
    return p - interpolate(soup_.positions, soup_.triangles, scene_.nearest(p).on);
  }
  Vector3 outward(Vertex v) const { return outward_.row(v); }

  /// Steps as long as the way to what is nearest, as nothing is nearer in any direction; until they
  /// lead past it.
  void go_in(Vertex v) {
    Vector3 place = wrap_.position(v), away = from_soup(place);
    const double share = share_of_way(away.norm(), how_);
    double left = share * farthest * how_.distance;
    for (int step = 0; step < steps && left > 0 && away.norm() > close * how_.gap; ++step) {
      const double length = std::min(away.norm() - how_.gap, left);
      const Vector3 next = place - length * Vector3(normals_.row(v));
      const Vector3 away_there = from_soup(next);
      if (away_there.norm() >= away.norm()) break;
      place = next, away = away_there, left -= length;
    }
    wrap_.positions.row(v) = place;
    outward_.row(v) = away.stableNormalized();
    goes_all_its_way_[static_cast<size_t>(v)] = share == 1;
  }

  bool is_turned(const Triangles::ConstRowXpr& f) const {
    const Vector3 a = wrap_.position(f[0]), b = wrap_.position(f[1]), c = wrap_.position(f[2]);
    const Vector3 normal = (b - a).cross(c - a);
    const Vector3 out = outward(f[0]) + outward(f[1]) + outward(f[2]);
    return normal.dot(out) < least_cosine * normal.norm() * out.norm();
  }

  /// Corners of triangles that are, but of walls and what leads to them. False: there are none.
  bool find_turned() {
    std::ranges::fill(turned_, 0);
    bool any = false;
    for (const auto& f : std::as_const(wrap_.triangles).rowwise()) {
      if (!is_turned(f)) continue;
      for (const Vertex v : f) {
        turned_[static_cast<size_t>(v)] = goes_all_its_way_[static_cast<size_t>(v)];
        any |= turned_[static_cast<size_t>(v)] != 0;
      }
    }
    return any;
  }

  /// Of those that are corners of turned triangles.
  Points middles_of_neighbours() const {
    Points sums = Points::Zero(wrap_.vertex_count(), 3);
    std::vector<int> counts(turned_.size(), 0);
    for (const auto& f : wrap_.triangles.rowwise()) {
      for (int k = 0; k < 3; ++k) {  // each neighbour is the next corner of one face
        if (!turned_[static_cast<size_t>(f[k])]) continue;
        sums.row(f[k]) += wrap_.positions.row(f[(k + 1) % 3]);
        ++counts[static_cast<size_t>(f[k])];
      }
    }
    for (Vertex v = 0; v < wrap_.vertex_count(); ++v)
      sums.row(v) /= std::max(counts[static_cast<size_t>(v)], 1);
    return sums;
  }

  /// At the gap from where the soup is nearest to a place, on the side that the vertex was on. It
  /// stays where the place is on the soup, of which no way leads out: about the rims of sheets.
  void settle(Vertex v, const Vector3& place) {
    const Vector3 away = from_soup(place);
    if (away.norm() < on_soup * how_.gap) return;
    const double side = away.dot(outward(v)) < 0 ? -1 : 1;
    outward_.row(v) = side * away.stableNormalized();
    wrap_.positions.row(v) = place - away + how_.gap * outward(v);
  }

  TriangleMesh& wrap_;
  const TriangleMesh& soup_;
  const RayScene scene_;
  const DrawIn& how_;
  const Points normals_;  // before
  Points outward_;        // unit, away from the soup
  std::vector<char> goes_all_its_way_, turned_;
};

}  // namespace

void draw_in(TriangleMesh& wrap, const TriangleMesh& soup, const DrawIn& how) {
  Drawer(wrap, soup, how).run();
}

}  // namespace sphparam
