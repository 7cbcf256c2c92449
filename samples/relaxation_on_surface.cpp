#include "relaxation_on_surface.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "sphparam/mesh/topology.h"
#include "sphparam/parallel.h"

// A ring's centre is the mean of its triangles' centres weighted by area, so that vertices move to
// where triangles are large. Flips act on half-edge arrays of their own (half-edge 3f + k runs from
// corner k of f to the next), one edge after the other in index order; moves are Jacobi steps, so
// order plays no part.

namespace sphparam::samples {
namespace {

class FlippableMesh {
 public:
  explicit FlippableMesh(const TriangleMesh& mesh) : mesh_(mesh) {
    const Topology topology(mesh);
    for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
      origin_.push_back(topology.origin(h));
      twin_.push_back(topology.twin(h));
    }
    valence_.resize(static_cast<size_t>(mesh.vertex_count()), 0);
    for (const Vertex v : origin_) ++valence_[static_cast<size_t>(v)];
  }

  /// One pass.
  void flip_towards_delaunay() {
    for (Halfedge h = 0; h < static_cast<Halfedge>(origin_.size()); ++h) {
      if (h < twin(h) && improves(h) && legal(h)) flip(h);
    }
  }

  void move_along(const Field& field, const SurfaceRelaxationOptions& options) {
    Points moved = mesh_.positions;
    std::vector<Halfedge> outgoing(valence_.size());
    for (Halfedge h = 0; h < static_cast<Halfedge>(origin_.size()); ++h) {
      outgoing[static_cast<size_t>(origin(h))] = h;
    }
    parallel_for(moved.rows(), 256, 0, [&](std::int64_t first, std::int64_t last) {
      for (Eigen::Index v = first; v < last; ++v) {
        moved.row(v) = relaxed(outgoing[static_cast<size_t>(v)], field, options);
      }
    });
    mesh_.positions = std::move(moved);
  }

  TriangleMesh mesh() const {
    TriangleMesh mesh = mesh_;
    for (Eigen::Index h = 0; h < 3 * mesh.face_count(); ++h) {
      mesh.triangles(h / 3, h % 3) = origin_[static_cast<size_t>(h)];
    }
    return mesh;
  }

 private:
  Vertex origin(Halfedge h) const { return origin_[static_cast<size_t>(h)]; }
  Halfedge twin(Halfedge h) const { return twin_[static_cast<size_t>(h)]; }
  Vector3 position(Halfedge h) const { return mesh_.position(origin(h)); }
  Halfedge next(Halfedge h) const { return Topology::next(h); }
  Halfedge previous(Halfedge h) const { return Topology::previous(h); }

  /// The two angles that face the edge sum to more than π, and the new triangles do not turn over.
  bool improves(Halfedge h) const {
    const Vector3 a = position(h), b = position(next(h));
    const Vector3 c = position(previous(h)), d = position(previous(twin(h)));
    const auto angle = [](const Vector3& u, const Vector3& v) {
      return std::atan2(u.cross(v).norm(), u.dot(v));
    };
    constexpr double margin = 1e-3;  // or rounding could flip an edge to and fro
    if (angle(a - c, b - c) + angle(b - d, a - d) < std::numbers::pi + margin) return false;
    const Vector3 normal = (b - a).cross(c - a) + (d - a).cross(b - a);
    return (d - a).cross(c - a).dot(normal) > 0 && (c - b).cross(d - b).dot(normal) > 0;
  }

  /// No vertex is left with two neighbours, and no edge is doubled.
  bool legal(Halfedge h) const {
    const Vertex a = origin(h), b = origin(next(h));
    if (valence_[static_cast<size_t>(a)] <= 3 || valence_[static_cast<size_t>(b)] <= 3)
      return false;
    const Vertex d = origin(previous(twin(h)));
    const Halfedge start = previous(h);
    Halfedge spoke = start;
    do {
      if (origin(next(spoke)) == d) return false;
      spoke = twin(previous(spoke));
    } while (spoke != start);
    return true;
  }

  /// Edge ab of triangles abc and bad becomes edge dc of triangles dca and cdb. The three slots of
  /// a face keep their order: h, bc, ca become dc, ca, ad; t, ad, db become cd, db, bc.
  void flip(Halfedge h) {
    const Halfedge t = twin(h);
    const Halfedge bc = next(h), ca = previous(h), ad = next(t), db = previous(t);
    const Vertex a = origin(h), b = origin(t), c = origin(ca), d = origin(db);
    const Halfedge over_bc = twin(bc), over_ca = twin(ca), over_ad = twin(ad), over_db = twin(db);
    --valence_[static_cast<size_t>(a)], --valence_[static_cast<size_t>(b)];
    ++valence_[static_cast<size_t>(c)], ++valence_[static_cast<size_t>(d)];
    const auto start = [&](Halfedge slot, Vertex v) { origin_[static_cast<size_t>(slot)] = v; };
    start(h, d), start(bc, c), start(ca, a);
    start(t, c), start(ad, d), start(db, b);
    join(bc, over_ca), join(ca, over_ad);
    join(ad, over_db), join(db, over_bc);
  }

  void join(Halfedge h, Halfedge t) {
    twin_[static_cast<size_t>(h)] = t;
    twin_[static_cast<size_t>(t)] = h;
  }

  Vector3 relaxed(Halfedge outgoing, const Field& field,
                  const SurfaceRelaxationOptions& options) const {
    const Vector3 here = position(outgoing);
    Vector3 centre = Vector3::Zero();
    double area = 0;
    Halfedge h = outgoing;
    do {
      const Vector3 a = position(next(h)), b = position(previous(h));
      const double weight = (a - here).cross(b - here).norm();
      centre += weight * (here + a + b) / 3;
      area += weight;
      h = twin(previous(h));
    } while (h != outgoing);
    if (!(area > 0)) return here;
    const Vector3 normal = gradient(field, here, options.difference).normalized();
    const Vector3 step = options.step * (centre / area - here);
    Vector3 point = here + step - step.dot(normal) * normal;
    const Vector3 slope = gradient(field, point, options.difference);
    for (int k = 0; k < 2; ++k) {  // Newton steps back to the surface
      point -= field(point) / std::max(slope.squaredNorm(), 1e-6) * slope;
    }
    return point;
  }

  TriangleMesh mesh_;
  std::vector<Vertex> origin_;
  std::vector<Halfedge> twin_;
  std::vector<int> valence_;
};

}  // namespace

TriangleMesh relaxed_on_surface(const TriangleMesh& mesh, const Field& field,
                                const SurfaceRelaxationOptions& options) {
  FlippableMesh flippable(mesh);
  for (int round = 0; round < options.rounds; ++round) {
    flippable.flip_towards_delaunay();
    flippable.move_along(field, options);
  }
  flippable.flip_towards_delaunay();
  return flippable.mesh();
}

}  // namespace sphparam::samples
