#include "embedding/constructions/grid_lift.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "embedding/constructions/planar_drawing.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/sweeps/kernel_placement.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/orientation.h"

// Barycentric coordinates r = (r₀, r₁, r₂) of the drawing, Σ rᵢ = W, become rays 3r + (h − W)1: a
// linear map that keeps the sign of determinants, so that those of all faces drawn are positive.
// About the axis (1, 1, 1) the rays fill a cone, the wider the smaller h > 0; h puts the weighted
// mean of their heights at half their length, which spreads them evenly over that half-sphere.
// The polygon left by the star of S has five corners or fewer, so some c sees all its edges from
// inside, and −c, where S goes, from outside. Faces of the star are positive then, and a ray near
// −c meets no other: degree 1.
//
// Rounding to unit length. Grid triangles have altitudes of at least 2/3W of the grid's width, an
// ulp moves a ray by 2⁻⁵³·|ray|/h of it: with W ≤ 2²⁴ there is room for a factor of 2⁵ in the
// slope. Meshes with more than 2²⁴ faces, or steeper rays, may need the integers themselves.

namespace sphparam {
namespace {

using Weight = std::int64_t;

constexpr int greatest_valence = 5;  // of the vertex left out
constexpr int most_attempts = 100;   // vertices left out in turn; none after the first was needed
constexpr Weight grid_size = Weight{1} << 24;
constexpr double grid_share = 0.5;  // of it, for areas; the rest is one for each face
constexpr int most_halvings = 12;   // of the cone's height

size_t at(int i) { return static_cast<size_t>(i); }

std::vector<Vertex> link_of(const Topology& topology, Vertex v) {
  std::vector<Vertex> link;
  topology.for_each_outgoing(v, [&](Halfedge h) { link.push_back(topology.target(h)); });
  return link;
}

/// Vertices of small valence, those with the largest stars first.
std::vector<Vertex> vertices_to_leave_out(const Topology& topology, const RestTriangles& source) {
  std::vector<int> valence(at(topology.vertex_count()), 0);
  std::vector<double> star(valence.size(), 0);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    ++valence[at(topology.origin(h))];
    star[at(topology.origin(h))] += source[at(Topology::face(h))].area;
  }
  std::vector<Vertex> result;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    if (valence[at(v)] <= greatest_valence) result.push_back(v);
  }
  const auto most = result.begin() + std::min<std::ptrdiff_t>(std::ssize(result), most_attempts);
  std::partial_sort(result.begin(), most, result.end(), [&](Vertex a, Vertex b) {
    return star[at(a)] > star[at(b)] || (star[at(a)] == star[at(b)] && a < b);
  });
  result.erase(most, result.end());
  return result;
}

/// The hole that S leaves, filled with a fan of triangles around `link[0]`.
struct FilledHole {
  std::vector<Vertex> link;  // counter-clockwise about S
  Topology topology;         // S has the name of the last vertex, which takes that of S
  Face outer;                // the middle one of the fan
  std::vector<Face> origin;  // of each face but the fan's, which come last
};

bool are_neighbours(const Topology& topology, Vertex a, Vertex b) {
  return topology.find_halfedge(a, b) >= 0;
}

/// Turns the link so that the fan around its first vertex adds no edge that is there already. Five
/// corners have at most two diagonals outside, which share an end: one of the others will do.
void turn_to_fan(const Topology& topology, std::vector<Vertex>& link) {
  const auto fan_is_new = [&] {
    for (size_t i = 2; i + 1 < link.size(); ++i) {
      if (are_neighbours(topology, link[i], link[0])) return false;
    }
    return true;
  };
  for (size_t turn = 0; turn < link.size() && !fan_is_new(); ++turn) {
    std::rotate(link.begin(), link.begin() + 1, link.end());
  }
}

FilledHole fill_hole(const Topology& topology, Vertex south, int threads) {
  FilledHole hole{link_of(topology, south), topology, 0, {}};
  turn_to_fan(topology, hole.link);
  const Vertex last = topology.vertex_count() - 1;
  const auto name = [&](Vertex v) { return v == last ? south : v; };
  const int fan = static_cast<int>(hole.link.size()) - 2;
  Triangles triangles(topology.face_count() - 2, 3);
  Eigen::Index row = 0;
  for (Face f = 0; f < topology.face_count(); ++f) {
    const std::array<Vertex, 3> v{topology.vertex(f, 0), topology.vertex(f, 1),
                                  topology.vertex(f, 2)};
    if (std::find(v.begin(), v.end(), south) != v.end()) continue;
    triangles.row(row++) << name(v[0]), name(v[1]), name(v[2]);
    hole.origin.push_back(f);
  }
  for (size_t i = 1; i + 1 < hole.link.size(); ++i) {
    triangles.row(row++) << name(hole.link[0]), name(hole.link[i]), name(hole.link[i + 1]);
  }
  hole.topology = Topology(triangles, last, threads);
  hole.outer = static_cast<Face>(row) - fan + (fan - 1) / 2;
  return hole;
}

/// By source area, each at least one.
std::vector<Weight> face_weights(const FilledHole& hole, const RestTriangles& source) {
  std::vector<Weight> weights(at(hole.topology.face_count()), 1);
  double area = 0;
  for (const Face f : hole.origin) area += source[at(f)].area;
  const double scale = grid_share * static_cast<double>(grid_size) / area;
  for (size_t i = 0; i < hole.origin.size(); ++i) {
    weights[i] += static_cast<Weight>(scale * source[at(hole.origin[i])].area);
  }
  return weights;
}

/// Height of the cone for which the mean of the rays' heights, by source area, is half their
/// length.
Weight cone_height(const FilledHole& hole, const PlanarDrawing& drawing,
                   const RestTriangles& source) {
  VectorX area = VectorX::Zero(hole.topology.vertex_count());
  for (size_t i = 0; i < hole.origin.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      area[hole.topology.vertex(static_cast<Face>(i), k)] += source[at(hole.origin[i])].area;
    }
  }
  const double total = static_cast<double>(drawing.total);
  const VectorX radius =
      (3 * drawing.coordinates.cast<double>().array() - total).matrix().rowwise().norm();
  Weight height = drawing.total;
  for (int i = 0; i < most_halvings && height > 1; ++i) {
    const double h = std::sqrt(3.0) * static_cast<double>(height);
    const double mean = (area.array() * h / (h * h + radius.array().square()).sqrt()).sum();
    if (mean < area.sum() / 2) break;
    height /= 2;
  }
  return height;
}

/// The rays of all vertices but S, whose row is zero.
Points rays_of(const PlanarDrawing& drawing, Weight height, Vertex south) {
  const Vertex last = static_cast<Vertex>(drawing.coordinates.rows());
  Points rays(last + 1, 3);
  for (Vertex v = 0; v < last; ++v) {
    rays.row(v) =
        (3 * drawing.coordinates.row(v).array() + (height - drawing.total)).matrix().cast<double>();
  }
  rays.row(last) = rays.row(south);  // if S is the last vertex, its row is written next
  rays.row(south).setZero();
  return rays;
}

/// A ray for S that sees all edges of its link; nothing if rounding hides the kernel.
std::optional<Vector3> place_south(const Points& rays, const std::vector<Vertex>& link) {
  std::vector<Vector3> ring;
  for (const Vertex v : link) ring.push_back(rays.row(v).normalized());
  const std::optional<Vector3> point = place_in_kernel(ring);
  if (!point) return std::nullopt;
  for (size_t i = 0; i < link.size(); ++i) {  // the ring was rounded
    if (orientation(*point, rays.row(link[i]), rays.row(link[(i + 1) % link.size()])) <= 0)
      return std::nullopt;
  }
  return point;
}

std::optional<Points> rays_without(const Topology& topology, const RestTriangles& source,
                                   Vertex south, int threads) {
  const FilledHole hole = fill_hole(topology, south, threads);
  const PlanarDrawing drawing = draw_inside(hole.topology, hole.outer, face_weights(hole, source));
  Points rays = rays_of(drawing, cone_height(hole, drawing, source), south);
  const std::optional<Vector3> point = place_south(rays, hole.link);
  if (!point) return std::nullopt;
  rays.row(south) = *point;
  return rays;
}

}  // namespace

GridLift grid_lift(const TriangleMesh& mesh, const Topology& topology,
                   const GridLiftOptions& options) {
  require_domain(options.energy);
  require_at_least("sweeps", options.sweeps, 0);
  report(options.progress, "grid lift", 0);
  const RestTriangles source = measure_source(mesh, options.threads);
  GridLift result;
  std::optional<Points> rays;
  for (const Vertex south : vertices_to_leave_out(topology, source)) {
    ++result.report.attempts;
    result.report.south = south;
    if ((rays = rays_without(topology, source, south, options.threads))) break;
  }
  if (!rays) return result;
  result.map = normalised(*rays);
  result.report.unit = certify(topology, result.map, options.threads).bijective();
  if (!result.report.unit) {
    result.map.points = *std::move(rays);
    result.bijective = certify(topology, result.map, options.threads).bijective();
    return result;
  }
  result.bijective = true;
  Relaxation relaxed = relax(topology, source, result.map,
                             {.energy = options.energy,
                              .sweeps = options.sweeps,
                              .threads = options.threads,
                              .progress = options.progress,
                              .measure_energy = false});
  result.map = std::move(relaxed.map);
  result.report.relaxation = relaxed.report;
  return result;
}

}  // namespace sphparam
