#include "records/body_record.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "number_text.h"
#include "place_text.h"

namespace sphparam {
namespace {

constexpr int figure_digits = 6;

/// With which nothing is enclosed: sums over the faces would depend on where they are taken from.
constexpr std::array unsound = {
    DefectKind::Empty,        DefectKind::IndexOutOfRange, DefectKind::NonFinitePosition,
    DefectKind::BoundaryEdge, DefectKind::NonManifoldEdge, DefectKind::InconsistentOrientation};

bool is_sound(const MeshDefect& defect) {
  return std::ranges::find(unsound, defect.kind) == unsound.end();
}

std::string list_of(const Vector3& numbers) {
  return short_number(numbers[0], figure_digits) + ", " + short_number(numbers[1], figure_digits) +
         ", " + short_number(numbers[2], figure_digits);
}

std::string direction(const Vector3& axis) { return "(" + place_text(axis, 1) + ")"; }

}  // namespace

bool has_defect(const MeshInspection& inspection, DefectKind kind) {
  return std::ranges::any_of(inspection.defects,
                             [kind](const MeshDefect& defect) { return defect.kind == kind; });
}

bool has_volume(const MeshInspection& inspection) {
  return inspection.boundary_loops == 0 &&
         !has_defect(inspection, DefectKind::InconsistentOrientation);
}

std::optional<MassProperties> enclosed_body(const TriangleMesh& mesh,
                                            const MeshInspection& inspection) {
  if (!std::ranges::all_of(inspection.defects, is_sound)) return std::nullopt;
  const std::optional<MassProperties> body = mass_properties(mesh);
  return body && body->inertia.allFinite() ? body : std::nullopt;
}

Json body_json(const std::optional<MassProperties>& body) {
  if (!body) return nullptr;
  Json inertia = Json::array(), axes = Json::array();
  for (int k = 0; k < 3; ++k) {
    inertia.push_back(vector_json(body->inertia.row(k).transpose()));
    axes.push_back(vector_json(body->axes.row(k).transpose()));
  }
  return {{"centroid", vector_json(body->centroid)},
          {"inertia", inertia},
          {"principal_moments", vector_json(body->moments)},
          {"principal_axes", axes},
          {"extents", vector_json(body->extents)}};
}

std::vector<std::pair<std::string, std::string>> body_lines(
    const std::optional<MassProperties>& body, double length) {
  if (!body) return {};
  return {{"centroid", "(" + place_text(body->centroid, length) + ")"},
          {"inertia", list_of(body->moments) + " about the centroid, at density 1, along " +
                          direction(body->axes.row(0)) + ", " + direction(body->axes.row(1)) +
                          ", " + direction(body->axes.row(2))},
          {"extents", list_of(body->extents) + " along these"}};
}

}  // namespace sphparam
