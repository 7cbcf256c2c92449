#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// What materials that become one leave to it, beside what images hold: what most of the area has;
/// of alpha, Mask where some of it is masked, for images with an alpha of 1 elsewhere. What is
/// blended in part of the area would let one see into all of it.
struct OneMaterial {
  MaterialFinish finish;
  bool unlit = false;
  AlphaMode alpha_mode = AlphaMode::Opaque;  // Blend only where all of the area is
  double alpha_cutoff = 0.5;                 // of Mask: the least; other alphas are to be scaled
  /// For people: of whom it is not, with their share of the area; empty where all agree.
  std::vector<std::string> warnings;
};

/// Faces without a material have what glTF says of those: no finish, lit. Fillers do not count.
/// Cost: O(#F).
OneMaterial one_material(const MeshFile& file);

}  // namespace sphparam
