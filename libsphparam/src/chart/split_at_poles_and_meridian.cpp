#include "chart/split_at_poles_and_meridian.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "chart/longitude.h"
#include "elementary.h"
#include "mesh/faces_where.h"
#include "sphere/difference_of_products.h"
#include "sphparam/sphere/orientation.h"

// All happens among the faces that touch the circle y = 0, about √#F of them. First vertices are
// snapped, so that no sliver thinner than the rounding of (u, v) arises; then ±z become vertices:
// a vertex that is there, else a point of an edge, else of a face; then every edge that crosses the
// half-circle is split, until none does. What is inside, outside, across is decided by exact signs.

namespace sphparam {
namespace {

// Radians. Doubles near 1 are 2⁻⁵³ apart: closer than a few hundred of these to a line, (u, v) does
// not hold the shape of a triangle.
constexpr double snapping_angle = 0x1p-44;

constexpr int most_steps = 8;  // of a unit in the last place, to tell crossings apart

class PolarSplitting {
 public:
  PolarSplitting(RefinedMesh& mesh, int threads)
      : mesh_(mesh), faces_(faces_around_meridian(mesh, threads)), first_new_(mesh.face_count()) {}

  PolarFrame run() {
    frame_.north = snap_to_pole(1);
    frame_.south = snap_to_pole(-1);
    snap_to_meridian();
    if (frame_.north < 0) frame_.north = insert_pole(1);
    if (frame_.south < 0) frame_.south = insert_pole(-1);
    split_meridian();
    return frame_;
  }

 private:
  // --- snapping -------------------------------------------------------------------------------

  /// The vertex at the pole (0, 0, z), or the nearest within rounding that can be moved there.
  Vertex snap_to_pole(double z) {
    const Vector3 pole(0, 0, z);
    std::vector<std::pair<double, Halfedge>> near;
    for (const Face f : faces_) {
      for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
        const Vector3& x = mesh_.point(mesh_.origin(h));
        if (x.z() * z <= 0) continue;
        if (at_pole(x)) return mesh_.origin(h);
        const double distance = elementary::hypot(x.x(), x.y());
        if (distance <= snapping_angle * std::abs(x.z())) near.emplace_back(distance, h);
      }
    }
    std::sort(near.begin(), near.end());
    Vertex last = -1;
    for (const auto& [distance, h] : near) {
      const Vertex v = mesh_.origin(h);
      if (std::exchange(last, v) != v && try_snap(h, pole)) return v;
    }
    return -1;
  }

  void snap_to_meridian() {
    std::vector<std::pair<Vertex, Halfedge>> near;
    for (const Face f : faces_) {
      for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
        const Vector3& x = mesh_.point(mesh_.origin(h));
        const bool close = x.x() > 0 && std::abs(x.y()) <= snapping_angle * x.x();
        if (close && x.y() != 0) near.emplace_back(mesh_.origin(h), h);
      }
    }
    std::sort(near.begin(), near.end());
    Vertex last = -1;
    for (const auto& [v, h] : near) {
      if (std::exchange(last, v) == v) continue;
      const Vector3& x = mesh_.point(v);
      try_snap(h, {x.x(), 0, x.z()});
    }
  }

  /// Moves the origin of h, if all faces around it stay positive.
  bool try_snap(Halfedge h, const Vector3& to) {
    Halfedge spoke = h;
    do {
      if (orientation(to, mesh_.point(mesh_.target(spoke)), mesh_.point(mesh_.apex(spoke))) <= 0)
        return false;
      spoke = mesh_.rotate_ccw(spoke);
    } while (spoke != h);
    mesh_.snap(mesh_.origin(h), to);
    ++frame_.snapped_vertices;
    return true;
  }

  // --- poles ----------------------------------------------------------------------------------

  Vertex insert_pole(double z) {
    const Vector3 pole(0, 0, z);
    const Face f = find_face(pole);
    ++frame_.pole_splits;
    for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
      const Vector3 &a = mesh_.point(mesh_.origin(h)), &b = mesh_.point(mesh_.target(h));
      const Vector3 normal = a.cross(b);
      if (std::abs(normal.z()) > snapping_angle * normal.norm()) continue;
      // The foot of ±z on the plane of the edge is αa + βb.
      const double alpha = pole.dot(b.cross(normal)), beta = pole.dot(normal.cross(a));
      if (alpha > 0 && beta > 0 && mesh_.fits(h, pole))
        return mesh_.split_edge(h, beta / (alpha + beta), pole);
    }
    // Cramer's rule, for the ray: the weights of the corners are det(b, c, ±z), …
    Vector3 weights;
    for (int k = 0; k < 3; ++k) {
      const Halfedge opposite = Topology::next(3 * f + k);
      const Vector3& b = mesh_.point(mesh_.origin(opposite));
      const Vector3& c = mesh_.point(mesh_.target(opposite));
      weights[k] = std::max(0.0, z * difference_of_products(b.x(), c.y(), b.y(), c.x()));
    }
    return mesh_.split_face(f, weights / weights.sum(), pole);
  }

  Face find_face(const Vector3& pole) const {
    for (const Face f : faces_) {
      if (holds(mesh_, f, pole)) return f;
    }
    for (Face f = first_new_; f < mesh_.face_count(); ++f) {
      if (holds(mesh_, f, pole)) return f;
    }
    throw std::invalid_argument("spherical_chart: no face holds the pole: not a one-to-one map");
  }

  // --- meridian -------------------------------------------------------------------------------

  void split_meridian() {
    std::vector<Face> waiting = faces_;
    for (Face f = first_new_; f < mesh_.face_count(); ++f) waiting.push_back(f);
    for (size_t i = 0; i < waiting.size(); ++i) {
      for (Halfedge h = 3 * waiting[i]; h < 3 * waiting[i] + 3; ++h) {
        const Vector3 &a = mesh_.point(mesh_.origin(h)), &b = mesh_.point(mesh_.target(h));
        if (!crosses_meridian(a, b)) continue;
        const Crossing crossing = meridian_crossing(a, b, Vector3::UnitX());
        waiting.insert(waiting.end(), {waiting[i], Topology::face(mesh_.twin(h)),
                                       mesh_.face_count(), mesh_.face_count() + 1});
        mesh_.split_edge(h, crossing.t, fitting_ray(h, crossing.point));
        ++frame_.meridian_splits;
        break;
      }
    }
  }

  /// The ray of the meridian nearest to a crossing, in units in the last place of its coordinates,
  /// that leaves the faces of the edge positive: where others cross within rounding of this one.
  /// The crossing itself if none does.
  Vector3 fitting_ray(Halfedge h, const Vector3& crossing) const {
    if (mesh_.fits(h, crossing)) return crossing;
    for (int steps = 1; steps <= most_steps; ++steps) {
      for (int dx = -steps; dx <= steps; ++dx) {
        for (int dz = -steps; dz <= steps; ++dz) {
          if (std::max(std::abs(dx), std::abs(dz)) < steps) continue;
          const Vector3 ray(crossing.x() * (1 + dx * 0x1p-52), 0,
                            crossing.z() * (1 + dz * 0x1p-52));
          if (mesh_.fits(h, ray)) return ray;
        }
      }
    }
    return crossing;
  }

  RefinedMesh& mesh_;
  const std::vector<Face> faces_;
  const Face first_new_;
  PolarFrame frame_;
};

}  // namespace

std::vector<Face> faces_around_meridian(const RefinedMesh& mesh, int threads) {
  return faces_where(mesh.face_count(), threads, [&](Face f) {
    const double y0 = mesh.point(mesh.vertex(f, 0)).y(), y1 = mesh.point(mesh.vertex(f, 1)).y(),
                 y2 = mesh.point(mesh.vertex(f, 2)).y();
    const double lowest = std::min({y0, y1, y2}), highest = std::max({y0, y1, y2});
    return lowest <= snapping_angle && highest >= -snapping_angle;
  });
}

bool holds(const RefinedMesh& mesh, Face f, const Vector3& ray) {
  const Vector3 &a = mesh.point(mesh.vertex(f, 0)), &b = mesh.point(mesh.vertex(f, 1)),
                &c = mesh.point(mesh.vertex(f, 2));
  return orientation(a, b, ray) >= 0 && orientation(b, c, ray) >= 0 && orientation(c, a, ray) >= 0;
}

PolarFrame split_at_poles_and_meridian(RefinedMesh& mesh, int threads) {
  return PolarSplitting(mesh, threads).run();
}

}  // namespace sphparam
