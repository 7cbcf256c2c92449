#include "pipeline/required_options.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include "curvilinear/harmonic.h"
#include "embedding/energy/energy_domain.h"
#include "option_domain.h"
#include "sphere/distinct_directions.h"
#include "sphere/required_directions.h"

namespace sphparam {
namespace {

void require_paper(const PaperSettings& paper) {
  require_more_than("paper.epsilon", paper.epsilon, 0);
  require_between("paper.epsilon", paper.epsilon, 0, greatest_epsilon);
  require_at_least("paper.iterations", paper.iterations, 0);
  require_at_least("paper.rings", paper.rings, 0);
  require_at_least("paper.sweeps", paper.sweeps, 0);
  require_one_of("paper.weights", paper.weights, WeightKind::SymmetricMeanValue);
}

void require_energy(const ParameterizeOptions& options) {
  if (options.energy.kind == EnergyKind::AngleAndArea)
    require_between("energy.lambda", options.energy.lambda, least_lambda, greatest_lambda);
  require_domain(options.energy);
}

void require_pins(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  std::set<Vertex> seen;
  DistinctDirections directions;
  if (options.poles) {
    seen = {options.poles->north, options.poles->south};
    directions.add(Vector3::UnitZ());
    directions.add(-Vector3::UnitZ());
  }
  for (const Landmark& pin : options.pins) {
    require_vertex("pins: vertex", pin.vertex, mesh.vertex_count());
    require_finite("pins: theta", pin.coordinates.theta);
    require_finite("pins: phi", pin.coordinates.phi);
    if (!seen.insert(pin.vertex).second) {
      throw std::invalid_argument("vertex " + std::to_string(pin.vertex) + " is pinned twice");
    }
    if (directions.add(to_cartesian(pin.coordinates))) {
      throw std::invalid_argument("vertex " + std::to_string(pin.vertex) +
                                  " is pinned where another one, or one of the poles, is");
    }
  }
}

/// One finite ray a vertex, none of them 0, and nothing else that says where the map lies.
void require_alignment(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  const Points& rays = options.align_to->points;
  if (rays.rows() != mesh.vertex_count() || !rays.allFinite() ||
      (rays.array() == 0).rowwise().all().any()) {
    throw std::invalid_argument("align_to: one finite ray a vertex is needed, none of them 0");
  }
  if (options.poles || options.meridian || !options.pins.empty()) {
    throw std::invalid_argument("align_to: not with poles, meridian or pins");
  }
}

void require_radial(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  for (int axis = 0; axis < 3; ++axis) require_finite("centre", options.centre[axis]);
  if (options.method != Method::Radial) return;
  if (options.poles || options.meridian || !options.pins.empty() || options.align_to) {
    throw std::invalid_argument(
        "method: Method::Radial lies as the body does: no poles, meridian, pins or align_to");
  }
  require_directions(mesh, options.centre);
}

void require_frame(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  if (options.poles) {
    require_vertex("poles.north", options.poles->north, mesh.vertex_count());
    require_vertex("poles.south", options.poles->south, mesh.vertex_count());
    if (options.poles->north == options.poles->south) {
      refuse_option("poles.south", options.poles->south, "another vertex than poles.north");
    }
  }
  if (options.align_to) require_alignment(mesh, options);
  require_radial(mesh, options);
  if (options.meridian) require_vertex("meridian", *options.meridian, mesh.vertex_count());
  require_pins(mesh, options);
}

void require_fillers(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  require_more_than("filler_share", options.filler_share, 0);
  require_between("filler_share", options.filler_share, 0, 1);
  const FillerMarks& fillers = options.fillers;
  if (fillers.empty()) return;
  if (std::ssize(fillers) != mesh.face_count()) {
    throw std::invalid_argument("fillers: " + std::to_string(fillers.size()) + " marks of " +
                                std::to_string(mesh.face_count()) + " triangles");
  }
  if (std::find(fillers.begin(), fillers.end(), 0) == fillers.end()) {
    throw std::invalid_argument("fillers: every triangle is marked, there is no surface");
  }
}

}  // namespace

void require_domain(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  require_one_of("method", options.method, Method::Radial);
  require_one_of("quality", options.quality, Quality::Best);
  require_one_of("balance", options.balance, Balance::EqualArea);
  require_at_least("sweeps", options.sweeps, 0);
  require_paper(options.paper);
  require_energy(options);
  require_frame(mesh, options);
  require_fillers(mesh, options);
}

}  // namespace sphparam
