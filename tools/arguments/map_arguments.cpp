// The options of `sphparam map`, and what they may not say together.

#include "arguments/map_arguments.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <limits>
#include <optional>
#include <vector>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "console/paths.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/names.h"

namespace sphparam::cli {

namespace {

constexpr double least_lambda = 1e-8, greatest_lambda = 1e3;
const std::string lambda_range = "1e-8 to 1000";

constexpr char summary[] =
    "Map a closed genus-0 mesh one-to-one onto the unit sphere, prove it, write it.\n"
    "\n"
    "Examples:\n"
    "  sphparam map statue.obj -o statue.sph.ply\n"
    "  sphparam map statue.ply -o statue.sph.ply --json map.json --charts charts/\n"
    "  sphparam map statue.off -o statue.sph.ply --write-sphere sphere.obj --poles 17,4203\n"
    "  sphparam map statue.obj -o placed.sph.ply --pin eyes.txt\n"
    "  sphparam map statue.obj -o even.sph.ply --balance equal-area --quality best\n"
    "  cat statue.obj | sphparam map - -o - > statue.sph.ply\n"
    "  sphparam map scan.ply -o scan.sph.ply --repair\n"
    "  sphparam map statue.obj -o folded.sph.ply --method paper --keep-folded\n"
    "  sphparam map statue.obj -o mended.sph.ply --method tangential --repair-map\n";

/// "17,23" → vertices 17 and 23; nothing if that is not what the text is.
std::optional<Poles> two_vertices(const std::string& text) {
  Poles poles{};
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, poles.north);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != ',') return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, poles.south);
  if (second.ec != std::errc{} || second.ptr != end) return std::nullopt;
  const bool make_sense = poles.north >= 0 && poles.south >= 0 && poles.north != poles.south;
  return make_sense ? std::optional(poles) : std::nullopt;
}

void settle_poles(const std::string& text, ParameterizeOptions& options) {
  options.automatic_poles = text != "none";
  if (text == "auto" || text == "none") return;
  options.poles = two_vertices(text);
  if (options.poles) return;
  throw UsageMistake("--poles: expected auto, none or two different vertices, as in 17,23");
}

/// `--balance` is a word or a number; a number is the λ of `--lambda`.
void settle_balance(const std::string& text, bool lambda_given, ParameterizeOptions& options) {
  const std::vector<std::string> words = {name_of(Balance::Conformal), name_of(Balance::Lambda),
                                          name_of(Balance::EqualArea)};
  if (text == words[1]) return;
  if (lambda_given) throw UsageMistake("--balance " + text + " and --lambda contradict each other");
  if (text == words[0] || text == words[2]) {
    options.balance = text == words[0] ? Balance::Conformal : Balance::EqualArea;
    return;
  }
  double& lambda = options.energy.lambda;
  const bool is_number = CLI::detail::lexical_cast(text, lambda);
  if (is_number && lambda >= least_lambda && lambda <= greatest_lambda) return;
  const std::string meant = is_number ? "" : nearest_word(text, words);
  throw UsageMistake("--balance: expected conformal, balanced, equal-area or a number from " +
                     lambda_range + (meant.empty() ? "" : "; did you mean " + meant + "?"));
}

/// Methods of others have no options: they run as published.
void require_no_settings(const CLI::App& command, AnyMethod method) {
  if (!std::holds_alternative<Baseline>(method)) return;
  for (const char* name : {"--poles", "--meridian", "--pin"}) {
    if (command.count(name) == 0) continue;
    throw UsageMistake(std::string(name) + " is not for --method " + info_of(method).name +
                       ", which lays out the sphere in its own way");
  }
  if (command.count("--lambda") > 0 && command.count("--repair-map") == 0) {
    throw UsageMistake(std::string("--lambda is for --method ") + info_of(method).name +
                       " only with --repair-map");
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

void require_sensible(const MapArguments& arguments) {
  if (is_stream(arguments.input) && is_stream(arguments.pins)) {
    throw UsageMistake("the mesh and --pin cannot both come from standard input");
  }
  const std::string extension = extension_of(arguments.output);
  if (!extension.empty() && extension != ".ply") {
    throw UsageMistake("-o: the map is a PLY, the name must end in .ply; for " + extension +
                       " see --write-sphere");
  }
  const bool is_named = !extension_of(arguments.sphere).empty();
  if (!arguments.sphere.empty() && !(is_named && is_written(arguments.sphere))) {
    throw UsageMistake("--write-sphere: the name must end in .ply, .obj, .off or .gii");
  }
  check_places(
      {arguments.input, arguments.pins},
      {{"-o", arguments.output}, {"--write-sphere", arguments.sphere}, {"--json", arguments.json}},
      arguments.charts);
}

/// Options that only the paper's method reads.
std::vector<CLI::Option*> add_paper_options(CLI::App& command, MapArguments& arguments) {
  PaperSettings& paper = arguments.options.paper;
  const std::string group = "With --method paper";
  return {add_choice<WeightKind>(command, "--weights", paper.weights,
                                 {{name_of(WeightKind::MeanValue), WeightKind::MeanValue},
                                  {name_of(WeightKind::Cotangent), WeightKind::Cotangent}},
                                 "Of the edges (default: mean-value)")
              ->group(group),
          command.add_option("--epsilon", paper.epsilon, "phi of the ring about a pole")
              ->check(between(1e-9, 1.5, "1e-9 to 1.5"))
              ->type_name("RADIANS")
              ->capture_default_str()
              ->group(group),
          command.add_option("--iterations", paper.iterations, "Quasi-harmonic iterations")
              ->check(between(0, 1000, "0 to 1000"))
              ->type_name("N")
              ->capture_default_str()
              ->group(group),
          command.add_option("--rings", paper.rings, "Rings about the date line that are smoothed")
              ->check(between(0, 1000, "0 to 1000"))
              ->type_name("N")
              ->capture_default_str()
              ->group(group),
          command.add_option("--sweeps", paper.sweeps, "Sweeps of tangential smoothing")
              ->check(between(0, 1000, "0 to 1000"))
              ->type_name("N")
              ->capture_default_str()
              ->group(group)};
}

void add_files(CLI::App& command, MapArguments& arguments) {
  command.add_option("MESH", arguments.input, readable_formats("or") + "; - for standard input")
      ->type_name(" ")
      ->required();
  command.add_option("-o,--output", arguments.output, "The map, a .sph.ply; - for standard output")
      ->type_name("FILE")
      ->required();
  command
      .add_option(
          "--write-sphere", arguments.sphere,
          "The bare sphere too: .ply, .obj or .off in doubles, .gii in floats of radius 100")
      ->type_name("FILE");
  add_json(command, arguments.json);
  command.add_option("--charts", arguments.charts, "The distortion as SVG charts")
      ->type_name("FOLDER");
}

void add_method(CLI::App& command, MapArguments& arguments) {
  ParameterizeOptions& options = arguments.options;
  std::vector<std::pair<std::string, AnyMethod>> methods;
  for (const MethodInfo& info : all_methods()) methods.emplace_back(info.name, info.method);
  add_choice<AnyMethod>(command, "--method", arguments.method, methods,
                        "How; paper and all after it: as printed, folds and all; after paper, as "
                        "others published them (default: progressive)");
  command
      .add_option("--lambda", options.energy.lambda,
                  "Weight of area against angle, " + lambda_range)
      ->check(between(least_lambda, greatest_lambda, lambda_range))
      ->type_name("NUMBER")
      ->capture_default_str();
  command.add_flag("--repair-map", options.repair_paper,
                   "Untangle what --method paper or one of others folds");
  command.add_flag("--keep-folded", arguments.keep_folded,
                   "Write a folded map too, marked in its header; the exit status stays 5");
  add_threads(command, options.threads);
}

void add_frame(CLI::App& command, MapArguments& arguments) {
  const std::string group = "Vertices, by their numbers in the file, from 0";
  command.add_option("--poles", arguments.poles, "The vertices that go to +z and -z, or none")
      ->type_name("auto|none|V1,V2")
      ->capture_default_str()
      ->group(group);
  command.add_option("--meridian", arguments.options.meridian, "The vertex that gets theta = 0")
      ->check(between(0, std::numeric_limits<Vertex>::max(), "0 on"))
      ->type_name("V")
      ->group(group);
  command
      .add_option("--pin", arguments.pins,
                  "Vertices to be exactly at given points; a line is: vertex theta phi (radians)")
      ->type_name("FILE")
      ->group(group);
}

/// Options that only the progressive method reads.
std::vector<CLI::Option*> add_progressive_options(CLI::App& command, MapArguments& arguments) {
  ParameterizeOptions& options = arguments.options;
  const std::string group = "With --method progressive";
  return {
      command
          .add_option("--balance", arguments.balance, "Angle against area; a number is a --lambda")
          ->type_name("conformal|balanced|equal-area|NUMBER")
          ->capture_default_str()
          ->group(group),
      add_choice<Quality>(command, "--quality", options.quality,
                          {{name_of(Quality::Draft), Quality::Draft},
                           {name_of(Quality::Normal), Quality::Normal},
                           {name_of(Quality::Best), Quality::Best}},
                          "Time against distortion (default: normal)")
          ->group(group),
      add_choice<EnergyKind>(
          command, "--energy", options.energy.kind,
          {{name_of(EnergyKind::AngleAndArea), EnergyKind::AngleAndArea},
           {name_of(EnergyKind::SymmetricDirichlet), EnergyKind::SymmetricDirichlet}},
          "What is minimised (default: angle-and-area)")
          ->group(group)};
}

void require_method(const std::vector<CLI::Option*>& given, Method needed, AnyMethod method) {
  for (const CLI::Option* option : given) {
    if (option->count() == 0 || method == AnyMethod(needed)) continue;
    throw UsageMistake(option->get_name() + " is for --method " + name_of(needed) + " only");
  }
}

}  // namespace

MapDeclaration declare_map_arguments(CLI::App& program, MapArguments& arguments) {
  CLI::App* command = program.add_subcommand("map", summary);
  add_files(*command, arguments);
  add_method(*command, arguments);
  add_frame(*command, arguments);
  const std::vector<CLI::Option*> progressive_only = add_progressive_options(*command, arguments);
  const std::vector<CLI::Option*> paper_only = add_paper_options(*command, arguments);
  add_repair_options(*command, arguments.repair);
  add_progress(*command, arguments.progress);
  add_loudness(*command, arguments.loudness);
  return {command, [&arguments, command, progressive_only, paper_only] {
            ParameterizeOptions& options = arguments.options;
            require_method(progressive_only, Method::Progressive, arguments.method);
            require_method(paper_only, Method::Paper, arguments.method);
            require_no_settings(*command, arguments.method);
            if (const auto* own = std::get_if<Method>(&arguments.method)) options.method = *own;
            settle_poles(arguments.poles, options);
            settle_balance(arguments.balance, command->count("--lambda") > 0, options);
            const bool weighted = command->count("--lambda") + command->count("--balance") > 0;
            if (weighted && options.energy.kind == EnergyKind::SymmetricDirichlet) {
              throw UsageMistake(
                  "--lambda and --balance weigh the energy angle-and-area; "
                  "symmetric-dirichlet has no weight");
            }
            require_sensible_frame(arguments);
            require_sensible(arguments);
            options.measure_stages =
                arguments.method == AnyMethod(Method::Paper) || arguments.loudness.verbose;
          }};
}

}  // namespace sphparam::cli
