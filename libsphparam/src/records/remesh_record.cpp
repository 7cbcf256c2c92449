#include "sphparam/records/remesh_record.h"

#include <nlohmann/json.hpp>

#include "number_text.h"
#include "records/error_words.h"
#include "records/json_parts.h"
#include "sphparam/io/paths.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

/// The file that a level is in: all are in one, or each has its own.
const std::string& output_of(const RemeshRecord& record, size_t level) {
  const RemeshOutputs& outputs = record.outputs;
  return level < outputs.levels.size() ? outputs.levels[level] : outputs.mesh;
}

double source_diagonal(const RemeshRecord& record) {
  return diagonal_of(record.source.mesh().positions);
}

/// "ico:5: at most 0.012 (0.4 % of the diagonal) from the mesh, either way"
std::string within_words(const RemeshRecord& record) {
  const double max = record.within->max;
  return record.grid + ": at most " + short_number(max) + " (" +
         percent(max / source_diagonal(record)) + " of the diagonal) from the mesh, either way";
}

std::string fit_line(const SubdivisionFit& fit, double diagonal) {
  return "  " + name_of(fit.topology->scheme()) +
         " surface fitted: " + error_words(fit.rms, fit.max, diagonal) + ", one way, from " +
         std::to_string(fit.samples) + " samples on it to the mesh\n";
}

Json fit_json(const SubdivisionFit& fit, double diagonal) {
  Json json;
  json["scheme"] = name_of(fit.topology->scheme());
  json["control_points"] = fit.control.rows();
  json["patches"] = fit.topology->patch_count();
  json["samples"] = fit.samples;
  json["rms"] = fit.rms;
  json["max"] = fit.max;
  json["two_sided_rms"] = fit.two_sided_rms;
  json["flat_rms"] = fit.flat_rms;
  json["rms_in_place"] = fit.rms_in_place;
  json["diagonal"] = diagonal;
  json["solver_steps"] = fit.steps;
  json["thin_vertices"] = fit.thin_vertices;
  json["seconds"]["sampling"] = fit.sampling_seconds;
  json["seconds"]["solving"] = fit.solving_seconds;
  json["seconds"]["projecting"] = fit.projecting_seconds;
  return json;
}

std::string proof_line(const char* what, const RebuildProof::Error& error, double diagonal) {
  return "  " + std::string(what) + ": " + error_words(error.rms, error.max, diagonal) +
         ", both ways\n";
}

std::string displacement_lines(const WrittenDisplacement& written, double diagonal) {
  const DisplacementFigures& made = written.figures;
  std::string lines = "  displacement from " + percent(made.least / diagonal) + " to " +
                      percent(made.greatest / diagonal) + " of the diagonal";
  if (made.missed > 0) {
    lines += ", " + counted(made.missed, "texel whose normal misses the mesh",
                            "texels whose normals miss the mesh");
  }
  lines += "\n";
  if (!written.proof) return lines;
  return lines + proof_line("surface alone", written.proof->base, diagonal) +
         proof_line("rebuilt", written.proof->rebuilt, diagonal);
}

Json error_json(const RebuildProof::Error& error) {
  return {{"rms", error.rms}, {"max", error.max}};
}

Json proof_json(const RebuildProof& proof, const std::string& file) {
  Json json;
  json["file"] = file;
  json["vertices"] = proof.vertices;
  json["triangles"] = proof.triangles;
  json["certified"] = proof.certified;
  json["base_error"] = error_json(proof.base);
  json["error"] = error_json(proof.rebuilt);
  json["warnings"] = Json::array();
  if (proof.farther_than_base()) json["warnings"].push_back(farther_warning);
  json["seconds"] = proof.seconds;
  return json;
}

Json displacement_json(const WrittenDisplacement& written, const RemeshOutputs& outputs) {
  const DisplacementFigures& made = written.figures;
  Json json;
  json["file"] = outputs.displacement;
  json["width"] = written.width;
  json["height"] = written.height;
  json["layout"] = written.layout ? "grid" : "equirectangular";
  json["scale"] = written.scale;
  json["midlevel"] = written.midlevel;
  json["min"] = made.least;
  json["max"] = made.greatest;
  json["texels"]["walked"] = made.walked;
  json["texels"]["cast"] = made.cast;
  json["texels"]["missed"] = made.missed;
  json["texels"]["inexact"] = made.inexact;
  json["seconds"] = written.seconds;
  if (written.proof) json["rebuilt"] = proof_json(*written.proof, outputs.rebuilt);
  return json;
}

std::string layout_line(const std::string& grid, const TextureLayout& layout) {
  const auto times = [](int a, int b) { return std::to_string(a) + " × " + std::to_string(b); };
  return "  texture coordinates in the layout of " + grid + ": " +
         (layout.columns > 1 ? times(layout.columns, layout.rows) + " tiles, " : "") +
         times(layout.width, layout.height) + " texels, one a vertex of " +
         counted(layout.levels, "level", "levels") + " of subdivision\n";
}

Json layout_json(const TextureLayout& layout) {
  return {{"layout", "grid"},        {"width", layout.width},
          {"height", layout.height}, {"tiles", {layout.columns, layout.rows}},
          {"steps", layout.steps},   {"gutter", layout.gutter},
          {"levels", layout.levels}};
}

std::string level_lines(const RemeshRecord& record, double diagonal) {
  std::string lines;
  for (size_t i = 0; i < record.levels.size(); ++i) {
    const LevelOfDetail& level = record.levels[i];
    const LevelOfDetail::Distance& distance = level.distance.value();
    lines += "  " + level.mesh.name() + ", " + std::to_string(level.mesh.map().points.rows()) +
             " vertices: " + error_words(distance.rms, distance.max, diagonal) + ", both ways → " +
             output_name(output_of(record, i)) + "\n";
  }
  return lines;
}

Json levels_json(const RemeshRecord& record) {
  Json json = Json::array();
  for (size_t i = 0; i < record.levels.size(); ++i) {
    const LevelOfDetail& level = record.levels[i];
    json.push_back({{"grid", level.mesh.name()},
                    {"file", output_of(record, i)},
                    {"vertices", level.mesh.map().points.rows()},
                    {"faces", level.mesh.faces().count()},
                    {"triangles", level.mesh.mesh().face_count()},
                    {"in_space", in_space_json(level.in_space)},
                    {"rms", level.distance.value().rms},
                    {"max", level.distance.value().max}});
  }
  return json;
}

Json adaptation_json(const Adaptation& adaptation) {
  return {{"steps", adaptation.steps},
          {"least_density", adaptation.least_density},
          {"greatest_density", adaptation.greatest_density}};
}

std::vector<std::string> carried_by(const MeshFile& file) {
  std::vector<std::string> carried;
  for (const Property& property : file.vertex_properties) carried.push_back(property.name);
  for (const Property& property : file.face_properties) carried.push_back(property.name);
  if (file.corner_texcoords) carried.emplace_back("uv");
  if (file.corner_normals) carried.emplace_back("corner normal");
  return carried;
}

Json outputs_json(const RemeshOutputs& outputs) {
  return {{"mesh", outputs.mesh},
          {"limit_mesh", outputs.limit_mesh},
          {"displacement", outputs.displacement},
          {"rebuilt", outputs.rebuilt},
          {"geometry_image", outputs.geometry_image},
          {"normals", outputs.normals},
          {"attribute_images", outputs.attribute_images},
          {"csv", outputs.csv},
          {"data", outputs.data}};
}

Json head_json(const RemeshRecord& record) {
  const MappedMesh& source = record.source;
  const Remeshed& made = record.levels.front().mesh;
  return {{"sphparam", version},
          {"command", "remesh"},
          {"input",
           {{"file", record.input},
            {"vertices", source.mesh().vertex_count()},
            {"triangles", source.mesh().face_count()},
            {"mapped_now", source.mapped_here()}}},
          {"grid",
           {{"name", record.grid},
            {"vertices", made.map().points.rows()},
            {"faces", made.faces().count()},
            {"triangles", made.mesh().face_count()}}},
          {"sample", name_of(record.sample)}};
}

}  // namespace

std::vector<std::string> warnings_of(const RemeshRecord& record) {
  std::vector<std::string> warnings;
  if (record.within && !record.within->holds())
    warnings.push_back(within_words(record) + ", more than " + short_number(record.within->most) +
                       ": no finer grid is looked at");
  for (const LevelOfDetail& level : record.levels) {
    if (!level.in_space || level.in_space->all_well()) continue;
    warnings.push_back(warning_of(*level.in_space, record.source, level.mesh));
  }
  return warnings;
}

std::string to_json(const RemeshRecord& record) {
  const LevelOfDetail& finest = record.levels.front();
  const Remeshed::Figures& figures = finest.mesh.figures();
  Json json = head_json(record);
  if (record.within)
    json["within"] = {{"most", record.within->most},
                      {"max", record.within->max},
                      {"held", record.within->holds()}};
  if (record.adaptation) json["adaptive"] = adaptation_json(*record.adaptation);
  json["averaged_vertices"] = figures.averaged;
  json["carried"] = carried_by(finest.mesh.file());
  json["certified"] = true;
  json["in_space"] = in_space_json(finest.in_space);
  json["warnings"] = warnings_of(record);
  if (finest.fit) json["subdivision"] = fit_json(*finest.fit, source_diagonal(record));
  if (record.layout) json["texture"] = layout_json(*record.layout);
  if (record.displacement)
    json["displacement"] = displacement_json(*record.displacement, record.outputs);
  if (record.levels.size() > 1) json["lods"] = levels_json(record);
  json["outputs"] = outputs_json(record.outputs);
  json["seconds"] = {{"grid", record.grid_seconds},
                     {"location", figures.locate_seconds},
                     {"positions", figures.transfer_seconds},
                     {"total", record.seconds}};
  return text_of(json);
}

std::string to_text(const RemeshRecord& record) {
  const LevelOfDetail& finest = record.levels.front();
  const double diagonal = source_diagonal(record);
  std::string lines;
  if (record.within && record.within->holds()) lines += "  " + within_words(record) + "\n";
  if (finest.fit) lines += fit_line(*finest.fit, diagonal);
  if (record.layout) lines += layout_line(record.grid, *record.layout);
  if (record.displacement) lines += displacement_lines(*record.displacement, diagonal);
  if (record.levels.size() > 1) lines += level_lines(record, diagonal);
  lines += display_name(record.input) + ": " + record.grid + ", " +
           std::to_string(finest.mesh.map().points.rows()) + " vertices, certified one-to-one, " +
           short_number(record.seconds) + " s";
  if (!record.outputs.mesh.empty()) lines += " → " + output_name(output_of(record, 0));
  return lines + "\n";
}

}  // namespace sphparam
