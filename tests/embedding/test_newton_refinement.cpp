#include <algorithm>
#include <catch2/catch.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "embedding/constructions/level_embedding.h"
#include "embedding/newton/newton_refinement.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

std::vector<ImagePoint> image_of(const SphereMap& map) {
  std::vector<ImagePoint> image;
  for (Vertex v = 0; v < map.points.rows(); ++v) image.push_back(image_point(map.point(v)));
  return image;
}

/// A mesh and its map without steps on the finest level.
struct Draft {
  TriangleMesh mesh;
  Topology topology{mesh};
  std::vector<ImagePoint> image = image_of(
      *embed_by_levels(mesh, topology, {.quality = Quality::Draft}, {}, {.demanding = 0}).map);

  int size() const { return topology.vertex_count(); }

  double energy() const {
    SphereMap map;
    map.points.resize(size(), 3);
    for (Vertex v = 0; v < size(); ++v) {
      map.points.row(v) = image[static_cast<size_t>(v)].vector().transpose();
    }
    return distortion_energy(topology, measure_source(mesh), map, {});
  }

  /// Returns how many steps were made.
  int refine(Quality quality, int finest) {
    int steps = 0;
    double done = 0;  // grows with every step; it is asked more often
    const auto count = [&](std::string_view, double fraction) {
      if (fraction > std::exchange(done, fraction)) ++steps;
      return true;
    };
    NewtonRefinement(finest, {.quality = quality, .progress = count})
        .improve(mesh, topology, {}, image);
    return steps;
  }
};

}  // namespace

TEST_CASE(
    "Newton refinement: ends where what is left is worth nothing, and of small meshes leaves "
    "less") {
  for (const auto& [rings, around] : {std::pair{40, 8}, {30, 16}, {60, 16}}) {
    const Draft draft{tube(rings, around)};
    Draft refined = draft, converged = draft;
    const int steps = refined.refine(Quality::Normal, draft.size());
    const int steps_to_the_end = converged.refine(Quality::Best, draft.size());
    const double least = converged.energy(), left = refined.energy() / least - 1;
    REQUIRE(draft.energy() > 1.03 * least);  // there is something to do
    CHECK(left < 3e-3 * draft.size() / 5000);
    CHECK(steps > 2);
    CHECK(steps < 2 * steps_to_the_end);  // which are better ones: by exact Hessians

    // As a coarse level of a larger mesh, whose own steps come later, it gets fewer.
    Draft coarse = draft;
    CHECK(coarse.refine(Quality::Normal, 100 * draft.size()) < steps);
    CHECK(coarse.energy() < draft.energy());
  }
}

TEST_CASE("Newton refinement: one step finds out that a ball needs none") {
  Draft ball{icosphere(3)};
  CHECK(ball.refine(Quality::Normal, ball.size()) == 1);
}

TEST_CASE("Newton refinement: levels are due at every fourfold size, large ones only after gains") {
  Draft ball{icosphere(3)}, protrusion{tube(75, 8)};  // 642 and 602 vertices
  const auto after = [](Draft& level, Quality quality, int finest) {
    NewtonRefinement refinement(finest, {.quality = quality});
    refinement.improve(level.mesh, level.topology, {}, level.image);
    return refinement;
  };
  const NewtonRefinement before(40'960, {});
  CHECK_FALSE(before.due(99));
  CHECK_FALSE(before.due(159));  // 40,960 / 4⁴ = 160
  CHECK(before.due(160));
  const NewtonRefinement draft_of_ball = after(ball, Quality::Draft, 40'960);
  CHECK_FALSE(draft_of_ball.due(40'960));
  CHECK_FALSE(draft_of_ball.due(10'240));
  CHECK(NewtonRefinement(40'960, {.quality = Quality::Draft}).due(160));  // cheap

  const NewtonRefinement after_ball = after(ball, Quality::Normal, 40'960);
  CHECK_FALSE(after_ball.due(ball.size()));  // it has had its steps: 2560 is next
  CHECK(after_ball.due(2560));               // cheap
  CHECK_FALSE(after_ball.due(2561));
  CHECK_FALSE(after_ball.due(40'960));
  const NewtonRefinement best = after(ball, Quality::Best, 40'960);
  CHECK_FALSE(best.due(2559));
  CHECK(best.due(40'960));
  const NewtonRefinement after_protrusion = after(protrusion, Quality::Normal, 40'960);
  CHECK(after_ball.sweeps_suffice());
  CHECK_FALSE(before.sweeps_suffice());  // it does not know
  CHECK_FALSE(after_protrusion.sweeps_suffice());
  CHECK_FALSE(after_protrusion.due(639));  // 640 is next
  CHECK(after_protrusion.due(40'960));
  Draft unrefined{tube(75, 8)};
  const NewtonRefinement draft_of_protrusion = after(unrefined, Quality::Draft, 40'960);
  CHECK(draft_of_protrusion.due(40'960));
}

TEST_CASE("Newton refinement: a draft of a large mesh asks a sample where little is left") {
  const int large = 40'960, small = 2'560;
  const auto after = [](TriangleMesh shape, Quality quality, int finest) {
    Draft level{std::move(shape)};
    NewtonRefinement refinement(finest, {.quality = quality});
    refinement.improve(level.mesh, level.topology, {}, level.image);
    return refinement;
  };
  const TriangleMesh limb = tube(20, 20);  // its first step gains between 0.2 and 1 %
  NewtonRefinement draft = after(limb, Quality::Draft, large);
  REQUIRE_FALSE(draft.sweeps_suffice());
  CHECK(draft.due(large / 4));
  CHECK_FALSE(draft.due(large));
  CHECK(draft.finest_is_open());
  draft.note_sampled_decrement(0.02);
  CHECK(draft.due(large));
  draft.note_sampled_decrement(0.01);
  CHECK_FALSE(draft.due(large));
  CHECK(draft.energy_left() > 0.02);

  CHECK(after(limb, Quality::Normal, large).due(large));
  CHECK(after(limb, Quality::Draft, small).due(small));
  const NewtonRefinement of_ball = after(icosphere(3), Quality::Draft, large);
  CHECK_FALSE(of_ball.finest_is_open());  // nothing is sampled, nothing known
  CHECK_FALSE(of_ball.energy_left());
}

TEST_CASE("Newton refinement: can be cancelled in every step") {
  Draft protrusion{tube(60, 16)};
  int told = 0;
  const auto cancel = [&](std::string_view stage, double) {
    CHECK(stage == "embedding");
    return ++told < 3;
  };
  NewtonRefinement refinement(protrusion.size(), {.progress = cancel});
  CHECK_THROWS_AS(refinement.improve(protrusion.mesh, protrusion.topology, {}, protrusion.image),
                  Cancelled);
  CHECK(told == 3);
}

TEST_CASE("Newton refinement: the progress of an embedding rises to one, at every step") {
  const TriangleMesh mesh = tube(60, 16);
  const Topology topology(mesh);
  const auto reports = [&](Quality quality) {
    std::vector<double> fractions;
    const auto note = [&](std::string_view stage, double fraction) {
      if (stage == "embedding") fractions.push_back(fraction);
      return true;
    };
    embed_progressively(mesh, topology, {.quality = quality, .progress = note});
    return fractions;
  };
  const std::vector<double> normal = reports(Quality::Normal);
  CHECK(std::is_sorted(normal.begin(), normal.end()));
  CHECK(normal.front() > 0);
  CHECK(normal.back() == 1);
  // Every start's steps are told, not the levels alone.
  CHECK(normal.size() > reports(Quality::Draft).size() + 10);
  const std::vector<double> best = reports(Quality::Best);
  CHECK(std::is_sorted(best.begin(), best.end()));
  CHECK(best.back() == 1);
  CHECK(best.size() > normal.size() + 10);
}
