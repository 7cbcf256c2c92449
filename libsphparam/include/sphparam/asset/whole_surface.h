#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/progress.h"

namespace sphparam {

/// How the one closed surface of an asset came about.
enum class WholeBy {
  Itself,  // it was one
  Repair,  // its holes are filled and the like; what is there stays in place
  Wrap,    // about it
};

/// "itself", "repair", "wrap".
const char* word_of(WholeBy by);

struct WholeOptions {
  double least_kept = 0.98;  // of the area, for a repair to be preferred to a wrap; 0 to 1
  int resolution = 192;      // of a wrap: voxels along the longest side of the box
  long faces = 50'000;       // of a wrap, about; 0: all
  bool upright = false;      // `with_upright_frame`, as the asset's file says what is up
  int threads = 0;           // 0: all cores
  Progress progress = {};
};

/// One closed surface of genus 0 that stands for an asset, and its map.
struct WholeSurface {
  MappedMesh mapped;  // with its chart at hand
  WholeBy by = WholeBy::Itself;
  double area_kept = 1;                 // of the asset's; a wrap keeps all of it inside
  std::vector<std::string> found = {};  // what stood in the way, in an artist's words, a line each
  std::vector<std::string> done = {};   // what repair did, or how it was wrapped; so too
  std::vector<std::string> details = {};   // both again with all figures, and where
  std::vector<RepairAction> repairs = {};  // where repair made it whole
};

/// The surface of an asset: itself, where it can be mapped as it is; mended by what repair does
/// unasked, where that keeps enough of its area; else a wrap of it (`wrap_soup`, a voxel away).
/// A map whose chart no texture can lie on (`spherical_chart` is not one-to-one) counts as none.
/// Throws: MeshError where there are no triangles with places; UnmeasurableMesh; NotCertifiedError;
/// std::invalid_argument for options outside their domains; Cancelled.
/// Cost: about that of the map; of a wrap some seconds.
WholeSurface whole_surface(const MeshSource& asset, const WholeOptions& options = {});

}  // namespace sphparam
