#include "sphparam/parameterize.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "sphparam/curvilinear/paper_map.h"
#include "sphparam/curvilinear/sound_map.h"
#include "sphparam/embedding/gnomonic.h"
#include "sphparam/embedding/pole_placement.h"
#include "sphparam/embedding/progressive.h"
#include "sphparam/embedding/relaxation.h"
#include "sphparam/embedding/untangle.h"
#include "sphparam/mesh/mesh_defects.h"
#include "stopwatch.h"

// The table of contents. Three methods, each a straight line of stages:
//   paper        poles → date line, cut, harmonic, quasi-harmonic, lift, smoothing
//   curvilinear  poles → the same, periodic and accumulated → relaxation along the date line
//   progressive  hierarchy, embedding → poles
// Then the certificate; where it fails and repair is wanted: untangling, the progressive embedding,
// the one-vertex lift. Whatever comes out last is certified as it is.

namespace sphparam {
namespace {

constexpr int date_line_rings = 5;    // the paper's five-neighbourhood (Section 5)
constexpr int date_line_sweeps = 10;  // of guarded relaxation there
constexpr double most_folds = 0.02;   // of the faces: beyond it nothing is local any more
constexpr double least_direct_lambda = 0.1, greatest_direct_lambda = 10;  // others by continuation
constexpr int pole_sweeps = 10;       // of pinned relaxation after poles were moved

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
  Pipeline(const TriangleMesh& mesh, const ParameterizeOptions& options)
      : topology_(require_sphere(mesh)),
        rescaled_(rescaled(mesh)),
        mesh_(rescaled_ ? *rescaled_ : mesh),
        options_(options),
        energy_(options.energy) {
    if (options.poles) require_poles_in_range(*options.poles);
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
    const bool repair =
        options_.repair && (options_.method != Method::Paper || options_.repair_paper);
    if (repair && !certified()) untangle_folds();
    if (repair && !certified()) embed_from_nothing();
    if (repair && !certified()) lift_one_vertex();
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
    PaperResult paper_map =
        map_as_paper(mesh_, topology_, *poles, paper, options_.progress, on_stage);
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
        .vertices = neighbourhood(result_.date_line->path, date_line_rings),
        .pinned = {poles->north, poles->south},
        .threads = options_.threads,
        .progress = options_.progress};
    SphereMap relaxed = relax(topology_, source(), sound.map, relaxation).map;
    record("relaxation", relaxed);
    accept("relaxation", std::move(relaxed));
  }

  void map_progressive() {
    if (!embed()) return give_up("the progressive embedding ran out of room");
    if (options_.poles) move_to_poles(*options_.poles);
  }

  // --- repair and fallbacks -------------------------------------------------------------------

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
    if (options_.method == Method::Progressive || !embed()) return;
    forget_poles();
    if (options_.poles) move_to_poles(*options_.poles);
  }

  void lift_one_vertex() {
    GnomonicEmbedding embedding = gnomonic_embedding(mesh_, topology_,
                                                     {.lambda = options_.energy.lambda,
                                                      .threads = options_.threads,
                                                      .progress = options_.progress});
    forget_poles();
    record("one-vertex lift", embedding.map);
    accept("one-vertex lift", std::move(embedding.map));
    if (certified() && options_.poles) move_to_poles(*options_.poles);
  }

  bool embed() {
    DistortionEnergy energy = options_.energy;
    const bool balanced = needs_balancing();
    if (balanced) energy.lambda = first_lambda();
    ProgressiveEmbedding embedding = embed_progressively(
        mesh_, topology_,
        {.energy = energy,
         .quality = balanced ? std::min(options_.quality, Quality::Normal) : options_.quality,
         .sweeps = options_.sweeps,
         .threads = options_.threads,
         .progress = options_.progress});
    if (!embedding.map) return false;
    record("progressive embedding", *embedding.map);
    if (balanced) *embedding.map = balance(*embedding.map, energy.lambda);
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

  SphereMap balance(const SphereMap& map, double from_lambda) {
    const double least_gain = options_.quality == Quality::Draft    ? 1e-2
                              : options_.quality == Quality::Normal ? 1e-3
                                                                    : 1e-6;
    BalancedMap result = optimise_balance(topology_, source(), map,
                                          {.balance = options_.balance,
                                           .from_lambda = from_lambda,
                                           .optimise = {.energy = options_.energy,
                                                        .least_gain = least_gain,
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

  void move_to_poles(Poles poles) {
    if (poles.north == poles.south || topology_.find_halfedge(poles.north, poles.south) >= 0) {
      return warn("the poles are the same or share an edge: they cannot lie opposite each other");
    }
    std::optional<PolePlacement> placement =
        place_poles(topology_, source(), result_.map, poles.north, poles.south,
                    {.energy = energy_,
                     .sweeps = pole_sweeps,
                     .threads = options_.threads,
                     .progress = options_.progress});
    if (!placement) return warn("the poles could not be moved to ±z without folds");
    result_.poles = poles;
    record("pole placement", placement->map);
    accept("pole placement", std::move(placement->map));
  }

  void forget_poles() {
    result_.poles.reset();
    result_.date_line.reset();
  }

  void require_poles_in_range(Poles poles) const {
    for (const Vertex v : {poles.north, poles.south}) {
      if (v >= 0 && v < topology_.vertex_count()) continue;
      throw MeshError({{DefectKind::IndexOutOfRange,
                        true,
                        1,
                        {v},
                        "pole " + std::to_string(v) + " is not a vertex: there are " +
                            std::to_string(topology_.vertex_count()),
                        ""}});
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
    return summarise(measure_distortion(mesh_, map, options_.threads));
  }

  void give_up(const std::string& reason) { warn(reason); }
  void warn(std::string text) { result_.warnings.push_back(std::move(text)); }
  void warn_if_moved(const char* pole, Vertex wanted, Vertex used) {
    if (wanted == used) return;
    warn(std::string(pole) + " pole moved from vertex " + std::to_string(wanted) + " to " +
         std::to_string(used) + ": the wanted pair is too close, or its links have chords");
  }

  const SourceTriangles& source() {
    if (source_.empty()) source_ = measure_source(mesh_);
    return source_;
  }

  std::vector<Vertex> neighbourhood(const std::vector<Vertex>& seeds, int rings) const {
    std::vector<char> seen(static_cast<size_t>(topology_.vertex_count()), 0);
    std::vector<Vertex> found = seeds;
    for (const Vertex v : seeds) seen[static_cast<size_t>(v)] = 1;
    size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const size_t end = found.size();
      for (; begin < end; ++begin) {
        topology_.for_each_outgoing(found[begin], [&](Halfedge h) {
          char& mark = seen[static_cast<size_t>(topology_.target(h))];
          if (!std::exchange(mark, 1)) found.push_back(topology_.target(h));
        });
      }
    }
    return found;
  }

  const Topology topology_;
  const std::optional<TriangleMesh> rescaled_;
  const TriangleMesh& mesh_;
  const ParameterizeOptions& options_;
  DistortionEnergy energy_;  // minimised at last: with the λ that a balance has found
  SourceTriangles source_;  // measured when first needed
  Stopwatch stopwatch_;
  Parameterization result_;
};

}  // namespace

Parameterization parameterize(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  return Pipeline(mesh, options).run();
}

}  // namespace sphparam
