#include "sphparam/parameterize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "embedding/freed_memory.h"
#include "sphparam/curvilinear/paper_map.h"
#include "sphparam/curvilinear/sound_map.h"
#include "sphparam/embedding/axis_choice.h"
#include "sphparam/embedding/gnomonic.h"
#include "sphparam/embedding/grid_lift.h"
#include "sphparam/embedding/landmarks.h"
#include "sphparam/embedding/pole_placement.h"
#include "sphparam/embedding/progressive.h"
#include "sphparam/embedding/relaxation.h"
#include "sphparam/embedding/untangle.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/rings.h"
#include "sphparam/stopwatch.h"

// The table of contents. Three methods, each a straight line of stages:
//   paper        poles → date line, cut, harmonic, quasi-harmonic, lift, smoothing
//   curvilinear  poles → the same, periodic and accumulated → relaxation along the date line
//   progressive  hierarchy, embedding
// Then the certificate; where it fails and repair is wanted: untangling, the progressive embedding,
// the one-vertex lift, the grid lift. A certified map without poles gets them last: given ones and
// pins are held while it is embedded anew, automatic ones chosen on the finished map. Whatever
// comes out last is certified as it is.

namespace sphparam {
namespace {

constexpr int date_line_rings = 5;    // the paper's five-neighbourhood (Section 5)
constexpr int date_line_sweeps = 10;  // of guarded relaxation there
constexpr double most_folds = 0.02;   // of the faces: beyond it nothing is local any more
constexpr double least_direct_lambda = 0.1, greatest_direct_lambda = 10;  // others by continuation
constexpr int pole_sweeps = 10;      // of pinned relaxation after poles were moved
constexpr int most_pole_moves = 20;  // on finished maps, which are fine: each costs such sweeps

/// The mesh at about unit size, if its squares could overflow or vanish; nothing if it is fine.
/// A power of two changes no bit of any mantissa, and maps do not depend on size.
std::optional<TriangleMesh> rescaled(const TriangleMesh& mesh) {
  constexpr int harmless = 100;  // binary orders of magnitude
  const int exponent = std::ilogb(mesh.positions.cwiseAbs().maxCoeff());
  if (exponent == FP_ILOGB0 || std::abs(exponent) <= harmless) return std::nullopt;
  TriangleMesh result = mesh;
  for (Eigen::Index i = 0; i < result.positions.size(); ++i) {
    result.positions.data()[i] = std::ldexp(result.positions.data()[i], -exponent);
  }
  return result;
}

class Pipeline {
 public:
  /// Borrows all three. Requires: `require_sphere` accepts them.
  Pipeline(const TriangleMesh& mesh, const Topology& topology, const ParameterizeOptions& options)
      : topology_(topology),
        rescaled_(rescaled(mesh)),
        mesh_(rescaled_ ? *rescaled_ : mesh),
        options_(options),
        energy_(options.energy) {
    if (options.poles) {
      require_vertex("pole", options.poles->north);
      require_vertex("pole", options.poles->south);
    }
    if (options.meridian) require_vertex("meridian", *options.meridian);
    require_pins();
    stopwatch_.lap();
  }

  Parameterization run() {
    switch (options_.method) {
      case Method::Paper:
        map_paper();
        break;
      case Method::Curvilinear:
        map_curvilinear();
        break;
      case Method::Progressive:
        map_progressive();
        break;
    }
    const bool wants_repair =
        options_.repair && (options_.method != Method::Paper || options_.repair_paper);
    if (wants_repair) repair();
    if (certified()) place_frame();
    return std::move(result_);
  }

  Parameterization run_from(const SphereMap& map) {
    accept("given map", map);
    repair();
    if (certified()) place_frame();
    return std::move(result_);
  }

 private:
  // --- the methods ---------------------------------------------------------------------------

  void map_paper() {
    const std::optional<Poles> poles = find_poles();
    if (!poles) return give_up("no usable pair of poles: the paper's method does not apply");
    const PaperSettings& s = options_.paper;
    const PaperOptions paper{s.epsilon, s.iterations, s.rings,
                             s.sweeps,  s.weights,    options_.threads};
    const auto on_stage = [this](const PaperStage& stage, const SphereMap& map) {
      result_.stages.push_back(
          {stage.name, stage.seconds, stage.planar_folds, count_folds(map), measured(map)});
    };
    PaperResult paper_map;
    try {
      paper_map = map_as_paper(mesh_, topology_, *poles, paper, options_.progress, on_stage);
    } catch (const SolveError& error) {  // as below
      return give_up(error.what());
    }
    result_.stages.insert(result_.stages.end() - static_cast<long>(paper_map.stages.size()),
                          {"date line", paper_map.path_seconds});
    result_.poles = poles;
    result_.date_line = std::move(paper_map.date_line);
    stopwatch_.lap();
    accept("smoothing", std::move(paper_map.map));
  }

  void map_curvilinear() {
    const std::optional<Poles> poles = find_poles();
    if (!poles) return give_up("no usable pair of poles");
    SoundMap sound;
    try {
      sound =
          map_periodic(mesh_, topology_, *poles, {.threads = options_.threads}, options_.progress);
    } catch (const SolveError& error) {  // no area anywhere, or limbs where doubles underflow
      return give_up(error.what());
    }
    result_.poles = poles;
    result_.date_line = std::move(sound.date_line);
    if (sound.clamped_weights > 0) {
      warn(std::to_string(sound.clamped_weights) + " weights of degenerate triangles were clamped");
    }
    record("curvilinear map", sound.map, sound.planar_folds);
    const RelaxationOptions relaxation{
        .energy = options_.energy,
        .sweeps = date_line_sweeps,
        .vertices = rings_around(topology_, result_.date_line->path, date_line_rings),
        .pinned = {poles->north, poles->south},
        .threads = options_.threads,
        .progress = options_.progress};
    SphereMap relaxed = relax(topology_, source(), sound.map, relaxation).map;
    record("relaxation", relaxed);
    accept("relaxation", std::move(relaxed));
  }

  void map_progressive() {
    if (!embed({})) give_up("the progressive embedding ran out of room");
  }

  // --- repair and fallbacks -------------------------------------------------------------------

  void repair() {
    if (!certified()) untangle_folds();
    if (!certified()) embed_from_nothing();
    if (!certified()) lift_one_vertex();
    if (!certified()) lift_grid();
  }

  void untangle_folds() {
    if (result_.map.points.rows() == 0) return;  // the method made no map
    if (static_cast<double>(result_.certificate.fold_count()) > most_folds * topology_.face_count())
      return;
    UntangleOptions untangling{.lambda = options_.energy.lambda,
                               .threads = options_.threads,
                               .progress = options_.progress};
    if (result_.poles) untangling.pinned = {result_.poles->north, result_.poles->south};
    SphereMap map = untangle(topology_, source(), result_.map, untangling).map;
    record("untangling", map);
    accept("untangling", std::move(map));
  }

  void embed_from_nothing() {
    if (tried_to_embed_ || !embed({})) return;
    forget_poles();
  }

  void lift_one_vertex() {
    GnomonicEmbedding embedding;
    try {
      embedding = gnomonic_embedding(mesh_, topology_,
                                     {.lambda = options_.energy.lambda,
                                      .threads = options_.threads,
                                      .progress = options_.progress});
    } catch (const SolveError& error) {  // limbs where doubles underflow
      return give_up(error.what());
    }
    forget_poles();
    record("one-vertex lift", embedding.map);
    accept("one-vertex lift", std::move(embedding.map));
  }

  void lift_grid() {
    GridLift lift = grid_lift(mesh_, topology_,
                              {.energy = {.lambda = options_.energy.lambda},
                               .threads = options_.threads,
                               .progress = options_.progress});
    if (!lift.bijective) return give_up("the grid lift found no room");
    forget_poles();
    warn("made by the last resort, the grid lift: one-to-one, but greatly distorted");
    record("grid lift", lift.map);
    accept("grid lift", std::move(lift.map));
  }

  bool embed(const std::vector<Pin>& pins) {
    tried_to_embed_ = true;
    DistortionEnergy energy = options_.energy;
    const bool balanced = needs_balancing();
    if (balanced) energy.lambda = first_lambda();
    ProgressiveEmbedding embedding = embed_progressively(
        mesh_, topology_,
        {.energy = energy,
         .quality = balanced ? std::min(options_.quality, Quality::Normal) : options_.quality,
         .sweeps = options_.sweeps,
         .pins = pins,
         .threads = options_.threads,
         .progress = options_.progress});
    if (!embedding.map) return false;
    record(pins.empty() ? "progressive embedding" : "pinned embedding", *embedding.map);
    if (balanced) *embedding.map = balance(*embedding.map, energy.lambda, pins);
    accept(balanced ? "balance" : "progressive embedding", std::move(*embedding.map));
    return true;
  }

  /// Is λ too far from 1 for sweeps and a few steps?
  bool needs_balancing() const {
    return options_.energy.kind == EnergyKind::AngleAndArea &&
           (options_.balance != Balance::Lambda || options_.energy.lambda != first_lambda());
  }

  double first_lambda() const {
    if (options_.balance != Balance::Lambda) return 1;
    return std::clamp(options_.energy.lambda, least_direct_lambda, greatest_direct_lambda);
  }

  SphereMap balance(const SphereMap& map, double from_lambda, const std::vector<Pin>& pins) {
    const double least_gain = options_.quality == Quality::Draft    ? 1e-2
                              : options_.quality == Quality::Normal ? 1e-3
                                                                    : 1e-6;
    BalancedMap result = optimise_balance(topology_, source(), map,
                                          {.balance = options_.balance,
                                           .from_lambda = from_lambda,
                                           .optimise = {.energy = options_.energy,
                                                        .least_gain = least_gain,
                                                        .pinned = vertices_of(pins),
                                                        .threads = options_.threads,
                                                        .progress = options_.progress}});
    energy_.lambda = result.lambda;
    record("balance", result.map);
    return std::move(result.map);
  }

  // --- poles ----------------------------------------------------------------------------------

  std::optional<Poles> find_poles() {
    report(options_.progress, "poles", 0);
    std::optional<Poles> poles = options_.poles ? nearest_usable_poles(topology_, *options_.poles)
                                                : choose_poles(mesh_, topology_);
    if (poles && options_.poles) {
      warn_if_moved("north", options_.poles->north, poles->north);
      warn_if_moved("south", options_.poles->south, poles->south);
    }
    result_.stages.push_back({"poles", stopwatch_.lap()});
    return poles;
  }

  /// Poles, pins and meridian of a finished map.
  void place_frame() {
    const std::vector<Pin> pins = wanted_pins();
    if (options_.method == Method::Paper && !options_.pins.empty()) {
      warn("the paper's method has no pins: they are where it puts them");
      result_.pin_residuals = pin_residuals(result_.map, pins);
    } else if (!pins.empty()) {
      hold(pins);
    }
    const bool free = pins.empty() && !options_.poles && !result_.poles;
    if (free && options_.automatic_poles) {
      choose_poles_on_map();
    } else if (options_.meridian) {
      turn(result_.map, *options_.meridian);
    }
  }

  /// Given poles, unless the map has them or they cannot be opposite, and the given pins.
  std::vector<Pin> wanted_pins() {
    std::vector<Pin> pins;
    if (options_.poles && !result_.poles) {
      const auto [north, south] = *options_.poles;
      if (north == south || topology_.find_halfedge(north, south) >= 0) {
        warn("the poles are the same or share an edge: they cannot lie opposite each other");
      } else {
        pins = {{north, Vector3::UnitZ()}, {south, -Vector3::UnitZ()}};
      }
    }
    for (const Landmark& pin : options_.pins) {
      pins.push_back({pin.vertex, to_cartesian(pin.coordinates)});
    }
    return pins;
  }

  /// Embeds the mesh anew around the pins. The map so far says what they cost, and comes back where
  /// that fails or poles alone are not reached.
  void hold(const std::vector<Pin>& pins) {
    const DistortionEnergy measure = energy_;
    const double energy =
        distortion_energy(topology_, source(), result_.map, measure, options_.threads);
    Parameterization before = result_;
    forget_poles();
    const bool held = embed(pins) && certified();
    if (!held || (options_.pins.empty() && !all_exact(pin_residuals(result_.map, pins)))) {
      result_ = std::move(before);
      if (options_.pins.empty()) move_to_poles({pins[0].vertex, pins[1].vertex});
    }
    const std::vector<double> residuals = pin_residuals(result_.map, pins);
    const auto of_pins = residuals.end() - std::ssize(options_.pins);
    result_.pin_residuals.assign(of_pins, residuals.end());
    if (of_pins != residuals.begin()) {  // the first two are the poles'
      if (residuals[0] == 0 && residuals[1] == 0) {
        result_.poles = options_.poles;
      } else {
        warn("the poles could not be moved to ±z without folds");
      }
    }
    result_.pole_cost =
        distortion_energy(topology_, source(), result_.map, measure, options_.threads) / energy - 1;
  }

  void move_to_poles(Poles poles) {
    std::optional<PolePlacement> placement =
        place_poles(topology_, source(), result_.map, poles.north, poles.south, pole_options());
    if (!placement) return;
    record("pole placement", placement->map);
    accept_if_certified(std::move(placement->map));
  }

  void choose_poles_on_map() {
    const AxisChoice choice =
        choose_axis(topology_, source(), result_.map, {.threads = options_.threads});
    std::optional<PolePlacement> placement =
        place_poles_on_axis(topology_, source(), result_.map, choice.axis, pole_options());
    if (!placement) return warn("no vertex could be moved to -z: the map has no poles");
    const Vertex meridian = options_.meridian ? *options_.meridian : quiet_meridian(placement->map);
    if (!turn(placement->map, meridian) && !accept_if_certified(std::move(placement->map))) {
      return warn("turning the map to its poles folds it by rounding: it has no poles");
    }
    result_.poles = {placement->north, placement->south};
    result_.pole_cost = placement->energy_after / placement->energy_before - 1;
    record("pole placement", result_.map);
  }

  /// A vertex at the equator, on the half-circle that crosses fewest triangles.
  Vertex quiet_meridian(const SphereMap& map) const {
    const double theta = choose_meridian(topology_, map, options_.threads);
    const Vector3 front = to_cartesian({theta, std::numbers::pi / 2});
    return nearest_vertices(map, front, 1, options_.threads).front();
  }

  /// Accepts the map with a vertex turned to θ = 0; false where that is not possible.
  bool turn(const SphereMap& map, Vertex meridian) {
    const Vector3 x = map.point(meridian);
    if (!options_.pins.empty()) {
      warn("pins fix every direction: no other meridian");
    } else if (x.x() == 0 && x.y() == 0) {
      warn("a pole has no longitude: it cannot be the meridian");
    } else if (!accept_if_certified(turned_to_meridian(map, meridian, options_.threads))) {
      warn("turning the map to its meridian folds it by rounding");
    } else {
      result_.meridian = meridian;
      return true;
    }
    return false;
  }

  PolePlacementOptions pole_options() const {
    return {.energy = energy_,
            .sweeps = pole_sweeps,
            .most_moves = most_pole_moves,
            .threads = options_.threads,
            .progress = options_.progress};
  }

  void forget_poles() {
    result_.poles.reset();
    result_.date_line.reset();
  }

  static std::vector<Vertex> vertices_of(const std::vector<Pin>& pins) {
    std::vector<Vertex> vertices;
    for (const Pin& pin : pins) vertices.push_back(pin.vertex);
    return vertices;
  }

  void require_vertex(const char* what, Vertex v) const {
    if (v >= 0 && v < topology_.vertex_count()) return;
    throw MeshError({{DefectKind::IndexOutOfRange,
                      true,
                      1,
                      {v},
                      std::string(what) + " " + std::to_string(v) + " is not a vertex: there are " +
                          std::to_string(topology_.vertex_count()),
                      ""}});
  }

  void require_pins() const {
    std::set<Vertex> seen;
    std::set<std::array<double, 3>> points;
    if (options_.poles) seen = {options_.poles->north, options_.poles->south};
    for (const Landmark& pin : options_.pins) {
      require_vertex("pin", pin.vertex);
      if (!seen.insert(pin.vertex).second) {
        throw std::invalid_argument("vertex " + std::to_string(pin.vertex) + " is pinned twice");
      }
      const Vector3 x = to_cartesian(pin.coordinates);
      if (!points.insert({x.x(), x.y(), x.z()}).second) {
        throw std::invalid_argument("vertex " + std::to_string(pin.vertex) +
                                    " is pinned where another one is");
      }
    }
  }

  // --- bookkeeping ----------------------------------------------------------------------------

  bool certified() const { return result_.certificate.bijective(); }

  /// The map so far, and its certificate.
  void accept(std::string made_by, SphereMap map) {
    result_.certificate = certify(topology_, map, options_.threads);
    result_.map = std::move(map);
    result_.made_by = std::move(made_by);
    result_.stages.push_back(
        {"certificate", stopwatch_.lap(), -1, result_.certificate.fold_count()});
  }

  /// Takes a map that differs from the last one by its frame; false: it is not certified, and the
  /// last one stays.
  bool accept_if_certified(SphereMap map) {
    Certificate certificate = certify(topology_, map, options_.threads);
    if (!certificate.bijective()) return false;
    result_.certificate = std::move(certificate);
    result_.map = std::move(map);
    return true;
  }

  void record(std::string name, const SphereMap& map, long planar_folds = -1) {
    const double seconds = stopwatch_.lap();
    result_.stages.push_back(
        {std::move(name), seconds, planar_folds, count_folds(map), measured(map)});
    stopwatch_.lap();
  }

  long count_folds(const SphereMap& map) const {
    if (!options_.measure_stages) return -1;
    return certify(topology_, map, options_.threads).fold_count();
  }

  std::optional<DistortionSummary> measured(const SphereMap& map) const {
    if (!options_.measure_stages) return std::nullopt;
    return summarise(measure_distortion(mesh_, map, options_.threads), options_.threads);
  }

  void give_up(const std::string& reason) { warn(reason); }
  void warn(std::string text) { result_.warnings.push_back(std::move(text)); }
  void warn_if_moved(const char* pole, Vertex wanted, Vertex used) {
    if (wanted == used) return;
    warn(std::string(pole) + " pole moved from vertex " + std::to_string(wanted) + " to " +
         std::to_string(used) + ": the wanted pair is too close, or its links have chords");
  }

  const SourceTriangles& source() {
    if (source_.empty()) source_ = measure_source(mesh_, options_.threads);
    return source_;
  }

  const Topology& topology_;
  const std::optional<TriangleMesh> rescaled_;
  const TriangleMesh& mesh_;
  const ParameterizeOptions& options_;
  DistortionEnergy energy_;  // minimised at last: with the λ that a balance has found
  SourceTriangles source_;   // measured when first needed
  bool tried_to_embed_ = false;
  Stopwatch stopwatch_;
  Parameterization result_;
};

}  // namespace

Parameterization parameterize(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  Parameterization result = Pipeline(mesh, require_sphere(mesh), options).run();
  give_back_freed_memory();  // before the caller writes the map
  return result;
}

Parameterization parameterize(const TriangleMesh& mesh, const Topology& topology,
                              const ParameterizeOptions& options) {
  require_sphere(mesh, topology);
  Parameterization result = Pipeline(mesh, topology, options).run();
  give_back_freed_memory();
  return result;
}

Parameterization repair_map(const TriangleMesh& mesh, const SphereMap& map,
                            const ParameterizeOptions& options) {
  if (map.points.rows() != mesh.vertex_count() || !map.points.allFinite()) {
    throw std::invalid_argument("repair_map: one finite ray a vertex is needed");
  }
  return Pipeline(mesh, require_sphere(mesh), options).run_from(map);
}

}  // namespace sphparam
