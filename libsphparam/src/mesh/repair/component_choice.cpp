#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "mesh/cavities.h"
#include "mesh/repair/repair_state.h"
#include "mesh/triangle_geometry.h"
#include "mesh/union_find.h"

// Parts are ranked by area: faces are many where somebody modelled finely, a mug's handle more than
// the mug. Areas are of the unit box, and added in the order of the faces, so that the ranking is
// the same on every machine.

namespace sphparam {
namespace {

constexpr size_t listed = 10;  // parts that are told

struct Part {
  int root;
  long faces;
  double area;
};

double area_of(const RepairState& state, const std::array<Vertex, 3>& face) {
  return triangle_area(state.shape[face[0]], state.shape[face[1]], state.shape[face[2]]);
}

std::vector<Part> ranked_parts(const RepairState& state, UnionFind& classes) {
  std::vector<Part> by_root(state.positions.size(), Part{-1, 0, 0});
  for (const auto& face : state.faces) {
    const int root = classes.find(face[0]);
    Part& part = by_root[root];
    part = {root, part.faces + 1, part.area + area_of(state, face)};
  }
  std::erase_if(by_root, [](const Part& part) { return part.root < 0; });
  std::stable_sort(by_root.begin(), by_root.end(), [](const Part& x, const Part& y) {
    return std::pair(x.area, x.faces) > std::pair(y.area, y.faces);
  });
  return by_root;
}

std::vector<SurfacePart> with_shares(const RepairState& state, const std::vector<Part>& ranked) {
  Part all{};
  for (const Part& part : ranked) {
    all.area += part.area;
    all.faces += part.faces;
  }
  std::vector<SurfacePart> shares;
  for (const Part& part : ranked) {
    const double of_faces = static_cast<double>(part.faces) / static_cast<double>(all.faces);
    shares.push_back({.area_share = all.area > 0 ? part.area / all.area : of_faces,
                      .face_share = of_faces,
                      .faces = part.faces,
                      .vertex = state.vertex_origin[part.root]});
  }
  return shares;
}

/// Of the largest component, before the others go.
void count_cavities(RepairState& state) {
  const Cavities found = find_cavities(state.mesh());
  state.cavities.count += std::ssize(found.lowest);
  state.cavities.volume += found.volume;
  state.cavities.share += found.share;
}

void drop_others(RepairState& state, UnionFind& classes, const std::vector<Part>& ranked,
                 int chosen) {
  for (const Part& part : ranked) {
    if (part.root == chosen) continue;
    state.log(RepairKind::ComponentDropped, {state.vertex_origin[part.root]});
  }
  std::vector<char> kept(state.faces.size());
  for (Face f = 0; f < state.face_count(); ++f) kept[f] = classes.find(state.faces[f][0]) == chosen;
  state.keep_faces(kept);
}

}  // namespace

void keep_component(RepairState& state, int rank, double least_kept) {
  UnionFind classes(state.positions.size());
  for (const auto& [a, b, c] : state.faces) {
    classes.unite(a, b);
    classes.unite(b, c);
  }
  const std::vector<Part> ranked = ranked_parts(state, classes);
  if (ranked.empty()) return;
  if (static_cast<size_t>(rank) > ranked.size()) {
    throw NoSuchComponent("there is no component " + std::to_string(rank) + ": the mesh has " +
                          std::to_string(ranked.size()));
  }
  if (ranked.size() == 1) return;
  std::vector<SurfacePart> shares = with_shares(state, ranked);
  const SurfacePart chosen = shares[rank - 1];
  KeptParts& parts = state.parts;
  if (parts.count == 0) {
    parts.count = static_cast<long>(ranked.size());
    shares.resize(std::min(shares.size(), listed));
    parts.largest = std::move(shares);
  }
  parts.refused = parts.area_share * chosen.area_share < least_kept;
  if (parts.refused) return;
  parts.area_share *= chosen.area_share;
  parts.face_share *= chosen.face_share;
  if (rank == 1) count_cavities(state);
  drop_others(state, classes, ranked, ranked[rank - 1].root);
}

}  // namespace sphparam
