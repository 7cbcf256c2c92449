#include "embedding/constructions/level_embedding.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "elementary.h"
#include "embedding/constructions/narrow_rings.h"
#include "embedding/constructions/pressed_levels.h"
#include "embedding/energy/map_image.h"
#include "embedding/energy/rest_floors.h"
#include "embedding/newton/freed_memory.h"
#include "embedding/newton/minimise.h"
#include "embedding/newton/newton_refinement.h"
#include "embedding/newton/sampled_decrement.h"
#include "embedding/sweeps/lane_sweep.h"
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
// is relaxed again, which opens the rings, and the level is tried once more.
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
constexpr size_t large_levels = 3;     // on which memory is at its peak

size_t at(int i) { return static_cast<size_t>(i); }

using Image = std::vector<ImagePoint>;

RefinementOptions refinement_options(const ProgressiveOptions& options, const StartOptions& how) {
  return {.quality = options.quality,
          .energy = options.energy,
          .threads = options.threads,
          .progress = options.progress,
          .fatness = how.fatness,
          .most_blocked = how.most_blocked};
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
           const KeptVertices& keep, const StartOptions& how)
      : mesh_(mesh),
        topology_(topology),
        hierarchy_(build_hierarchy(mesh, topology, options.threads, keep, options.progress)),
        options_(options),
        how_(how),
        area_floor_(options.least_area * 4 * std::numbers::pi / topology.face_count()),
        refinement_(topology.vertex_count(), refinement_options(options, how)),
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
      if (l == 0) result.report.limbs = !refinement_.sweeps_suffice();
      if (!ring_energy_.empty()) refinement_.note_sampled_decrement(sampled());
      result.report.demanding = l == 0 && !is_pressed() && is_demanding();
      if (refinement_.due(vertices) && !is_pressed() && !result.report.demanding)
        refine_by_newton(l, {before, done / all});
      ask_();
    }
    result.report.energy_left = refinement_.energy_left();
    result.report.left_slivers = refinement_.left_slivers();
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
    packs_ = pack(l, std::move(packs_));
    ask_();
    for (int attempt = 0;; ++attempt) {
      prolong(level, coarser);
      if (insert(level, report)) break;
      if (attempt == options_.retries) return false;
      ++report.retries;
      restrict(coarser);
      const RingPacks coarse = pack(l + 1);
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
    return sampled_decrement(hierarchy_[0], floors_of(0), image_, ring_energy, options_.energy,
                             options_.threads);
  }

  /// The pins' names on a level once they are placed; none before.
  std::vector<Vertex> held_pins(size_t l) const {
    return pins_placed_ ? pinned_[l] : std::vector<Vertex>{};
  }

  /// `used`: packs whose memory is taken over.
  RingPacks pack(size_t l, RingPacks used = {}) const {
    return pack_rings(hierarchy_[l], floors_of(l), options_.threads, held_pins(l), std::move(used));
  }

  RestFloors floors_of(size_t l) const {
    return {area_floor_, Fatness(how_.fatness, 2.0 * hierarchy_[l].vertex_count() - 4)};
  }

  bool is_pressed() const { return pressed_.pressure() > 0; }

  void press(size_t l) {
    const std::vector<Vertex> pinned = held_pins(l);
    const SphereMap map = pressed_.pressed(l, triangle_mesh(hierarchy_[l]), map_of(image_), pinned);
    std::ranges::copy(image_of(map), image_.begin());  // which keeps its room
  }

  /// Of the finest level.
  bool is_demanding() {
    if (!std::isfinite(how_.demanding) || refinement_.sweeps_suffice()) return false;
    packs_ = {};  // no more sweeps
    const RestTriangles source =
        fattened(measure_source(mesh_, options_.threads), how_.fatness, options_.threads);
    const double energy =
        distortion_energy(topology_, source, map_of(image_), options_.energy, options_.threads);
    return !(energy <= how_.demanding * isometric_energy(source, options_.energy, {}));
  }

  void refine_by_newton(size_t l, ProgressShare share) {
    const std::vector<Vertex> pinned = held_pins(l);
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
    packs_ = pack(l, std::move(packs_));
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
    rings.open(std::move(narrow), held_pins(level_));
  }

  NarrowRings::Options narrow_options() const {
    return {options_.energy, floors_of(level_), options_.over_relaxation, options_.threads, ask_};
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
  const StartOptions how_;
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

}  // namespace

ProgressiveEmbedding embed_by_levels(const TriangleMesh& mesh, const Topology& topology,
                                     const ProgressiveOptions& options, const KeptVertices& keep,
                                     const StartOptions& how) {
  return Embedder(mesh, topology, options, keep, how).run();
}

}  // namespace sphparam
