#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"

namespace sphparam {

/// What the elements of a defect name; edges have two.
RepairPlace place_of(DefectKind kind);

/// How a list of places calls them: "between vertices", and those without a number: "made here".
struct PlaceWords {
  const char *noun, *unnamed;
};

/// ": between vertices 4-17, 17-23 and 2 made here, …", with which a message ends: `count` places,
/// of which these are the first. Of those that have no number (negative) it says how many there
/// are.
std::string place_list(const PlaceWords& words, RepairPlace place, const std::vector<int>& elements,
                       long count);

/// The list of a defect's places.
std::string place_list(RepairPlace place, const std::vector<int>& elements, long count);

/// The same defect with other numbers of vertices and faces, in its message too. Places that have
/// none (negative) are no longer among its elements; faces of one number, one after the other, are
/// one.
MeshDefect renumbered(MeshDefect defect, const std::function<long(Vertex)>& vertex,
                      const std::function<long(Face)>& face);

}  // namespace sphparam
