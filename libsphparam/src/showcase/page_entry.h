#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake_scene.h"
#include "compare/entry.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam {

/// One map of a mesh with all that a page shows of it.
struct PageEntry {
  Entry entry;
  Provenance provenance;             // of the file, or of the map that was made here
  std::optional<BakeTarget> target;  // the chart of a map that is one-to-one

  const SphericalChart* chart() const { return target ? &target->chart : nullptr; }
};

/// Makes the chart, where there can be one.
PageEntry make_page_entry(Entry entry, Provenance provenance, const MeshFile& file,
                          int threads = 0);

}  // namespace sphparam
