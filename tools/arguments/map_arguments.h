#pragma once

#include <functional>
#include <string>

#include "arguments/centre_argument.h"
#include "arguments/declaration.h"
#include "arguments/naming.h"
#include "arguments/repair_arguments.h"
#include "compare/methods.h"
#include "sphparam/parameterize.h"

namespace sphparam::cli {

/// What the command line of `sphparam map` says.
struct MapArguments : CommonArguments {
  std::string input;
  std::string output;  // empty: not wanted; so are:
  std::string sphere;
  std::string plots;
  std::string pins;
  Words data;
  Naming naming;      // of the sphere
  std::string align;  // body, or another map of the mesh
  std::string like;   // another mesh that lies where this one does, with its map
  std::string poles = "auto";
  Up up;                             // as the command line says
  bool upright_poles = false;        // top and bottom
  bool front_meridian = false;       // what is in front
  std::string balance = "balanced";  // a word, or the λ it stands for
  RepairArguments repair;
  bool all_components = false;
  std::string component;  // which it is of which mesh, for its file; empty: the mesh is whole
  bool keep_folded = false;
  AnyMethod method = Method::Progressive;
  CentreArgument centre;
  // Complete but for `progress`, `pins` and `centre`, once settled. Vertices have their numbers in
  // the file.
  ParameterizeOptions options;
  std::function<bool(const std::string&)> given;  // was this option on the command line?
};

void declare_map_options(Declaration& command, MapArguments& arguments);

/// Completes the arguments. Throws: UsageMistake when they make no sense together.
void settle(MapArguments& arguments);

}  // namespace sphparam::cli
