#include "paper_trial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "curvilinear/paper_map.h"
#include "sphparam/errors.h"
#include "sphparam/mesh/mesh_defects.h"

namespace sphparam::samples {

namespace {

constexpr int further_iterations = 10;

/// Triangles with all corners in the patch that the paper smooths.
std::vector<Face> faces_within(const TriangleMesh& mesh, const std::vector<Vertex>& patch) {
  std::vector<char> inside(static_cast<size_t>(mesh.vertex_count()), 0);
  for (const Vertex v : patch) inside[static_cast<size_t>(v)] = 1;
  std::vector<Face> faces;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    int corners = 0;
    for (int k = 0; k < 3; ++k) corners += inside[static_cast<size_t>(mesh.triangles(f, k))];
    if (corners == 3) faces.push_back(f);
  }
  return faces;
}

struct PatchMeans {
  double angle = 0, area = 0;
};

PatchMeans means(const Distortion& distortion, const std::vector<Face>& faces) {
  PatchMeans sums;
  for (const Face f : faces) {
    sums.area += std::abs(std::log(distortion.area_ratio[f]));
    sums.angle += distortion.angle_ratio.row(f).array().log().abs().sum() / 3;
  }
  const double count = static_cast<double>(std::max<size_t>(faces.size(), 1));
  return {sums.angle / count, sums.area / count};
}

/// Runs the method and measures every stage of it.
std::vector<PaperStep> observe(const TriangleMesh& mesh, const Topology& topology, Poles poles,
                               const PaperOptions& options, const std::vector<Face>& patch,
                               bool keep_maps) {
  std::vector<PaperStep> steps;
  map_as_paper(mesh, topology, poles, options, {},
               [&](const PaperStage& stage, const SphereMap& map) {
                 const Distortion distortion = measure_distortion(mesh, map);
                 const PatchMeans around = means(distortion, patch);
                 steps.push_back({stage.name, stage.planar_folds,
                                  certify(topology, map).fold_count(), summarise(distortion),
                                  around.angle, around.area, keep_maps ? map : SphereMap{}});
               });
  return steps;
}

std::optional<PaperSteps> paper_steps(const TriangleMesh& mesh, const Topology& topology,
                                      bool keep_maps) {
  const std::optional<Poles> poles = choose_poles(mesh, topology);
  if (!poles) return std::nullopt;
  const PaperOptions printed;
  const DateLine line = shortest_date_line(mesh, topology, *poles);
  PaperSteps steps;
  steps.patch = faces_within(mesh, date_line_patch(topology, line, printed.rings));
  steps.date_line_middle = mesh.position(line.path[line.path.size() / 2]);
  try {
    steps.printed = observe(mesh, topology, *poles, printed, steps.patch, keep_maps);
    steps.further = observe(mesh, topology, *poles, {.iterations = further_iterations, .sweeps = 0},
                            steps.patch, false);
  } catch (const SolveError&) {  // the entry says so too
    return std::nullopt;
  }
  if (steps.further.back().name == "smoothing") steps.further.pop_back();  // of no sweeps
  return steps;
}

}  // namespace

const std::vector<PaperModel>& paper_models() {
  static const std::vector<PaperModel> models = {
      {"mannequin", "1", 23, 3, 0},   {"homer", "2", 0, 0, 0},         {"gargoyle", "3", 50, 7, 0},
      {"skull", "6, 10", 40, 5, 132}, {"gargoyle", "7, 11", 20, 0, 0}, {"turtle", "8", 38, 0, 0},
      {"camel", "9", 78, 0, 0},       {"cow", "9", 23, 0, 0}};
  return models;
}

const Entry& Trial::by(const std::string& method) const {
  return *std::find_if(entries.begin(), entries.end(),
                       [&](const Entry& c) { return c.name == method; });
}

Trial try_mesh(std::string name, MeshFile file, bool keep_maps) {
  Trial trial = {std::move(name), std::move(file), {}, std::nullopt};
  const Topology topology = require_sphere(trial.file.mesh);
  for (const MethodInfo& info : all_methods()) {
    Entry entry = entry_of_method(info.method, trial.file.mesh, {});
    if (!keep_maps) {
      entry.map.points.resize(entry.has_map() ? 1 : 0, 3);
      entry.distortion.reset();
    }
    trial.entries.push_back(std::move(entry));
  }
  trial.steps = paper_steps(trial.file.mesh, topology, keep_maps);
  return trial;
}

}  // namespace sphparam::samples
