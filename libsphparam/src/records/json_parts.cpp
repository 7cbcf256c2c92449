// Library values → JSON, key by key in the order a reader wants them.

#include "records/json_parts.h"

#include <nlohmann/json.hpp>

#include "records/body_record.h"
#include "sphparam/names.h"

namespace sphparam {

namespace {

Json names_json(const std::vector<Property>& properties) {
  Json result = Json::array();
  for (const Property& property : properties) result.push_back(property.name);
  return result;
}

}  // namespace

Json vector_json(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json pairs_json(const std::vector<std::pair<std::string, std::string>>& pairs) {
  Json result = Json::object();
  for (const auto& [key, value] : pairs) result[key] = value;
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

Json handles_json(const std::vector<HandleLoop>& loops) {
  Json result = Json::array();
  for (const HandleLoop& loop : loops) {
    result.push_back({{"kind", loop.filled ? "fill" : "cut"},
                      {"length", loop.length},
                      {"diagonals", loop.share},
                      {"centre", vector_json(loop.centre)},
                      {"area_added", loop.area_added},
                      {"crossings", loop.crossings},
                      {"vertices", loop.vertices}});
  }
  return result;
}

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

Json crossings_json(const SelfCrossings& crossings) {
  Json first = nullptr;
  if (crossings.pairs > 0)
    first = {{"triangles", crossings.first}, {"place", vector_json(crossings.place)}};
  return {{"pairs", crossings.pairs},
          {"triangles", crossings.faces},
          {"first", first},
          {"all_looked_at", crossings.all}};
}

Json in_space_json(const std::optional<FacesInSpace>& found) {
  if (!found) return nullptr;
  return {{"triangles", found->faces},
          {"area_share", found->area_share},
          {"turned_over", found->turned_over},
          {"concave_quads", found->concave_quads},
          {"crossings", crossings_json(found->crossings)},
          {"crossings_of_mesh", found->source_pairs}};
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
          {"volume", has_volume(inspection) ? Json(inspection.volume) : Json()},
          {"bounding_box", {vector_json(inspection.lower), vector_json(inspection.upper)}},
          {"defects", defects}};
}

Json input_json(const MeshSource& source) {
  const MeshFile& file = source.file;
  return {{"file", source.path},
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
          {"stretch_linf", d.stretch_linf},
          {"flat_images", d.flat_images},
          {"flat_faces", d.flat_faces}};
}

namespace {

Json stage_json(const StageRecord& stage) {
  Json result = {{"name", stage.name}, {"seconds", stage.seconds}};
  if (stage.planar_folds >= 0) result["planar_folds"] = stage.planar_folds;
  if (stage.folds >= 0) result["folds"] = stage.folds;
  if (stage.distortion) result["distortion"] = distortion_json(stage.distortion);
  return result;
}

}  // namespace

Json stages_json(const std::vector<StageRecord>& stages) {
  Json result = Json::array();
  for (const StageRecord& stage : stages) result.push_back(stage_json(stage));
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

Json textures_json(const std::vector<TextureFigures>& textures) {
  Json all = Json::array();
  for (const TextureFigures& texture : textures)
    all.push_back({{"name", texture.name},
                   {"kind", texture.kind},
                   {"bytes", texture.bytes},
                   {"bytes_as_given", texture.given_bytes},
                   {"exact", texture.exact}});
  return all;
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
          {"max_shift", certificate.max_shift},
          {"vertices", chart->vertices},
          {"triangles", chart->triangles},
          {"wedges", chart->wedges},
          {"folded", certificate.folded},
          {"torn", certificate.torn},
          {"outside", certificate.outside},
          {"malformed", certificate.malformed}};
}

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sphparam
