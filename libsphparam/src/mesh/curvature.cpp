#include "sphparam/mesh/curvature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "elementary.h"
#include "mesh/flat_face.h"
#include "mesh/surface_average.h"
#include "mesh/triangle_geometry.h"
#include "mesh/unit_size.h"
#include "option_domain.h"
#include "sphparam/errors.h"
#include "sphparam/parallel.h"

// One pass for the normals and areas of faces, one over the rings of vertices:
//   M_v = ¼ Σ_{e∋v} β_e |e|     β the angle by which the surface bends at the edge, > 0 convex
//   G_v = 2π − Σ angles at v
// Their densities are averaged over a scale (mesh/surface_average). A triangle without area has no
// normal of its own: it is a piece of the face across its longest side, so that what bends there
// bends at its other sides. Its angles are those of the limit, and sum to π.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;
constexpr double area_floor = 1e-9;  // of the mean area of a vertex
constexpr double least_area = std::numeric_limits<double>::min();

struct Faces {
  Points normals;  // unit; zero where there is none
  VectorX area;    // #F
  /// #F: the side of a face without area across which it gets its normal; −1: it has one.
  std::vector<Halfedge> borrowed;
};

bool is_filler(const FillerMarks& fillers, Face face) {
  return !fillers.empty() && fillers[static_cast<size_t>(face)] != 0;
}

/// The longest side of a triangle of this area, if that is none beside it; else −1.
Halfedge side_without_area(const TriangleMesh& mesh, Face f, double area) {
  Halfedge longest = -1;
  double square = -1;
  for (int k = 0; k < 3; ++k) {
    const Vertex a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
    const double of_side = (mesh.position(b) - mesh.position(a)).squaredNorm();
    if (of_side > square) longest = 3 * f + k, square = of_side;
  }
  return area <= flat_area * square ? longest : -1;
}

Faces measure_faces(const TriangleMesh& mesh, const FillerMarks& fillers, int threads) {
  const auto count = static_cast<size_t>(mesh.face_count());
  Faces faces{Points(mesh.face_count(), 3), VectorX(mesh.face_count()),
              std::vector<Halfedge>(count)};
  parallel_for(mesh.face_count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (Face f = static_cast<Face>(first); f < last; ++f) {
      const Vector3 a = mesh.position(mesh.triangles(f, 0));
      const Vector3 b = mesh.position(mesh.triangles(f, 1)) - a;
      const Vector3 c = mesh.position(mesh.triangles(f, 2)) - a;
      const Vector3 normal = b.cross(c);
      const double area = normal.stableNorm() / 2;
      faces.area[f] = is_filler(fillers, f) ? 0 : area;
      faces.normals.row(f) = normal.stableNormalized();
      faces.borrowed[static_cast<size_t>(f)] = side_without_area(mesh, f, area);
    }
  });
  return faces;
}

/// Gives faces without area the normal of what they are a piece of.
class NormalBorrowing {
 public:
  NormalBorrowing(const Topology& topology, Faces& faces)
      : topology_(topology), faces_(faces), asked_(faces.borrowed.size(), 0) {}

  void run() {
    for (Face f = 0; f < topology_.face_count(); ++f) {
      if (!has_normal(f) && !asked_[static_cast<size_t>(f)]) borrow_for(f);
    }
  }

 private:
  bool has_normal(Face f) const { return faces_.borrowed[static_cast<size_t>(f)] < 0; }

  /// From face to face across the longest sides, to one that has a normal. Where that leads back,
  /// two lie back to back: beside them is one, or all of them stay without.
  void borrow_for(Face f) {
    std::vector<Face> way;
    for (; !has_normal(f) && !asked_[static_cast<size_t>(f)]; f = lender_of(f)) {
      asked_[static_cast<size_t>(f)] = 1;
      way.push_back(f);
    }
    for (size_t i = way.size(); !has_normal(f) && i-- > 0;) f = beside(way[i]);
    const Vector3 normal = has_normal(f) ? Vector3(faces_.normals.row(f)) : Vector3::Zero();
    for (const Face borrower : way) {
      faces_.normals.row(borrower) = normal;
      if (has_normal(f)) faces_.borrowed[static_cast<size_t>(borrower)] = -1;
    }
  }

  Face lender_of(Face f) const {
    return Topology::face(topology_.twin(faces_.borrowed[static_cast<size_t>(f)]));
  }
  /// A face beside this one that has a normal, or this one.
  Face beside(Face f) const {
    for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
      if (has_normal(Topology::face(topology_.twin(h)))) return Topology::face(topology_.twin(h));
    }
    return f;
  }

  const Topology& topology_;
  Faces& faces_;
  std::vector<char> asked_;
};

Vector3 edge_vector(const TriangleMesh& mesh, const Topology& topology, Halfedge h) {
  return mesh.position(topology.target(h)) - mesh.position(topology.origin(h));
}

/// β |e|: positive where the two faces of the edge bend away from the outside.
double bend(const TriangleMesh& mesh, const Topology& topology, const Faces& faces, Halfedge h) {
  const Vector3 edge = edge_vector(mesh, topology, h);
  const double length = edge.stableNorm();
  if (!(length > 0)) return 0;
  const Vector3 n = faces.normals.row(Topology::face(h));
  const Vector3 m = faces.normals.row(Topology::face(topology.twin(h)));
  return length * elementary::atan2(n.cross(m).dot(edge) / length, n.dot(m));
}

/// Between the half-edge and the one before it in its face. Right at both ends of a side without
/// length; a third of two right ones where all three sides are.
double angle_at_origin(const TriangleMesh& mesh, const Topology& topology, Halfedge h) {
  const Vector3 a = edge_vector(mesh, topology, h);
  const Vector3 b = -edge_vector(mesh, topology, Topology::previous(h));
  const int without_length = a.isZero(0) + b.isZero(0);
  if (without_length == 2) return std::numbers::pi / 3;
  if (without_length == 1) return std::numbers::pi / 2;
  return angle_between(a.stableNormalized(), b.stableNormalized());
}

struct Measures {
  VectorX mean, gauss, area;
};

Measures measure_vertices(const TriangleMesh& mesh, const Topology& topology, const Faces& faces,
                          int threads) {
  const Eigen::Index count = mesh.vertex_count();
  Measures measures{VectorX(count), VectorX(count), VectorX(count)};
  parallel_for(count, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (Vertex v = static_cast<Vertex>(first); v < last; ++v) {
      double bends = 0, angles = 0, area = 0;
      topology.for_each_outgoing(v, [&](Halfedge h) {
        bends += bend(mesh, topology, faces, h);
        angles += angle_at_origin(mesh, topology, h);
        area += faces.area[Topology::face(h)];
      });
      measures.mean[v] = bends / 4;
      measures.gauss[v] = 2 * std::numbers::pi - angles;
      measures.area[v] = area / 3;
    }
  });
  return measures;
}

/// Rims have measures of a boundary, which are no curvature of the surface: they get the density of
/// their neighbours inside, or of those that have got it; what only fillers use gets nothing.
class RimMeasures {
 public:
  /// area: of the surface, positive.
  RimMeasures(const Topology& topology, const FillerMarks& fillers, const VectorX& area,
              Measures& measures)
      : topology_(topology),
        area_(area),
        measures_(measures),
        known_(static_cast<size_t>(area.size()), Known::Yes) {
    for (Vertex v = 0; v < static_cast<Vertex>(area.size()); ++v) forget_beside_fillers(v, fillers);
  }

  /// Ring by ring of the rims, from the inside.
  void spread() {
    while (!waiting_.empty()) {
      std::vector<Vertex> reached;
      for (const Vertex v : waiting_)
        if (take_from_neighbours(v)) reached.push_back(v);
      for (const Vertex v : reached) known(v) = Known::Yes;
      waiting_ = unknown_beside(reached);
    }
  }

 private:
  enum class Known : char { No, Yes, Never };  // Never: only fillers use it

  Known& known(Vertex v) { return known_[static_cast<size_t>(v)]; }

  void forget_beside_fillers(Vertex v, const FillerMarks& fillers) {
    bool surface = false, filler = false;
    topology_.for_each_outgoing(
        v, [&](Halfedge h) { (is_filler(fillers, Topology::face(h)) ? filler : surface) = true; });
    if (!filler) return;
    measures_.mean[v] = measures_.gauss[v] = 0;
    known(v) = surface ? Known::No : Known::Never;
    if (surface) waiting_.push_back(v);
  }

  /// False: none of them has any.
  bool take_from_neighbours(Vertex v) {
    double sum = 0, mean = 0, gauss = 0;
    topology_.for_each_outgoing(v, [&](Halfedge h) {
      const Vertex other = topology_.target(h);
      if (known(other) != Known::Yes) return;
      mean += measures_.mean[other];
      gauss += measures_.gauss[other];
      sum += area_[other];
    });
    if (!(sum > 0)) return false;
    measures_.mean[v] = area_[v] * (mean / sum);
    measures_.gauss[v] = area_[v] * (gauss / sum);
    return true;
  }

  std::vector<Vertex> unknown_beside(const std::vector<Vertex>& vertices) {
    std::vector<Vertex> beside;
    for (const Vertex v : vertices) {
      topology_.for_each_outgoing(v, [&](Halfedge h) {
        if (known(topology_.target(h)) == Known::No) beside.push_back(topology_.target(h));
      });
    }
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    return beside;
  }

  const Topology& topology_;
  const VectorX& area_;
  Measures& measures_;
  std::vector<Known> known_;
  std::vector<Vertex> waiting_;
};

double total_area(const TriangleMesh& mesh, int threads) {
  return parallel_sum(mesh.face_count(), threads, [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (Eigen::Index f = first; f < last; ++f) {
      const Vector3 a = mesh.position(mesh.triangles(f, 0));
      sum += (mesh.position(mesh.triangles(f, 1)) - a)
                 .cross(mesh.position(mesh.triangles(f, 2)) - a)
                 .stableNorm() /
             2;
    }
    return sum;
  });
}

/// Of the mesh 2^exponent times as large; what is too large for a double is the largest.
void enlarge(Curvature& curvature, int exponent) {
  const auto times = [](int power) {
    return [power](double x) {
      constexpr double largest = std::numeric_limits<double>::max();
      return std::clamp(std::ldexp(x, power), -largest, largest);
    };
  };
  curvature.mean = curvature.mean.unaryExpr(times(-exponent)).eval();
  curvature.gauss = curvature.gauss.unaryExpr(times(-2 * exponent)).eval();
  curvature.area = curvature.area.unaryExpr(times(2 * exponent)).eval();
}

/// Requires: squares of the positions neither overflow nor vanish.
Curvature measure_harmless(const TriangleMesh& mesh, const Topology& topology, double scale,
                           const FillerMarks& fillers, int threads) {
  // 1. The measures at the vertices, and their densities as they are.
  Faces faces = measure_faces(mesh, fillers, threads);
  NormalBorrowing(topology, faces).run();
  Measures measures = measure_vertices(mesh, topology, faces, threads);
  const double mean_area = measures.area.mean();
  VectorX& area = measures.area;
  area = area.cwiseMax(mean_area > 0 ? std::max(area_floor * mean_area, least_area) : 1);
  if (!fillers.empty()) RimMeasures(topology, fillers, area, measures).spread();
  Curvature curvature{measures.mean.cwiseQuotient(area), measures.gauss.cwiseQuotient(area), area,
                      scale};
  if (!(scale > 0) || !(mean_area > 0)) return curvature;

  // 2. Averages over the scale.
  const SurfaceAverage average(mesh, topology, faces.area, area, scale);
  curvature.mean = average(measures.mean);
  curvature.gauss = average(measures.gauss);
  return curvature;
}

double radius_of_harmless(const TriangleMesh& mesh, int threads) {
  return std::sqrt(total_area(mesh, threads) / (4 * std::numbers::pi));
}

}  // namespace

double equal_area_radius(const TriangleMesh& mesh, int threads) {
  const auto unit = at_unit_size(mesh);
  if (!unit) return radius_of_harmless(mesh, threads);
  // Triangles that lie over one another may have more area than a sphere in the range of doubles.
  return std::min(std::ldexp(radius_of_harmless(unit->mesh, threads), unit->exponent),
                  std::numeric_limits<double>::max());
}

Curvature measure_curvature(const TriangleMesh& mesh, const Topology& topology, double scale,
                            int threads, const FillerMarks& fillers) {
  require_at_least("scale", scale, 0);
  const auto unit = at_unit_size(mesh);
  if (!unit) return measure_harmless(mesh, topology, scale, fillers, threads);
  Curvature curvature =
      measure_harmless(unit->mesh, topology, std::ldexp(scale, -unit->exponent), fillers, threads);
  enlarge(curvature, unit->exponent);
  curvature.scale = scale;
  return curvature;
}

}  // namespace sphparam
