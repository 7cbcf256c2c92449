#pragma once

#include <functional>
#include <optional>
#include <string>

#include "arguments/centre_argument.h"
#include "arguments/repair_arguments.h"
#include "sphparam/io/harmonic_expansion.h"

namespace sphparam::cli {

/// The command line of `sphparam spharm`. Files that are empty are not wanted; sphere: the mesh's
/// own map.
struct SpharmArguments : CommonArguments {
  static constexpr int usual_degree = 20;

  std::string input, sphere;
  Words scalars;
  std::optional<int> degree;  // none: usual_degree, or all that there are in a file
  bool least_squares = true;
  bool radius = false;
  CentreArgument centre;  // none: that of a radial map, else the origin
  HarmonicNormalisation normalisation = HarmonicNormalisation::Orthonormal;
  std::string align, flips;
  std::string csv, shadr, coef, reconstruction;
  std::string grid;  // of the reconstruction; empty: the mesh's own vertices
  RepairArguments repair;
  std::function<bool(const std::string&)> given;

  int wanted_degree() const { return degree.value_or(usual_degree); }
  bool has_radius() const { return radius || !shadr.empty(); }
};

/// A file of coefficients, not of a mesh.
bool has_coefficients(const std::string& path);

/// The file that --grid names, which must be there; empty: it names none.
std::string file_of_grid(const SpharmArguments& arguments);

HarmonicAlignment alignment_of(const SpharmArguments& arguments);

/// Looks at all names before any work. Throws: UsageMistake; WriteError.
void require_sensible(const SpharmArguments& arguments);

/// Of coefficients there is no mesh: nothing is expanded, and there is no other grid than is named.
/// Throws: UsageMistake.
void require_coefficients_alone(const SpharmArguments& arguments);

void declare_options(Declaration& command, SpharmArguments& arguments);

}  // namespace sphparam::cli
