#include "reports/remesh_report.h"

#include <nlohmann/json.hpp>

#include "reports/percent.h"
#include "reports/wording.h"
#include "sphparam/io/paths.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

using Json = nlohmann::ordered_json;

/// The file that a level is in.
const std::string& output_of(const RemeshReport& report, size_t level) {
  return report.requests.outputs[report.requests.one_file ? 0 : level];
}

std::string fit_line(const SubdivisionFit& fit, const TriangleMesh& source) {
  const double diagonal = diagonal_of(source.positions);
  return "  " + name_of(fit.topology->scheme()) + " surface fitted: RMS " +
         percent_of(diagonal, fit.rms) + ", at most " + percent_of(diagonal, fit.max) +
         " of the diagonal, one way, from " + std::to_string(fit.samples) +
         " samples on it to the mesh";
}

Json fit_json(const SubdivisionFit& fit, const TriangleMesh& source) {
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
  json["diagonal"] = diagonal_of(source.positions);
  json["solver_steps"] = fit.steps;
  json["thin_vertices"] = fit.thin_vertices;
  json["seconds"]["sampling"] = fit.sampling_seconds;
  json["seconds"]["solving"] = fit.solving_seconds;
  json["seconds"]["projecting"] = fit.projecting_seconds;
  return json;
}

std::string displacement_lines(const WrittenDisplacement& report, const TriangleMesh& source) {
  const auto percent = [diagonal = diagonal_of(source.positions)](double length) {
    return percent_of(diagonal, length);
  };
  const DisplacementFigures& made = report.figures;
  std::string lines = "  displacement from " + percent(made.least) + " to " +
                      percent(made.greatest) + " of the diagonal";
  if (made.missed > 0) {
    lines += ", ";
    lines += std::to_string(made.missed);
    lines += made.missed == 1 ? " texel whose normal misses the mesh"
                              : " texels whose normals miss the mesh";
  }
  if (!report.proof) return lines;
  const auto line = [&](const char* what, const RebuildProof::Error& error) {
    return std::string("\n  ")
        .append(what)
        .append(": RMS ")
        .append(percent(error.rms))
        .append(", at most ")
        .append(percent(error.max))
        .append(" of the diagonal, both ways");
  };
  return lines + line("surface alone", report.proof->base) + line("rebuilt", report.proof->rebuilt);
}

Json displacement_json(const WrittenDisplacement& report, const RemeshArguments& arguments) {
  const DisplacementFigures& made = report.figures;
  const DisplacementSize size = image_size_named(arguments.displacement_size).value();
  Json json;
  json["file"] = arguments.displacement;
  json["width"] = size.width;
  json["height"] = size.height;
  json["min"] = made.least;
  json["max"] = made.greatest;
  json["texels"]["walked"] = made.walked;
  json["texels"]["cast"] = made.cast;
  json["texels"]["missed"] = made.missed;
  json["texels"]["inexact"] = made.inexact;
  json["seconds"] = report.seconds;
  if (!report.proof) return json;
  const auto as_json = [](const RebuildProof::Error& error) {
    return Json{{"rms", error.rms}, {"max", error.max}};
  };
  Json& proof = json["rebuilt"];
  proof["file"] = arguments.rebuilt;
  proof["vertices"] = report.proof->vertices;
  proof["triangles"] = report.proof->triangles;
  proof["certified"] = report.proof->certified;
  proof["base_error"] = as_json(report.proof->base);
  proof["error"] = as_json(report.proof->rebuilt);
  proof["warnings"] = Json::array();
  if (report.proof->farther_than_base()) proof["warnings"].push_back(farther_warning);
  proof["seconds"] = report.proof->seconds;
  return json;
}

std::string level_lines(const RemeshReport& report, const TriangleMesh& source) {
  const double diagonal = diagonal_of(source.positions);
  std::string lines;
  for (size_t i = 0; i < report.levels.size(); ++i) {
    const LevelOfDetail& level = report.levels[i];
    lines.append(lines.empty() ? "  " : "\n  ")
        .append(level.mesh.name())
        .append(", ")
        .append(std::to_string(level.mesh.map().points.rows()))
        .append(" vertices: RMS ")
        .append(percent_of(diagonal, level.distance.value().rms))
        .append(", at most ")
        .append(percent_of(diagonal, level.distance.value().max))
        .append(" of the diagonal, both ways → ")
        .append(output_name(output_of(report, i)));
  }
  return lines;
}

Json levels_json(const RemeshReport& report) {
  Json json = Json::array();
  for (size_t i = 0; i < report.levels.size(); ++i) {
    const LevelOfDetail& level = report.levels[i];
    json.push_back({{"grid", level.mesh.name()},
                    {"file", output_of(report, i)},
                    {"vertices", level.mesh.map().points.rows()},
                    {"faces", level.mesh.faces().count()},
                    {"triangles", level.mesh.mesh().face_count()},
                    {"rms", level.distance.value().rms},
                    {"max", level.distance.value().max}});
  }
  return json;
}

std::vector<std::string> carried_by(const MeshFile& file) {
  std::vector<std::string> carried;
  for (const Property& property : file.vertex_properties) carried.push_back(property.name);
  for (const Property& property : file.face_properties) carried.push_back(property.name);
  if (file.corner_texcoords) carried.emplace_back("uv");
  if (file.corner_normals) carried.emplace_back("corner normal");
  return carried;
}

Json outputs_json(const RemeshArguments& arguments) {
  Json json;
  json["mesh"] = arguments.output;
  json["limit_mesh"] = arguments.limit_output;
  json["displacement"] = arguments.displacement;
  json["rebuilt"] = arguments.rebuilt;
  json["geometry_image"] = arguments.geometry_image;
  json["normals"] = arguments.normal_image;
  json["attribute_images"] = arguments.attribute_images;
  json["csv"] = arguments.csv;
  return json;
}

}  // namespace

std::string to_json(const RemeshReport& report, const MappedMesh& source) {
  const Remeshed& result = report.levels.front().mesh;
  Json json;
  json["sphparam"] = version;
  json["command"] = "remesh";
  json["input"]["file"] = report.arguments.input;
  json["input"]["vertices"] = source.mesh().vertex_count();
  json["input"]["triangles"] = source.mesh().face_count();
  json["input"]["mapped_now"] = source.mapped_here();
  json["grid"]["name"] = report.arguments.grid;
  json["grid"]["vertices"] = result.map().points.rows();
  json["grid"]["faces"] = result.faces().count();
  json["grid"]["triangles"] = result.mesh().face_count();
  json["sample"] = report.arguments.sample == SampleMode::Cell ? "cell" : "point";
  if (report.adaptation) {
    json["adaptive"]["steps"] = report.adaptation->steps;
    json["adaptive"]["least_density"] = report.adaptation->least_density;
    json["adaptive"]["greatest_density"] = report.adaptation->greatest_density;
  }
  json["averaged_vertices"] = result.figures().averaged;
  json["carried"] = carried_by(result.file());
  json["certified"] = true;
  if (const auto& fit = report.levels.front().fit)
    json["subdivision"] = fit_json(*fit, source.mesh());
  if (report.displacement)
    json["displacement"] = displacement_json(*report.displacement, report.arguments);
  if (report.levels.size() > 1) json["lods"] = levels_json(report);
  json["outputs"] = outputs_json(report.arguments);
  json["seconds"]["grid"] = report.grid_seconds;
  json["seconds"]["location"] = result.figures().locate_seconds;
  json["seconds"]["positions"] = result.figures().transfer_seconds;
  json["seconds"]["total"] = report.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void tell(const RemeshReport& report, const TriangleMesh& source, Console& console) {
  const RemeshArguments& arguments = report.arguments;
  const LevelOfDetail& finest = report.levels.front();
  const Remeshed& result = finest.mesh;
  const std::string vertices = std::to_string(result.map().points.rows());
  console.detail("  grid: " + short_number(report.grid_seconds) +
                 " s, location: " + short_number(result.figures().locate_seconds) +
                 " s, positions: " + short_number(result.figures().transfer_seconds) + " s");
  if (arguments.sample == SampleMode::Cell) {
    console.detail("  means over cells at " + std::to_string(result.figures().averaged) + " of " +
                   vertices + " vertices");
  }
  if (finest.fit) console.say(fit_line(*finest.fit, source));
  if (report.displacement) console.say(displacement_lines(*report.displacement, source));
  if (report.levels.size() > 1) console.say(level_lines(report, source));
  std::string line = display_name(arguments.input) + ": " + arguments.grid + ", " + vertices +
                     " vertices, certified one-to-one, " + short_number(report.seconds) + " s";
  if (!arguments.output.empty()) line += " → " + output_name(output_of(report, 0));
  console.say(line);
}

}  // namespace sphparam::cli
