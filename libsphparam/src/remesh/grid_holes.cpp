#include "remesh/grid_holes.h"

#include <algorithm>
#include <map>

#include "mesh/union_find.h"
#include "remesh/faces_of_point.h"
#include "sphparam/remesh/remesh.h"

// First vertices where fans touch get fillers all around; then surface that is not of the largest
// piece becomes fillers; then of each hole's pieces the largest stays. No step undoes the one
// before, and none parts the triangles of a polygon: the first takes whole ones, and to the others
// they are one piece.

namespace sphparam {
namespace {

size_t at(int i) { return static_cast<size_t>(i); }

/// Pieces of faces with the same mark, by their edges.
UnionFind pieces_of(const Topology& topology, const FillerMarks& fillers) {
  UnionFind pieces(at(topology.face_count()));
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const Face f = Topology::face(h), g = Topology::face(topology.twin(h));
    if ((fillers[at(f)] != 0) == (fillers[at(g)] != 0)) pieces.unite(f, g);
  }
  return pieces;
}

/// How many faces of each piece are fillers, or are not.
std::vector<int> sizes_of(UnionFind& pieces, const FillerMarks& fillers, bool of_fillers) {
  std::vector<int> sizes(fillers.size(), 0);
  for (Face f = 0; f < std::ssize(fillers); ++f)
    sizes[at(pieces.find(f))] += (fillers[at(f)] != 0) == of_fillers;
  return sizes;
}

/// Of fillers about a vertex, how many fans apart.
int fans_at(const Topology& grid, const FillerMarks& fillers, Vertex v) {
  int fans = 0;
  grid.for_each_outgoing(v, [&](Halfedge h) {
    const bool before = fillers[at(Topology::face(grid.twin(h)))] != 0;
    fans += fillers[at(Topology::face(h))] != 0 && !before;
  });
  return fans;
}

/// Marks all triangles of a triangle's polygon: they come in a row.
void fill_polygon(const Triangulation& cut, Face f, FillerMarks& fillers) {
  const auto is_of_it = [&](Face g) {
    return g >= 0 && g < std::ssize(fillers) && cut.polygon_of(g) == cut.polygon_of(f);
  };
  Face first = f;
  while (is_of_it(first - 1)) --first;
  for (Face g = first; is_of_it(g); ++g) fillers[at(g)] = 1;
}

void join_fans(const Topology& grid, const Triangulation& cut, FillerMarks& fillers) {
  for (bool changed = true; changed;) {
    changed = false;
    for (Vertex v = 0; v < grid.vertex_count(); ++v) {
      if (fans_at(grid, fillers, v) < 2) continue;
      grid.for_each_outgoing(v, [&](Halfedge h) { fill_polygon(cut, Topology::face(h), fillers); });
      changed = true;
    }
  }
}

void keep_largest_surface(const Topology& grid, FillerMarks& fillers) {
  UnionFind pieces = pieces_of(grid, fillers);
  const std::vector<int> size = sizes_of(pieces, fillers, false);
  const auto largest = std::max_element(size.begin(), size.end()) - size.begin();
  for (Face f = 0; f < grid.face_count(); ++f) {
    if (pieces.find(f) != largest) fillers[at(f)] = 1;
  }
}

void keep_largest_of_holes(const Topology& grid, const std::vector<int>& holes,
                           FillerMarks& fillers) {
  UnionFind pieces = pieces_of(grid, fillers);
  const std::vector<int> size = sizes_of(pieces, fillers, true);
  std::map<int, int> largest;  // of a hole: a piece
  for (Face f = 0; f < grid.face_count(); ++f) {
    if (!fillers[at(f)] || holes[at(f)] < 0) continue;
    const int piece = pieces.find(f);
    int& known = largest.try_emplace(holes[at(f)], piece).first->second;
    if (size[at(piece)] > size[at(known)]) known = piece;
  }
  std::vector<char> stays(fillers.size(), 0);
  for (const auto& [hole, piece] : largest) stays[at(piece)] = 1;
  for (Face f = 0; f < grid.face_count(); ++f) {
    if (!stays[at(pieces.find(f))]) fillers[at(f)] = 0;
  }
}

}  // namespace

std::vector<int> holes_of(const Topology& topology, const FillerMarks& fillers) {
  UnionFind pieces = pieces_of(topology, fillers);
  std::vector<int> holes(fillers.size(), -1);
  std::map<int, int> names;
  for (Face f = 0; f < topology.face_count(); ++f) {
    if (!fillers[at(f)]) continue;
    const int next = static_cast<int>(names.size());
    holes[at(f)] = names.try_emplace(pieces.find(f), next).first->second;
  }
  return holes;
}

FillerMarks tidy_fillers(const Topology& grid, const Triangulation& cut,
                         const std::vector<int>& holes) {
  FillerMarks fillers(holes.size());
  for (size_t f = 0; f < holes.size(); ++f) fillers[f] = holes[f] >= 0 ? 1 : 0;
  if (std::find(fillers.begin(), fillers.end(), 0) == fillers.end()) return fillers;
  const FillerMarks before = fillers;
  join_fans(grid, cut, fillers);
  if (std::find(fillers.begin(), fillers.end(), 0) == fillers.end()) return before;
  keep_largest_surface(grid, fillers);
  keep_largest_of_holes(grid, holes, fillers);
  return fillers;
}

FillerMarks in_holes(const MappedMesh& source, const Points& directions, int threads) {
  const FillerMarks& fillers = source.fillers();
  if (fillers.empty()) return {};
  FillerMarks marks;
  marks.reserve(at(static_cast<int>(directions.rows())));
  const auto is_surface = [&](Face f) { return fillers[at(f)] == 0; };
  for (const SurfacePoint& place : source.locator().locate_all(directions, threads))
    marks.push_back(any_face_of(place, source.topology(), is_surface) ? 0 : 1);
  return marks;
}

}  // namespace sphparam
