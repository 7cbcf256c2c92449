#pragma once

#include <string>
#include <vector>

#include "cli/input_limits.h"
#include "mesh_io/mesh_file.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"

namespace sphparam::tools {

/// A mesh file as the map takes it, and what was found on the way.
struct Source {
  std::string path;                  // as it was named
  MeshFile file;                     // welded where needed, without unused vertices
  std::optional<Topology> topology;  // of it; nothing where it is no closed manifold
  MeshInspection inspection;  // with the ids of the file, or after welding if that was needed
  bool welded = false;
  std::vector<std::string> notes;     // of the reader, then what was done to the mesh
  std::vector<RepairAction> repairs;  // with the numbers of the file; see cli/repairing.h
  KeptParts parts;                    // what they kept of the surface, so numbered too
};

/// Throws: ReadError. A mesh that is no sphere is returned all the same: see `inspection`.
Source read_source(const std::string& path, const ReadOptions& options = input_limits());

/// The textures that a file names are read too: from now on no output may replace them.
/// `read_source` sees to it; whoever reads a mesh otherwise and shows its textures calls it.
void keep_textures(const MeshFile& file);

}  // namespace sphparam::tools
