#include "asset/asset_words.h"

#include "number_text.h"

namespace sphparam {
namespace {

/// "8 faces turned": a message without the ids after it.
std::string without_places(const std::string& message) {
  return message.substr(0, message.find(": "));
}

}  // namespace

std::string plain_words(const MeshDefect& defect, const MeshInspection& found) {
  switch (defect.kind) {
    case DefectKind::NonFinitePosition:
      return counted(defect.count, "point has", "points have") + " no place";
    case DefectKind::DuplicateFace:
      return counted(defect.count, "face is", "faces are") + " there twice";
    case DefectKind::BoundaryEdge:
      return "it is open: " + counted(found.boundary_loops, "hole or border", "holes or borders");
    case DefectKind::NonManifoldEdge:
      return "three or more faces meet at " + counted(defect.count, "edge");
    case DefectKind::InconsistentOrientation:
      return "faces beside each other look opposite ways at " + counted(defect.count, "edge");
    case DefectKind::NonManifoldVertex:
      return "it touches itself at " + counted(defect.count, "point");
    case DefectKind::SeveralComponents:
      return "it is in " + counted(found.components, "part");
    case DefectKind::WrongGenus:
      if (found.genus > 0) return "it has " + counted(found.genus, "handle") + ", as cups have";
      [[fallthrough]];
    default:
      return without_places(defect.message);
  }
}

std::string plain_words(const RepairAction& action) { return without_places(action.message); }

std::vector<std::string> plain_words(const Wrap& wrap, double size) {
  std::vector<std::string> lines = {"a skin is drawn around it, " + percent(wrap.gap / size) +
                                    " of its size away; gaps narrower than " +
                                    percent(2 * wrap.distance / size) + " are closed"};
  if (wrap.parts > 1)
    lines.push_back(counted(wrap.parts, "part") + " that lie apart are joined by thin bridges");
  if (wrap.handles > 0)
    lines.push_back(counted(wrap.handles, "opening", "openings") +
                    " through it closed by thin walls");
  if (wrap.cavities > 0)
    lines.push_back(counted(wrap.cavities, "hollow", "hollows") + " within it filled");
  return lines;
}

}  // namespace sphparam
