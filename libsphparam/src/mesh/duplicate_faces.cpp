#include <algorithm>

#include "mesh/face_sides.h"
#include "mesh/repair_state.h"

// Faces with the same three vertices are told apart by the way they run: of those that run alike
// the first stays. Of two that lie back to back, one stays where most of their edges have one face
// besides them, that which runs against it; both stay where most have none or two: the surface
// passes through both (two bodies that share a wall, a flap, the ear of a vertex of valence two),
// and splitting the edges tells whose each is.

namespace sphparam {
namespace {

/// Three vertices in increasing order; whether the face runs through them in that order.
struct FaceKey {
  std::array<Vertex, 3> sorted;
  bool forward;
  Face face;
};

FaceKey key_of(const RepairState& state, Face f) {
  const std::array<Vertex, 3>& face = state.faces[f];
  const size_t first =
      static_cast<size_t>(std::min_element(face.begin(), face.end()) - face.begin());
  FaceKey key{face, false, f};
  std::sort(key.sorted.begin(), key.sorted.end());
  key.forward = face[(first + 1) % 3] == key.sorted[1];
  return key;
}

std::vector<FaceKey> sorted_keys(const RepairState& state) {
  std::vector<FaceKey> keys;
  keys.reserve(state.faces.size());
  for (Face f = 0; f < state.face_count(); ++f) keys.push_back(key_of(state, f));
  std::sort(keys.begin(), keys.end(), [](const FaceKey& x, const FaceKey& y) {
    return std::tie(x.sorted, x.forward, x.face) < std::tie(y.sorted, y.forward, y.face);
  });
  return keys;
}

void remove(RepairState& state, const std::vector<char>& kept, RepairKind kind) {
  for (Face f = 0; f < state.face_count(); ++f) {
    if (!kept[f]) state.log(kind, {state.face_origin[f]});
  }
  state.keep_faces(kept);
}

void remove_copies(RepairState& state) {
  std::vector<char> kept(state.faces.size(), 1);
  const std::vector<FaceKey> keys = sorted_keys(state);
  for (size_t i = 1; i < keys.size(); ++i) {
    const FaceKey &one = keys[i - 1], &other = keys[i];
    if (one.sorted == other.sorted && one.forward == other.forward) kept[other.face] = 0;
  }
  remove(state, kept, RepairKind::DuplicateFaceRemoved);
}

/// How many faces an edge has, and how many of them run from its lower to its higher vertex.
struct EdgeUse {
  Vertex low, high;
  long faces, forward;
};

std::vector<EdgeUse> edge_uses(const RepairState& state) {
  const std::vector<FaceSide> sides = sorted_sides(state.triangles(), [](Face) { return true; });
  std::vector<EdgeUse> uses;
  for_each_edge(sides, [&](size_t i, size_t j) {
    EdgeUse use{sides[i].low, sides[i].high, static_cast<long>(j - i), 0};
    for (size_t s = i; s < j; ++s) use.forward += sides[s].forward;
    uses.push_back(use);
  });
  return uses;
}

const EdgeUse& use_of(const std::vector<EdgeUse>& uses, Vertex a, Vertex b) {
  const std::pair edge{std::min(a, b), std::max(a, b)};
  return *std::lower_bound(uses.begin(), uses.end(), edge,
                           [](const EdgeUse& use, const std::pair<Vertex, Vertex>& wanted) {
                             return std::pair(use.low, use.high) < wanted;
                           });
}

/// For two faces back to back: the one to give up, or −1 for neither.
Face superfluous(const std::vector<EdgeUse>& uses, const FaceKey& backward,
                 const FaceKey& forward) {
  int odd = 0, votes_for_forward = 0;
  for (int k = 0; k < 3; ++k) {
    const Vertex a = forward.sorted[k], b = forward.sorted[(k + 1) % 3];
    const EdgeUse& use = use_of(uses, a, b);
    const long others = use.faces - 2, others_up = use.forward - 1,
               others_down = others - others_up;
    if (others % 2 == 0) continue;
    ++odd;
    const bool forward_goes_up = a < b;
    votes_for_forward += (others_down > others_up) == forward_goes_up ? 1 : -1;
  }
  if (odd < 2) return -1;
  if (votes_for_forward == 0) return std::max(forward.face, backward.face);
  return votes_for_forward > 0 ? backward.face : forward.face;
}

}  // namespace

void remove_invalid_faces(RepairState& state) {
  std::vector<char> kept(state.faces.size());
  for (Face f = 0; f < state.face_count(); ++f) {
    const auto [a, b, c] = state.faces[f];
    const bool inside = std::min({a, b, c}) >= 0 && std::max({a, b, c}) < state.vertex_count();
    kept[f] = inside && a != b && b != c && c != a;
  }
  remove(state, kept, RepairKind::InvalidFaceRemoved);
}

void remove_duplicate_faces(RepairState& state) {
  remove_copies(state);
  const std::vector<FaceKey> keys = sorted_keys(state);
  const std::vector<EdgeUse> uses = edge_uses(state);
  std::vector<char> kept(state.faces.size(), 1);
  for (size_t i = 1; i < keys.size(); ++i) {
    if (keys[i - 1].sorted != keys[i].sorted) continue;
    const Face given_up = superfluous(uses, keys[i - 1], keys[i]);
    if (given_up >= 0) kept[given_up] = 0;
  }
  remove(state, kept, RepairKind::DuplicateFaceRemoved);
}

}  // namespace sphparam
