// Two small meshes of any connectivity and shape, matched: the match is certified, and holds its
// landmarks exactly. Then what is made of one of them by its map: values of a bake, harmonics.

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "expect.h"
#include "recipe.h"
#include "sphparam/bake/bake.h"
#include "sphparam/correspondence/match.h"
#include "sphparam/errors.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace {

using namespace sphparam;
using namespace sphparam::tests;

MappedMesh mapped(Recipe& recipe) {
  MeshFile file;
  file.mesh = recipe.sphere_mesh();
  SphereMap map = parameterize(file.mesh, {.quality = Quality::Draft, .threads = 1}).map;
  return MappedMesh({.file = std::move(file), .map = std::move(map)}, 1);
}

/// No vertex twice on either side.
std::vector<LandmarkPair> landmarks_of(Recipe& recipe, const MappedMesh& from,
                                       const MappedMesh& to) {
  std::vector<LandmarkPair> made;
  for (unsigned n = recipe.byte() % 6; n > 0; --n) {
    const LandmarkPair pair{static_cast<int>(recipe.byte() % from.mesh().vertex_count()),
                            static_cast<int>(recipe.byte() % to.mesh().vertex_count())};
    if (std::ranges::none_of(made, [&](const LandmarkPair& other) {
          return other.from == pair.from || other.to == pair.to;
        }))
      made.push_back(pair);
  }
  return made;
}

void expect_matched(Recipe& recipe, const MappedMesh& from, const MappedMesh& to) {
  MatchOptions options{.landmarks = landmarks_of(recipe, from, to), .threads = 1};
  const unsigned what = recipe.byte();
  options.search = options.landmarks.empty() && what & 1;
  options.alike = (what & 2) != 0;
  if (what & 4) options.energy = {};
  try {
    const Match match = match_surfaces(from, to, options);
    expect(match.map.from().certificate().bijective(), "a match is certified");
    for (const LandmarkPair& pair : options.landmarks)
      expect(match.map.from().map().points.row(pair.from) == to.map().points.row(pair.to),
             "landmarks are held exactly");
  } catch (const UnreachableLandmarks&) {
  } catch (const MirroredLandmarks&) {
  } catch (const UnmeasurableMesh&) {  // without area
  }
}

void expect_baked(const MappedMesh& mesh, unsigned taste) {
  const std::vector<std::vector<std::string>> fields = {{"position", "normal-object"},
                                                        {"height", "ao"},
                                                        {"curvature", "area"},
                                                        {"thickness", "bent"}};
  long values = 0;
  const auto take = [&](std::size_t, const BakedField&, int, int rows, const float*) {
    values += rows;
  };
  BakeSettings settings{.width = 16, .threads = 1};
  settings.fields.rays = 4;
  if (taste & 4) settings.interpolation = Interpolation::Sphere;
  if (taste & 8) settings.refine_poles = 4;
  try {
    const std::vector<BakedField> made = bake_values(mesh, fields[taste % 4], settings, take);
    expect(values == 8 * std::ssize(made), "every row is handed over, of each field");
  } catch (const NotCertifiedError&) {  // thinner in (u, v) than numbers tell
  } catch (const FieldError&) {
  } catch (const UnmeasurableMesh&) {
  } catch (const std::range_error&) {  // beyond float32
  }
}

void expect_expanded(const MappedMesh& mesh, unsigned degree) {
  const HarmonicFit fit = fit_harmonics(mesh.topology(), mesh.map(), mesh.mesh().positions,
                                        {.degree = static_cast<int>(degree), .threads = 1});
  expect(fit.coefficients.allFinite() && fit.rms.allFinite(), "harmonics are finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Recipe recipe({data, size});
  const unsigned taste = recipe.byte();
  const MappedMesh from = mapped(recipe), to = mapped(recipe);
  expect_matched(recipe, from, to);
  expect_baked(from, taste);
  expect_expanded(to, taste / 16);
  return 0;
}
