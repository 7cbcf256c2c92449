// Surfaces with handles by the thousand: from volumes with noise, from tori with bumps, from grids
// of tubes. Every one must end with genus 0, as many loops as it had handles, no defect that it had
// not before, and a certified map; caps that pass through the surface are counted.
//
//     handle_trial --count 10000

#include <CLI/CLI.hpp>
#include <cstdio>

#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

struct Tally {
  long surfaces = 0, without = 0, handles = 0, most = 0, crossing_caps = 0, crossed_surfaces = 0,
       failed = 0;
};

TriangleMesh surface(unsigned seed) {
  switch (seed % 3) {
    case 0:
      return noisy_ball(10 + static_cast<int>(seed % 23), 0.1 + 0.0007 * (seed % 200), seed);
    case 1:
      return relabelled(
          bumped_torus(3 + static_cast<int>(seed % 17), 4 + static_cast<int>(seed % 41),
                       0.05 + 0.008 * (seed % 100), 0.01 * (seed % 60), seed),
          seed);
    default:
      return tube_grid(2 + static_cast<int>(seed % 13), 2 + static_cast<int>(seed % 11),
                       5 + static_cast<int>(seed % 3), 0.2 + 0.01 * (seed % 10));
  }
}

HandleChoice choice(unsigned seed) {
  constexpr HandleChoice choices[] = {HandleChoice::Cut,      HandleChoice::Fill,
                                      HandleChoice::Area,     HandleChoice::Shortest,
                                      HandleChoice::Shortest, HandleChoice::Shortest};
  return choices[seed / 3 % std::size(choices)];
}

long defects(const MeshInspection& inspection) {
  long count = 0;
  for (const MeshDefect& defect : inspection.defects) {
    // Both rims of a loop stay where it was.
    if (defect.kind != DefectKind::CoincidentVertices) count += defect.count;
  }
  return count;
}

/// Empty: all is well.
std::string complaint(const TriangleMesh& mesh, long genus, const RepairedMesh& cut) {
  if (!cut.inspection.is_sphere()) return "no sphere";
  if (std::ssize(cut.handles) != genus) return std::to_string(cut.handles.size()) + " loops";
  if (cut.mesh.positions.topRows(mesh.vertex_count()) != mesh.positions) return "vertices moved";
  MeshInspection before = inspect_mesh(mesh);
  std::erase_if(before.defects,
                [](const MeshDefect& d) { return d.kind == DefectKind::WrongGenus; });
  if (defects(cut.inspection) > defects(before)) {
    return "a new defect: " + cut.inspection.defects.front().message;
  }
  const Parameterization map = parameterize(cut.mesh, {.quality = Quality::Draft});
  return map.certificate.bijective() ? "" : "not certified";
}

void try_one(unsigned seed, Tally& tally) {
  const TriangleMesh mesh = surface(seed);
  const long genus = inspect_mesh(mesh).genus;
  RepairOptions options = RepairOptions::none();
  options.handles = true;
  options.longest_handle = 10;
  options.handle_choice = choice(seed);
  const RepairedMesh cut = repair_mesh(mesh, options);
  ++tally.surfaces;
  tally.without += genus == 0;
  tally.handles += genus;
  tally.most = std::max(tally.most, genus);
  long crossing = 0;
  for (const HandleLoop& loop : cut.handles) crossing += loop.crossings > 0;
  tally.crossing_caps += crossing;
  tally.crossed_surfaces += crossing > 0;
  const std::string wrong = complaint(mesh, genus, cut);
  if (wrong.empty()) return;
  ++tally.failed;
  std::printf("seed %u, genus %ld: %s\n", seed, genus, wrong.c_str());
}

}  // namespace

int main(int count_of_words, char** words) {
  unsigned first = 1, count = 100;
  CLI::App app("Removes the handles of many surfaces");
  app.add_option("--seed", first, "The first");
  app.add_option("--count", count, "Surfaces");
  CLI11_PARSE(app, count_of_words, words);
  Tally tally;
  for (unsigned seed = first; seed < first + count; ++seed) try_one(seed, tally);
  std::printf(
      "%ld surfaces (seeds %u to %u), %ld of them without handles, %ld handles, genus up to %ld\n",
      tally.surfaces, first, first + count - 1, tally.without, tally.handles, tally.most);
  std::printf("%ld loops have a cap that passes through the surface, on %ld surfaces\n",
              tally.crossing_caps, tally.crossed_surfaces);
  std::printf("%ld failed\n", tally.failed);
  return tally.failed == 0 ? 0 : 1;
}
