#include "sphparam/baselines/curvature_flow.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "baselines/harmless_mesh.h"
#include "baselines/mobius_centring.h"
#include "baselines/outcome.h"
#include "baselines/vertex_system.h"
#include "mesh/triangle_geometry.h"
#include "option_domain.h"
#include "sphparam/mesh/edge_weights.h"

// (M_t + δ L₀) x_{t+1} = M_t x_t. Linear elements: a triangle of area A adds A/6 to M_ii, A/12 to
// M_ij. The mean curvature flow would take L_t; with L₀, the cotangents of the source, angles stay.
#include "number_text.h"

namespace sphparam {
namespace {

/// M_t by vertex and by half-edge; the surface's area and centre.
struct Mass {
  std::vector<double> diagonal, off_diagonal;
  double area = 0;
  Vector3 centre = Vector3::Zero();
};

Mass measure_mass(const Topology& topology, const Points& x) {
  Mass mass{std::vector<double>(static_cast<size_t>(topology.vertex_count()), 0),
            std::vector<double>(static_cast<size_t>(topology.halfedge_count()), 0)};
  for (Face f = 0; f < topology.face_count(); ++f) {
    const std::array<Vertex, 3> t = {topology.vertex(f, 0), topology.vertex(f, 1),
                                     topology.vertex(f, 2)};
    const Vector3 a = x.row(t[0]), b = x.row(t[1]), c = x.row(t[2]);
    const double area = triangle_area(a, b, c);
    for (int k = 0; k < 3; ++k) {
      const Halfedge h = 3 * f + k;
      mass.diagonal[static_cast<size_t>(t[static_cast<size_t>(k)])] += area / 6;
      mass.off_diagonal[static_cast<size_t>(h)] += area / 12;
      mass.off_diagonal[static_cast<size_t>(topology.twin(h))] += area / 12;
    }
    mass.area += area;
    mass.centre += area * (a + b + c) / 3;
  }
  if (mass.area > 0) mass.centre /= mass.area;
  return mass;
}

/// Centres the surface and scales it to area 4π. False if it has no area.
bool standardise(const Topology& topology, Points& x) {
  const Mass mass = measure_mass(topology, x);
  if (!(mass.area > 0) || !std::isfinite(mass.area)) return false;
  x.rowwise() -= mass.centre.transpose();
  x *= std::sqrt(4 * std::numbers::pi / mass.area);
  return true;
}

/// Root mean square deviation of the radii from their mean, as a share of it; by area.
double roundness(const Points& x, const std::vector<double>& mass) {
  double sum = 0, first = 0, second = 0;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double m = mass[static_cast<size_t>(v)], r = x.row(v).norm();
    sum += m;
    first += m * r;
    second += m * r * r;
  }
  const double mean = first / sum;
  return std::sqrt(std::max(0.0, second / sum - mean * mean)) / mean;
}

class Flow {
 public:
  Flow(const TriangleMesh& mesh, const Topology& topology, const FlowOptions& options)
      : topology_(topology),
        stiffness_(EdgeWeights(mesh, topology, WeightKind::Cotangent, options.threads)
                       .with(topology, {}, options.threads)),
        time_step_(options.time_step),
        system_(topology, 1) {}

  /// Throws: SolveError.
  Points step(const Points& x) {
    const Mass mass = measure_mass(topology_, x);
    std::vector<double> diagonal = mass.diagonal, off_diagonal = mass.off_diagonal;
    Points moments = x;  // M x
    for (Vertex v = 0; v < topology_.vertex_count(); ++v) {
      moments.row(v) *= mass.diagonal[static_cast<size_t>(v)];
    }
    for (Halfedge h = 0; h < topology_.halfedge_count(); ++h) {
      const Vertex i = topology_.origin(h);
      const double flux = time_step_ * stiffness_[static_cast<size_t>(h)];
      diagonal[static_cast<size_t>(i)] += flux;
      off_diagonal[static_cast<size_t>(h)] -= flux;
      moments.row(i) += mass.off_diagonal[static_cast<size_t>(h)] * x.row(topology_.target(h));
    }
    system_.factorise(diagonal, off_diagonal);
    return system_.solve(moments);
  }

 private:
  const Topology& topology_;
  const std::vector<double> stiffness_;
  const double time_step_;
  VertexSystem system_;
};

SphereMap projected(const Points& x) {
  SphereMap map{x};
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double length = x.row(v).norm();
    if (length > 0) {
      map.points.row(v) /= length;
    } else {
      map.points.row(v) << 0, 0, 1;
    }
  }
  return map;
}

}  // namespace

BaselineResult map_flow(const TriangleMesh& given, const Topology& topology,
                        const FlowOptions& options, const Progress& progress) {
  require_at_least("max_steps", options.max_steps, 0);
  require_more_than("time_step", options.time_step, 0);
  require_at_least("roundness", options.roundness, 0);
  const HarmlessMesh harmless(given);
  const TriangleMesh& mesh = harmless.mesh;
  return run_rival([&](Outcome& outcome) {
    report(progress, "curvature flow", 0);
    Points x = mesh.positions;
    if (!standardise(topology, x)) return outcome.no_result("the surface has no area");
    Flow flow(mesh, topology, options);
    outcome.finish_stage("matrices");
    double deviation = roundness(x, measure_mass(topology, x).diagonal);
    int steps = 0;
    for (; steps < options.max_steps && deviation > options.roundness; ++steps) {
      report(progress, "curvature flow", double(steps) / options.max_steps);
      x = flow.step(x);
      if (!standardise(topology, x)) return outcome.no_result("the flow collapsed to no area");
      deviation = roundness(x, measure_mass(topology, x).diagonal);
    }
    outcome.finish_stage("curvature flow", steps);
    SphereMap map = mobius_centred(projected(x), vertex_masses(mesh), 60, options.threads);
    outcome.finish_stage("Möbius centring");
    const bool round = deviation <= options.roundness;
    return outcome.take(std::move(map),
                        round ? BaselineEnd::Converged : BaselineEnd::IterationLimit,
                        (round ? "round after " : "not round after ") + std::to_string(steps) +
                            " steps: radii deviate by " + short_number(deviation));
  });
}

}  // namespace sphparam
