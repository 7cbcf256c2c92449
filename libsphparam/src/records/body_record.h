#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "records/json_parts.h"
#include "sphparam/mesh/mass_properties.h"

namespace sphparam {

bool has_defect(const MeshInspection& inspection, DefectKind kind);

/// An open mesh encloses none, and of one whose faces look both ways the sum means nothing.
bool has_volume(const MeshInspection& inspection);

/// What a closed mesh encloses; nothing of an open one, of one whose faces or numbers are none, or
/// whose faces do not look the same way at an edge, or whose moments doubles do not hold.
std::optional<MassProperties> enclosed_body(const TriangleMesh& mesh,
                                            const MeshInspection& inspection);

/// Null where there is none.
Json body_json(const std::optional<MassProperties>& body);

/// A label and what it says: centroid, moments of inertia and axes. None where there is no body.
/// `length`: of the mesh, for the digits.
std::vector<std::pair<std::string, std::string>> body_lines(
    const std::optional<MassProperties>& body, double length);

}  // namespace sphparam
