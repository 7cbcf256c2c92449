#include "sphparam/io/shared_places.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "io/polygons/distinct_rows.h"
#include "io/shell_word.h"
#include "mesh/repair/repair_kinds.h"
#include "number_text.h"

// Each vertex is given the number of its place, as a reader of such a format does it, and edges
// between places are counted.

namespace sphparam {
namespace {

/// Those that stand more than twice.
long crowded(std::vector<std::pair<int, int>> edges) {
  std::ranges::sort(edges);
  long count = 0;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto end = std::upper_bound(first, edges.end(), *first);
    count += end - first > 2;
    first = end;
  }
  return count;
}

}  // namespace

SharedPlaces shared_places(const TriangleMesh& mesh) {
  DistinctRows<double, 3> places(static_cast<std::size_t>(mesh.vertex_count()));
  std::vector<int> place(static_cast<std::size_t>(mesh.vertex_count()), -1);
  SharedPlaces shared;
  for (const Vertex v : mesh.triangles.reshaped()) {
    int& found = place[static_cast<std::size_t>(v)];
    if (found >= 0) continue;
    const auto known = std::ssize(places.rows());
    const Vector3 x = mesh.position(v);
    found = places.insert({x.x() + 0.0, x.y() + 0.0, x.z() + 0.0});  // −0 and 0 are one place
    shared.vertices += std::ssize(places.rows()) == known;
  }
  if (shared.vertices == 0) return shared;
  std::vector<std::pair<int, int>> edges;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = place[static_cast<std::size_t>(mesh.triangles(f, k))],
                b = place[static_cast<std::size_t>(mesh.triangles(f, (k + 1) % 3))];
      if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  shared.edges = crowded(std::move(edges));
  return shared;
}

std::string words_of(const SharedPlaces& shared) {
  return counted(shared.vertices, "vertex lies exactly on another",
                 "vertices lie exactly on others");
}

std::string words_when_welded(const SharedPlaces& shared) {
  return shared.edges > 0
             ? counted(shared.edges, "edge", "edges") + " with more than two faces then"
             : "the surface touches itself then";
}

std::string shared_places_line(const MeshSource& mended) {
  const bool has_copies = std::ranges::any_of(mended.repairs, [](const RepairAction& repair) {
    return info_of(repair.kind).trait == RepairTrait::CopiesVertices;
  });
  if (!has_copies) return "";
  const SharedPlaces shared = shared_places(mended.file.mesh);
  if (shared.vertices == 0) return "";
  return words_of(shared) + ": .ply and .obj keep them apart, STL welds them (" +
         words_when_welded(shared) + "), and `sphparam wrap " + shell_file(mended.path) +
         " -o wrapped.ply` makes a surface without such, larger by its distance (by as little as "
         "you "
         "say with --gap LENGTH)";
}

}  // namespace sphparam
