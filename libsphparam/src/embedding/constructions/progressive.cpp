#include "embedding/constructions/progressive.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "elementary.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/frame/pin_domain.h"
#include "embedding/newton/freed_memory.h"
#include "embedding/newton/newton_refinement.h"
#include "embedding/sweeps/kernel_placement.h"
#include "embedding/sweeps/lane_sweep.h"
#include "embedding/sweeps/relaxation.h"
#include "embedding/sweeps/ring_packs.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// From the tetrahedron up, level by level:
//   1. vertices that are already there keep their points;
//   2. each removed vertex goes to the mean of its ring, or, where that is not well inside, to the
//      deepest point of the ring's kernel; then it makes one Newton step;
//   3. sweeps of guarded Newton steps over all vertices, colour by colour. Coarse levels are cheap
//      and get more of them.
// A vertex without room (rounding on very long protrusions) sends the level back: the coarser one
// is relaxed again, which opens the rings, and the level is tried once more. Then areas weigh more;
// last, the shape is forgotten and everything equilateral.
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
constexpr int shape_sweeps = 30;    // of relaxation, where the embedding knew nothing of the shape
constexpr size_t large_levels = 3;  // on which memory is at its peak
// Tried in turn when vertices found no room at the λ asked for.
constexpr double roomier_lambdas[] = {10, 100, 1000};

size_t at(int i) { return static_cast<size_t>(i); }

using Image = std::vector<ImagePoint>;

SphereMap map_of(const Image& image) {
  SphereMap map;
  map.points.resize(static_cast<Eigen::Index>(image.size()), 3);
  for (size_t v = 0; v < image.size(); ++v) {
    map.points.row(static_cast<Eigen::Index>(v)) = image[v].vector();
  }
  return map;
}

Image image_of(const SphereMap& map) {
  Image image(static_cast<size_t>(map.points.rows()));
  for (size_t v = 0; v < image.size(); ++v) {
    image[v] = image_point(map.point(static_cast<Vertex>(v)));
  }
  return image;
}

RefinementOptions refinement_options(const ProgressiveOptions& options) {
  return {.quality = options.quality,
          .energy = options.energy,
          .threads = options.threads,
          .progress = options.progress};
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
        refinement_(topology.vertex_count(), refinement_options(options)) {
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
      if (refinement_.due(vertices)) refine_by_newton(l, {before, done / all});
      ask_();
    }
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
    const int sweeps = sweeps_on(level.vertex_count());
    // The first sweep need not move the removed vertices: they have just made their step.
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      ask_();
      sweep_colours(packs_, sweep == 0 ? 1 : 0, options_.over_relaxation);
    }
    return true;
  }

  RingPacks pack(size_t l, bool hold_pins, RingPacks used = {}) const {
    return pack_rings(hierarchy_[l], area_floor_, options_.threads,
                      hold_pins ? pinned_[l] : std::vector<Vertex>{}, std::move(used));
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

  /// Places the removed vertices (colour 0), moves no other. False: some found no room.
  bool insert(const HierarchyLevel& level, ProgressiveReport& report) {
    std::atomic<long> refused{0}, failed{0};
    const int count = packs_.colour_start[1];
    std::vector<unsigned char> bits(at(count), 0);
    parallel_for(count, pack_grain, options_.threads, [&](std::int64_t first, std::int64_t last) {
      const int begin = static_cast<int>(first), end = static_cast<int>(last);
      place_at_means(packs_, begin, end, image_.data(), bits.data());
      for (int p = begin; p < end; ++p) {
        for (int lane = 0; lane < pack_width; ++lane) {
          if (!(bits[at(p)] >> lane & 1)) continue;
          ++refused;
          if (!insert_in_kernel(level, packs_.packs[at(p)].vertex[lane])) ++failed;
        }
      }
      if (failed == 0) {
        step_packs(packs_, begin, end, image_.data(), options_.energy, 1.0);
      }
    });
    report.kernel_placements += refused;
    return failed == 0;
  }

  bool insert_in_kernel(const HierarchyLevel& level, Vertex v) {
    std::vector<Vector3> ring;
    const Vertex* begin = level.ring_begin(v);
    for (int i = 0; i < level.valence(v); ++i) ring.push_back(image_[at(begin[i])].vector());
    const auto point = place_in_kernel(ring);
    if (point) image_[at(v)] = image_point(*point);
    return point.has_value();
  }

  void sweep_colours(const RingPacks& packs, int first_colour, double over_relaxation) {
    for (int c = first_colour; c < packs.colours(); ++c) {
      const int begin = packs.colour_start[at(c)], end = packs.colour_start[at(c) + 1];
      parallel_for(
          end - begin, pack_grain, options_.threads, [&](std::int64_t first, std::int64_t last) {
            step_packs(packs, begin + static_cast<int>(first), begin + static_cast<int>(last),
                       image_.data(), options_.energy, over_relaxation);
          });
    }
  }

  const TriangleMesh& mesh_;
  const Topology& topology_;
  MeshHierarchy hierarchy_;
  const ProgressiveOptions& options_;
  std::function<void()> ask_;  // whether to go on; throws if not
  const double area_floor_;
  std::vector<std::vector<Vertex>> pinned_;  // per level that has all pins: their names there
  bool pins_placed_ = false;
  int idle_levels_ = 0;  // that brought the pins no nearer
  RingPacks packs_;      // of the level at hand; its memory serves all levels
  Image image_;
  NewtonRefinement refinement_;
};

/// Towards the energy asked for, where the map was found by another one.
void refine_map(const TriangleMesh& mesh, const Topology& topology,
                const ProgressiveOptions& options, const KeptVertices& keep, SphereMap& map) {
  if (options.quality == Quality::Draft) return;
  Image image = image_of(map);
  NewtonRefinement(topology.vertex_count(), refinement_options(options))
      .improve(mesh, topology, keep.vertices, image);
  map = map_of(image);
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
    if (embedding.map) refine_map(mesh, topology, options, keep, *embedding.map);
  }
  return embedding;
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
  refine_map(mesh, topology, options, keep, *embedding.map);
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
  require_pins(options.pins, vertices);
}

}  // namespace

ProgressiveEmbedding embed_progressively(const TriangleMesh& mesh, const Topology& topology,
                                         const ProgressiveOptions& options) {
  require_domain(options, topology.vertex_count());
  report(options.progress, "hierarchy", 0);
  KeptVertices keep{{}, std::max(options.pin_level, 20 * static_cast<int>(options.pins.size()))};
  for (const Pin& pin : options.pins) keep.vertices.push_back(pin.vertex);
  ProgressiveEmbedding embedding = embed_with_room(mesh, topology, options, keep);
  give_back_freed_memory();  // before the caller measures and turns the map
  if (embedding.map) return embedding;
  const int retries = embedding.report.retries;
  embedding = embed_by_valences(mesh, topology, options, keep);
  embedding.report.retries += retries;
  return embedding;
}

}  // namespace sphparam
