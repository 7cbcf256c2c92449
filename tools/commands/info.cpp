// `sphparam info`: what a file holds, and everything that is wrong with it.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/command.h"
#include "arguments/common_options.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "reports/json_report.h"
#include "console/paths.h"
#include "commands/repairing.h"
#include "commands/source.h"
#include "reports/wording.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/stopwatch.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Say what a mesh is, and everything that is wrong with it.\n"
    "\n"
    "Examples:\n"
    "  sphparam info statue.obj\n"
    "  sphparam info statue.ply --json -\n"
    "  cat statue.off | sphparam info -\n"
    "\n"
    "Ends with 0 when the mesh can be mapped to a sphere, with 4 when it cannot.\n";

constexpr int figure_digits = 6;

struct InfoArguments {
  std::string input;
  std::string json;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// "nx, ny, nz, texture coordinates per corner, 2 materials"
std::string attributes(const MeshFile& file) {
  std::vector<std::string> words;
  for (const Property& property : file.vertex_properties) words.push_back(property.name);
  for (const Property& property : file.face_properties)
    words.push_back(property.name + " per face");
  if (file.corner_texcoords) words.push_back("texture coordinates per corner");
  if (file.corner_normals) words.push_back("normals per corner");
  if (!file.materials.empty()) {
    words.push_back(std::to_string(file.materials.size()) + " materials");
  }
  return words.empty() ? "none" : joined(words);
}

std::string point(const Vector3& p) {
  return "(" + short_number(p.x(), figure_digits) + ", " + short_number(p.y(), figure_digits) +
         ", " + short_number(p.z(), figure_digits) + ")";
}

/// "  label         value"
std::string line(const std::string& label, const std::string& value) {
  constexpr size_t column = 14;
  return "  " + label + std::string(column - std::min(label.size(), column - 1), ' ') + value +
         "\n";
}

std::string counted(long count, const std::string& what) {
  return std::to_string(count) + " " + what;
}

std::string topology(const MeshInspection& mesh) {
  std::string text = "Euler characteristic " + std::to_string(mesh.euler_characteristic);
  if (mesh.genus >= 0) text += ", genus " + std::to_string(mesh.genus);
  if (mesh.boundary_loops) text += ", " + counted(mesh.boundary_loops, "boundary loops");
  return text;
}

std::string figures(const MeshSource& source) {
  const MeshInspection& mesh = source.inspection;
  const MeshFile& file = source.file;
  const std::string triangulated =
      file.polygons ? ", " + counted(file.polygons, "polygons were triangulated") : "";
  return line("format", file.format) + line("vertices", std::to_string(mesh.vertices)) +
         line("triangles", std::to_string(mesh.faces) + triangulated) +
         line("edges", std::to_string(mesh.edges)) +
         line("components", std::to_string(mesh.components)) + line("topology", topology(mesh)) +
         line("bounding box", point(mesh.lower) + " to " + point(mesh.upper)) +
         line("area", short_number(mesh.area, figure_digits)) +
         line("volume", short_number(mesh.volume, figure_digits)) +
         line("attributes", attributes(file)) +
         line("welding", source.welded ? "used: the faces as indexed are not closed" : "not used");
}

std::string text_of(const InfoReport& report) {
  const MeshSource& source = report.input.source;
  std::string text = display_name(report.input.file) + "\n" + figures(source);
  for (const auto& [key, value] : report.provenance) text += line("map " + key, value);
  for (const std::string& note : source.notes) text += line("note", note);
  if (!source.inspection.defects.empty()) {
    text += "What is odd or wrong:\n" + defect_list(source.inspection.defects);
  }
  if (source.inspection.is_sphere()) return text + "A closed genus-0 mesh: it can be mapped.\n";
  return text + "This mesh cannot be mapped to a sphere as it is.\n" +
         words_of(*report.repair, source.path);
}

int run_info(const InfoArguments& arguments) {
  const Stopwatch stopwatch;
  require_report_place({arguments.input}, arguments.json);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  console.progress("inspection", 0);
  const MeshSource source = read_source(arguments.input);
  std::optional<RepairTrial> trial;
  if (!source.inspection.is_sphere()) trial = try_repair(source);
  const InfoReport report = {
      .input = {arguments.input, source},
      .provenance = has_map(source.file) ? read_provenance(source.file) : Provenance{},
      .repair = trial,
      .seconds = stopwatch.seconds()};
  console.clear_progress();
  if (!arguments.json.empty()) write_file(arguments.json, to_json(report));
  if (!is_stream(arguments.json) && !arguments.loudness.quiet) write_file("-", text_of(report));
  if (source.inspection.is_sphere()) return Ok;
  if (arguments.loudness.quiet) {
    print_error(display_name(arguments.input) + ": this is not a closed genus-0 mesh");
  }
  return MeshUnusable;
}

}  // namespace

Command declare_info(CLI::App& program) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = program.add_subcommand("info", summary);
  command
      ->add_option("MESH", arguments->input,
                   "OBJ, PLY, OFF, STL, glTF, GLB or GIFTI; - for standard input")
      ->type_name(" ")
      ->required();
  add_json(*command, arguments->json);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_info(*arguments); }};
}

}  // namespace sphparam::cli
