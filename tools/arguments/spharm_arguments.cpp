#include "arguments/spharm_arguments.h"

#include <stdexcept>
#include <string_view>

#include "arguments/mesh_names.h"
#include "console/exit_codes.h"
#include "console/places.h"
#include "sphparam/io/paths.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam::cli {
namespace {

constexpr std::string_view like_prefix = "like:";

void require_alignment(const SpharmArguments& arguments) {
  if (!arguments.align.empty() && arguments.align != "true" && arguments.align != "sphere")
    throw UsageMistake(
        "--align: with sphere and surface, --align; of the sphere alone, --align=sphere");
  if (arguments.align.empty() && !arguments.flips.empty())
    throw UsageMistake("--flip-template is for --align only");
  if (!arguments.align.empty() && arguments.wanted_degree() < 1)
    throw UsageMistake("--align: degree 0 has no first-order ellipsoid; --degree 1 at least");
  if (!arguments.align.empty() && !arguments.shadr.empty())
    throw UsageMistake(
        "--shadr is of the body's own longitudes and latitudes, which --align would turn");
}

void require_grid(const SpharmArguments& arguments) try {
  if (arguments.grid.empty()) return;
  if (arguments.reconstruction.empty())
    throw UsageMistake("--grid is of the surface that --reconstruct writes");
  if (!arguments.grid.starts_with(like_prefix)) parse_grid(arguments.grid);
  if (arguments.grid == like_prefix)
    throw UsageMistake("--grid like: names no mesh, as in like:MESH");
} catch (const std::invalid_argument& error) {
  throw UsageMistake("--grid " + arguments.grid + ": " + error.what());
}

void declare_outputs(Declaration& command, SpharmArguments& arguments) {
  command.json(arguments, "Coefficients and figures")
      .text("--csv", arguments.csv, "FILE",
            "Coefficients, a line each, tabs between in a .tsv; - for standard output")
      .written()
      .text("--shadr", arguments.shadr, "FILE",
            "4pi-normalised C and S of the radius as the PDS has them")
      .written()
      .text("--coef", arguments.coef, "FILE", "Coefficients of x, y, z as SPHARM-PDM has them")
      .written()
      .text("--reconstruct", arguments.reconstruction, "FILE",
            "The mesh as the harmonics have it, in the format of its name")
      .written()
      .text("--grid", arguments.grid, "GRID",
            "What --reconstruct writes is on this grid, not on the mesh's vertices: " +
                grid_patterns() + " or like:MESH");
}

}  // namespace

bool has_coefficients(const std::string& path) {
  const std::string kind = extension_of(path);
  return kind == ".json" || kind == ".coef";
}

std::string file_of_grid(const SpharmArguments& arguments) {
  return arguments.grid.starts_with(like_prefix) ? arguments.grid.substr(like_prefix.size()) : "";
}

HarmonicAlignment alignment_of(const SpharmArguments& arguments) {
  if (arguments.align.empty()) return HarmonicAlignment::None;
  return arguments.align == "sphere" ? HarmonicAlignment::Sphere
                                     : HarmonicAlignment::SphereAndSurface;
}

void require_sensible(const SpharmArguments& arguments) {
  if (arguments.centre.is_given() && !arguments.has_radius())
    throw UsageMistake("--centre is for --radius and --shadr only");
  require_alignment(arguments);
  require_grid(arguments);
  require_mesh_name("--reconstruct", "the surface", arguments.reconstruction);
  table_separator("--csv", arguments.csv);
  check_places({{"--json", arguments.json},
                {"--csv", arguments.csv},
                {"--shadr", arguments.shadr},
                {"--coef", arguments.coef},
                {"--reconstruct", arguments.reconstruction}});
}

void require_coefficients_alone(const SpharmArguments& arguments) {
  const std::string name = display_name(arguments.input);
  for (const char* option :
       {"--sphere", "--scalar", "--fit", "--radius", "--centre", "--normalisation", "--align",
        "--flip-template", "--json", "--csv", "--shadr", "--coef"})
    if (arguments.given(option))
      throw UsageMistake(std::string(option) + " is of a mesh: " + name + " has its coefficients");
  if (!typed_again(arguments.repair).empty())
    throw UsageMistake("repairs are of a mesh: " + name + " has its coefficients");
  if (arguments.grid.empty() || arguments.reconstruction.empty())
    throw UsageMistake(name +
                       " has coefficients: --grid GRID --reconstruct FILE makes a surface "
                       "of them");
}

void declare_options(Declaration& command, SpharmArguments& arguments) {
  command
      .input("MESH", arguments.input,
             "A .sph.ply, or any mesh: it is mapped first; - for standard input; or coefficients: "
             "a .json of --json, or a .coef")
      .sphere(arguments.sphere)
      .number("--degree", arguments.degree, "L", {0, greatest_harmonic_degree},
              "Greatest degree, 0 to 1000")
      .preset("20; of coefficients in a file all that there are")
      .texts("--scalar", arguments.scalars, "NAME", "A property of the vertices; may be repeated")
      .choice("--fit", arguments.least_squares, {{"least-squares", true}, {"quadrature", false}},
              "At the vertices, weighted by their solid angles, or the integral over the "
              "sphere (default: least-squares)")
      .flag("--radius", arguments.radius, "The distance from the centre of the body too")
      .parsed(
          "--centre", centre_pattern,
          [&arguments](const std::string& text) { return read_centre(text, arguments.centre); },
          wanted_centre,
          "The body's centre, in the mesh's coordinates, or that of what it encloses")
      .preset("that of a radial map, else 0,0,0")
      .choice("--normalisation", arguments.normalisation,
              {{"orthonormal", HarmonicNormalisation::Orthonormal},
               {"4pi", HarmonicNormalisation::FourPi}},
              "Of the functions that coefficients in --json and --csv belong to; 4pi: as in "
              "geodesy (default: orthonormal)")
      .flag("--align", arguments.align,
            "Turn sphere and surface onto the axes of the first-order ellipsoid, as SPHARM-PDM "
            "does; --align=sphere: the sphere alone")
      .text("--flip-template", arguments.flips, "FILE",
            "With --align: half turns that bring coefficients nearest to those of this .coef "
            "(default: by skewness)");
  declare_outputs(command, arguments);
  arguments.given = command.given();
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace sphparam::cli
