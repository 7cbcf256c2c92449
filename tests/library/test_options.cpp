#include <array>
#include <catch2/catch.hpp>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "curvilinear/curvilinear_map.h"
#include "curvilinear/paper_map.h"
#include "curvilinear/tangential_smoothing.h"
#include "embedding/constructions/float32_safe.h"
#include "embedding/constructions/gnomonic.h"
#include "embedding/constructions/grid_lift.h"
#include "embedding/constructions/progressive.h"
#include "embedding/constructions/untangle.h"
#include "embedding/frame/axis_choice.h"
#include "embedding/frame/pole_placement.h"
#include "embedding/newton/optimise.h"
#include "mesh/rings.h"
#include "sphparam/baselines/brechbuehler.h"
#include "sphparam/baselines/conformal.h"
#include "sphparam/baselines/curvature_flow.h"
#include "sphparam/baselines/hemispheres.h"
#include "sphparam/baselines/stereographic.h"
#include "sphparam/baselines/tangential.h"
#include "sphparam/mesh/curvature.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/spherical_harmonics.h"
#include "support/reference_newton.h"
#include "support/test_meshes.h"

// What an option may be is said in its header; anything else ends with its name before any work.
// That no work was done is seen by the callback, which every function asks when it begins.

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct Shape {
  TriangleMesh mesh = icosphere(2);
  Topology topology{mesh};
  RestTriangles source = measure_source(mesh);
  SphereMap map = normalised(mesh.positions);
};

const Shape& shape() {
  static const Shape instance;
  return instance;
}

const Vertex beyond = static_cast<Vertex>(icosphere(2).vertex_count());

Progress never() {
  return [](std::string_view stage, double) {
    FAIL("work was begun: " << stage);
    return false;
  };
}

void check_refused(const std::string& option, const std::function<void()>& call) {
  INFO(option);
  try {
    call();
    FAIL_CHECK("no exception");
  } catch (const std::invalid_argument& error) {
    CHECK_THAT(error.what(), Catch::StartsWith(option + " is ") && Catch::Contains("must be"));
  }
}

/// Options with one of them at each bad value in turn.
template <class Options, class Value>
class Refusals {
 public:
  using Call = std::function<void(const Options&)>;

  explicit Refusals(Call call) : call_(std::move(call)) {}

  Refusals& of(const std::string& name, Value Options::*option,
               std::initializer_list<Value> values) {
    for (const Value value : values) {
      Options options;
      if constexpr (requires { options.progress; }) options.progress = never();
      options.*option = value;
      check_refused(name, [&] { call_(options); });
    }
    return *this;
  }

 private:
  Call call_;
};

template <class Options>
using Numbers = Refusals<Options, double>;
template <class Options>
using Counts = Refusals<Options, int>;

/// Options that have an energy, which is to be one.
template <class Options>
void check_energy(const std::function<void(const Options&)>& call) {
  for (const double lambda : {no_number, -1.0, -1e-300, infinity, 2e6}) {
    Options options;
    options.progress = never();
    options.energy.lambda = lambda;
    check_refused("energy.lambda", [&] { call(options); });
  }
  for (const double epsilon : {no_number, -1.0, infinity}) {
    Options options;
    options.progress = never();
    options.energy.epsilon = epsilon;
    check_refused("energy.epsilon", [&] { call(options); });
  }
  Options options;
  options.progress = never();
  options.energy.kind = static_cast<EnergyKind>(2);
  check_refused("energy.kind", [&] { call(options); });
}

}  // namespace

TEST_CASE("options: parameterize and repair_map refuse what is outside of a domain, by name") {
  const auto& [mesh, topology, source, map] = shape();
  const std::array<std::function<void(const ParameterizeOptions&)>, 3> calls{
      [&](const ParameterizeOptions& o) { parameterize(mesh, o); },
      [&](const ParameterizeOptions& o) { parameterize(mesh, topology, o); },
      [&](const ParameterizeOptions& o) { repair_map(mesh, map, o); }};
  for (const auto& call : calls) {
    check_energy<ParameterizeOptions>(call);
    Numbers<ParameterizeOptions>(call).of("sweeps", &ParameterizeOptions::sweeps,
                                          {no_number, -1, infinity});
    const auto refused = [&](const std::string& option, const auto& change) {
      ParameterizeOptions options;
      options.progress = never();
      change(options);
      check_refused(option, [&] { call(options); });
    };
    using Options = ParameterizeOptions;
    refused("energy.lambda", [](Options& o) { o.energy.lambda = 0; });
    refused("method", [](Options& o) { o.method = static_cast<Method>(4); });
    refused("quality", [](Options& o) { o.quality = static_cast<Quality>(-1); });
    refused("balance", [](Options& o) { o.balance = static_cast<Balance>(7); });
    refused("paper.weights", [](Options& o) { o.paper.weights = static_cast<WeightKind>(9); });
    for (const double bad : {no_number, -0.1, 0.0, 1.6, infinity}) {
      refused("paper.epsilon", [=](Options& o) { o.paper.epsilon = bad; });
    }
    refused("paper.iterations", [](Options& o) { o.paper.iterations = -1; });
    refused("paper.rings", [](Options& o) { o.paper.rings = -1; });
    refused("paper.sweeps", [](Options& o) { o.paper.sweeps = -1; });
    for (const Vertex bad : {-1, beyond}) {
      refused("poles.north", [=](Options& o) { o.poles = Poles{bad, 0}; });
      refused("poles.south", [=](Options& o) { o.poles = Poles{0, bad}; });
      refused("meridian", [=](Options& o) { o.meridian = bad; });
      refused("pins: vertex", [=](Options& o) { o.pins = {{bad, {0, 1}}}; });
    }
    refused("poles.south", [](Options& o) { o.poles = Poles{3, 3}; });
    for (const double bad : {no_number, infinity}) {
      refused("centre", [=](Options& o) { o.centre.y() = bad; });
      refused("pins: theta", [=](Options& o) { o.pins = {{0, {bad, 1}}}; });
      refused("pins: phi", [=](Options& o) { o.pins = {{0, {1, bad}}}; });
    }
  }
}

TEST_CASE("options: two pins in one direction are refused, however it is written") {
  constexpr double turn = 2 * std::numbers::pi;
  const TriangleMesh& mesh = shape().mesh;
  using Places = std::array<SphericalCoordinates, 2>;
  for (const Places& same : {Places{{{0, 1}, {0, 1}}}, Places{{{0, 1}, {turn, 1}}},
                             Places{{{1, 1}, {1 + turn, 1}}}, Places{{{0, 1}, {turn / 2, -1}}},
                             Places{{{1, 0}, {2, 0}}}, Places{{{1, turn / 2}, {2, turn / 2}}}}) {
    CHECK_THROWS_WITH(
        parameterize(mesh, {.pins = {{3, same[0]}, {4, same[1]}}, .progress = never()}),
        "vertex 4 is pinned where another one, or one of the poles, is");
  }
  CHECK_THROWS_AS(parameterize(mesh, {.poles = Poles{0, 1}, .pins = {{3, {1, 0}}}}),
                  std::invalid_argument);
  const Progress stop = [](std::string_view, double) { return false; };
  CHECK_THROWS_AS(parameterize(mesh, {.pins = {{3, {0, 1}}, {4, {1e-14, 1}}}, .progress = stop}),
                  Cancelled);
}

TEST_CASE("options: the embedding's functions refuse what is outside of a domain, by name") {
  const auto& [mesh, topology, source, map] = shape();
  const std::vector<Vertex> strangers{0, beyond};

  const auto embed = [&](const ProgressiveOptions& o) { embed_progressively(mesh, topology, o); };
  check_energy<ProgressiveOptions>(embed);
  Numbers<ProgressiveOptions>(embed)
      .of("sweeps", &ProgressiveOptions::sweeps, {no_number, -1, infinity})
      .of("over_relaxation", &ProgressiveOptions::over_relaxation, {no_number, -1, infinity})
      .of("least_area", &ProgressiveOptions::least_area, {no_number, -1, 2});
  Counts<ProgressiveOptions>(embed)
      .of("most_sweeps", &ProgressiveOptions::most_sweeps, {-1})
      .of("retries", &ProgressiveOptions::retries, {-1, 21})
      .of("pin_level", &ProgressiveOptions::pin_level, {-1});
  const Vector3 up(0, 0, 1);
  for (const std::vector<Pin>& pins :
       {std::vector<Pin>{{beyond, up}}, std::vector<Pin>{{1, up}, {1, -up}}}) {
    check_refused("pins: vertex", [&] { embed({.pins = pins, .progress = never()}); });
    check_refused("pins: vertex", [&] { place_landmarks(topology, source, map, pins, {}); });
  }
  for (const Vector3& point : {Vector3(0, 0, 0), Vector3(no_number, 0, 0), Vector3(0, 0, 2)}) {
    check_refused("pins: squared length of the point", [&] { embed({.pins = {{0, point}}}); });
  }

  const auto relaxed = [&](const RelaxationOptions& o) { relax(topology, source, map, o); };
  check_energy<RelaxationOptions>(relaxed);
  Counts<RelaxationOptions>(relaxed).of("sweeps", &RelaxationOptions::sweeps, {-1});
  Numbers<RelaxationOptions>(relaxed).of("over_relaxation", &RelaxationOptions::over_relaxation,
                                         {no_number, -1, infinity});
  check_refused("vertices", [&] { relaxed({.vertices = strangers}); });
  check_refused("pinned", [&] { relaxed({.pinned = strangers}); });

  const auto newton = [&](const NewtonOptions& o) { minimise_by_newton(topology, source, map, o); };
  check_energy<NewtonOptions>(newton);
  Counts<NewtonOptions>(newton).of("max_steps", &NewtonOptions::max_steps, {-1});
  Numbers<NewtonOptions>(newton).of("least_gain", &NewtonOptions::least_gain, {no_number, -1, 2});
  check_refused("vertices", [&] { newton({.vertices = strangers}); });
  check_refused("pinned", [&] { newton({.pinned = strangers}); });

  const auto optimised = [&](const OptimiseOptions& o) { optimise(topology, source, map, o); };
  check_energy<OptimiseOptions>(optimised);
  Numbers<OptimiseOptions>(optimised)
      .of("least_gain", &OptimiseOptions::least_gain, {no_number, -1, 2})
      .of("least_share", &OptimiseOptions::least_share, {no_number, -1, 2});
  Counts<OptimiseOptions>(optimised)
      .of("max_steps", &OptimiseOptions::max_steps, {-1})
      .of("sweeps", &OptimiseOptions::sweeps, {-1});
  check_refused("pinned", [&] { optimised({.pinned = strangers}); });

  const auto balanced = [&](const BalanceOptions& o) {
    optimise_balance(topology, source, map, o);
  };
  Numbers<BalanceOptions>(balanced)
      .of("from_lambda", &BalanceOptions::from_lambda, {no_number, -1, 0, infinity})
      .of("area_error", &BalanceOptions::area_error, {no_number, -1, infinity});
  for (const double lambda : {no_number, -1.0, 0.0, infinity}) {
    check_refused("energy.lambda", [&] { balanced({.optimise = {.energy = {.lambda = lambda}}}); });
  }
  check_refused("balance", [&] { balanced({.balance = static_cast<Balance>(3)}); });

  const auto untangled = [&](const UntangleOptions& o) { untangle(topology, source, map, o); };
  Numbers<UntangleOptions>(untangled)
      .of("lambda", &UntangleOptions::lambda, {no_number, -1, infinity})
      .of("max_work", &UntangleOptions::max_work, {no_number, -1});
  Counts<UntangleOptions>(untangled)
      .of("rings", &UntangleOptions::rings, {-1})
      .of("max_rounds", &UntangleOptions::max_rounds, {-1})
      .of("max_patch", &UntangleOptions::max_patch, {-1})
      .of("max_steps", &UntangleOptions::max_steps, {-1});
  check_refused("pinned", [&] { untangled({.pinned = strangers}); });

  const auto lifted = [&](const GnomonicOptions& o) { gnomonic_embedding(mesh, topology, o); };
  Numbers<GnomonicOptions>(lifted).of("lambda", &GnomonicOptions::lambda,
                                      {no_number, -1, infinity});
  Counts<GnomonicOptions>(lifted)
      .of("reweightings", &GnomonicOptions::reweightings, {-1})
      .of("sweeps", &GnomonicOptions::sweeps, {-1});
  check_refused("south", [&] { lifted({.south = beyond}); });
  check_refused("south", [&] { tutte_disk(mesh, topology, -1); });

  const auto on_grid = [&](const GridLiftOptions& o) { grid_lift(mesh, topology, o); };
  check_energy<GridLiftOptions>(on_grid);
  Counts<GridLiftOptions>(on_grid).of("sweeps", &GridLiftOptions::sweeps, {-1});

  const auto rounded = [&](const Float32SafeOptions& o) {
    round_float32_safe(mesh, topology, map, o);
  };
  check_energy<Float32SafeOptions>(rounded);

  const auto pinned = [&](const LandmarkOptions& o) {
    place_landmarks(topology, source, map, {{0, up}}, o);
  };
  check_energy<LandmarkOptions>(pinned);
  Counts<LandmarkOptions>(pinned)
      .of("sweeps", &LandmarkOptions::sweeps, {-1})
      .of("most_rounds", &LandmarkOptions::most_rounds, {-1})
      .of("most_detours", &LandmarkOptions::most_detours, {-1});
}

TEST_CASE("options: axes and poles refuse what is outside of a domain, by name") {
  const auto& [mesh, topology, source, map] = shape();
  for (const int candidates : {0, -1}) {
    check_refused("candidates",
                  [&] { choose_axis(topology, source, map, {.candidates = candidates}); });
  }
  const auto on_axis = [&](const PolePlacementOptions& o) {
    place_poles_on_axis(topology, source, map, {0, 1, 0}, o);
  };
  const auto at = [&](const PolePlacementOptions& o) {
    place_poles(topology, source, map, 0, 3, o);
  };
  for (const std::function<void(const PolePlacementOptions&)>& call :
       {std::function<void(const PolePlacementOptions&)>(on_axis),
        std::function<void(const PolePlacementOptions&)>(at)}) {
    check_energy<PolePlacementOptions>(call);
    Counts<PolePlacementOptions>(call)
        .of("sweeps", &PolePlacementOptions::sweeps, {-1})
        .of("most_moves", &PolePlacementOptions::most_moves, {0, -1});
  }
  for (const Vector3& axis : {Vector3(0, 0, 0), Vector3(no_number, 0, 1)}) {
    check_refused("axis: squared length",
                  [&] { place_poles_on_axis(topology, source, map, axis); });
  }
  check_refused("north", [&] { place_poles(topology, source, map, -1, 3); });
  check_refused("south", [&] { place_poles(topology, source, map, 3, beyond); });
  check_refused("meridian", [&] { turned_to_meridian(map, beyond); });
  check_refused("poles.north", [&] { nearest_usable_poles(topology, {beyond, 0}); });
}

TEST_CASE("options: the paper's methods refuse what is outside of a domain, by name") {
  const auto& [mesh, topology, source, map] = shape();
  const Poles poles = *choose_poles(mesh, topology);
  const auto printed = [&](const PaperOptions& o) {
    map_as_paper(mesh, topology, poles, o, never());
  };
  Numbers<PaperOptions>(printed).of("epsilon", &PaperOptions::epsilon,
                                    {no_number, -1, 0, 1.6, infinity});
  Counts<PaperOptions>(printed)
      .of("iterations", &PaperOptions::iterations, {-1})
      .of("rings", &PaperOptions::rings, {-1})
      .of("sweeps", &PaperOptions::sweeps, {-1});
  check_refused("weights", [&] { printed({.weights = static_cast<WeightKind>(3)}); });
  check_refused("poles.south", [&] { map_as_paper(mesh, topology, {0, beyond}, {}, never()); });

  const auto sound = [&](const CurvilinearOptions& o) {
    map_curvilinear(mesh, topology, poles, o, never());
  };
  Numbers<CurvilinearOptions>(sound).of("epsilon", &CurvilinearOptions::epsilon,
                                        {no_number, -1, 1.6});
  Counts<CurvilinearOptions>(sound).of("iterations", &CurvilinearOptions::iterations, {-1});
  check_refused("poles.north", [&] { map_curvilinear(mesh, topology, Poles{-1, 0}, {}, never()); });

  const DateLine line = shortest_date_line(mesh, topology, poles);
  const auto smooth = [&](const SmoothingOptions& o) {
    smooth_date_line(mesh, topology, line, map, o);
  };
  Counts<SmoothingOptions>(smooth)
      .of("rings", &SmoothingOptions::rings, {-1})
      .of("sweeps", &SmoothingOptions::sweeps, {-1});
}

TEST_CASE("options: the methods of others refuse what is outside of a domain, by name") {
  const auto& [mesh, topology, source, map] = shape();
  const auto heat = [&](const BrechbuehlerOptions& o) {
    map_brechbuehler(mesh, topology, o, never());
  };
  Counts<BrechbuehlerOptions>(heat).of("max_steps", &BrechbuehlerOptions::max_steps, {-1});
  Numbers<BrechbuehlerOptions>(heat)
      .of("least_gain", &BrechbuehlerOptions::least_gain, {no_number, -1, 2})
      .of("greatest_penalty", &BrechbuehlerOptions::greatest_penalty, {no_number, 0, infinity});
  check_refused("poles: north", [&] { heat({.poles = std::pair(beyond, 0)}); });
  check_refused("poles: south", [&] { heat({.poles = std::pair(0, -1)}); });

  const auto descent = [&](const ConformalOptions& o) {
    map_conformal(mesh, topology, o, never());
  };
  Counts<ConformalOptions>(descent).of("max_iterations", &ConformalOptions::max_iterations, {-1});
  Numbers<ConformalOptions>(descent).of("least_gain", &ConformalOptions::least_gain,
                                        {no_number, -1, 2});

  const auto flow = [&](const FlowOptions& o) { map_flow(mesh, topology, o, never()); };
  Counts<FlowOptions>(flow).of("max_steps", &FlowOptions::max_steps, {-1});
  Numbers<FlowOptions>(flow)
      .of("time_step", &FlowOptions::time_step, {no_number, -1, 0, infinity})
      .of("roundness", &FlowOptions::roundness, {no_number, -1, infinity});

  const auto halves = [&](const HemispheresOptions& o) {
    map_hemispheres(mesh, topology, o, never());
  };
  Counts<HemispheresOptions>(halves)
      .of("max_sweeps", &HemispheresOptions::max_sweeps, {-1})
      .of("max_steps", &HemispheresOptions::max_steps, {-1});
  Numbers<HemispheresOptions>(halves).of("tolerance", &HemispheresOptions::tolerance,
                                         {no_number, -1, infinity});
  check_refused("weights", [&] { halves({.weights = WeightKind::MeanValue}); });

  for (const Face cut : {-1, static_cast<Face>(mesh.face_count())}) {
    check_refused("cut", [&] { map_stereographic(mesh, topology, {.cut = cut}, never()); });
  }

  const auto smooth = [&](const TangentialOptions& o) {
    map_tangential(mesh, topology, o, never());
  };
  Counts<TangentialOptions>(smooth)
      .of("max_sweeps", &TangentialOptions::max_sweeps, {-1})
      .of("sweeps_per_anchors", &TangentialOptions::sweeps_per_anchors, {0, -1});
  Numbers<TangentialOptions>(smooth).of("rest", &TangentialOptions::rest,
                                        {no_number, -1, infinity});
}

TEST_CASE("options: meshes and harmonics refuse what is outside of a domain, by name") {
  const auto& [mesh, topology, source, map] = shape();
  const auto repair = [&](const RepairOptions& o) { repair_mesh(mesh, o); };
  Counts<RepairOptions>(repair)
      .of("component", &RepairOptions::component, {-1})
      .of("largest_hole", &RepairOptions::largest_hole, {2, -1});
  Numbers<RepairOptions>(repair)
      .of("longest_handle", &RepairOptions::longest_handle, {no_number, -1, infinity})
      .of("longest_handle_length", &RepairOptions::longest_handle_length,
          {no_number, -1, infinity});
  for (const double scale : {no_number, -1.0, infinity}) {
    check_refused("scale", [&] { measure_curvature(mesh, topology, scale); });
  }
  check_refused("vertices", [&] { rings_around(topology, {beyond}, 1); });
  check_refused("rings", [&] { rings_around(topology, {0}, -1); });
  const auto fit = [&](const HarmonicFitOptions& o) {
    fit_harmonics(topology, map, mesh.positions, o);
  };
  Counts<HarmonicFitOptions>(fit).of("most_iterations", &HarmonicFitOptions::most_iterations, {-1});
  Numbers<HarmonicFitOptions>(fit).of("tolerance", &HarmonicFitOptions::tolerance,
                                      {no_number, -1, 2});
}

TEST_CASE("options: the ends of the domains are maps") {
  const TriangleMesh mesh = random_sphere_mesh(60, 3);
  for (const double lambda : {least_lambda, greatest_lambda}) {
    for (const Quality quality : {Quality::Draft, Quality::Normal, Quality::Best}) {
      const auto result =
          parameterize(mesh, {.energy = {.lambda = lambda}, .quality = quality, .sweeps = 0});
      CHECK(result.certificate.bijective());
    }
  }
}
