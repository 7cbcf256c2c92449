// `sphparam spharm`: the surface, and what it carries, as a sum of spherical harmonics: the shape
// description that a map to the sphere was first made for (Brechbühler, Gerig, Kübler 1995).

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "arguments/suggestion.h"
#include "commands/command.h"
#include "commands/mapped_source.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/records/harmonics_record.h"
#include "sphparam/stopwatch.h"
#include "number_text.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Describe a surface by spherical harmonics.\n"
    "\n"
    "Examples:\n"
    "  sphparam spharm brain.sph.ply --degree 20 --json brain.json\n"
    "  sphparam spharm brain.ply --sphere brain.sphere.gii --degree 60 --reconstruct smooth.ply\n"
    "  sphparam spharm moon.sph.ply --degree 90 --scalar gravity --csv moon.csv\n"
    "\n"
    "The coefficients are of x, y and z, and of the scalars named, in a real orthonormal basis.\n"
    "Least squares weigh each vertex by its solid angle on the sphere, that is, the part of the\n"
    "sphere that it stands for; residuals are told so weighted, and plain.\n";

struct SpharmArguments {
  std::string input;
  std::string sphere;  // empty: the mesh's own map; so are, not wanted:
  std::string json;
  std::string csv;
  std::string reconstruction;
  std::vector<std::string> scalars;
  int degree = 20;
  bool least_squares = true;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

std::vector<std::string> names_of(const std::vector<Property>& properties) {
  std::vector<std::string> names;
  for (const Property& property : properties) names.push_back(property.name);
  return names;
}

void require_scalars(const MeshFile& file, const std::vector<std::string>& scalars) {
  for (const std::string& name : scalars) {
    if (file.find_vertex_property(name)) continue;
    const std::string meant = nearest_word(name, names_of(file.vertex_properties));
    throw UsageMistake("--scalar: the vertices have no property " + name +
                       (meant.empty() ? "" : "; did you mean " + meant + "?"));
  }
}

HarmonicExpansion expand(const SpharmArguments& arguments, const MappedMesh& mapped,
                         Console& console) {
  require_measurable(mapped.mesh());
  require_scalars(mapped.file(), arguments.scalars);
  HarmonicExpansion expansion = expand_in_harmonics(
      mapped, arguments.scalars,
      {.degree = arguments.degree,
       .least_squares = arguments.least_squares,
       .threads = arguments.threads,
       .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }});
  console.clear_progress();
  return expansion;
}

void add_reconstruction(PendingFiles& files, const SpharmArguments& arguments,
                        const MappedMesh& mapped, const HarmonicExpansion& expansion) {
  const std::string& path = arguments.reconstruction;
  const MeshFile file = reconstruction(mapped, expansion);
  require_numbers(file, path);
  std::string bytes = serialise_mesh(path, file);
  if (keeps_map(path)) {
    add_certified(files, path, std::move(bytes), mapped.topology(), arguments.threads);
  } else {
    files.add(path, std::move(bytes));
  }
}

void require_sensible(const SpharmArguments& arguments) {
  const std::string& mesh = arguments.reconstruction;
  const std::string extension = extension_of(mesh);
  const bool can_be = is_written(mesh) && !extension.empty() && extension != ".gii";
  if (!mesh.empty() && !is_stream(mesh) && !can_be) {
    throw UsageMistake("--reconstruct: the name must end in .ply, .obj or .off");
  }
  check_places({arguments.input, arguments.sphere}, {{"--json", arguments.json},
                                                     {"--csv", arguments.csv},
                                                     {"--reconstruct", arguments.reconstruction}});
}

/// More coefficients than vertices: the residual at the vertices says nothing then.
void warn_of_few_vertices(const SpharmArguments& arguments, const MeshFile& file,
                          Console& console) {
  const std::int64_t count = std::int64_t{arguments.degree + 1} * (arguments.degree + 1);
  if (!arguments.least_squares || count <= file.mesh.vertex_count()) return;
  console.warning(std::to_string(count) + " coefficients for " +
                  std::to_string(file.mesh.vertex_count()) +
                  " vertices: what these leave open is as in --fit quadrature");
}

void tell(const SpharmArguments& arguments, const HarmonicExpansion& report,
          const Stopwatch& stopwatch, Console& console) {
  std::string line = display_name(arguments.input) + ": degree " + std::to_string(report.degree()) +
                     ", RMS distance at the vertices, weighted by solid angle, " +
                     short_number(report.position_rms()) + " (" +
                     percent(report.position_rms() / report.diagonal) +
                     " of the diagonal), unweighted " + short_number(report.plain_position_rms()) +
                     ", " + short_number(stopwatch.seconds()) + " s";
  console.say(line);
  if (report.degree() >= 1) {
    const Vector3 axes = first_order_ellipsoid(report.fit.coefficients.leftCols(3));
    console.say("  first-order ellipsoid: semi-axes " + short_number(axes[0], 6) + ", " +
                short_number(axes[1], 6) + ", " + short_number(axes[2], 6));
  }
  for (size_t k = 3; k < report.functions.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    console.say("  " + report.functions[k] + ": RMS residual, weighted, " +
                short_number(report.fit.rms[i]) + ", unweighted " +
                short_number(report.plain_rms[i]));
  }
  console.detail("  " + std::to_string(report.fit.iterations) + " iterations");
}

int run_spharm(const SpharmArguments& arguments) {
  require_sensible(arguments);
  const Stopwatch stopwatch;
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const OrderlyInterruption orderly;
  const MappedMesh mapped =
      read_mapped_source(arguments.input, arguments.sphere, arguments.threads, console);
  warn_of_few_vertices(arguments, mapped.file(), console);
  const HarmonicExpansion expansion = expand(arguments, mapped, console);
  PendingFiles files;
  if (!arguments.json.empty())
    files.add(arguments.json, to_json(expansion, arguments.input, mapped.provenance()));
  if (!arguments.csv.empty()) files.add(arguments.csv, to_csv(expansion));
  if (!arguments.reconstruction.empty()) add_reconstruction(files, arguments, mapped, expansion);
  if (interrupted()) throw Cancelled();
  files.publish();
  tell(arguments, expansion, stopwatch, console);
  return Ok;
}

void add_options(CLI::App& command, SpharmArguments& arguments) {
  command
      .add_option("MESH", arguments.input,
                  "A .sph.ply, or any mesh: it is mapped first; - for standard input")
      ->type_name(" ")
      ->required();
  command.add_option("--sphere", arguments.sphere, "Another map of the mesh: a sphere mesh")
      ->type_name("FILE");
  command.add_option("--degree", arguments.degree, "Greatest degree, 0 to 1000")
      ->check(between(0, greatest_harmonic_degree, "0 to 1000"))
      ->type_name("L")
      ->capture_default_str();
  command.add_option("--scalar", arguments.scalars, "A property of the vertices; may be repeated")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_choice<bool>(command, "--fit", arguments.least_squares,
                   {{"least-squares", true}, {"quadrature", false}},
                   "At the vertices, weighted by their solid angles, or the integral over the "
                   "sphere (default: least-squares)");
  add_json(command, arguments.json, "Coefficients and figures");
  command.add_option("--csv", arguments.csv, "Coefficients, a line each; - for standard output")
      ->type_name("FILE");
  command
      .add_option("--reconstruct", arguments.reconstruction,
                  "The mesh as the harmonics have it: .ply, .obj or .off")
      ->type_name("FILE");
  add_threads(command, arguments.threads);
  add_progress(command, arguments.progress);
  add_loudness(command, arguments.loudness);
}

}  // namespace

Command declare_spharm(CLI::App& program) {
  const auto arguments = std::make_shared<SpharmArguments>();
  CLI::App* command = program.add_subcommand("spharm", summary);
  add_options(*command, *arguments);
  return {command, [arguments] { return run_spharm(*arguments); }};
}

}  // namespace sphparam::cli
