// How far matches are from the truth on sets of shapes whose correspondences are known: geodesic
// distance over √area of the target, a line a pair and a table of means. Landmarks are drawn from
// the truth by farthest points. The shapes are in two public repositories, one folder each:
//
//     git clone https://github.com/llorz/SGA18_orientation_BCICP_dataset bcicp
//     git clone https://github.com/patr-schm/surface-maps-via-adaptive-triangulations shrec
//     match_table --bcicp bcicp/Dataset --shrec shrec/data/meshes/shrec --log pairs.tsv
//
// Distances are of paths along edges and across pairs of triangles, as Dijkstra finds them: some
// per cent too long, never too short. A pair belongs to the third that was held out when its number
// leaves 2 divided by 3. Landmarks are no points that errors are measured at. With --pictures the
// worst pair of each line of the table is drawn, both surfaces coloured by places on the second.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/pictures.h"
#include "correspondence/surface_roads.h"
#include "mesh/triangle_geometry.h"
#include "showcase/match_pictures.h"
#include "sphparam/correspondence/match.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/stopwatch.h"

using namespace sphparam;
namespace fs = std::filesystem;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int held_out = 2;  // the remainder, by 3, of a held-out pair's number

/// A shape, and which of its vertices are known to correspond to those of others of its set.
struct Shape {
  MappedMesh mapped;
  std::vector<Vertex> truth;
  double map_seconds;
};

struct Pair {
  std::string first, second;
};

struct Set {
  std::string name;
  std::vector<Pair> pairs;
  std::map<std::string, std::pair<std::string, std::string>> files;  // mesh and truth, of a shape
  bool one_based = false;
  int landmarks = 5;
  bool alike = false;  // in space, which a search may use
};

struct Outcome {
  std::optional<SurfaceMap> map = {};
  bool certified = false;
  double error = 0, most = 0, seconds = 0, energy = 0, confidence = 1;
  std::string complaint;
};

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) { return mesh.position(mesh.triangles(f, k)); };
    area += triangle_area(corner(0), corner(1), corner(2));
  }
  return area;
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

Shape load(const Set& set, const std::string& name, int threads) {
  const auto& [mesh, truth] = set.files.at(name);
  const Stopwatch watch;
  MappedMesh mapped = load_mapped(mesh, {.map = {.threads = threads}});
  mapped.locator();
  Shape shape{std::move(mapped), {}, watch.seconds()};
  for (const std::string& line : lines_of(truth))
    shape.truth.push_back(std::stoi(line) - (set.one_based ? 1 : 0));
  return shape;
}

/// Numbers in the truth, each as far as can be from those before.
std::vector<size_t> farthest_points(const Shape& shape, const SurfaceRoads& roads, int count) {
  std::vector<double> near = roads.distances(shape.truth[0], {});
  std::vector<size_t> chosen;
  for (int n = 0; n < count; ++n) {
    size_t best = 0;
    for (size_t i = 0; i < shape.truth.size(); ++i) {
      const auto distance = [&](size_t j) { return near[static_cast<size_t>(shape.truth[j])]; };
      if (distance(i) > distance(best)) best = i;
    }
    chosen.push_back(best);
    const std::vector<double> from = roads.distances(shape.truth[best], {});
    for (size_t v = 0; v < near.size(); ++v)
      near[v] = n == 0 ? from[v] : std::min(near[v], from[v]);
  }
  return chosen;
}

Outcome score(const Shape& from, const Shape& to, const SurfaceRoads& from_roads,
              const SurfaceRoads& to_roads, const Set& set, int most_points, int threads) try {
  const std::vector<size_t> landmarks = farthest_points(from, from_roads, set.landmarks);
  MatchOptions options;
  options.threads = threads;
  options.search = set.landmarks == 0;
  options.alike = set.alike;
  for (const size_t i : landmarks) options.landmarks.push_back({from.truth[i], to.truth[i]});
  const Stopwatch watch;
  const Match match = match_surfaces(from.mapped, to.mapped, options);
  Outcome outcome;
  outcome.seconds = watch.seconds();
  outcome.certified = match.map.from().certificate().bijective();
  outcome.energy = match.energy;
  outcome.confidence = match.confidence;
  outcome.map = match.map;
  const std::vector<SurfacePoint> forth = match.map.forth(threads);
  const size_t count = std::min(from.truth.size(), to.truth.size());
  const size_t stride = std::max<size_t>(1, count / static_cast<size_t>(most_points));
  const double unit = std::sqrt(area_of(to.mapped.mesh()));
  int measured = 0;
  for (size_t i = 0; i < count; i += stride) {
    if (std::ranges::count(landmarks, i) > 0) continue;
    const double error =
        to_roads.distance(to.truth[i], forth[static_cast<size_t>(from.truth[i])]) / unit;
    outcome.error += error;
    outcome.most = std::max(outcome.most, error);
    ++measured;
  }
  outcome.error /= measured;
  return outcome;
} catch (const std::exception& error) {
  Outcome outcome;
  outcome.complaint = error.what();
  return outcome;
}

void add_files(Set& set, const fs::path& meshes, const fs::path& truths) {
  for (const auto& entry : fs::directory_iterator(meshes)) {
    const std::string name = entry.path().stem().string();
    const fs::path truth = truths / (name + ".vts");
    if (entry.path().extension() == ".off" && fs::exists(truth))
      set.files[name] = {entry.path().string(), truth.string()};
  }
}

Set bcicp_set(const fs::path& folder, bool both_ways) {
  Set set;
  set.name = folder.filename().string();
  set.one_based = true;
  add_files(set, folder / "vtx_5k", folder / "vtx_5k" / "corres");
  for (const std::string& line : lines_of(folder / "test_pairs.txt")) {
    Pair pair;
    std::istringstream(line) >> pair.first >> pair.second;
    set.pairs.push_back(pair);
    if (both_ways) set.pairs.push_back({pair.second, pair.first});
  }
  return set;
}

Set shrec_set(const fs::path& folder) {
  Set set;
  set.name = "SHREC07 four-legged";
  set.landmarks = 6;
  add_files(set, folder, folder);
  for (const auto& [first, files] : set.files)
    for (const auto& [second, others] : set.files)
      if (first != second) set.pairs.push_back({first, second});
  return set;
}

struct Tally {
  int pairs = 0, certified = 0;
  double error = 0, worst = 0, seconds = 0, slowest = 0;
  std::vector<double> errors;
  std::optional<SurfaceMap> worst_map = {};
};

void draw_worst(const std::string& folder, const std::string& name, const Tally& tally,
                int threads) {
  if (folder.empty() || !tally.worst_map) return;
  fs::create_directories(folder);
  const MatchPictures pictures(*tally.worst_map, {}, {.up = Vector3::UnitY(), .threads = threads});
  std::ofstream(fs::path(folder) / (name + ".png"), std::ios::binary)
      << png(pictures.places(false));
}

void tell(const std::string& name, const Tally& tally) {
  if (tally.pairs == 0) return;
  std::vector<double> errors = tally.errors;
  std::ranges::sort(errors);
  const double median = errors.empty() ? 0 : errors[errors.size() / 2];
  std::printf(
      "%-34s %4d pairs, %4d certified, error %.4f, median pair %.4f, worst %.4f, %.2f s a pair, "
      "slowest %.2f s\n",
      name.c_str(), tally.pairs, tally.certified,
      tally.error / static_cast<double>(std::max<size_t>(1, errors.size())), median, tally.worst,
      tally.seconds / tally.pairs, tally.slowest);
}

void run(const Set& set, int every, int offset, int most_points, int threads,
         const std::string& pictures, std::ofstream& log) {
  std::map<std::string, Shape> shapes;
  std::map<std::string, SurfaceRoads> roads;
  const auto prepare = [&](const std::string& name) {
    if (shapes.contains(name)) return;
    const Shape& shape = shapes.emplace(name, load(set, name, threads)).first->second;
    roads.emplace(name, SurfaceRoads(shape.mapped.mesh(), shape.mapped.topology()));
  };
  Tally developed, held;
  for (size_t i = static_cast<size_t>(offset); i < set.pairs.size();
       i += static_cast<size_t>(every)) {
    const auto& [first, second] = set.pairs[i];
    prepare(first);
    prepare(second);
    const Outcome outcome = score(shapes.at(first), shapes.at(second), roads.at(first),
                                  roads.at(second), set, most_points, threads);
    Tally& tally = i % 3 == held_out ? held : developed;
    ++tally.pairs;
    tally.certified += outcome.certified;
    tally.seconds += outcome.seconds;
    tally.slowest = std::max(tally.slowest, outcome.seconds);
    if (outcome.complaint.empty()) {
      tally.errors.push_back(outcome.error);
      tally.error += outcome.error;
      if (outcome.error >= tally.worst) {
        tally.worst = outcome.error;
        tally.worst_map = outcome.map;
      }
    }
    log << set.name << '\t' << i << '\t' << first << '\t' << second << '\t' << outcome.error << '\t'
        << outcome.most << '\t' << outcome.energy << '\t' << outcome.seconds << '\t'
        << outcome.confidence << '\t' << outcome.complaint << std::endl;
  }
  tell(set.name + ", developed on", developed);
  tell(set.name + ", held out", held);
  const std::string name =
      set.name + (set.landmarks == 0 ? " without landmarks" : "") + (set.alike ? ", alike" : "");
  draw_worst(pictures, name, developed, threads);
  draw_worst(pictures, name + ", held out", held, threads);
}

// Pairs of the program of Schmidt et al., "Surface maps via adaptive triangulations" (2023), with
// the landmarks that its examples have: what our maps distort, which is what it minimises. Their
// maps have to be made by it.

struct Example {
  std::string name, first, second, first_landmarks, second_landmarks;
};

std::vector<Example> examples() {
  std::vector<Example> all{
      {"plane, bird", "meshes/shrec/61.off", "meshes/shrec/248.off",
       "landmarks/shrec_plane_bird/61.pinned", "landmarks/shrec_plane_bird/248.pinned"},
      {"busts", "meshes/shrec/302.off", "meshes/shrec/314.off",
       "landmarks/shrec_user_sizing/302.vts", "landmarks/shrec_user_sizing/314.vts"},
      {"cat, horse", "meshes/yang2020/cat_horse/input0.obj", "meshes/yang2020/cat_horse/input1.obj",
       "meshes/yang2020/cat_horse/landmarks0.txt", "meshes/yang2020/cat_horse/landmarks1.txt"},
      {"rabbits", "meshes/yang2020/rabbit12-15/input0.obj",
       "meshes/yang2020/rabbit12-15/input1.obj", "meshes/yang2020/rabbit12-15/landmarks0.txt",
       "meshes/yang2020/rabbit12-15/landmarks1.txt"}};
  for (const char* hand : {"0", "1", "3", "5", "7", "8"})
    all.push_back({std::string("hands, ") + hand, "meshes/hand/hand_plain.obj",
                   "meshes/hand/hand_vulcan.obj", "meshes/hand/hand_plain.pinned",
                   std::string("meshes/hand/hand_vulcan_") + hand + ".pinned"});
  return all;
}

/// A vertex a line, maybe after a word, maybe with coordinates behind.
std::vector<Vertex> vertices_in(const std::string& path) {
  std::vector<Vertex> vertices;
  for (const std::string& line : lines_of(path))
    vertices.push_back(std::stoi(line.substr(line.find_first_of("0123456789"))));
  return vertices;
}

void run_example(const fs::path& data, const Example& example, int threads) try {
  const MappedMesh first = load_mapped(data / example.first, {.map = {.threads = threads}});
  const MappedMesh second = load_mapped(data / example.second, {.map = {.threads = threads}});
  const std::vector<Vertex> from = vertices_in(data / example.first_landmarks);
  const std::vector<Vertex> to = vertices_in(data / example.second_landmarks);
  MatchOptions options;
  options.threads = threads;
  for (size_t i = 0; i < std::min(from.size(), to.size()); ++i)
    options.landmarks.push_back({from[i], to[i]});
  const Stopwatch watch;
  const Match match = match_surfaces(first, second, options);
  const double seconds = watch.seconds();
  const DistortionSummary d = summarise(measure_distortion(match.map, threads));
  std::printf(
      "%-12s %6ld %6ld triangles, %2zu landmarks, energy %.3f, symmetric Dirichlet %.2f, "
      "|ln area| %.3f, |ln angle| %.3f, %.1f s\n",
      example.name.c_str(), static_cast<long>(first.mesh().face_count()),
      static_cast<long>(second.mesh().face_count()), options.landmarks.size(), match.energy,
      d.symmetric_dirichlet, d.mean_abs_ln_area, d.mean_abs_ln_angle, seconds);
  for (const std::string& warning : match.warnings) std::printf("    %s\n", warning.c_str());
} catch (const std::exception& error) {
  std::printf("%-12s %s\n", example.name.c_str(), error.what());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Scores matches of surfaces against known correspondences.");
  std::string bcicp, shrec, schmidt, pictures, log_path = "match_table.tsv";
  bool none = false, alike = false;
  int every = 1, offset = 0, points = 500, threads = 0;
  app.add_option("--bcicp", bcicp, "The folder Dataset of SGA18_orientation_BCICP_dataset");
  app.add_option("--shrec", shrec, "data/meshes/shrec of surface-maps-via-adaptive-triangulations");
  app.add_option("--schmidt", schmidt, "data of surface-maps-via-adaptive-triangulations");
  app.add_flag("--without-landmarks", none);
  app.add_flag("--alike", alike, "Without landmarks: take the shapes to lie alike in space");
  app.add_option("--log", log_path, "A line a pair");
  app.add_option("--pictures", pictures, "A folder for pictures of the worst pairs");
  app.add_option("--every", every, "Only every so many pairs")->check(CLI::PositiveNumber);
  app.add_option("--offset", offset, "The first of these")->check(CLI::NonNegativeNumber);
  app.add_option("--points", points, "At most, of the truth, that are measured a pair");
  app.add_option("--threads", threads);
  CLI11_PARSE(app, argc, argv);
  std::ofstream log(log_path);
  const auto with = [&](Set set) {
    if (none) set.landmarks = 0;
    set.alike = none && alike;
    return set;
  };
  if (!bcicp.empty()) {
    run(with(bcicp_set(fs::path(bcicp) / "FAUST", false)), every, offset, points, threads, pictures,
        log);
    run(with(bcicp_set(fs::path(bcicp) / "TOSCA_nonIsometric", true)), every, offset, points,
        threads, pictures, log);
  }
  if (!schmidt.empty())
    for (const Example& example : examples()) run_example(schmidt, example, threads);
  if (!shrec.empty()) run(with(shrec_set(shrec)), every, offset, points, threads, pictures, log);
  return 0;
}
