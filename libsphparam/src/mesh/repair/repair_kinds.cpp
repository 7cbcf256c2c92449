#include "mesh/repair/repair_kinds.h"

#include <algorithm>
#include <cstddef>

#include "mesh/defect_places.h"
#include "number_text.h"

namespace sphparam {
namespace {

using enum RepairKind;
using enum RepairPlace;
using enum RepairTrait;

constexpr RepairKindInfo kinds[] = {
    {NonFiniteFaceRemoved, "non-finite-face-removed", "face", "faces",
     "removed that had a vertex without a place", Faces, "faces"},
    {NonFiniteVertexDropped, "non-finite-vertex-dropped", "vertex", "vertices",
     "dropped whose coordinates were no finite numbers", Vertices, "vertices"},
    {InvalidFaceRemoved, "invalid-face-removed", "face", "faces",
     "that named a vertex twice removed", Faces, "faces", MayFollowWelding},
    {DuplicateFaceRemoved, "duplicate-face-removed", "duplicate face", "duplicate faces", "removed",
     Faces, "faces", MayFollowWelding},
    {VertexWelded, "vertex-welded", "boundary vertex", "boundary vertices",
     "welded onto others nearby", Vertices, "vertices", KeepsSurface},
    {EdgeSplitAtVertex, "edge-split-at-vertex", "boundary edge", "boundary edges",
     "split at a vertex that lay on it", Vertices, "at vertices"},
    {FaceTurned, "face-turned", "face", "faces", "turned over to run like neighbouring faces",
     Faces, "faces"},
    {EdgeSplit, "edge-split", "edge", "edges",
     "of three or more faces split, one copy for each sheet", Edges, "between vertices",
     CopiesVertices},
    {DiagonalTurned, "diagonal-turned", "diagonal", "diagonals",
     "turned, where two sheets had the same edge", Edges, "between vertices"},
    {EdgeMidpointAdded, "edge-midpoint-added", "vertex", "vertices",
     "added, where two sheets had the same edge", Edges, "between vertices"},
    {VertexSplit, "vertex-split", "vertex copy", "vertex copies", "made, one for each fan of faces",
     Vertices, "of vertices", CopiesVertices},
    {ComponentDropped, "component-dropped", "component", "components", "dropped", Vertices,
     "with vertices"},
    {HoleFilled, "hole-filled", "hole", "holes", "filled", Vertices, "at vertices"},
    {HoleKept, "hole-kept", "hole", "holes", "kept: closed by fillers, which are no surface",
     Vertices, "at vertices"},
    {HandleCut, "handle-cut", "handle", "handles", "cut through and both ends closed", Vertices,
     "at vertices", CopiesVertices},
    {HandleFilled, "handle-filled", "tunnel", "tunnels", "closed at one place by a double membrane",
     Vertices, "at vertices", CopiesVertices},
    {TurnedOutward, "turned-outward", nullptr, nullptr,
     "the whole surface turned over: it was inside out", Faces, nullptr},
    {FlatFaceTurned, "flat-face-turned", "face", "faces",
     "without area turned, with the neighbour across the longest edge", Faces, "faces"},
    {FlatFaceCollapsed, "flat-face-collapsed", "vertex", "vertices",
     "merged with another at the same place, to be rid of faces without area", Vertices,
     "vertices"},
    {UnusedVertexDropped, "unused-vertex-dropped", "vertex", "vertices",
     "that no face uses dropped", Vertices, "vertices", KeepsSurface},
    {EdgeHalved, "edge-halved", "edge", "edges", "halved, longer than asked for", Edges,
     "between vertices", KeepsSurface}};

/// Every kind, in the order of the enumeration.
consteval bool is_complete() {
  int next = 0;
  for (const RepairKindInfo& info : kinds)
    if (static_cast<int>(info.kind) != next++) return false;
  return next == static_cast<int>(EdgeHalved) + 1;
}
static_assert(is_complete());

}  // namespace

const RepairKindInfo& info_of(RepairKind kind) { return kinds[static_cast<std::size_t>(kind)]; }

long count_of(const std::vector<RepairAction>& actions, RepairKind kind) {
  const auto found = std::ranges::find(actions, kind, &RepairAction::kind);
  return found == actions.end() ? 0 : found->count;
}

RepairPlace place_of(RepairKind kind) { return info_of(kind).place; }

std::string describe(const RepairAction& action) {
  const RepairKindInfo& info = info_of(action.kind);
  if (!info.one) return info.done;
  const std::string what = counted(action.count, info.one, info.many) + " " + info.done;
  if (action.elements.empty()) return what;
  return what +
         place_list({info.noun, "made by this repair"}, info.place, action.elements, action.count);
}

}  // namespace sphparam
