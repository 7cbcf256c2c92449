// Surfaces with handles by the thousand: from volumes with noise, from tori with bumps, from grids
// of tubes, genus 1 to 200 and a little more. Every one must end with genus 0, as many loops as it
// had handles, no defect that it had not before, and a certified map; caps that pass through the
// surface are counted. The log has a line a surface; begun again with it, the run goes on.
//
//     handle_trial --count 10000 --log surfaces.tsv

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr std::array kinds = {"noise", "torus", "tubes"};
constexpr double most_handles = 200;

/// What became of a surface: a line of the log.
struct Outcome {
  unsigned seed = 0;
  std::string kind, choice;
  long genus = 0, triangles = 0, crossing_caps = 0;
  double longest = 0;  // loop, in diagonals
  std::string complaint;
};

/// Few handles more often than many: the logarithm of their number is even.
TriangleMesh random_tube_grid(unsigned seed) {
  const double even = static_cast<double>(seed / 3 * 2654435761U % 65536U) / 65536;
  const int handles = static_cast<int>(std::lround(std::pow(most_handles, even)));
  int across = static_cast<int>(std::sqrt(handles)) - static_cast<int>(seed / 7 % 3);
  across = std::max(1, across);
  return tube_grid(1 + across, 1 + handles / across, 5 + static_cast<int>(seed % 2),
                   0.2 + 0.01 * (seed % 10));
}

TriangleMesh surface(unsigned seed) {
  switch (seed % kinds.size()) {
    case 0:
      return noisy_ball(10 + static_cast<int>(seed % 23), 0.1 + 0.0012 * (seed % 200), seed);
    case 1:
      return relabelled(
          bumped_torus(3 + static_cast<int>(seed % 17), 4 + static_cast<int>(seed % 41),
                       0.05 + 0.008 * (seed % 100), 0.01 * (seed % 60), seed),
          seed);
    default:
      return random_tube_grid(seed);
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

constexpr std::array choice_names = {"shortest", "cut", "fill", "area"};

/// Nothing of a surface without handles.
std::optional<Outcome> tried(unsigned seed) {
  const TriangleMesh mesh = surface(seed);
  const long genus = inspect_mesh(mesh).genus;
  if (genus == 0) return std::nullopt;
  RepairOptions options = RepairOptions::none();
  options.handles = true;
  options.longest_handle = 10;
  options.handle_choice = choice(seed);
  const RepairedMesh cut = repair_mesh(mesh, options);
  Outcome outcome;
  outcome.seed = seed;
  outcome.kind = kinds[seed % kinds.size()];
  outcome.choice = choice_names[static_cast<size_t>(options.handle_choice)];
  outcome.genus = genus;
  outcome.triangles = mesh.face_count();
  for (const HandleLoop& loop : cut.handles) {
    outcome.crossing_caps += loop.crossings > 0;
    outcome.longest = std::max(outcome.longest, loop.share);
  }
  outcome.complaint = complaint(mesh, genus, cut);
  return outcome;
}

std::string line_of(const Outcome& o) {
  std::ostringstream line;
  line << o.seed << '\t' << o.kind << '\t' << o.choice << '\t' << o.genus << '\t' << o.triangles
       << '\t' << o.crossing_caps << '\t' << o.longest << '\t'
       << (o.complaint.empty() ? "certified" : o.complaint);
  return line.str();
}

Outcome outcome_of(const std::string& line) {
  std::istringstream words(line);
  Outcome o;
  words >> o.seed >> o.kind >> o.choice >> o.genus >> o.triangles >> o.crossing_caps >> o.longest;
  std::getline(words >> std::ws, o.complaint);
  if (!words) throw std::runtime_error("not a line of a log: " + line);
  if (o.complaint == "certified") o.complaint.clear();
  return o;
}

std::vector<Outcome> read_log(const std::string& path) {
  std::vector<Outcome> outcomes;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) outcomes.push_back(outcome_of(line));
  return outcomes;
}

struct Row {
  long surfaces = 0, handles = 0, most = 0, triangles = 0, crossing_caps = 0, crossed = 0,
       failed = 0;
  double longest = 0;

  void add(const Outcome& o) {
    ++surfaces;
    handles += o.genus;
    most = std::max(most, o.genus);
    triangles += o.triangles;
    crossing_caps += o.crossing_caps;
    crossed += o.crossing_caps > 0;
    failed += !o.complaint.empty();
    longest = std::max(longest, o.longest);
  }
  void print(const std::string& name) const {
    if (surfaces == 0) return;
    std::printf("| %s | %ld | %ld | %ld | %ld | %.0f %% | %ld | %ld | %ld |\n", name.c_str(),
                surfaces, handles, most, triangles / surfaces, 100 * longest, crossing_caps,
                crossed, failed);
  }
};

template <class Belongs>
void print_row(const std::string& name, const std::vector<Outcome>& outcomes, Belongs belongs) {
  Row row;
  for (const Outcome& o : outcomes) {
    if (belongs(o)) row.add(o);
  }
  row.print(name);
}

void print_table(const std::vector<Outcome>& outcomes) {
  std::printf(
      "| surfaces | number | handles | most | triangles, mean | longest loop, of the diagonal | "
      "caps through the surface | surfaces with such | failed "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string kind : kinds) {
    print_row(kind, outcomes, [&](const Outcome& o) { return o.kind == kind; });
  }
  constexpr std::array<long, 6> bounds = {1, 5, 20, 50, 100, 1000};
  for (size_t i = 0; i < bounds.size(); ++i) {
    const long from = i == 0 ? 1 : bounds[i - 1] + 1;
    const std::string name = "genus " + std::to_string(from) +
                             (i == 0                   ? ""
                              : i + 1 == bounds.size() ? " and more"
                                                       : " to " + std::to_string(bounds[i]));
    print_row(name, outcomes,
              [&](const Outcome& o) { return o.genus >= from && o.genus <= bounds[i]; });
  }
  for (const std::string choice : choice_names) {
    print_row("`" + choice + "`", outcomes, [&](const Outcome& o) { return o.choice == choice; });
  }
  print_row("all", outcomes, [](const Outcome&) { return true; });
}

/// Seeds one after the other, until there are so many surfaces.
void run(unsigned seed, size_t count, const std::string& log, std::vector<Outcome>& outcomes) {
  std::ofstream file;
  if (!log.empty()) file.open(log, std::ios::app);
  if (!outcomes.empty()) seed = outcomes.back().seed + 1;
  for (; outcomes.size() < count; ++seed) {
    const std::optional<Outcome> outcome = tried(seed);
    if (!outcome) continue;
    outcomes.push_back(*outcome);
    if (!outcome->complaint.empty()) std::printf("%s\n", line_of(*outcome).c_str());
    if (!log.empty() && !(file << line_of(*outcome) << std::endl)) {
      throw std::runtime_error(log + ": cannot be written to");
    }
  }
}

}  // namespace

int main(int count_of_words, char** words) {
  unsigned first = 1;
  size_t count = 100;
  std::string log;
  CLI::App app("Removes the handles of many surfaces");
  app.add_option("--seed", first, "The first");
  app.add_option("--count", count, "Surfaces with handles");
  app.add_option("--log", log, "A line a surface; what it has already is not done again");
  CLI11_PARSE(app, count_of_words, words);
  std::vector<Outcome> outcomes = log.empty() ? std::vector<Outcome>{} : read_log(log);
  run(first, count, log, outcomes);
  print_table(outcomes);
  const auto failed = [](const Outcome& o) { return !o.complaint.empty(); };
  return std::any_of(outcomes.begin(), outcomes.end(), failed) ? 1 : 0;
}
