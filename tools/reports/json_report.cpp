// Library values → JSON, key by key in the order a reader wants them. The only user of
// nlohmann::json, which is slow to compile. Numbers that are not finite become null.

#include "reports/json_report.h"

#include <nlohmann/json.hpp>

#include "sphparam/io/file_numbers.h"
#include "reports/wording.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

Json pairs_json(const NamedTexts& pairs) {
  Json result = Json::object();
  for (const auto& [key, value] : pairs) result[key] = value;
  return result;
}

Json names_json(const std::vector<Property>& properties) {
  Json result = Json::array();
  for (const Property& property : properties) result.push_back(property.name);
  return result;
}

Json defect_json(const MeshDefect& defect) {
  return {{"kind", name_of(defect.kind)}, {"fatal", defect.fatal},     {"count", defect.count},
          {"first", defect.elements},     {"message", defect.message}, {"hint", defect.hint}};
}

Json repairs_json(const std::vector<RepairAction>& repairs) {
  Json result = Json::array();
  for (const RepairAction& repair : repairs) {
    result.push_back({{"kind", name_of(repair.kind)},
                      {"count", repair.count},
                      {"first", repair.elements},
                      {"message", repair.message}});
  }
  return result;
}

/// What choosing a component kept, or may choose from; null where there was one only.
Json parts_json(const KeptParts& parts) {
  if (parts.count == 0) return nullptr;
  Json largest = Json::array();
  for (const SurfacePart& part : parts.largest) {
    largest.push_back({{"area_share", part.area_share},
                       {"face_share", part.face_share},
                       {"triangles", part.faces},
                       {"vertex", part.vertex}});
  }
  return {{"count", parts.count},
          {"area_kept", parts.area_share},
          {"faces_kept", parts.face_share},
          {"largest", largest}};
}

/// What --repair would do; null for a mesh that needs none.
Json trial_json(const std::optional<RepairTrial>& trial) {
  if (!trial) return nullptr;
  Json remaining = Json::array();
  for (const MeshDefect& defect : trial->remaining) remaining.push_back(defect_json(defect));
  return {{"mends", trial->mends_unasked()},
          {"mends_with", trial->can_mend() ? Json("--repair" + further_options(trial->options)) : Json()},
          {"actions", repairs_json(trial->actions)},
          {"components", parts_json(trial->parts)},
          {"remaining", remaining}};
}

Json inspection_json(const MeshInspection& inspection) {
  Json defects = Json::array();
  for (const MeshDefect& defect : inspection.defects) defects.push_back(defect_json(defect));
  return {{"mappable", inspection.is_sphere()},
          {"vertices", inspection.vertices},
          {"used_vertices", inspection.used_vertices},
          {"edges", inspection.edges},
          {"triangles", inspection.faces},
          {"components", inspection.components},
          {"boundary_loops", inspection.boundary_loops},
          {"euler_characteristic", inspection.euler_characteristic},
          {"genus", inspection.genus},
          {"area", inspection.area},
          {"volume", inspection.volume},
          {"bounding_box", {vector_json(inspection.lower), vector_json(inspection.upper)}},
          {"defects", defects}};
}

Json input_json(const InputReport& input) {
  const MeshFile& file = input.source.file;
  return {{"file", input.file},
          {"format", file.format},
          {"vertices", file.mesh.vertex_count()},
          {"triangles", file.mesh.face_count()},
          {"polygons_triangulated", file.polygons},
          {"vertex_properties", names_json(file.vertex_properties)},
          {"face_properties", names_json(file.face_properties)},
          {"corner_texture_coordinates", file.corner_texcoords.has_value()},
          {"corner_normals", file.corner_normals.has_value()},
          {"materials", file.materials},
          {"comments", file.comments}};
}

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

Json pins_json(const MapReport& report) {
  const FileNumbers numbers(report.input.source.file);
  const std::vector<double>& residuals = report.result.pin_residuals;
  Json result = Json::array();
  for (size_t i = 0; i < report.pins.size(); ++i) {
    const Landmark& pin = report.pins[i];
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

/// The λ that the map is minimised for, where one is.
Json lambda_json(const MapReport& report) {
  const ParameterizeOptions& options = report.options;
  const bool minimises = !report.account && options.method != Method::Paper &&
                         options.energy.kind == EnergyKind::AngleAndArea;
  if (!minimises) return nullptr;
  return report.result.balance ? report.result.balance->lambda : options.energy.lambda;
}

Json balance_json(const std::optional<BalanceRecord>& balance) {
  if (!balance) return nullptr;
  return {{"lambda", balance->lambda},
          {"mean_abs_log2_area", balance->area_error},
          {"moved", balance->moved}};
}

Json options_json(const MapReport& report) {
  const ParameterizeOptions& options = report.options;
  if (report.account) {
    return {{"method", report.method},
            {"repair", report.repairs_wanted},
            {"repair_map", options.repair_paper}};
  }
  Json result = {{"method", report.method},
                 {"poles", wanted_poles(options)},
                 {"meridian", options.meridian ? Json(*options.meridian) : Json()},
                 {"lambda", options.energy.lambda},
                 {"repair", report.repairs_wanted},
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

Json distortion_json(const std::optional<DistortionSummary>& distortion) {
  if (!distortion) return nullptr;
  const DistortionSummary& d = *distortion;
  return {{"mean_abs_ln_area", d.mean_abs_ln_area},
          {"mean_abs_ln_angle", d.mean_abs_ln_angle},
          {"area_within_two", d.area_within_two},
          {"area_ratio_min", d.area_ratio_min},
          {"area_ratio_p01", d.area_ratio_p01},
          {"area_ratio_p50", d.area_ratio_p50},
          {"area_ratio_p99", d.area_ratio_p99},
          {"area_ratio_max", d.area_ratio_max},
          {"angle_ratio_max", d.angle_ratio_max},
          {"weighted_abs_log2_area", d.weighted_abs_log2_area},
          {"symmetric_dirichlet", d.symmetric_dirichlet},
          {"quasi_conformal_mean", d.quasi_conformal_mean},
          {"quasi_conformal_max", d.quasi_conformal_max},
          {"stretch_l2", d.stretch_l2},
          {"stretch_linf", d.stretch_linf}};
}

Json stage_json(const StageRecord& stage) {
  Json result = {{"name", stage.name}, {"seconds", stage.seconds}};
  if (stage.planar_folds >= 0) result["planar_folds"] = stage.planar_folds;
  if (stage.folds >= 0) result["folds"] = stage.folds;
  if (stage.distortion) result["distortion"] = distortion_json(stage.distortion);
  return result;
}

Json certificate_json(const Certificate& c) {
  return {{"verdict", verdict(c)},
          {"one_to_one", c.bijective()},
          {"folds", c.fold_count()},
          {"degree", c.degree},
          {"covering", c.covering},
          {"reversed", c.reversed},
          {"max_length_error", c.max_length_error},
          {"folded_faces", c.folded},
          {"degenerate_faces", c.degenerate},
          {"unusable_points", c.unusable_points},
          {"branch_vertices", c.branch_vertices}};
}

Json chart_json(const std::optional<ChartReport>& chart) {
  if (!chart) return nullptr;
  if (!chart->not_made.empty()) return {{"certified", false}, {"not_made", chart->not_made}};
  const ChartCounts& counts = chart->counts;
  const ChartCertificate& certificate = chart->certificate;
  return {{"certified", certificate.one_to_one()},
          {"splits",
           {{"total", counts.splits()},
            {"poles", counts.pole_splits},
            {"meridian", counts.meridian_splits},
            {"folds", counts.fold_splits}}},
          {"folded_without_splits", counts.folded_faces},
          {"snapped_vertices", counts.snapped_vertices},
          {"nudged_vertices", counts.nudged_vertices},
          {"vertices", chart->vertices},
          {"triangles", chart->triangles},
          {"wedges", chart->wedges},
          {"folded", certificate.folded},
          {"torn", certificate.torn},
          {"outside", certificate.outside},
          {"malformed", certificate.malformed}};
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

/// Of a method of others; null for ours.
Json account_json(const std::optional<BaselineAccount>& account) {
  if (!account) return nullptr;
  return {{"source", account->citation},
          {"end", name_of(account->end)},
          {"iterations", account->iterations},
          {"statement", account->statement}};
}

Json contender_json(const Entry& c) {
  Json stages = Json::array();
  for (const StageRecord& stage : c.stages) stages.push_back(stage_json(stage));
  return {{"name", c.name},
          {"source", c.source},
          {"seconds", c.seconds ? Json(*c.seconds) : Json()},
          {"iterations", c.iterations},
          {"statement", c.statement},
          {"has_map", c.has_map()},
          {"stages", stages},
          {"certificate", c.has_map() ? certificate_json(c.certificate) : Json()},
          {"distortion", distortion_json(c.figures)}};
}

/// Bytes of a file name that are not UTF-8 must not stop the report.
std::string text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string to_json(const MapReport& report) {
  Json stages = Json::array();
  for (const StageRecord& stage : report.result.stages) stages.push_back(stage_json(stage));
  const FileNumbers numbers(report.input.source.file);
  return text({{"sphparam", version},
               {"command", "map"},
               {"input", input_json(report.input)},
               {"inspection", inspection_json(report.input.source.inspection)},
               {"repairs", repairs_json(report.input.source.repairs)},
               {"components", parts_json(report.input.source.parts)},
               {"options", options_json(report)},
               {"account", account_json(report.account)},
               {"stages", stages},
               {"made_by", report.result.made_by},
               {"poles", poles_json(report.result.poles, numbers)},
               {"meridian", vertex_json(report.result.meridian, numbers)},
               {"pole_residuals", pole_residuals_json(report.pole_residuals)},
               {"pins", pins_json(report)},
               {"lambda", lambda_json(report)},
               {"balance", balance_json(report.result.balance)},
               {"energy_cost", report.result.pole_cost},
               {"certificate", certificate_json(report.certificate)},
               {"distortion", distortion_json(report.distortion)},
               {"chart", chart_json(report.chart)},
               {"outputs", pairs_json(report.outputs)},
               {"warnings", report.result.warnings},
               {"notes", report.input.source.notes},
               {"seconds", report.seconds}});
}

std::string to_json(const InfoReport& report) {
  return text({{"sphparam", version},
               {"command", "info"},
               {"input", input_json(report.input)},
               {"inspection", inspection_json(report.input.source.inspection)},
               {"repair", trial_json(report.repair)},
               {"welded", report.input.source.welded},
               {"provenance", pairs_json(report.provenance)},
               {"notes", report.input.source.notes},
               {"seconds", report.seconds}});
}

std::string to_json(const VerifyReport& report) {
  return text({{"sphparam", version},
               {"command", "verify"},
               {"file", report.file},
               {"rays", report.rays},
               {"mean_length", report.mean_length},
               {"length_deviation", report.length_deviation},
               {"certificate", certificate_json(report.certificate)},
               {"distortion", distortion_json(report.distortion)},
               {"chart", chart_json(report.chart)},
               {"notes", report.notes},
               {"seconds", report.seconds}});
}

std::string to_json(const CompareReport& report) {
  Json maps = Json::array();
  for (const Entry& c : report.entries) maps.push_back(contender_json(c));
  return text({{"sphparam", version},
               {"command", "compare"},
               {"input", input_json(report.input)},
               {"maps", maps},
               {"notes", report.input.source.notes},
               {"seconds", report.seconds}});
}

}  // namespace sphparam::cli
