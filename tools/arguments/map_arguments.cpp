// The options of `sphparam map`, and what they may not say together.

#include "arguments/map_arguments.h"

#include "arguments/energy_words.h"
#include "console/exit_codes.h"
#include "console/places.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/names.h"

namespace sphparam::cli {

namespace {

void settle_poles(const std::string& text, ParameterizeOptions& options) {
  options.automatic_poles = text != "none";
  if (text == "auto" || text == "none" || text == "up") return;
  const auto poles = two_numbers(text, ',');
  const bool make_sense =
      poles && poles->first >= 0 && poles->second >= 0 && poles->first != poles->second;
  if (!make_sense)
    throw UsageMistake("--poles: expected auto, none, up or two different vertices, as in 17,23");
  options.poles = Poles{poles->first, poles->second};
}

/// `--balance` is a word or a number; a number is the λ of `--lambda`.
void settle_balance(const std::string& text, bool lambda_given, ParameterizeOptions& options) {
  const Words words = {name_of(Balance::Conformal), name_of(Balance::Lambda),
                       name_of(Balance::EqualArea)};
  if (text == words[1]) return;
  if (lambda_given) throw UsageMistake("--balance " + text + " and --lambda contradict each other");
  if (text == words[0] || text == words[2]) {
    options.balance = text == words[0] ? Balance::Conformal : Balance::EqualArea;
    return;
  }
  double& lambda = options.energy.lambda;
  const bool is_number = read_number(text, lambda);
  if (is_number && lambdas.holds(lambda)) return;
  throw UsageMistake("--balance: expected conformal, balanced, equal-area or a number from " +
                     lambdas.text() + (is_number ? "" : did_you_mean(text, words)));
}

/// Options that only one of our methods reads.
void require_method(const MapArguments& arguments, Method needed, const Words& names) {
  if (arguments.method == AnyMethod(needed)) return;
  for (const std::string& name : names) {
    if (arguments.given(name))
      throw UsageMistake(name + " is for --method " + name_of(needed) + " only");
  }
}

/// Methods of others have no options: they run as published.
void require_no_settings(const MapArguments& arguments) {
  if (!std::holds_alternative<Baseline>(arguments.method)) return;
  const std::string method = info_of(arguments.method).name;
  for (const std::string name : {"--poles", "--meridian", "--pin", "--align"}) {
    if (!arguments.given(name)) continue;
    throw UsageMistake(name + " is not for --method " + method +
                       ", which lays out the sphere in its own way");
  }
  if (arguments.given("--lambda") && !arguments.given("--repair-map"))
    throw UsageMistake("--lambda is for --method " + method + " only with --repair-map");
}

/// A radial map lies as the body does, an aligned one as it is told to.
void require_one_frame(const MapArguments& arguments) {
  const bool radial = arguments.method == AnyMethod(Method::Radial);
  for (const std::string name : {"--poles", "--meridian", "--pin"}) {
    if (!arguments.given(name)) continue;
    if (radial) {
      throw UsageMistake(name + " is not for --method radial, which lies as the body does");
    }
    if (!arguments.align.empty()) {
      throw UsageMistake(name + " and --align contradict each other: both say where the map lies");
    }
  }
  if (radial && !arguments.align.empty()) {
    throw UsageMistake("--align is not for --method radial, which lies as the body does");
  }
  if (arguments.given("--centre") && !radial && arguments.align != "body") {
    throw UsageMistake("--centre is for --method radial and --align body only");
  }
}

/// What poles, meridian and pins may not say together, and not with every method.
void require_sensible_frame(const MapArguments& arguments) {
  const ParameterizeOptions& options = arguments.options;
  const bool progressive = options.method == Method::Progressive;
  if (!options.automatic_poles && !progressive) {
    throw UsageMistake("--poles none is for --method progressive only: the others start at poles");
  }
  if (!arguments.pins.empty() && !progressive) {
    throw UsageMistake("--pin is for --method progressive only");
  }
  if (!options.meridian) return;
  if (options.method == Method::Paper) {
    throw UsageMistake("--meridian is not for --method paper: theta is 0 at its date line");
  }
  if (!arguments.pins.empty()) {
    throw UsageMistake("--meridian and --pin contradict each other: pins fix every direction");
  }
  if (options.poles &&
      (*options.meridian == options.poles->north || *options.meridian == options.poles->south)) {
    throw UsageMistake("--meridian: vertex " + std::to_string(*options.meridian) +
                       " is a pole, which has no longitude");
  }
}

/// What --up and --front say of where the map lies; poles, pins and the like that are given say
/// more.
void settle_upright(MapArguments& arguments) {
  const ParameterizeOptions& options = arguments.options;
  const bool wanted = arguments.given("--up") || arguments.given("--front");
  const bool free = arguments.pins.empty() && arguments.align.empty() &&
                    std::holds_alternative<Method>(arguments.method) &&
                    options.method != Method::Radial;
  if (arguments.poles == "up" && !arguments.pins.empty())
    throw UsageMistake("--poles up and --pin contradict each other: pins fix every direction");
  arguments.upright_poles =
      arguments.poles == "up" || (wanted && free && !arguments.given("--poles"));
  arguments.front_meridian =
      free && !options.meridian && options.method != Method::Paper &&
      (arguments.upright_poles || (arguments.given("--front") && options.poles));
}

/// The other mesh's map says where everything lies and what is made.
void require_only_like(const MapArguments& arguments) {
  if (arguments.like.empty()) return;
  for (const std::string name :
       {"--method", "--lambda", "--repair-map", "--keep-folded", "--poles", "--meridian", "--pin",
        "--up", "--front", "--align", "--centre", "--balance", "--quality", "--energy",
        "--all-components", "--keep-holes"}) {
    if (!arguments.given(name)) continue;
    throw UsageMistake(name + " and --like contradict each other: the map follows from that of " +
                       display_name(arguments.like));
  }
}

/// Files of their own, and vertices of no one part.
void require_sensible_parts(const MapArguments& arguments) {
  if (!arguments.all_components) return;
  for (const std::string name :
       {"--component", "--write-sphere", "--plots", "--loops", "--meridian", "--pin"}) {
    if (!arguments.given(name)) continue;
    throw UsageMistake(name + " is for one map, and --all-components makes several");
  }
  if (arguments.options.poles) {
    throw UsageMistake("--poles V1,V2 is for one map, and --all-components makes several");
  }
  if (is_stream(arguments.output) || arguments.output.empty()) {
    throw UsageMistake("--all-components writes NAME_0001.sph.ply and so on: -o must name a file");
  }
}

/// The name of the sphere, where a pattern makes it.
void settle_sphere(MapArguments& arguments) {
  if (!arguments.naming.pattern) {
    if (arguments.given("--subject")) throw UsageMistake("--subject is for --names only");
    return;
  }
  if (arguments.sphere.empty())
    throw UsageMistake("--names is of the sphere: give --write-sphere a folder");
  arguments.sphere = named_surface(arguments.naming, arguments.sphere, "--write-sphere",
                                   arguments.input, "", "sphere", "");
}

/// What there is for a format that cannot keep a map.
std::string what_writes(const std::string& extension) {
  if (is_written_as_sphere("sphere" + extension))
    return "--write-sphere FILE writes the sphere alone as " + extension;
  if (extension == ".glb" || extension == ".gltf")
    return "`sphparam export` of the map writes " + extension;
  return "the sphere alone is written as " + sphere_extensions();
}

void require_sensible(const MapArguments& arguments) {
  if (arguments.output.empty() && arguments.sphere.empty())
    throw UsageMistake("nothing to write: give -o, the map, or --write-sphere, the bare sphere");
  require_one_stream({arguments.input, arguments.pins, arguments.align, arguments.like},
                     "the mesh, --pin, --align and --like");
  const std::string extension = inner_extension_of(arguments.output);
  if (!extension.empty() && !keeps_map(arguments.output)) {
    throw UsageMistake("-o: the map is a PLY, .ply, or a polydata of VTK, .vtk or .vtp: " +
                       extension + " cannot keep one; " + what_writes(extension));
  }
  require_sensible_parts(arguments);
  const bool is_named = !inner_extension_of(arguments.sphere).empty();
  if (!arguments.sphere.empty() && !(is_named && is_written_as_sphere(arguments.sphere))) {
    throw UsageMistake("--write-sphere: the name must end in " + sphere_extensions());
  }
  check_places({{"-o", arguments.output},
                {"--write-sphere", arguments.sphere},
                {"--loops", arguments.repair.loops},
                {"--json", arguments.json}},
               arguments.plots);
}

void declare_files(Declaration& command, MapArguments& arguments) {
  command.input("MESH", arguments.input, readable_formats("or") + "; - for standard input")
      .text("-o,--output", arguments.output, "FILE",
            "The map, a .sph.ply (or .vtk, .vtp); - for standard output; without it, give "
            "--write-sphere")
      .written()
      .flag("--all-components", arguments.all_components,
            "A map of each component, the largest by area first: NAME_0001.sph.ply, …")
      .text("--write-sphere", arguments.sphere, "FILE",
            "The bare sphere too: .ply, .obj, .off, .vtk or .vtp in doubles, .gii, .sphere or .mz3 "
            "in "
            "floats of radius 100")
      .written()
      .data(arguments.data)
      .json(arguments)
      .text("--plots", arguments.plots, "FOLDER", "The distortion as SVG plots")
      .written();
  declare_naming(command, arguments.naming, "--write-sphere");
}

void declare_method(Declaration& command, MapArguments& arguments) {
  ParameterizeOptions& options = arguments.options;
  std::vector<std::pair<std::string, AnyMethod>> methods;
  for (const MethodInfo& info : mapping_methods()) methods.emplace_back(info.name, info.method);
  command
      .choice("--method", arguments.method, methods,
              "How; paper to flow: as printed, folds and all; after paper, as others published "
              "them; radial: directions from a centre (default: progressive)")
      .number("--lambda", options.energy.lambda, "NUMBER", lambdas,
              "Weight of area against angle, " + lambdas.text())
      .flag("--repair-map", options.repair_paper,
            "Untangle what --method paper or one of others folds")
      .flag("--keep-folded", arguments.keep_folded,
            "Write a folded map too, marked in its header; the exit status stays 5; with --method "
            "radial, untangle nothing")
      .threads(arguments);
}

void declare_frame(Declaration& command, MapArguments& arguments) {
  command.group("Vertices, by their numbers in the file, from 0")
      .text("--poles", arguments.poles, "auto|none|up|V1,V2",
            "The vertices that go to +z and -z; up: the mesh's top and bottom")
      .number("--meridian", arguments.options.meridian, "V", {0}, "The vertex that gets theta = 0")
      .text("--pin", arguments.pins, "FILE",
            "Vertices to be exactly at given points; a line is: vertex theta phi (radians)")
      .group("As the mesh stands: top and bottom at the poles, the front at theta = 0")
      .up(arguments.up)
      .group("The sphere of another mesh")
      .text("--like", arguments.like, "FILE",
            "Map this mesh, which lies where that one does, so that both mean the same in every "
            "direction")
      .group("The axes of a body")
      .text("--align", arguments.align, "body|FILE",
            "Turn the map to the directions from the centre, or to another map of the mesh")
      .parsed(
          "--centre", centre_pattern,
          [&arguments](const std::string& text) { return read_centre(text, arguments.centre); },
          wanted_centre,
          "The centre of --method radial and --align body, in the mesh's coordinates, or that of "
          "what it encloses")
      .preset("0,0,0");
}

const Words progressive_only = {"--balance", "--quality", "--energy"};

void declare_progressive(Declaration& command, MapArguments& arguments) {
  ParameterizeOptions& options = arguments.options;
  command.group("With --method progressive")
      .text("--balance", arguments.balance, "conformal|balanced|equal-area|NUMBER",
            "Angle against area; a number is a --lambda")
      .choice("--quality", options.quality,
              {{name_of(Quality::Draft), Quality::Draft},
               {name_of(Quality::Normal), Quality::Normal},
               {name_of(Quality::Best), Quality::Best}},
              "Time against distortion (default: normal)")
      .choice("--energy", options.energy.kind,
              {{name_of(EnergyKind::AngleAndArea), EnergyKind::AngleAndArea},
               {name_of(EnergyKind::SymmetricDirichlet), EnergyKind::SymmetricDirichlet}},
              "What is minimised (default: angle-and-area)");
}

const Words paper_only = {"--weights", "--epsilon", "--iterations", "--rings", "--sweeps"};

void declare_paper(Declaration& command, PaperSettings& paper) {
  command.group("With --method paper")
      .choice("--weights", paper.weights,
              {{name_of(WeightKind::MeanValue), WeightKind::MeanValue},
               {name_of(WeightKind::Cotangent), WeightKind::Cotangent}},
              "Of the edges (default: mean-value)")
      .number("--epsilon", paper.epsilon, "RADIANS", {1e-9, 1.5, "1e-9 to 1.5"},
              "phi of the ring about a pole")
      .number("--iterations", paper.iterations, "N", {0, 1000}, "Quasi-harmonic iterations")
      .number("--rings", paper.rings, "N", {0, 1000}, "Rings about the date line that are smoothed")
      .number("--sweeps", paper.sweeps, "N", {0, 1000}, "Sweeps of tangential smoothing");
}

}  // namespace

void declare_map_options(Declaration& command, MapArguments& arguments) {
  arguments.given = command.given();
  declare_files(command, arguments);
  declare_method(command, arguments);
  declare_frame(command, arguments);
  declare_progressive(command, arguments);
  declare_paper(command, arguments.options.paper);
  declare_repair_and_loops(command, arguments.repair);
  command.console(arguments);
}

void settle(MapArguments& arguments) {
  ParameterizeOptions& options = arguments.options;
  require_only_like(arguments);
  require_method(arguments, Method::Progressive, progressive_only);
  require_method(arguments, Method::Paper, paper_only);
  require_no_settings(arguments);
  if (const auto* own = std::get_if<Method>(&arguments.method)) options.method = *own;
  settle_poles(arguments.poles, options);
  if (!arguments.like.empty()) options.automatic_poles = false;
  options.filler_share = wanted_filler_share(arguments.repair);
  settle_balance(arguments.balance, arguments.given("--lambda"), options);
  const bool weighted = arguments.given("--lambda") || arguments.given("--balance");
  if (weighted && options.energy.kind == EnergyKind::SymmetricDirichlet) {
    throw UsageMistake(
        "--lambda and --balance weigh the energy angle-and-area; symmetric-dirichlet has no "
        "weight");
  }
  require_one_frame(arguments);
  require_sensible_frame(arguments);
  settle_upright(arguments);
  settle_sphere(arguments);
  require_sensible(arguments);
  options.threads = arguments.threads;
  // What folds in the directions of a body may be what one wants to see.
  options.repair = !(arguments.keep_folded && options.method == Method::Radial);
  options.measure_stages = arguments.method == AnyMethod(Method::Paper) || arguments.verbose;
}

}  // namespace sphparam::cli
