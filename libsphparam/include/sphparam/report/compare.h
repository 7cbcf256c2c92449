#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/progress.h"
#include "sphparam/report/named_map.h"
#include "sphparam/texture/mesh_textures.h"

namespace sphparam {

struct CompareOptions {
  bool pictures = true;  // of the spheres
  Up up = {};            // of the mesh; nothing: as its file says
  int size = 360;        // pixels, of each side of a picture; 16 to 4096
  std::shared_ptr<const MeshTextures> textures = nullptr;  // see `shown_textures`; null: none
  int threads = 0;                                         // 0: all cores
  Progress progress = {};
};

/// The names of all methods that can map a mesh: ours, the default first, then those of others.
std::vector<std::string> method_names();

/// Maps a mesh by methods and puts the maps side by side with others of it: the page index.html,
/// with the table, the spheres, and the polar charts of the first map against each other one, and
/// what it shows, as names and bytes of files of one folder. Methods of others run as their authors
/// published them, and no map of theirs is repaired: maps that fold are results here.
/// Requires: a method or a map; names of maps are of letters, digits, dots, - and _, begin with
/// neither dot nor -, and each is there once, for files are called by them. Throws:
/// std::invalid_argument, before any work, where that is not so, for a name that is not among
/// `method_names`, for a size outside its domain, or not a ray a vertex; MeshError unless the mesh
/// is a closed genus-0 manifold; ImageError; Cancelled.
std::vector<std::pair<std::string, std::string>> compare_maps(
    const std::string& name, const MeshFile& file, const std::vector<std::string>& methods,
    const std::vector<NamedMap>& others = {}, const CompareOptions& options = {});

}  // namespace sphparam
