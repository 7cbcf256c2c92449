#include "mesh/repair/weld_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mesh/box.h"
#include "mesh/face_sides.h"
#include "mesh/index_range.h"
#include "sphparam/mesh/mesh_repair.h"

// A vertex has a near one where its cell, or one beside that, has another vertex: of cells with an
// edge of the distance over 2√3 none of these is farther away. Nothing but numbers of vertices in
// cells is looked at, so that thousands in one place cost no more than thousands apart. From the
// longest distance downward, as most meshes have none.

namespace sphparam {
namespace {

constexpr double much_longer = 5;    // edges than the distance
constexpr double short_edges = 0.1;  // of the edges may be shorter
constexpr double nearly_all = 0.95;  // of the vertices
// Down to what float32 does not tell apart.
constexpr std::array shares_tried = {1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5,
                                     5e-6, 2e-6, 1e-6, 5e-7, 2e-7, 1e-7, 5e-8, 2e-8, 1e-8};

struct Boundary {
  std::vector<Vector3> places;  // in diagonals of the box, from its middle
  double edge = 0;              // of its edges few are shorter
};

/// Of three vertices that are there.
bool is_triangle(const TriangleMesh& mesh, Face f) {
  const Vertex a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
  return is_inside(mesh.triangles, f, mesh.vertex_count()) && a != b && b != c && c != a;
}

Boundary boundary_of(const TriangleMesh& mesh) {
  const auto [lower, upper] = surface_box(mesh);
  const Vector3 middle = lower / 2 + upper / 2;
  const double extent = (upper / 2 - lower / 2).maxCoeff();
  if (!(extent > 0)) return {};
  const double diagonal = 2 * ((upper - middle) / extent).norm();  // in extents
  const auto place = [&](Vertex v) -> Vector3 {
    return (mesh.position(v) - middle) / extent / diagonal;
  };
  std::vector<double> lengths;
  std::vector<Vertex> vertices;
  const std::vector<FaceSide> sides =
      sorted_sides(mesh.triangles, [&](Face f) { return is_triangle(mesh, f); });
  for_each_edge(sides, [&](size_t i, size_t j) {
    if (j - i != 1) return;
    const double length = (place(sides[i].low) - place(sides[i].high)).norm();
    if (length > shares_tried.back()) lengths.push_back(length);  // else one place, as at a pole
    vertices.insert(vertices.end(), {sides[i].low, sides[i].high});
  });
  if (lengths.empty()) return {};
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Boundary boundary;
  for (const Vertex v : vertices) boundary.places.push_back(place(v));
  const auto at = lengths.begin() +
                  static_cast<std::ptrdiff_t>(short_edges * static_cast<double>(lengths.size()));
  std::nth_element(lengths.begin(), at, lengths.end());
  boundary.edge = *at;
  return boundary;
}

using Cell = std::array<std::int64_t, 3>;

/// How many have a near one.
size_t near_ones(const std::vector<Vector3>& places, double share) {
  const double edge = share / (2 * std::sqrt(3.0));
  std::vector<Cell> cells;  // of all places, sorted
  for (const Vector3& p : places) {
    Cell cell;
    for (int k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(p[k] / edge));
    cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end());
  const auto is_taken = [&](const Cell& cell) {
    return std::binary_search(cells.begin(), cells.end(), cell);
  };
  const auto has_neighbour = [&](const Cell& cell) {
    for (int i = 0; i < 27; ++i) {
      const Cell beside = {cell[0] + i / 9 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i % 3 - 1};
      if (beside != cell && is_taken(beside)) return true;
    }
    return false;
  };
  size_t near = 0;
  for (size_t i = 0; i < cells.size();) {
    size_t j = i + 1;
    while (j < cells.size() && cells[j] == cells[i]) ++j;
    if (j - i > 1 || has_neighbour(cells[i])) near += j - i;
    i = j;
  }
  return near;
}

bool nearly_all_have_a_near_one(const std::vector<Vector3>& places, double share) {
  return static_cast<double>(near_ones(places, share)) >=
         nearly_all * static_cast<double>(places.size());
}

/// Few steps of float32 at the largest coordinate: 0 where that is no share tried.
double rounding_share(const TriangleMesh& mesh) {
  constexpr double few_steps = 0x1p-21;
  const auto [lower, upper] = surface_box(mesh);
  const double largest = std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
  const double rounding = few_steps / (upper / largest - lower / largest).norm();
  const auto found = std::find_if(shares_tried.rbegin(), shares_tried.rend(),
                                  [&](double share) { return share >= rounding; });
  return found == shares_tried.rend() ? 0 : *found;
}

/// Whether a vertex of the boundary is so near another one, or an edge.
bool joins_anything(const TriangleMesh& mesh, double share) {
  RepairOptions options = RepairOptions::none();
  options.cracks = true;
  const auto joined = [&] {
    long count = 0;
    for (const RepairAction& action : repair_mesh(mesh, options).actions) count += action.count;
    return count;
  };
  const long without = joined();
  options.weld_share = share;
  return joined() > without;
}

/// 0 where that is none of these, or edges of the boundary are not much longer.
double short_rounding(const TriangleMesh& mesh, const Boundary& boundary) {
  if (boundary.places.empty()) return 0;
  const double rounding = rounding_share(mesh);
  return rounding > 0 && rounding * much_longer <= boundary.edge ? rounding : 0;
}

}  // namespace

double rounding_weld(const TriangleMesh& mesh) {
  if (mesh.vertex_count() == 0 || !mesh.positions.allFinite()) return 0;
  const Boundary boundary = boundary_of(mesh);
  const double rounding = short_rounding(mesh, boundary);
  return rounding > 0 && near_ones(boundary.places, rounding) > 0 ? rounding : 0;
}

std::vector<double> weld_shares(const TriangleMesh& mesh) {
  if (mesh.vertex_count() == 0 || !mesh.positions.allFinite()) return {};
  const Boundary boundary = boundary_of(mesh);
  std::vector<double> shares;
  for (const double share : shares_tried) {
    if (share * much_longer > boundary.edge) continue;
    if (!nearly_all_have_a_near_one(boundary.places, share)) break;
    shares.insert(shares.begin(), share);
  }
  if (!shares.empty() || boundary.places.empty()) return shares;
  const double rounding = short_rounding(mesh, boundary);
  if (rounding > 0 && joins_anything(mesh, rounding)) shares.push_back(rounding);
  return shares;
}

}  // namespace sphparam
