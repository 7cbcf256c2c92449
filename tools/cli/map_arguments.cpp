// The options of `sphparam map`, and what they may not say together.

#include "cli/map_arguments.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>
#include <optional>
#include <vector>

#include "cli/choice.h"
#include "cli/paths.h"
#include "cli/wording.h"
#include "mesh_io/mesh_writer.h"

namespace sphparam::tools {

namespace {

constexpr char summary[] =
    "Map a closed genus-0 mesh one-to-one onto the unit sphere, prove it, write it.\n"
    "\n"
    "Examples:\n"
    "  sphparam map statue.obj -o statue.sph.ply\n"
    "  sphparam map statue.ply -o statue.sph.ply --json map.json --charts charts/\n"
    "  sphparam map statue.off -o statue.sph.ply --sphere sphere.obj --poles 17,4203\n"
    "  sphparam map statue.obj -o even.sph.ply --balance equal-area --quality best\n"
    "  cat statue.obj | sphparam map - -o - > statue.sph.ply\n"
    "  sphparam map statue.obj -o folded.sph.ply --method paper --keep-folded\n";

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

std::optional<Poles> parse_poles(const std::string& text) {
  if (text == "auto") return std::nullopt;
  const std::optional<Poles> poles = two_vertices(text);
  if (!poles) throw UsageMistake("--poles: expected auto or two different vertices, as in 17,23");
  return poles;
}

void require_sensible(const MapArguments& arguments) {
  const bool same = (!arguments.sphere.empty() && arguments.sphere == arguments.output) ||
                    (!arguments.json.empty() && arguments.json == arguments.output) ||
                    (!arguments.json.empty() && arguments.json == arguments.sphere);
  if (same) throw UsageMistake("-o, --sphere and --json must go to different places");
  require_not_input(arguments.input, arguments.output, "-o");
  require_not_input(arguments.input, arguments.sphere, "--sphere");
  require_not_input(arguments.input, arguments.json, "--json");
  const std::string extension = std::filesystem::path(arguments.output).extension();
  if (!extension.empty() && extension != ".ply") {
    throw UsageMistake("-o: the map is a PLY, the name must end in .ply; for " + extension +
                       " see --sphere");
  }
  if (!arguments.sphere.empty() && !serialiser(arguments.sphere)) {
    throw UsageMistake("--sphere: the name must end in .ply, .obj or .off");
  }
}

/// Options that only the paper's method reads.
std::vector<CLI::Option*> add_paper_options(CLI::App& command, MapArguments& arguments) {
  PaperSettings& paper = arguments.options.paper;
  const std::string group = "With --method paper";
  return {add_choice<WeightKind>(command, "--weights", paper.weights,
                                 {{name_of(WeightKind::MeanValue), WeightKind::MeanValue},
                                  {name_of(WeightKind::Cotangent), WeightKind::Cotangent}},
                                 "mean-value (default) or cotangent")
              ->type_name("KIND")
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
  command.add_option("MESH", arguments.input, "OBJ, PLY or OFF; - for standard input")
      ->type_name(" ")
      ->required();
  command.add_option("-o,--output", arguments.output, "The map, a .sph.ply; - for standard output")
      ->type_name("FILE")
      ->required();
  command.add_option("--sphere", arguments.sphere, "The bare sphere too: .ply, .obj or .off")
      ->type_name("FILE");
  command.add_option("--json", arguments.json, "A report; - for standard output")
      ->type_name("FILE");
  command.add_option("--charts", arguments.charts, "The distortion as SVG charts")
      ->type_name("FOLDER");
}

void add_method(CLI::App& command, MapArguments& arguments) {
  ParameterizeOptions& options = arguments.options;
  add_choice<Method>(command, "--method", options.method,
                     {{name_of(Method::Progressive), Method::Progressive},
                      {name_of(Method::Curvilinear), Method::Curvilinear},
                      {name_of(Method::Paper), Method::Paper}},
                     "progressive (default), curvilinear, or paper: as printed, folds and all")
      ->type_name("METHOD");
  command.add_option("--poles", arguments.poles, "Vertices that go to +z and -z, as 17,4203")
      ->type_name("auto|V1,V2")
      ->capture_default_str();
  command.add_option("--lambda", options.energy.lambda, "Weight of area against angle")
      ->check(between(1e-8, 1e3, "1e-8 to 1000"))
      ->type_name("NUMBER")
      ->capture_default_str();
  command.add_flag("--repair-map", options.repair_paper, "Untangle what --method paper folds");
  command.add_flag("--keep-folded", arguments.keep_folded,
                   "Write a folded map too, marked in its header; still ends with 5");
  command.add_option("--threads", options.threads, "How many threads (0: all cores); same bytes")
      ->check(between(0, 4096, "0 to 4096"))
      ->type_name("N")
      ->capture_default_str();
}

/// Options that only the progressive method reads.
std::vector<CLI::Option*> add_progressive_options(CLI::App& command, MapArguments& arguments) {
  ParameterizeOptions& options = arguments.options;
  const std::string group = "With --method progressive";
  return {add_choice<Balance>(command, "--balance", options.balance,
                              {{name_of(Balance::Conformal), Balance::Conformal},
                               {name_of(Balance::Lambda), Balance::Lambda},
                               {name_of(Balance::EqualArea), Balance::EqualArea}},
                              "balanced (default: what --lambda says), conformal or equal-area")
              ->type_name("WORD")
              ->group(group),
          add_choice<Quality>(command, "--quality", options.quality,
                              {{name_of(Quality::Draft), Quality::Draft},
                               {name_of(Quality::Normal), Quality::Normal},
                               {name_of(Quality::Best), Quality::Best}},
                              "draft, normal (default) or best: slower, less distortion")
              ->type_name("WORD")
              ->group(group),
          add_choice<EnergyKind>(
              command, "--energy", options.energy.kind,
              {{name_of(EnergyKind::AngleAndArea), EnergyKind::AngleAndArea},
               {name_of(EnergyKind::SymmetricDirichlet), EnergyKind::SymmetricDirichlet}},
              "angle-and-area (default) or symmetric-dirichlet")
              ->type_name("WORD")
              ->group(group)};
}

void require_method(const std::vector<CLI::Option*>& given, Method needed, Method method) {
  for (const CLI::Option* option : given) {
    if (option->count() == 0 || method == needed) continue;
    throw UsageMistake(option->get_name() + " is for --method " + name_of(needed) + " only");
  }
}

void add_progress(CLI::App& command, MapArguments& arguments) {
  add_choice<ProgressStyle>(
      command, "--progress", arguments.progress,
      {{"auto", ProgressStyle::Auto}, {"none", ProgressStyle::None}, {"json", ProgressStyle::Json}},
      "auto (on a terminal), none or json")
      ->type_name("STYLE");
}

}  // namespace

MapDeclaration declare_map_arguments(CLI::App& program, MapArguments& arguments) {
  CLI::App* command = program.add_subcommand("map", summary);
  add_files(*command, arguments);
  add_method(*command, arguments);
  const std::vector<CLI::Option*> progressive_only = add_progressive_options(*command, arguments);
  const std::vector<CLI::Option*> paper_only = add_paper_options(*command, arguments);
  add_progress(*command, arguments);
  add_loudness(*command, arguments.loudness);
  return {command, [&arguments, progressive_only, paper_only] {
            ParameterizeOptions& options = arguments.options;
            require_method(progressive_only, Method::Progressive, options.method);
            require_method(paper_only, Method::Paper, options.method);
            require_sensible(arguments);
            options.poles = parse_poles(arguments.poles);
            options.measure_stages = options.method == Method::Paper || arguments.loudness.verbose;
          }};
}

Serialiser serialiser(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension();
  if (extension == ".ply") return serialise_ply;
  if (extension == ".obj") return serialise_obj;
  if (extension == ".off") return serialise_off;
  return nullptr;
}

}  // namespace sphparam::tools
