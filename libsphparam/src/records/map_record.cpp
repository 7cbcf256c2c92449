#include "sphparam/records/map_record.h"

#include <nlohmann/json.hpp>
#include <numbers>

#include "io/attributes/corner_colours.h"
#include "mesh/enclosed_volume.h"
#include "mesh/unit_size.h"
#include "records/json_parts.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/names.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

/// Vertices go by their numbers in the file.
Json vertex_json(const std::optional<Vertex>& vertex, const FileNumbers& numbers) {
  return vertex ? Json(numbers.number(*vertex)) : Json();
}

Json poles_json(const std::optional<Poles>& poles, const FileNumbers& numbers) {
  if (!poles) return nullptr;
  return {{"north", numbers.number(poles->north)}, {"south", numbers.number(poles->south)}};
}

/// The options as given: numbers of the file already.
Json wanted_poles(const ParameterizeOptions& options) {
  if (!options.poles) return options.automatic_poles ? "auto" : "none";
  return {{"north", options.poles->north}, {"south", options.poles->south}};
}

Json pins_json(const MapRecord& record) {
  const FileNumbers numbers(record.source.file);
  const std::vector<double>& residuals = record.result.pin_residuals;
  Json result = Json::array();
  for (size_t i = 0; i < record.pins.size(); ++i) {
    const Landmark& pin = record.pins[i];
    result.push_back({{"vertex", numbers.number(pin.vertex)},
                      {"theta", pin.coordinates.theta},
                      {"phi", pin.coordinates.phi},
                      {"residual", i < residuals.size() ? Json(residuals[i]) : Json()}});
  }
  return result;
}

Json pole_residuals_json(const std::vector<double>& residuals) {
  if (residuals.empty()) return nullptr;
  return {{"north", residuals[0]}, {"south", residuals[1]}};
}

/// The energy that the map is minimised for, where one is.
std::optional<DistortionEnergy> energy_of(const MapRecord& record) {
  if (record.account || record.options.method == Method::Paper) return std::nullopt;
  DistortionEnergy energy = record.options.energy;
  if (record.result.balance) energy.lambda = record.result.balance->lambda;
  return energy;
}

Json lambda_json(const MapRecord& record) {
  const std::optional<DistortionEnergy> energy = energy_of(record);
  return energy && energy->kind == EnergyKind::AngleAndArea ? Json(energy->lambda) : Json();
}

/// Of the finished map, over that of an isometry.
Json energy_json(const MapRecord& record) {
  const std::optional<DistortionEnergy> energy = energy_of(record);
  const std::optional<Topology>& topology = record.source.topology;
  const SphereMap& map = record.result.map;
  if (!energy || !topology || map.points.rows() == 0) return nullptr;
  const TriangleMesh& given = record.source.file.mesh;
  const std::optional<Rescaled> rescaled = at_unit_size(given);
  const int threads = record.options.threads;
  const RestTriangles rest = measure_source(rescaled ? rescaled->mesh : given, threads);
  const double of_isometry = 4 * std::numbers::pi * energy_density(*energy, 1, 1);
  return distortion_energy(*topology, rest, map, *energy, threads) / of_isometry;
}

Json optional_json(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

Json balance_json(const std::optional<BalanceRecord>& balance) {
  if (!balance) return nullptr;
  return {{"lambda", balance->lambda},
          {"mean_abs_log2_area", balance->area_error},
          {"moved", balance->moved}};
}

Json radial_json(const std::optional<RadialRecord>& radial) {
  if (!radial) return nullptr;
  const Vector3& c = radial->centre;
  return {{"centre", {c.x(), c.y(), c.z()}},
          {"folds", radial->folds},
          {"folded_area", radial->folded_area},
          {"moved", radial->moved},
          {"largest_movement", radial->largest_movement}};
}

Json options_json(const MapRecord& record) {
  const ParameterizeOptions& options = record.options;
  const std::string method = record.method.empty() ? name_of(options.method) : record.method;
  if (record.account) {
    return {{"method", method},
            {"repair", names_of(record.repairs)},
            {"repair_map", options.repair_paper}};
  }
  Json result = {{"method", method},
                 {"poles", wanted_poles(options)},
                 {"meridian", options.meridian ? Json(*options.meridian) : Json()},
                 {"lambda", options.energy.lambda},
                 {"repair", names_of(record.repairs)},
                 {"repair_map", options.repair_paper}};
  if (options.method == Method::Progressive) {
    result["balance"] = name_of(options.balance);
    result["quality"] = name_of(options.quality);
    result["energy"] = name_of(options.energy.kind);
  }
  if (options.method == Method::Paper) {
    const PaperSettings& paper = options.paper;
    result["weights"] = name_of(paper.weights);
    result["epsilon"] = paper.epsilon;
    result["iterations"] = paper.iterations;
    result["rings"] = paper.rings;
    result["sweeps"] = paper.sweeps;
  }
  return result;
}

const char* name_of(BaselineEnd end) {
  switch (end) {
    case BaselineEnd::Converged:
      return "converged";
    case BaselineEnd::IterationLimit:
      return "iteration-limit";
    case BaselineEnd::Stalled:
      return "stalled";
    case BaselineEnd::NoResult:
      return "no-result";
  }
  return "";
}

/// Of a map that follows another mesh's; null for others.
Json likeness_json(const MapRecord& record) {
  if (!record.likeness) return nullptr;
  const Likeness& likeness = *record.likeness;
  return {{"other", record.other},
          {"in_place", likeness.in_place},
          {"nowhere", likeness.nowhere},
          {"median_distance", likeness.median},
          {"farthest", likeness.farthest}};
}

/// Of a method of others; null for ours.
Json account_json(const std::optional<BaselineAccount>& account) {
  if (!account) return nullptr;
  return {{"source", account->citation},
          {"end", name_of(account->end)},
          {"iterations", account->iterations},
          {"statement", account->statement}};
}

/// What reading, welding and repair note in a mesh.
bool is_noted(const std::string& property) {
  return property == "source_vertex" || property == "source_face" || is_corner_colour(property);
}

Json input_json(const MapRecord& record) {
  Json json = input_json(record.source);
  if (!record.input) return json;
  Json of_faces = Json::array();
  for (const Property& property : record.source.file.face_properties)
    if (!is_noted(property.name)) of_faces.push_back(property.name);
  json["face_properties"] = std::move(of_faces);
  json["vertex_properties"] = record.input->vertex_properties;
  json["comments"] = record.input->comments;
  return json;
}

std::vector<std::string> warnings_of(const MapRecord& record) {
  std::vector<std::string> warnings = shape_warnings(record.source);
  const std::vector<std::string>& made = record.result.warnings;
  warnings.insert(warnings.end(), made.begin(), made.end());
  return warnings;
}

}  // namespace

InputNames input_names(const MeshFile& file) {
  InputNames names;
  for (const Property& property : file.vertex_properties)
    if (!is_noted(property.name)) names.vertex_properties.push_back(property.name);
  for (const std::string& comment : file.comments)
    if (!says_vertices_of_file(comment)) names.comments.push_back(comment);
  return names;
}

std::vector<std::string> shape_warnings(const MeshSource& source) {
  std::vector<std::string> warnings;
  if (is_sheet(source.file.mesh, fillers_of(source.file))) return warnings;
  for (const MeshDefect& defect : source.inspection.defects)
    if (defect.kind == DefectKind::InsideOut)
      warnings.push_back(defect.message +
                         ", and the map a mirror image of the body: --repair=orientation turns it");
  return warnings;
}

std::string to_json(const MapRecord& record) {
  const FileNumbers numbers(record.source.file);
  Json json = {{"sphparam", version},
               {"command", "map"},
               {"input", input_json(record)},
               {"inspection", inspection_json(record.source.inspection)},
               {"repairs", repairs_json(record.source.repairs)},
               {"handles", handles_json(record.source.handles)},
               {"added", record.source.added_share},
               {"components", parts_json(record.source.parts)},
               {"options", options_json(record)},
               {"account", account_json(record.account)},
               {"like", likeness_json(record)},
               {"stages", stages_json(record.result.stages)},
               {"made_by", record.result.made_by},
               {"made_anew", record.result.made_anew},
               {"poles", poles_json(record.result.poles, numbers)},
               {"meridian", vertex_json(record.result.meridian, numbers)},
               {"radial", radial_json(record.result.radial)},
               {"alignment", record.result.alignment ? Json(*record.result.alignment) : Json()},
               {"pole_residuals", pole_residuals_json(record.pole_residuals)},
               {"pins", pins_json(record)},
               {"lambda", lambda_json(record)},
               {"filler_share", optional_json(record.result.filler_share)},
               {"balance", balance_json(record.result.balance)},
               {"energy", energy_json(record)},
               {"energy_gap", optional_json(record.result.energy_gap)},
               {"energy_cost", record.result.pole_cost},
               {"certificate", certificate_json(record.result.certificate)},
               {"distortion", distortion_json(record.distortion)},
               {"chart", chart_json(record.chart)},
               {"outputs", pairs_json(record.outputs)},
               {"warnings", warnings_of(record)},
               {"notes", record.source.notes},
               {"seconds", record.seconds}};
  if (!record.upright.empty()) json["upright"] = record.upright;
  return text_of(json);
}

}  // namespace sphparam
