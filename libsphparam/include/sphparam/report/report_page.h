#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/progress.h"
#include "sphparam/report/named_map.h"
#include "sphparam/texture/mesh_textures.h"

namespace sphparam {

struct PageOptions {
  bool viewer = true;  // models that change into their spheres, where the viewer is installed
                       // beside the program; else pictures
  Up up = {};          // of the mesh; nothing: as its file says
  int size = 1024;  // pixels, the width of textures and heat maps, and the most of pictures; 64 to
                    // 8192
  /// Of the mesh, see `shown_textures`; null: those of its file.
  std::shared_ptr<const MeshTextures> textures = nullptr;
  std::vector<std::pair<std::string, std::string>> facts = {};  // for the foot of the page
  int threads = 0;                                              // 0: all cores
  Progress progress = {};
};

/// One page of HTML that shows maps of a mesh and needs nothing else: models or pictures, heat
/// maps, the paper's polar charts, histograms, tables, provenance. Several maps stand side by side,
/// their charts on the same scale. The mesh is shown in its own colours; with its textures, where
/// its file has them. Requires: at least one map. Ensures: the page loads nothing from anywhere.
/// Throws: std::invalid_argument, before any work, where there is no map, or not a ray a vertex,
/// and for a size outside its domain; ImageError; Cancelled. Cost: some seconds a map.
std::string make_report(const std::string& name, const MeshFile& file,
                        const std::vector<NamedMap>& maps, const PageOptions& options = {});

/// The page of one mapped mesh.
std::string make_report(const MappedMesh& mapped, const PageOptions& options = {});

/// Writes it, all of it or nothing. Throws: as `make_report`; WriteError.
void write_report(const std::string& path, const MappedMesh& mapped,
                  const PageOptions& options = {});

}  // namespace sphparam
