#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/asset/whole_surface.h"
#include "sphparam/bake/bake.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/up_axis.h"

namespace sphparam {

struct RemakeOptions {
  WholeOptions whole = {};                        // its threads and progress serve all
  int width = 2048;                               // texels a row of images; even, 2 to 65536
  int samples = 1;                                // N × N a texel; 1 to 32
  bool occlusion = false;                         // ambient occlusion too, by rays
  bool clear_walls = false;                       // walls of a wrap are masked out of what is seen
  bool compress = false;                          // the .glb: see `GltfOptions::compress`
  TextureFormat textures = TextureFormat::Given;  // its images; those beside it are PNG
  int webp_quality = 90;                          // see `LookOptions`
  Up up = {};                                     // nothing: as the asset's file says
  bool page = true;
  std::vector<std::pair<std::string, std::string>> facts = {};  // for the foot of the page
};

/// A part of an asset, what hangs together, and what of the images it has.
struct PartTexels {
  std::string material = {};  // of its first triangle; empty: none
  long triangles = 0;
  double area = 0, texels = 0;  // shares of all
};

/// What became of an asset.
struct RemadeAsset {
  WholeSurface whole;
  BakeReport baked;
  ChartFigures chart = {};                    // as the .glb has it
  WrittenFiles files = {};                    // names in the folder, and sizes where they are known
  std::string sizes = {};                     // of the .glb and its images, in words for people
  std::vector<TextureFigures> textures = {};  // what became of these
  std::vector<PartTexels> parts = {};         // of what was baked, that with most texels first
  std::vector<std::string> warnings = {};
  std::vector<std::string> losses = {};   // what its file had and what is made has not, or the .glb
                                          // alone; as `add_loss` words it
  std::vector<std::string> remarks = {};  // on images of one colour
  bool viewer_is_missing = false;         // the page has pictures only
  std::vector<std::pair<std::string, double>> seconds = {};  // of each stage
};

/// An asset with all that it shows, in one chart: its surface made whole (`whole_surface`), mapped,
/// all channels of its materials baked (`bake`; on another surface than itself along normals),
/// exported. Adds to `files`, in `folder`: NAME.sph.ply, the mesh with its map; NAME_basecolor.png
/// and so on, the images; NAME.glb, which has them all; NAME.html, a page that shows it beside what
/// it was. NAME is that of the asset's file.
/// Requires: the folder is there. Throws: as `whole_surface`, `bake`, `make_asset`, for options
/// outside their domains before any work; WriteError.
RemadeAsset remake_asset(const MeshSource& asset, const std::string& folder,
                         const RemakeOptions& options, PendingFiles& files);

/// "One closed surface as it was, certified one-to-one", in words for people.
std::string verdict_of(const RemadeAsset& remade);

/// "texels of its 3 parts: 71 %, 20 %, 9 %", the first five.
std::string line_of(const std::vector<PartTexels>& parts);

/// As `sphparam asset --json` tells it.
std::string to_json(const MeshSource& asset, const RemadeAsset& remade);

}  // namespace sphparam
