#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "arguments/declaration.h"
#include "arguments/naming.h"
#include "arguments/numbers.h"
#include "arguments/repair_arguments.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/displacement.h"
#include "sphparam/remesh/sphere_grid.h"
#include "sphparam/remesh/texture_layout.h"

namespace sphparam::cli {

/// Columns and rows.
struct DisplacementSize {
  int width = 4096, height = 2048;
};

/// Which texture coordinates the new mesh has.
enum class TextureOf { Grid, Mesh };

/// The command line of `sphparam remesh`.
struct RemeshArguments : CommonArguments {
  std::string input;
  std::string sphere;  // a map of the mesh in a file of its own
  std::string grid;
  std::optional<Amount> within;  // how far the new mesh may be: a level of the grid ico is sought
  std::string output;
  Words data;                        // numbers a vertex in files of their own
  double lambda = remeshing_lambda;  // of a map that is made or adapted here
  std::string areas;                 // of vertices: two files, on the source and on the grid
  Words data_outputs;                // a file for each of `data`
  Naming naming;                     // of `output` and what lies beside it
  std::string transfer = "all";
  std::optional<TextureOf> uv;
  SampleMode sample = SampleMode::Point;
  std::optional<Scheme> subdivision;                  // fitted to the source
  std::string limit_output;                           // its points at the grid's vertices
  std::string displacement;                           // image of what the fit leaves
  std::optional<DisplacementSize> displacement_size;  // of it, and of the layout of a grid
  std::string rebuilt;                                // mesh of fit and image
  int lods = 0;                                       // coarser meshes
  bool adaptive = false;  // the map relaxed so that detail gets more vertices
  std::string geometry_image;
  std::string normal_image;
  Words attribute_images;  // NAME=FILE
  std::optional<ImageDepth> depth;
  std::string csv;
  bool degrees = false;  // in it
  FillersInFile holes = FillersInFile::Marked;
  RepairArguments repair;
  std::function<bool(const std::string&)> given;  // was this option on the command line?
};

void declare_remesh_options(Declaration& command, RemeshArguments& arguments);

/// An image of `what` a vertex has: "position", "normal", "color" or a property.
struct ImageRequest {
  std::string what;
  std::string path;
};

/// What a command line of `remesh` asks for, having been found to make sense.
struct RemeshRequests {
  std::optional<GridSpec> grid;      // with --within the finest; nothing: another sphere's …
  std::string like;                  // … vertices, in this file
  std::vector<GridSpec> coarser;     // grids of --lods
  std::vector<std::string> outputs;  // of -o and --lods: one a level, or one .glb
  std::vector<ImageRequest> images;
  bool one_file = false;  // a .glb
  bool is_usd = false;
  std::optional<TextureLayout> layout;         // texture coordinates in that of the grid …
  std::vector<TextureLayout> coarser_layouts;  // … and of those of --lods
  Words areas;                                 // none, or two files
  Words data_outputs;
  bool missing_values = false;  // may be in data: it goes into files of its own alone
};

/// Refuses before any work what makes no sense. Throws: UsageMistake; WriteError as `check_places`.
RemeshRequests check_remesh_arguments(RemeshArguments& arguments);

}  // namespace sphparam::cli
