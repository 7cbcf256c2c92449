#include "reports/remesh_report.h"

#include <nlohmann/json.hpp>

#include "commands/remesh_subdivision.h"
#include "sphparam/version.h"

namespace sphparam::cli {

std::string to_json(const RemeshReport& report) {
  using Json = nlohmann::ordered_json;
  const Remeshed& result = report.result;
  std::vector<std::string> carried;
  for (const Property& property : result.file.vertex_properties) carried.push_back(property.name);
  for (const Property& property : result.file.face_properties) carried.push_back(property.name);
  if (result.file.corner_texcoords) carried.emplace_back("uv");
  if (result.file.corner_normals) carried.emplace_back("corner normal");
  Json json;
  json["sphparam"] = version;
  json["command"] = "remesh";
  json["input"]["file"] = report.arguments.input;
  json["input"]["vertices"] = report.source.file().mesh.vertex_count();
  json["input"]["triangles"] = report.source.file().mesh.face_count();
  json["input"]["mapped_now"] = report.source.mapped_here();
  json["grid"]["name"] = report.arguments.grid;
  json["grid"]["vertices"] = result.map.points.rows();
  json["grid"]["faces"] = result.faces.count();
  json["grid"]["triangles"] = result.file.mesh.face_count();
  json["sample"] = report.arguments.sample == SampleMode::Cell ? "cell" : "point";
  if (report.adaptation) {
    json["adaptive"]["steps"] = report.adaptation->steps;
    json["adaptive"]["least_density"] = report.adaptation->least_density;
    json["adaptive"]["greatest_density"] = report.adaptation->greatest_density;
  }
  json["averaged_vertices"] = result.averaged;
  json["carried"] = carried;
  json["certified"] = true;
  if (report.fit) {
    json["subdivision"] = fit_report(*report.fit, report.source.file().mesh);
  }
  if (report.displacement) json["displacement"] = to_json(*report.displacement, report.arguments);
  if (report.levels.size() > 1) json["lods"] = to_json(report.levels);
  json["outputs"]["mesh"] = report.arguments.output;
  json["outputs"]["limit_mesh"] = report.arguments.limit_output;
  json["outputs"]["displacement"] = report.arguments.displacement;
  json["outputs"]["rebuilt"] = report.arguments.rebuilt;
  json["outputs"]["geometry_image"] = report.arguments.geometry_image;
  json["outputs"]["normals"] = report.arguments.normal_image;
  json["outputs"]["attribute_images"] = report.arguments.attribute_images;
  json["outputs"]["csv"] = report.arguments.csv;
  json["seconds"]["grid"] = report.grid_seconds;
  json["seconds"]["location"] = result.locate_seconds;
  json["seconds"]["positions"] = result.transfer_seconds;
  json["seconds"]["total"] = report.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sphparam::cli
