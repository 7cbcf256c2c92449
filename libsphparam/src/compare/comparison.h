#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/entry.h"
#include "compare/pictures.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/report/compare.h"

namespace sphparam {

/// Files of a folder, as name and bytes; nothing touches the disk here.
using FolderFiles = std::vector<std::pair<std::string, std::string>>;

/// Can a map be called so? Its name is part of names of files anywhere, and of addresses on a page.
bool can_name_files(std::string_view name);

struct ComparisonOptions {
  bool pictures = true;  // of the spheres; they need the image module
  PictureOptions look = {};
  MeshTextures textures = {};  // of the mesh
};

/// The page index.html about the maps of one mesh, and what it shows: table, spheres side by side
/// (as they are, folds in red, and coloured by area distortion), and the polar charts of the first
/// entry, blue, against every other one, red.
/// Paper: Figures 6, 7, 10 and 11. Throws: ImageError.
FolderFiles comparison_files(const std::string& name, const MeshFile& file,
                             const std::vector<Entry>& entries,
                             const ComparisonOptions& options = {});

/// The entries of methods, by name, and then of other maps: each is told as it is there.
/// Throws: std::invalid_argument for a name that is not among `method_names`, before any work;
/// MeshError unless the mesh is a closed genus-0 manifold; Cancelled.
std::vector<Entry> make_entries(const MeshFile& file, const std::vector<std::string>& methods,
                                const std::vector<NamedMap>& others, const CompareOptions& options,
                                const std::function<void(const Entry&)>& tell = {});

/// What a user says, of this mesh.
ComparisonOptions comparison_options(const MeshFile& file, const CompareOptions& options);

/// A heading of one pair of charts, area and angle, on the page; the SVGs are added to `files` as
/// NAME-area.svg and NAME-angle.svg. Requires: both have a distortion.
void add_polar_plots(Page& page, FolderFiles& files, const std::string& name, const Entry& ours,
                     const Entry& other);

/// The sphere of a entry as NAME.png in `files`, and the figure that shows it.
PageFigure sphere_figure(FolderFiles& files, const std::string& name, const MeshFile& file,
                         const Entry& entry, const PictureOptions& look,
                         const MeshTextures& textures = {});

}  // namespace sphparam
