#include "mapping/task_trial.h"

#include <cmath>
#include <ctime>
#include <exception>
#include <utility>

#include "digest.h"
#include "random.h"
#include "sphparam/io/upright_frame.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/sphere/radial_directions.h"
#include "support/test_meshes.h"

namespace sphparam::campaign {
namespace {

constexpr double largest_mean = 1e300;  // JSON has neither infinity nor NaN

double finite(double mean) { return std::isfinite(mean) ? mean : largest_mean; }

sphparam::Poles drawn_poles(const TriangleMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  const auto count = static_cast<int>(mesh.vertex_count());
  const Vertex north = random.below(count);
  return {north, (north + random.between(1, count - 1)) % count};
}

/// The options of a way, with those of a placement.
ParameterizeOptions placed(ParameterizeOptions options, Placement placement,
                           const TriangleMesh& mesh, const Topology& topology,
                           const UprightAxes& axes, std::uint64_t seed) {
  options.threads = 1;
  options.automatic_poles = placement == Placement::Automatic;
  if (placement == Placement::Upright)
    return with_upright_frame(std::move(options), mesh, topology, axes);
  if (placement == Placement::Drawn) options.poles = drawn_poles(mesh, seed);
  if (placement == Placement::Aligned)
    options.align_to = radial_directions(mesh, mesh.positions.colwise().mean());
  return options;
}

/// The poles, or the directions, are those asked for.
bool is_placed(const Parameterization& result, const ParameterizeOptions& options) {
  if (options.align_to) return result.alignment.has_value();
  if (!options.poles) return true;
  return result.poles && result.poles->north == options.poles->north &&
         result.poles->south == options.poles->south;
}

void take_result(const TriangleMesh& mesh, const Topology& topology, const Parameterization& result,
                 TaskRecord& record) {
  record.made_by = result.made_by;
  for (const StageRecord& stage : result.stages) record.stages.push_back(stage.name);
  if (result.map.points.rows() != topology.vertex_count()) {
    record.end = not_certified;
    record.reason = "no map";
    return;
  }
  const Certificate certificate = certify(topology, result.map, 1);
  record.end = certificate.bijective() ? certified : not_certified;
  if (!certificate.bijective()) record.reason = verdict(certificate);
  Digest digest;
  digest.add(result.map.points);
  record.digest = digest.bits();
  const DistortionSummary distortion = summarise_distortion(mesh, result.map, 1);
  record.mean_abs_ln_angle = finite(distortion.mean_abs_ln_angle);
  record.mean_abs_ln_area = finite(distortion.mean_abs_ln_area);
}

}  // namespace

TaskRecord TaskTrial::blank(std::int64_t number) const {
  const Task task = tasks_.task(number);
  const SourceMesh& mesh = tasks_.mesh_of(task);
  TaskRecord record{.task = number,
                    .mesh = mesh.path,
                    .folder = mesh.folder,
                    .size = name_of_size(task.size),
                    .order = name_of_order(task.order),
                    .poles = placements[static_cast<size_t>(task.placement)],
                    .way = ways()[static_cast<size_t>(task.way)].name};
  const std::uint64_t in_all_ways = static_cast<std::uint64_t>(number) / ways().size();
  if (task.order > 0) record.order_seed = static_cast<std::uint32_t>(mixed(seed_, in_all_ways));
  return record;
}

TaskRecord TaskTrial::run(std::int64_t number) {
  const Task task = tasks_.task(number);
  TaskRecord record = blank(number);
  try {
    prepare(tasks_.mesh_of(task));
    map(task, record);
  } catch (const std::exception& error) {
    record.end = thrown;
    record.reason = first_line(error);
  }
  return record;
}

void TaskTrial::prepare(const SourceMesh& mesh) {
  if (mesh.path == path_) return;
  MeshFile file = load(mesh);
  axes_ = upright_axes(file);
  shapes_.clear();
  shapes_[0] = std::move(file.mesh);
  path_ = mesh.path;
}

const TriangleMesh& TaskTrial::shape(int size) {
  if (!shapes_.contains(size)) shapes_[size] = next_simplification(shape(size - 1), size);
  return shapes_[size];
}

void TaskTrial::map(const Task& task, TaskRecord& record) {
  TriangleMesh mesh = shape(task.size);
  record.triangles = mesh.face_count();
  if (task.order > 0) mesh = tests::relabelled(mesh, record.order_seed);
  const Topology topology = require_sphere(mesh);
  const auto placement = static_cast<Placement>(task.placement);
  const std::uint64_t poles_seed = mixed(seed_ + 1, static_cast<std::uint64_t>(record.task));
  const ParameterizeOptions options = placed(ways()[static_cast<size_t>(task.way)].options,
                                             placement, mesh, topology, axes_, poles_seed);
  const std::clock_t begun = std::clock();
  const Parameterization result = parameterize(mesh, topology, options);
  record.seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  record.placed = is_placed(result, options);
  take_result(mesh, topology, result, record);
}

}  // namespace sphparam::campaign
