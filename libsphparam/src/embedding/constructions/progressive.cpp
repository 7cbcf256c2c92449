#include "embedding/constructions/progressive.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "elementary.h"
#include "embedding/constructions/narrow_rings.h"
#include "embedding/constructions/pressed_levels.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/energy/map_image.h"
#include "embedding/frame/pin_domain.h"
#include "embedding/newton/freed_memory.h"
#include "embedding/newton/newton_refinement.h"
#include "embedding/newton/optimise.h"
#include "embedding/newton/sampled_decrement.h"
#include "embedding/sweeps/lane_sweep.h"
#include "embedding/sweeps/relaxation.h"
#include "embedding/sweeps/ring_packs.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// From the tetrahedron up, level by level:
//   1. vertices that are already there keep their points;
//   2. each removed vertex goes where it lies in its ring on the source (mean value coordinates),
//      or, where that is not well inside, on the way there from the kernel of the ring; then it
//      makes one Newton step. Rings that are too narrow for it are opened (narrow_rings.cpp);
//   3. sweeps of guarded Newton steps over all vertices, colour by colour. Coarse levels are cheap
//      and get more of them.
// A vertex without room (rounding on very long protrusions) sends the level back: the coarser one
// is relaxed again, which opens the rings, and the level is tried once more. Then areas weigh more;
// last, the shape is forgotten and everything equilateral.
// A map that ends far from its energy is made once more, from maps in which areas weigh more.
// Pins are placed on the coarsest level that has them all, and held from there on. Pins that block
// each other there (edges between them, too few vertices) travel on as levels get finer.

namespace sphparam {
namespace {

constexpr std::int64_t pack_grain = 16;
constexpr int pin_work = 200'000;           // rounds × vertices on a level that places pins
constexpr int fewest_pin_rounds = 40;       // on fine levels
constexpr double least_pin_progress = 0.9;  // of the distances left: more than that is idle
constexpr int most_idle_levels = 6;
// Exponents: how many more sweeps coarser levels get. On protrusions the coarse levels carry more.
constexpr double sweep_growth = 0.5, sweep_growth_without_protrusions = 0.3;
constexpr int protruding_level = 100;  // vertices: on smaller levels every shape is cramped
constexpr int shape_sweeps = 30;    // of relaxation, where the embedding knew nothing of the shape
constexpr size_t large_levels = 3;  // on which memory is at its peak
// Tried in turn when vertices found no room at the λ asked for.
constexpr double roomier_lambdas[] = {10, 100, 1000};
// A second start, where the first ended so far from its energy: how much more areas weigh.
constexpr double far_from_energy = 0.1, down = 0.3;
// How much more areas weigh where the starts of Quality::Best begin. They come down in factors of
// four, with so many steps at each λ.
constexpr double other_lambdas[] = {10, 1, 100, 1000};
constexpr double step_down = 4;
constexpr int steps_down = 6;
constexpr double agreement = 5e-4;  // of two minima's energies: they are one
constexpr double unforeseen = 2;    // times as much as is estimated may be left of an energy

size_t at(int i) { return static_cast<size_t>(i); }

using Image = std::vector<ImagePoint>;

RefinementOptions refinement_options(const ProgressiveOptions& options) {
  return {.quality = options.quality,
          .energy = options.energy,
          .threads = options.threads,
          .progress = options.progress};
}

PressedLevels::Options pressed_options(const ProgressiveOptions& options) {
  return {options.fillers,
          options.filler_share,
          {.energy = options.energy, .threads = options.threads, .progress = options.progress}};
}

/// Uses the hierarchy up: a level is given back as soon as the next finer one is done.
class Embedder {
 public:
  Embedder(const TriangleMesh& mesh, const Topology& topology, const ProgressiveOptions& options,
           const KeptVertices& keep)
      : mesh_(mesh),
        topology_(topology),
        hierarchy_(build_hierarchy(mesh, topology, options.threads, keep, options.progress)),
        options_(options),
        area_floor_(options.least_area * 4 * std::numbers::pi / topology.face_count()),
        refinement_(topology.vertex_count(), refinement_options(options)),
        pressed_(topology, hierarchy_, pressed_options(options)) {
    std::vector<Vertex> names;
    for (const Pin& pin : options.pins) names.push_back(pin.vertex);
    while (!names.empty() && std::count(names.begin(), names.end(), -1) == 0) {
      pinned_.push_back(names);
      if (pinned_.size() == hierarchy_.size()) break;  // the tetrahedron may have them all
      for (Vertex& v : names) v = coarser_name(hierarchy_[pinned_.size()], v);
    }
  }

  ProgressiveEmbedding run() {
    ProgressiveEmbedding result;
    result.report.levels = static_cast<int>(hierarchy_.size());
    image_ = tetrahedron_image(hierarchy_.back());
    image_.reserve(at(topology_.vertex_count()));
    packs_ = room_for_rings(topology_.halfedge_count());
    double done = 0, all = 0;
    for (const HierarchyLevel& level : hierarchy_) all += level.vertex_count();
    ask_ = [&] { report(options_.progress, "embedding", done / all); };
    for (size_t l = hierarchy_.size(); l-- > 0;) {
      if (l + 1 < hierarchy_.size() && !refine(l, result.report)) return result;
      hierarchy_.resize(l + 1);
      if (l < pinned_.size()) place_pins(l, result.report.pin_residuals);
      const double before = done / all;
      const int vertices = hierarchy_[l].vertex_count();
      done += vertices;
      if (pressed_.due(l, vertices)) press(l);
      if (!ring_energy_.empty()) refinement_.note_sampled_decrement(sampled());
      if (refinement_.due(vertices) && !is_pressed()) refine_by_newton(l, {before, done / all});
      ask_();
    }
    result.report.energy_left = refinement_.energy_left();
    result.report.sweeps_sufficed = refinement_.sweeps_suffice();
    result.report.pressure = pressed_.pressure();
    packs_ = {};
    hierarchy_.clear();
    result.map = map_of(image_);
    return result;
  }

 private:
  static Image tetrahedron_image(const HierarchyLevel& level) {
    const double q = 1 / std::sqrt(3.0);
    Image image{{q, q, q, 0}, {-q, -q, q, 0}, {-q, q, -q, 0}, {q, -q, -q, 0}};
    const Vertex* ring = level.ring_begin(0);
    if (orientation(image[0].vector(), image[at(ring[0])].vector(), image[at(ring[1])].vector()) <
        0) {
      std::swap(image[0], image[1]);
    }
    return image;
  }

  /// Takes the image one level finer. False: some vertices found no room.
  bool refine(size_t l, ProgressiveReport& report) {
    if (l < large_levels) give_back_freed_memory();
    complete_positions(hierarchy_[l], hierarchy_[l + 1], options_.threads);
    const HierarchyLevel &level = hierarchy_[l], &coarser = hierarchy_[l + 1];
    level_ = l;
    packs_ = pack(l, pins_placed_, std::move(packs_));
    ask_();
    for (int attempt = 0;; ++attempt) {
      prolong(level, coarser);
      if (insert(level, report)) break;
      if (attempt == options_.retries) return false;
      ++report.retries;
      restrict(coarser);
      const RingPacks coarse = pack(l + 1, pins_placed_);
      for (int sweep = 0; sweep < 10 << attempt; ++sweep) {
        sweep_colours(coarse, 0, 1.0);
        ask_();
      }
    }
    if (is_pressed()) pressed_.mark(l, packs_);
    const int sweeps = sweeps_on(level.vertex_count());
    // The first sweep need not move the removed vertices: they have just made their step.
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      ask_();
      // Their rings are left out of the energies too: those of their neighbours cover them.
      const bool told =
          l == 0 && sweep + 1 == sweeps && refinement_.finest_is_open() && !is_pressed();
      if (told) ring_energy_.assign(image_.size(), 0.0F);
      sweep_colours(packs_, sweep == 0 ? 1 : 0, options_.over_relaxation,
                    told ? ring_energy_.data() : nullptr);
    }
    return true;
  }

  /// Of the finest level.
  double sampled() {
    const std::vector<float> ring_energy = std::exchange(ring_energy_, {});
    return sampled_decrement(hierarchy_[0], area_floor_, image_, ring_energy, options_.energy,
                             options_.threads);
  }

  RingPacks pack(size_t l, bool hold_pins, RingPacks used = {}) const {
    return pack_rings(hierarchy_[l], area_floor_, options_.threads,
                      hold_pins ? pinned_[l] : std::vector<Vertex>{}, std::move(used));
  }

  bool is_pressed() const { return pressed_.pressure() > 0; }

  void press(size_t l) {
    const std::vector<Vertex> pinned = pins_placed_ ? pinned_[l] : std::vector<Vertex>{};
    const SphereMap map = pressed_.pressed(l, triangle_mesh(hierarchy_[l]), map_of(image_), pinned);
    std::ranges::copy(image_of(map), image_.begin());  // which keeps its room
  }

  void refine_by_newton(size_t l, ProgressShare share) {
    const std::vector<Vertex> pinned = pins_placed_ ? pinned_[l] : std::vector<Vertex>{};
    if (l == 0) {
      packs_ = {};  // there is no room to spare in a Newton step
      hierarchy_.clear();
      return refinement_.improve(mesh_, topology_, pinned, image_, share);
    }
    const TriangleMesh mesh = triangle_mesh(hierarchy_[l]);
    refinement_.improve(mesh, Topology(mesh, options_.threads), pinned, image_, share);
    image_.reserve(at(topology_.vertex_count()));
  }

  /// Moves the pins of a level to their points, then relaxes the rest around them, until they are
  /// there or several levels have brought them no nearer.
  void place_pins(size_t l, std::vector<double>& residuals) {
    if (all_exact(residuals) || idle_levels_ == most_idle_levels) return;
    const TriangleMesh mesh = triangle_mesh(hierarchy_[l]);
    const Topology topology(mesh, options_.threads);
    std::vector<Pin> pins = options_.pins;
    for (size_t i = 0; i < pins.size(); ++i) pins[i].vertex = pinned_[l][i];
    const int rounds = pin_work / static_cast<int>(image_.size());
    const LandmarkPlacement placement =
        place_landmarks(topology, measure_source(mesh, options_.threads), map_of(image_), pins,
                        {.energy = options_.energy,
                         .most_rounds = std::max(fewest_pin_rounds, rounds),
                         .threads = options_.threads,
                         .progress = options_.progress});
    std::ranges::copy(image_of(placement.map), image_.begin());  // which keeps its room
    pins_placed_ = true;
    packs_ = pack(l, true, std::move(packs_));
    const int sweeps = sweeps_on(hierarchy_[l].vertex_count());
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      ask_();
      sweep_colours(packs_, 0, options_.over_relaxation);
    }
    const double left = std::accumulate(residuals.begin(), residuals.end(), 0.0);
    residuals = placement.residuals;
    const double still = std::accumulate(residuals.begin(), residuals.end(), 0.0);
    idle_levels_ = left > 0 && still > least_pin_progress * left ? idle_levels_ + 1 : 0;
  }

  int sweeps_on(int vertices) const {
    const double finest = topology_.vertex_count();
    const double growth =
        refinement_.sweeps_suffice() ? sweep_growth_without_protrusions : sweep_growth;
    const double wanted = options_.sweeps * elementary::pow(finest / vertices, growth);
    return static_cast<int>(std::lround(std::min<double>(options_.most_sweeps, wanted)));
  }

  /// Gives the image's points the names of the finer level. Names grow: the last goes first.
  void prolong(const HierarchyLevel& level, const HierarchyLevel& coarser) {
    image_.resize(at(level.vertex_count()));
    for (int v = coarser.vertex_count(); v-- > 0;) image_[at(coarser.finer[at(v)])] = image_[at(v)];
  }

  /// Back to the names of the coarser level.
  void restrict(const HierarchyLevel& coarser) {
    for (int v = 0; v < coarser.vertex_count(); ++v)
      image_[at(v)] = image_[at(coarser.finer[at(v)])];
    image_.resize(at(coarser.vertex_count()));
  }

  /// Places the removed vertices (colour 0), and moves others where those are squeezed in. False:
  /// some found no room.
  bool insert(const HierarchyLevel& level, ProgressiveReport& report) {
    std::atomic<long> refused{0}, failed{0};
    const int count = packs_.colour_start[1];
    std::vector<unsigned char> bits(at(count), 0);  // refused, and then: squeezed in
    const NarrowRings::Options options = narrow_options();
    NarrowRings narrow(level, image_, options);
    parallel_for(count, pack_grain, options_.threads, [&](std::int64_t first, std::int64_t last) {
      const int begin = static_cast<int>(first), end = static_cast<int>(last);
      place_in_rings(packs_, begin, end, image_.data(), bits.data());
      for (int p = begin; p < end; ++p) {
        for (int lane = 0; lane < pack_width; ++lane) {
          if (!(bits[at(p)] >> lane & 1)) continue;
          ++refused;
          const Room room = narrow.place(packs_.packs[at(p)].vertex[lane]);
          if (room == Room::None) ++failed;
          if (room != Room::Narrow) bits[at(p)] ^= static_cast<unsigned char>(1U << lane);
        }
      }
      if (failed == 0) {
        step_packs(packs_, begin, end, image_.data(), options_.energy, 1.0);
      }
    });
    report.kernel_placements += refused;
    if (failed > 0) return false;
    open_rings(narrow, bits);
    return true;
  }

  void open_rings(NarrowRings& rings, const std::vector<unsigned char>& bits) {
    std::vector<Vertex> narrow;
    for (size_t p = 0; p < bits.size(); ++p) {
      for (int lane = 0; lane < pack_width; ++lane) {
        if (bits[p] >> lane & 1) narrow.push_back(packs_.packs[p].vertex[lane]);
      }
    }
    if (narrow.empty()) return;
    if (std::ssize(image_) >= protruding_level) refinement_.note_protrusions();
    rings.open(std::move(narrow), pins_placed_ ? pinned_[level_] : std::vector<Vertex>{});
  }

  NarrowRings::Options narrow_options() const {
    return {options_.energy, area_floor_, options_.over_relaxation, options_.threads, ask_};
  }

  void sweep_colours(const RingPacks& packs, int first_colour, double over_relaxation,
                     float* ring_energy = nullptr) {
    DistortionEnergy energy = options_.energy;
    energy.pressure = -pressed_.pressure();
    sweep_packs(packs, first_colour, image_.data(), energy, over_relaxation, options_.threads,
                ring_energy);
  }

  const TriangleMesh& mesh_;
  const Topology& topology_;
  MeshHierarchy hierarchy_;
  const ProgressiveOptions& options_;
  std::function<void()> ask_;  // whether to go on; throws if not
  const double area_floor_;
  std::vector<std::vector<Vertex>> pinned_;  // per level that has all pins: their names there
  bool pins_placed_ = false;
  size_t level_ = 0;     // at hand
  int idle_levels_ = 0;  // that brought the pins no nearer
  RingPacks packs_;      // of the level at hand; its memory serves all levels
  Image image_;
  std::vector<float> ring_energy_;  // of the finest level, if `refinement_` asks for a sample
  NewtonRefinement refinement_;
  PressedLevels pressed_;
};

/// Towards the energy asked for, where the map was found by another one. Returns the share of it
/// that is left.
std::optional<double> refine_map(const TriangleMesh& mesh, const Topology& topology,
                                 const ProgressiveOptions& options, const KeptVertices& keep,
                                 SphereMap& map) {
  if (options.quality == Quality::Draft) return std::nullopt;
  Image image = image_of(map);
  NewtonRefinement refinement(topology.vertex_count(), refinement_options(options));
  refinement.improve(mesh, topology, keep.vertices, image);
  map = map_of(image);
  return refinement.energy_left();
}

/// With the λ asked for, or else with greater ones: weighing areas more keeps protrusions from
/// shrinking to where doubles have no room left. From such a map Newton steps go back towards the λ
/// asked for.
ProgressiveEmbedding embed_with_room(const TriangleMesh& mesh, const Topology& topology,
                                     const ProgressiveOptions& options, const KeptVertices& keep) {
  const auto embed = [&](const ProgressiveOptions& how) {
    return Embedder(mesh, topology, how, keep).run();
  };
  ProgressiveEmbedding embedding = embed(options);
  for (const double lambda : roomier_lambdas) {
    if (embedding.map) break;
    ProgressiveOptions roomier = options;
    roomier.energy = {.lambda = std::max(lambda, options.energy.lambda)};
    roomier.quality = Quality::Draft;
    const int retries = embedding.report.retries;
    embedding = embed(roomier);
    embedding.report.retries += retries;
    if (!embedding.map) continue;
    embedding.report.energy_left = refine_map(mesh, topology, options, keep, *embedding.map);
  }
  return embedding;
}

double energy_of(const TriangleMesh& mesh, const Topology& topology, const SphereMap& map,
                 const ProgressiveOptions& options) {
  return distortion_energy(topology, measure_source(mesh, options.threads), map, options.energy,
                           options.threads);
}

/// From a map in which areas weigh more, down to the λ asked for. Where the embedding ended far
/// from its energy, triangles have too little area for any step to give it back; areas that shrink
/// are in nobody's way.
ProgressiveEmbedding embed_from_above(const TriangleMesh& mesh, const Topology& topology,
                                      const ProgressiveOptions& options, const KeptVertices& keep,
                                      double lambda) {
  ProgressiveOptions above = options;
  above.quality = Quality::Normal;
  above.energy = {.lambda = lambda * std::max(1.0, options.energy.lambda)};
  ProgressiveEmbedding embedding = embed_with_room(mesh, topology, above, keep);
  if (!embedding.map) return embedding;
  while ((above.energy.lambda *= down) > options.energy.lambda / down) {
    refine_map(mesh, topology, above, keep, *embedding.map);
  }
  embedding.report.energy_left = refine_map(mesh, topology, options, keep, *embedding.map);
  return embedding;
}

/// Where the first embedding is far from its energy: the better of it and of others from above.
ProgressiveEmbedding embed_nearer(const TriangleMesh& mesh, const Topology& topology,
                                  const ProgressiveOptions& options, const KeptVertices& keep,
                                  ProgressiveEmbedding first) {
  double least = energy_of(mesh, topology, *first.map, options);
  for (const double lambda : roomier_lambdas) {
    ProgressiveEmbedding second = embed_from_above(mesh, topology, options, keep, lambda);
    if (!second.map) continue;
    const double energy = energy_of(mesh, topology, *second.map, options);
    if (energy < least) {
      least = energy;
      second.report.retries += first.report.retries;
      first = std::move(second);
    }
    if (first.report.energy_left.value_or(0) < far_from_energy) break;
  }
  return first;
}

/// A map that may lead to another minimum.
struct Start {
  SphereMap map;
  double energy = 0, left = 1;  // of `energy`, the share that steps to come would take
};

Start start_from(const TriangleMesh& mesh, const Topology& topology,
                 const ProgressiveOptions& options, const KeptVertices& keep, SphereMap map) {
  Start start{std::move(map)};
  start.left = refine_map(mesh, topology, options, keep, start.map).value_or(1);
  start.energy = energy_of(mesh, topology, start.map, options);
  return start;
}

/// Down from a map in which areas weigh more, a few steps at each λ.
SphereMap descended(const TriangleMesh& mesh, const Topology& topology,
                    const ProgressiveOptions& options, SphereMap map, double lambda) {
  const RestTriangles source = measure_source(mesh, options.threads);
  OptimiseOptions how{.energy = {},
                      .least_gain = 1e-2,
                      .max_steps = steps_down,
                      .threads = options.threads,
                      .progress = options.progress};
  while ((lambda /= step_down) > options.energy.lambda) {
    how.energy.lambda = lambda;
    map = optimise(topology, source, map, how).map;
  }
  return map;
}

/// A start of Quality::Best besides its first: a map in which areas weigh `more`, or with 1 its
/// draft. Nothing: no vertex found room.
std::optional<Start> other_start(const TriangleMesh& mesh, const Topology& topology,
                                 const ProgressiveOptions& options, const KeptVertices& keep,
                                 double more) {
  ProgressiveOptions normal = options, above = options;
  normal.quality = Quality::Normal;
  above.quality = more > 1 ? Quality::Normal : Quality::Draft;
  if (more > 1) above.energy = {.lambda = more * std::max(1.0, options.energy.lambda)};
  std::optional<SphereMap> map = embed_with_room(mesh, topology, above, keep).map;
  if (!map) return std::nullopt;
  *map = descended(mesh, topology, options, std::move(*map), above.energy.lambda);
  return start_from(mesh, topology, normal, keep, std::move(*map));
}

/// The lowest of the minima that several starts lead to, until two agree. Those that cannot get
/// below what is found already, by twice what is estimated, are left as they are.
ProgressiveEmbedding embed_lowest(const TriangleMesh& mesh, const Topology& topology,
                                  const ProgressiveOptions& options, const KeptVertices& keep,
                                  ProgressiveEmbedding first) {
  double least = energy_of(mesh, topology, *first.map, options);
  for (const double more : other_lambdas) {
    std::optional<Start> start = other_start(mesh, topology, options, keep, more);
    if (!start || !(start->energy * (1 - unforeseen * start->left) < least)) continue;
    *start = start_from(mesh, topology, options, keep, std::move(start->map));
    const bool agree = std::abs(start->energy - least) <= agreement * least;
    if (start->energy < least) {
      least = start->energy;
      first.map = std::move(start->map);
      first.report.energy_left = start->left;
    }
    if (agree) break;
  }
  return first;
}

/// One embedding, or the lowest of several where the first is far from its energy, or the best is
/// wanted of a shape that is not plain.
ProgressiveEmbedding embed_better(const TriangleMesh& mesh, const Topology& topology,
                                  const ProgressiveOptions& options, const KeptVertices& keep) {
  ProgressiveEmbedding first = embed_with_room(mesh, topology, options, keep);
  if (!first.map || options.quality == Quality::Draft || !options.pins.empty()) return first;
  const bool plain = first.report.sweeps_sufficed;
  if (!(first.report.energy_left.value_or(0) < far_from_energy)) {
    first = embed_nearer(mesh, topology, options, keep, std::move(first));
  }
  if (options.quality != Quality::Best || plain) return first;
  return embed_lowest(mesh, topology, options, keep, std::move(first));
}

/// As if all triangles were equilateral, then relaxed and refined for the shape they have. No
/// shape is too hard for that, but what neither reaches stays distorted.
ProgressiveEmbedding embed_by_valences(const TriangleMesh& mesh, const Topology& topology,
                                       const ProgressiveOptions& options,
                                       const KeptVertices& keep) {
  TriangleMesh shapeless = mesh;
  shapeless.positions.setZero();
  ProgressiveOptions draft = options;
  draft.quality = Quality::Draft;
  draft.least_area = 1;  // all are as large as the mean: the source has the sphere's area
  ProgressiveEmbedding embedding = embed_with_room(shapeless, topology, draft, keep);
  if (!embedding.map) return embedding;
  embedding.map = relax(topology, measure_source(mesh, options.threads), *embedding.map,
                        {.energy = options.energy,
                         .sweeps = shape_sweeps,
                         .pinned = keep.vertices,
                         .threads = options.threads,
                         .progress = options.progress,
                         .measure_energy = false})
                      .map;
  embedding.report.energy_left = refine_map(mesh, topology, options, keep, *embedding.map);
  return embedding;
}

void require_domain(const ProgressiveOptions& options, int vertices) {
  require_domain(options.energy);
  require_one_of("quality", options.quality, Quality::Best);
  require_at_least("sweeps", options.sweeps, 0);
  require_at_least("most_sweeps", options.most_sweeps, 0);
  require_between("over_relaxation", options.over_relaxation, 0, most_over_relaxation);
  require_between("retries", options.retries, 0, most_retries);
  require_at_least("pin_level", options.pin_level, 0);
  require_between("least_area", options.least_area, 0, 1);
  require_between("filler_share", options.filler_share, 0, 1);
  require_pins(options.pins, vertices);
}

}  // namespace

ProgressiveEmbedding embed_progressively(const TriangleMesh& mesh, const Topology& topology,
                                         const ProgressiveOptions& options) {
  require_domain(options, topology.vertex_count());
  report(options.progress, "hierarchy", 0);
  KeptVertices keep{{}, std::max(options.pin_level, 20 * static_cast<int>(options.pins.size()))};
  for (const Pin& pin : options.pins) keep.vertices.push_back(pin.vertex);
  ProgressiveEmbedding embedding = embed_better(mesh, topology, options, keep);
  give_back_freed_memory();  // before the caller measures and turns the map
  if (embedding.map) return embedding;
  const int retries = embedding.report.retries;
  embedding = embed_by_valences(mesh, topology, options, keep);
  embedding.report.retries += retries;
  return embedding;
}

}  // namespace sphparam
