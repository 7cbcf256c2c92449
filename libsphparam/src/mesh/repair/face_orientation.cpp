#include "mesh/face_sides.h"
#include "mesh/repair/repair_state.h"

// Patches are walked through the edges that have two faces: across each, the neighbour must run the
// other way. The majority of a patch stays as it is. A patch where the walk contradicts itself is
// one-sided and is left alone.

namespace sphparam {
namespace {

constexpr Halfedge none = -1;

std::vector<Halfedge> twins_of_simple_edges(const RepairState& state) {
  const std::vector<FaceSide> sides = sorted_sides(state.triangles(), [](Face) { return true; });
  std::vector<Halfedge> twin(state.faces.size() * 3, none);
  for_each_edge(sides, [&](size_t i, size_t j) {
    if (j - i != 2) return;
    twin[sides[i].halfedge] = sides[i + 1].halfedge;
    twin[sides[i + 1].halfedge] = sides[i].halfedge;
  });
  return twin;
}

}  // namespace

void orient_alike(RepairState& state) {
  const std::vector<Halfedge> twin = twins_of_simple_edges(state);
  constexpr char unseen = -1;
  std::vector<char> turned(state.faces.size(), unseen);
  std::vector<char> stands(state.faces.size(), 1);
  for (Face first = 0; first < state.face_count(); ++first) {
    if (turned[first] != unseen) continue;
    turned[first] = 0;
    std::vector<Face> patch{first};
    bool one_sided = false;
    size_t turned_count = 0;
    for (size_t at = 0; at < patch.size(); ++at) {
      const Face f = patch[at];
      turned_count += turned[f];
      for (int k = 0; k < 3; ++k) {
        const Halfedge across = twin[3 * f + k];
        if (across == none) continue;
        const bool runs_alike = state.corner(across) == state.faces[f][k];
        const char wanted = turned[f] ^ static_cast<char>(runs_alike);
        char& mark = turned[across / 3];
        if (mark == unseen) {
          mark = wanted;
          patch.push_back(across / 3);
        }
        one_sided = one_sided || mark != wanted;
      }
    }
    if (one_sided) continue;
    const char majority = turned_count * 2 > patch.size() ? 1 : 0;
    for (const Face f : patch) stands[f] = turned[f] == majority;
  }
  for (Face f = 0; f < state.face_count(); ++f) {
    if (stands[f]) continue;
    state.turn_over(f);
    state.log(RepairKind::FaceTurned, {state.face_origin[f]});
  }
}

}  // namespace sphparam
