// The options of a map, and what they mean on the mesh at hand.

#include "map_request.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "sphere/body_centre.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/upright_frame.h"
#include "sphparam/names.h"

namespace sphparam::python {
namespace {

void take_method(Settings& settings, ParameterizeOptions& options) {
  settings
      .take("method", options.method,
            by_name({Method::Progressive, Method::Curvilinear, Method::Paper, Method::Radial}))
      .take("quality", options.quality, by_name({Quality::Draft, Quality::Normal, Quality::Best}))
      .take("balance", options.balance,
            by_name({Balance::Lambda, Balance::Conformal, Balance::EqualArea}))
      .take("energy", options.energy.kind,
            by_name({EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}))
      .take("lambda", options.energy.lambda);
}

void take_paper(Settings& settings, PaperSettings& paper) {
  settings.take("epsilon", paper.epsilon)
      .take("iterations", paper.iterations)
      .take("rings", paper.rings)
      .take("sweeps", paper.sweeps)
      .take("weights", paper.weights,
            {{"mean-value", WeightKind::MeanValue}, {"cotangent", WeightKind::Cotangent}});
}

/// Where the map lies.
void take_frame(Settings& settings, Request& request) {
  ParameterizeOptions& options = request.options;
  std::optional<std::pair<int, int>> poles;
  std::optional<std::array<double, 3>> centre;
  std::optional<py::array> rays;
  std::string up, front;
  settings.take("automatic_poles", options.automatic_poles)
      .take("pins", request.pins)
      .take("poles", poles)
      .take("meridian", options.meridian)
      .take("centre", centre)
      .take("to_body", request.to_body)
      .take("align_to", rays)
      .take("up", up)
      .take("front", front)
      .take("stands", request.stands)
      .take("upright_poles", request.upright_poles);
  request.up = up_of(up, front);
  if (poles) options.poles = Poles{poles->first, poles->second};
  if (centre) options.centre = Vector3(centre->data());
  bool finite = true;
  if (rays) options.align_to = SphereMap{points_of(*rays, finite)};
}

}  // namespace

Request map_request_of(const py::dict& values) {
  Request request;
  ParameterizeOptions& options = request.options;
  Settings settings(values);
  take_method(settings, options);
  take_paper(settings, options.paper);
  take_frame(settings, request);
  settings.take("threads", options.threads)
      .take("filler_share", options.filler_share)
      .take("repair_map", options.repair_paper)
      .take("measure_stages", options.measure_stages);
  settings.require_all_known();
  return request;
}

namespace {

void stand(Request& request, MeshFile& file, const Topology& topology) {
  ParameterizeOptions& options = request.options;
  const UprightAxes axes = upright_axes(file, request.up);
  note_up(file, {axes.up, axes.front});
  if (!request.upright_poles && !options.poles) return;
  const bool has_date_line = options.method == Method::Paper;  // where θ is 0
  const std::optional<Vertex> meridian = options.meridian;
  options.fillers = fillers_of(file);
  options = with_upright_frame(std::move(options), file.mesh, topology, axes);
  if (has_date_line) options.meridian = meridian;
}

void settle_vertices(Request& request, const MeshFile& file) {
  ParameterizeOptions& options = request.options;
  if (!options.poles && !options.meridian && request.pins.empty()) return;
  const FileNumbers numbers(file);
  options = with_vertices_of_mesh(std::move(options), numbers);
  for (const auto& [number, theta, phi] : request.pins) {
    const Vertex vertex = numbers.vertex(static_cast<long>(number));
    if (vertex < 0) throw NoSuchVertex("pins", numbers.absence(static_cast<long>(number)));
    options.pins.push_back({vertex, {theta, phi}});
  }
}

}  // namespace

std::vector<std::string> settle(Request& request, MeshFile& file, const Topology& topology) {
  ParameterizeOptions& options = request.options;
  settle_vertices(request, file);
  if (request.stands) stand(request, file, topology);
  if (request.to_body) options.align_to = body_directions(file, options.centre);
  std::vector<std::string> doubts;
  if (request.to_body || options.method == Method::Radial)
    doubts.push_back(line_of_outside(file.mesh, options.centre));
  std::erase(doubts, "");
  return doubts;
}

}  // namespace sphparam::python
