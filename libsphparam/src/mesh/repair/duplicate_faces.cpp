// Faces with the same three vertices are told apart by the way they run: of those that run alike
// the first stays. Two may lie back to back. Where such pairs lie side by side they are two sheets,
// and the rim of these decides, of a pair alone its three edges. Where most of the rim has one face
// besides, the surface is there twice, and the sheet stays that runs with it. Where most has none
// or two, both stay: the surface passes through both (two bodies that share a wall, a flap, the ear
// of a vertex of valence two), and splitting the edges tells whose each is.

#include <algorithm>
#include <span>

#include "mesh/face_sides.h"
#include "mesh/repair/repair_state.h"
#include "mesh/union_find.h"

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

/// Of each face the one that lies at its back, or −1. Requires: no copies.
std::vector<Face> backs(const RepairState& state) {
  const std::vector<FaceKey> keys = sorted_keys(state);
  std::vector<Face> back(state.faces.size(), -1);
  for (size_t i = 1; i < keys.size(); ++i) {
    if (keys[i - 1].sorted != keys[i].sorted) continue;
    back[keys[i - 1].face] = keys[i].face;
    back[keys[i].face] = keys[i - 1].face;
  }
  return back;
}

/// The sheets of faces that lie back to back, and what their rims say of each.
class Sheets {
 public:
  Sheets(const RepairState& state, const std::vector<Face>& back)
      : back_(back), sheet_(back.size()), rims_(back.size()) {
    const std::vector<FaceSide> sides = sorted_sides(state.triangles(), [](Face) { return true; });
    for_each_edge(sides, [&](size_t i, size_t j) { join(std::span(sides).subspan(i, j - i)); });
    for_each_edge(sides, [&](size_t i, size_t j) { count(std::span(sides).subspan(i, j - i)); });
  }

  /// Is it on a sheet that doubles the surface, and not the one that runs with it?
  bool is_superfluous(Face f) {
    if (back_[f] < 0) return false;
    const int own = sheet_.find(f), other = sheet_.find(back_[f]);
    const Rim& rim = rims_[own];
    if (own == other || 2 * rim.odd <= rim.edges) return false;
    return rim.votes == 0 ? own > other : rim.votes < 0;
  }

 private:
  struct Rim {
    long edges = 0, odd = 0;  // odd: with an odd number of faces besides the two sheets
    long votes = 0;           // of the odd ones, for this sheet and not for the other
  };

  static Face face_of(const FaceSide& side) { return side.halfedge / 3; }

  /// Do two pairs meet there, and nothing else?
  bool is_within(std::span<const FaceSide> edge) const {
    return edge.size() == 4 && std::ranges::all_of(edge, [&](const FaceSide& side) {
             return back_[face_of(side)] >= 0;
           });
  }

  void join(std::span<const FaceSide> edge) {
    if (!is_within(edge)) return;
    for (const FaceSide& one : edge)
      for (const FaceSide& other : edge)
        if (one.forward != other.forward && back_[face_of(one)] != face_of(other))
          sheet_.unite(face_of(one), face_of(other));
  }

  void count(std::span<const FaceSide> edge) {
    if (is_within(edge)) return;
    const long others = std::ssize(edge) - 2,
               up = std::ranges::count(edge, true, &FaceSide::forward) - 1;
    for (const FaceSide& side : edge) {
      if (back_[face_of(side)] < 0) continue;
      Rim& rim = rims_[sheet_.find(face_of(side))];
      ++rim.edges;
      if (others % 2 == 0) continue;
      ++rim.odd;
      rim.votes += (others - up > up) == side.forward ? 1 : -1;
    }
  }

  const std::vector<Face>& back_;
  UnionFind sheet_;        // of faces
  std::vector<Rim> rims_;  // by the name of the sheet
};

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
  const std::vector<Face> back = backs(state);
  if (std::ranges::all_of(back, [](Face f) { return f < 0; })) return;
  Sheets sheets(state, back);
  std::vector<char> kept(state.faces.size());
  for (Face f = 0; f < state.face_count(); ++f) kept[f] = !sheets.is_superfluous(f);
  remove(state, kept, RepairKind::DuplicateFaceRemoved);
}

}  // namespace sphparam
