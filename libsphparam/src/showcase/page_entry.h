#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bake/bake_scene.h"
#include "compare/entry.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/report/named_map.h"

namespace sphparam {

/// One map of a mesh with all that a page shows of it.
struct PageEntry {
  Entry entry;
  Provenance provenance;             // of the file, or of the map that was made here
  std::optional<BakeTarget> target;  // the chart of a map that is one-to-one
  std::optional<double> filler_share = std::nullopt;  // of the sphere, of a mesh with fillers
  std::string warning = {};                           // `roundness_warning` of a file's rays

  const SphericalChart* chart() const { return target ? &target->chart : nullptr; }
};

/// Makes the chart, where there can be one.
PageEntry make_page_entry(Entry entry, Provenance provenance, const MeshFile& file,
                          int threads = 0);
PageEntry make_page_entry(const NamedMap& map, const MeshFile& file, int threads = 0);

/// Files with maps of a mesh.
struct EntryFiles {
  std::vector<std::string> others = {};  // beside the mesh's own map
  std::string sphere = {};               // that one in a file of its own; empty: the mesh has it
  ReadOptions read = {};
};

/// The mesh's map first: where its file has none, it is mapped now, by our default, which `mapped`
/// is told; then the others. They are named by their files and told apart: "ball", "ball (2)".
/// Throws: ReadError, also where the connectivity of a file is another; Cancelled.
std::vector<PageEntry> load_page_entries(const MeshSource& mesh, const EntryFiles& files,
                                         const ParameterizeOptions& options,
                                         const std::function<void(const PageEntry&)>& mapped = {});

}  // namespace sphparam
