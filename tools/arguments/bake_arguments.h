#pragma once

#include <functional>
#include <string>
#include <vector>

#include "arguments/centre_argument.h"
#include "arguments/repair_arguments.h"
#include "console/exit_codes.h"
#include "sphparam/bake/bake.h"

namespace sphparam::cli {

struct BakeArguments : CommonArguments {
  std::string input;
  std::string output;
  std::vector<std::string> maps;                  // fields; none: the base colour
  std::string sphere;                             // the map in a file of its own; empty: none
  Words data;                                     // numbers a vertex in files of their own
  std::string target;                             // --for; empty: the source
  std::string from;                               // another surface to bake from; empty: none
  std::string body;                               // a name, radii or WKT; empty: none
  bool all_components = false;                    // of the files that `map` made of parts
  RepairArguments repair;                         // of the mesh
  double crease = -1;                             // degrees; below 0: none
  bool source_normals_down = false;               // green of its own normal maps
  CentreArgument centre;                          // of the body
  double unit = 1;                                // metres that the mesh's unit has
  std::function<bool(const std::string&)> given;  // was this option on the command line?
  BakeSettings settings;  // what has an option; names, target, progress are the command's
};

/// What `sphparam bake --help` begins with.
std::string bake_summary();

void declare_bake_options(Declaration& command, BakeArguments& arguments);

/// Completes the settings of a body. Throws: UsageMistake where there is no such body, or options
/// do not go together.
void settle_body(BakeArguments& arguments);

/// The images of the arguments, in their order, {map} replaced, before any work is done.
/// Throws: UsageMistake, for maps that do not exist (with the nearest), files that would be
/// written twice or are read, formats that are not written, options that do not go together.
std::vector<BakeRequest> bake_requests(const BakeArguments& arguments);

/// Those of the requests that the mesh has something for: of `--map channels` some may be without.
/// `is_map`: the input carries its map. Throws: UsageMistake where there are none.
std::vector<BakeRequest> requests_of_mesh(std::vector<BakeRequest> images,
                                          const BakeArguments& arguments, const MeshFile& file,
                                          bool is_map);

// The library's complaints about a bake, in the words of the command line: with the option that
// sets it; of the mesh that was read; of the one that images are for.
UsageMistake as_mistake(const BakeSettingError& error);
UsageMistake as_mistake(const FieldError& error, const BakeSettings& settings);
UsageMistake as_mistake(const OtherSphereError& error, const MappedMesh& source,
                        const BakeArguments& arguments);

/// What to type, in order, for a mesh on the sphere of `source` that --for takes.
std::string advice_for_target(const MappedMesh& source, const BakeArguments& arguments);

}  // namespace sphparam::cli
