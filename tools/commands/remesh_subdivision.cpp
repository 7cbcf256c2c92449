// A limit surface fitted to the source, and what `remesh` writes of it.

#include "commands/remesh_subdivision.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "arguments/choice.h"
#include "commands/diagonal.h"
#include "console/exit_codes.h"
#include "console/paths.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace {

/// Whether all faces, or some, are triangles.
bool is_of_triangles(const std::optional<GridSpec>& grid) {
  return !grid || (grid->kind != GridKind::Cube && grid->kind != GridKind::Geographic &&
                   grid->kind != GridKind::Healpix);
}

void set(MeshFile& file, const char* name, const auto& values) {
  file.set_vertex_property({name, ScalarType::Float64, {values.begin(), values.end()}});
}

}  // namespace

void declare_subdivision_options(CLI::App& command, RemeshArguments& arguments) {
  add_choice<std::optional<Scheme>>(
      command, "--subdiv-fit", arguments.subdivision,
      {{"loop", Scheme::Loop}, {"catmark", Scheme::CatmullClark}},
      "The new mesh is the control mesh of a subdivision surface that is fitted to the mesh: loop "
      "on grids of triangles, catmark on grids of quads");
  command
      .add_option("--limit-mesh", arguments.limit_output,
                  "With --subdiv-fit, also the mesh whose vertices lie on that surface: .ply, .obj")
      ->type_name("FILE");
}

void check_subdivision(const RemeshArguments& arguments, const std::optional<GridSpec>& grid) {
  const std::string& limit = arguments.limit_output;
  if (!arguments.subdivision) {
    if (!limit.empty()) throw UsageMistake("--limit-mesh is of --subdiv-fit, which is missing");
    return;
  }
  const bool triangles = is_of_triangles(grid);
  if (*arguments.subdivision == Scheme::Loop && !triangles) {
    throw UsageMistake("--subdiv-fit loop is for grids of triangles, and " + arguments.grid +
                       " has quads: use catmark");
  }
  if (*arguments.subdivision == Scheme::CatmullClark && triangles) {
    throw UsageMistake("--subdiv-fit catmark is for grids of quads, and " + arguments.grid +
                       " has triangles only: use loop");
  }
  if (grid && grid->kind == GridKind::Geographic &&
      grid->size > LimitTopology::most_faces_about_a_vertex) {
    throw UsageMistake("--subdiv-fit: at the poles of " + arguments.grid + " " +
                       std::to_string(grid->size) + " faces meet, and at most " +
                       std::to_string(LimitTopology::most_faces_about_a_vertex) +
                       " can about a vertex of a limit surface");
  }
  const std::string kind = is_stream(limit) ? ".ply" : extension_of(limit);
  if (!limit.empty() && kind != ".ply" && kind != ".obj") {
    throw UsageMistake("--limit-mesh: the mesh is written as .ply or .obj, not as " +
                       output_name(limit));
  }
}

std::string name_of(Scheme scheme) { return scheme == Scheme::Loop ? "loop" : "catmark"; }

SubdivisionFit fit_subdivision(const MappedMesh& mapped, Remeshed& result,
                               const RemeshArguments& arguments, Console& console) try {
  const SphereGrid grid{
      .directions = result.map.points, .faces = result.faces, .level_vertices = {}, .parents = {}};
  SubdivisionFit fit = fit_subdivision(
      mapped.file().mesh, mapped.map(), grid,
      {.scheme = arguments.subdivision.value(),
       .threads = arguments.threads,
       .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }});
  const LimitVertices limit =
      limit_at_vertices(LimitSurface(fit.topology, fit.control), result.faces, arguments.threads);
  MeshFile& file = result.file;
  file.mesh.positions = fit.control;
  file.position_type = ScalarType::Float64;
  file.corner_normals.reset();
  set(file, "nx", limit.normals.col(0));
  set(file, "ny", limit.normals.col(1));
  set(file, "nz", limit.normals.col(2));
  set(file, "mean_curvature", limit.mean);
  set(file, "gauss_curvature", limit.gauss);
  return fit;
} catch (const std::invalid_argument& error) {
  throw UsageMistake("--subdiv-fit: " + arguments.grid + ": " + error.what());
}

Remeshed limit_mesh(Remeshed control, const SubdivisionFit& fit, int threads) {
  control.file.mesh.positions =
      limit_at_vertices(LimitSurface(fit.topology, fit.control), control.faces, threads).positions;
  return control;
}

std::string fit_line(const SubdivisionFit& fit, const TriangleMesh& source) {
  const double diagonal = diagonal_of(source.positions);
  return "  " + name_of(fit.topology->scheme()) + " surface fitted: RMS " +
         percent_of(diagonal, fit.rms) + ", at most " + percent_of(diagonal, fit.max) +
         " of the diagonal, one way, from " + std::to_string(fit.samples) +
         " samples on it to the mesh";
}

nlohmann::ordered_json fit_report(const SubdivisionFit& fit, const TriangleMesh& source) {
  nlohmann::ordered_json json;
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

}  // namespace sphparam::cli
