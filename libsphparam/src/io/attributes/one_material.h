#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// What materials that become one leave to it, beside what images hold: what most of the area has.
struct OneMaterial {
  MaterialFinish finish;
  bool unlit = false;
  /// For people: of whom it is not, with their share of the area; empty where all agree.
  std::vector<std::string> warnings;
};

/// Faces without a material have what glTF says of those: no finish, lit. Fillers do not count.
/// Cost: O(#F).
OneMaterial one_material(const MeshFile& file);

}  // namespace sphparam
