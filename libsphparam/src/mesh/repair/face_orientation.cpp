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

constexpr char unseen = -1;

struct Patch {
  std::vector<Face> faces;
  bool one_sided = false;
  size_t turned_count = 0;
};

/// Walks the patch of this face. `turned`, a face: whether it runs the other way than the first.
Patch walk_patch(const RepairState& state, const std::vector<Halfedge>& twin, Face first,
                 std::vector<char>& turned) {
  turned[first] = 0;
  Patch patch{{first}};
  for (size_t at = 0; at < patch.faces.size(); ++at) {
    const Face f = patch.faces[at];
    patch.turned_count += turned[f];
    for (int k = 0; k < 3; ++k) {
      const Halfedge across = twin[3 * f + k];
      if (across == none) continue;
      const bool runs_alike = state.corner(across) == state.faces[f][k];
      const char wanted = turned[f] ^ static_cast<char>(runs_alike);
      char& mark = turned[across / 3];
      if (mark == unseen) {
        mark = wanted;
        patch.faces.push_back(across / 3);
      }
      patch.one_sided = patch.one_sided || mark != wanted;
    }
  }
  return patch;
}

}  // namespace

void orient_alike(RepairState& state) {
  const std::vector<Halfedge> twin = twins_of_simple_edges(state);
  std::vector<char> turned(state.faces.size(), unseen);
  std::vector<char> stands(state.faces.size(), 1);
  for (Face first = 0; first < state.face_count(); ++first) {
    if (turned[first] != unseen) continue;
    const Patch patch = walk_patch(state, twin, first, turned);
    if (patch.one_sided) continue;
    const char majority = patch.turned_count * 2 > patch.faces.size() ? 1 : 0;
    for (const Face f : patch.faces) stands[f] = turned[f] == majority;
  }
  for (Face f = 0; f < state.face_count(); ++f) {
    if (stands[f]) continue;
    state.turn_over(f);
    state.log(RepairKind::FaceTurned, {state.face_origin[f]});
  }
}

}  // namespace sphparam
