#include "number_text.h"
#include "sphparam/mesh/mesh_repair.h"

// What was done, in words. A switch over all kinds, so that the compiler names a forgotten one.

namespace sphparam {
namespace {

/// What was done, and the noun of the places that follow.
std::pair<std::string, const char*> words(RepairKind kind, long n) {
  switch (kind) {
    case RepairKind::NonFiniteFaceRemoved:
      return {counted(n, "face", "faces") + " removed that had a vertex without a place", "faces"};
    case RepairKind::NonFiniteVertexDropped:
      return {
          counted(n, "vertex", "vertices") + " dropped whose coordinates were no finite numbers",
          "vertices"};
    case RepairKind::VertexWelded:
      return {counted(n, "boundary vertex", "boundary vertices") + " welded onto others nearby",
              "vertices"};
    case RepairKind::EdgeSplitAtVertex:
      return {counted(n, "boundary edge", "boundary edges") + " split at a vertex that lay on it",
              "at vertices"};
    case RepairKind::InvalidFaceRemoved:
      return {counted(n, "face", "faces") + " that named a vertex twice removed", "faces"};
    case RepairKind::DuplicateFaceRemoved:
      return {counted(n, "duplicate face", "duplicate faces") + " removed", "faces"};
    case RepairKind::FaceTurned:
      return {counted(n, "face", "faces") + " turned over to run like its neighbours", "faces"};
    case RepairKind::EdgeSplit:
      return {
          counted(n, "edge", "edges") + " of three or more faces split, one copy for each sheet",
          "between vertices"};
    case RepairKind::DiagonalTurned:
      return {counted(n, "diagonal", "diagonals") + " turned, where two sheets had the same edge",
              "between vertices"};
    case RepairKind::EdgeMidpointAdded:
      return {counted(n, "vertex", "vertices") + " added, where two sheets had the same edge",
              "between vertices"};
    case RepairKind::VertexSplit:
      return {counted(n, "vertex copy", "vertex copies") + " made, one for each fan of faces",
              "of vertices"};
    case RepairKind::ComponentDropped:
      return {counted(n, "component", "components") + " dropped", "with vertices"};
    case RepairKind::HoleFilled:
      return {counted(n, "hole", "holes") + " filled", "at vertices"};
    case RepairKind::HoleKept:
      return {counted(n, "hole", "holes") + " kept: closed by fillers, which are no surface",
              "at vertices"};
    case RepairKind::HandleCut:
      return {counted(n, "handle", "handles") + " cut through and both ends closed", "at vertices"};
    case RepairKind::HandleFilled:
      return {counted(n, "tunnel", "tunnels") + " closed on both sides", "at vertices"};
    case RepairKind::TurnedOutward:
      return {"the whole surface turned over: it was inside out", ""};
    case RepairKind::FlatFaceTurned:
      return {counted(n, "face", "faces") +
                  " without area turned, with the neighbour across the "
                  "longest edge",
              "faces"};
    case RepairKind::FlatFaceCollapsed:
      return {counted(n, "vertex", "vertices") +
                  " merged with another at the same place, to be rid of faces without area",
              "vertices"};
    case RepairKind::UnusedVertexDropped:
      return {counted(n, "vertex", "vertices") + " that no face uses dropped", "vertices"};
  }
  return {};
}

}  // namespace

RepairPlace place_of(RepairKind kind) {
  switch (kind) {
    case RepairKind::EdgeSplit:
    case RepairKind::DiagonalTurned:
    case RepairKind::EdgeMidpointAdded:
      return RepairPlace::Edges;
    case RepairKind::VertexSplit:
    case RepairKind::ComponentDropped:
    case RepairKind::HoleFilled:
    case RepairKind::HoleKept:
    case RepairKind::HandleCut:
    case RepairKind::HandleFilled:
    case RepairKind::FlatFaceCollapsed:
    case RepairKind::UnusedVertexDropped:
    case RepairKind::NonFiniteVertexDropped:
    case RepairKind::VertexWelded:
    case RepairKind::EdgeSplitAtVertex:
      return RepairPlace::Vertices;
    case RepairKind::NonFiniteFaceRemoved:
    case RepairKind::InvalidFaceRemoved:
    case RepairKind::DuplicateFaceRemoved:
    case RepairKind::FaceTurned:
    case RepairKind::TurnedOutward:
    case RepairKind::FlatFaceTurned:
      break;
  }
  return RepairPlace::Faces;
}

std::string describe(const RepairAction& action) {
  auto [text, noun] = words(action.kind, action.count);
  if (*noun == '\0') return text;
  const size_t ids = place_of(action.kind) == RepairPlace::Edges ? 2 : 1;
  std::string names;
  long made_here = 0;
  for (size_t i = 0; i < action.elements.size(); i += ids) {
    const int first = action.elements[i], second = action.elements[i + ids - 1];
    if (first < 0 || second < 0) {
      ++made_here;
      continue;
    }
    names += (names.empty() ? "" : ", ") + std::to_string(first);
    if (ids == 2) names.append("-").append(std::to_string(second));
  }
  if (!names.empty()) names = ": " + std::string(noun) + " " + names;
  if (made_here > 0) {
    names += (names.empty() ? ": " : " and ") + std::to_string(made_here) + " made by this repair";
  }
  return text + names +
         (static_cast<long>(action.elements.size() / ids) < action.count ? ", …" : "");
}

}  // namespace sphparam
