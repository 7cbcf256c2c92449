// `sphparam verify`: proves a written map again, ours or a peer's. The rays of the vertices are
// found in the file (sx sy sz, or the positions of a bare sphere) and certified as they are: a ray
// has no length, so a sphere of any radius will do.

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reports/chart_report.h"
#include "arguments/choice.h"
#include "commands/command.h"
#include "arguments/common_options.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "reports/json_report.h"
#include "console/paths.h"
#include "commands/source.h"
#include "reports/wording.h"
#include "sphparam/io/connectivity.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"
#include "io/sphere_angles.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/stopwatch.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Prove a written map again, ours or anybody's.\n"
    "\n"
    "Examples:\n"
    "  sphparam verify statue.sph.ply                 a map with sx sy sz, as `map` writes it\n"
    "  sphparam verify sphere.obj                     a bare sphere about the origin\n"
    "  sphparam verify statue.obj sphere.obj --json -   a mesh and its sphere, with figures\n"
    "  sphparam verify statue.glb                     what `export --theta-phi` wrote\n"
    "  sphparam verify statue.sph.ply --chart         the texture chart too\n"
    "\n"
    "Ends with 0 when the map (and with --chart its chart) is one-to-one, with 5 when it is not, "
    "and\n"
    "with 3 when the two files are not of one connectivity: the same vertices in every triangle.\n";

/// Beyond this share of the radius a "sphere" is not one, and only the directions of its vertices
/// count: six printed digits, or a float32, stay far below.
constexpr double roundness = 1e-3;

struct VerifyArguments {
  std::string file;
  std::string sphere;  // empty: the map is in `file`
  bool chart = false;
  std::string json;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

/// The map to be proved, on the mesh that it is a map of.
struct Claim {
  TriangleMesh mesh;
  SphereMap map;
  bool has_shape = false;    // the positions are a shape, not the sphere itself
  std::string rays;          // where they were found
  std::string way_out = {};  // what to do where they turn out to be no sphere
  std::vector<std::string> notes;
};

TriangleMesh mirrored(TriangleMesh mesh) {
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

/// Throws: MeshError when there are no faces: nothing is mapped.
MeshSource read_mapped(const std::string& path) {
  MeshSource source = read_source(path);
  if (source.file.mesh.face_count() == 0) throw MeshError(source.inspection.defects);
  return source;
}

bool is_gltf(const MeshFile& file) { return file.format.starts_with("glTF"); }

struct Radius {
  double mean = 0;
  double deviation = 0;  // largest | |x| / mean − 1 |
};

Radius measure_radius(const Points& rays) {
  const Eigen::VectorXd lengths = rays.rowwise().norm();
  const double mean = lengths.mean();
  return {mean, (lengths.array() / mean - 1).abs().maxCoeff()};
}

/// Angles beside a sphere are somebody's notes: the sphere is the claim. In glTF they are ours.
bool has_angles_only(const MeshFile& file) {
  return is_gltf(file) || !(measure_radius(file.mesh.positions).deviation <= roundness);
}

Claim claim_of_file(const std::string& path) {
  MeshSource source = read_mapped(path);
  std::optional<SphereMap> map = read_sphere(source.file);
  std::string rays = "properties sx sy sz";
  if (!map && has_angles_only(source.file) && (map = read_angles(source.file)))
    rays = is_gltf(source.file) ? "attribute _THETA_PHI" : "properties theta phi";
  return {.mesh = source.file.mesh,
          .map = map ? *map : SphereMap{source.file.mesh.positions},
          .has_shape = map.has_value(),
          .rays = map ? rays : "vertex positions",
          .way_out = is_gltf(source.file) ? "; `sphparam export --theta-phi` writes the map into "
                                            "glTF, as the attribute _THETA_PHI"
                                          : "",
          .notes = source.notes};
}

/// Of the map, or of its mirror image, as it was certified.
std::optional<ChartReport> chart_of(const Claim& claim, const Certificate& certificate,
                                    int threads) {
  if (!certificate.bijective()) return std::nullopt;
  return report_chart(certificate.reversed ? mirrored(claim.mesh) : claim.mesh, claim.map, threads);
}

/// Throws: ReadError when the two are not one connectivity: nothing can be said about such a map.
Claim claim_of_pair(const std::string& shape_path, const std::string& sphere_path) {
  const MeshSource shape = read_mapped(shape_path), sphere = read_mapped(sphere_path);
  const std::string where = connectivity_difference(shape.file, sphere.file);
  if (!where.empty()) {
    throw ReadError(display_name(sphere_path),
                    "not a sphere of " + display_name(shape_path) + ": " + where);
  }
  const std::optional<SphereMap> map = read_sphere(sphere.file);
  const long cut = cut_otherwise(shape.file, sphere.file);
  return {
      .mesh = shape.file.mesh,
      .map = map ? *map : SphereMap{sphere.file.mesh.positions},
      .has_shape = true,
      .rays = std::string(map ? "properties sx sy sz" : "vertex positions") + " of the sphere" +
              (cut > 0 ? ", " + std::to_string(cut) + " of its polygons cut as in the mesh" : ""),
      .notes = shape.notes};
}

/// The certificate of a map and, when all its faces are negative, of its mirror image: a sphere
/// seen from inside is one-to-one too.
Certificate certify_either_way(const Claim& claim, int threads) {
  Certificate certificate = certify(Topology(claim.mesh), claim.map, threads);
  if (!certificate.reversed) return certificate;
  certificate = certify(Topology(mirrored(claim.mesh)), claim.map, threads);
  certificate.reversed = true;
  return certificate;
}

std::string text_of(const VerifyReport& report, Eigen::Index triangles) {
  const Certificate& certificate = report.certificate;
  std::string text = display_name(report.file) + ": " + verdict(certificate) + ", " +
                     std::to_string(triangles) + " triangles" +
                     (certificate.reversed ? ", seen from inside\n" : "\n");
  text += complaint(certificate);
  text += "  rays: " + report.rays + ", mean length " + short_number(report.mean_length) +
          ", largest relative deviation " + short_number(report.length_deviation) + "\n";
  if (report.distortion) text += "  " + distortion_line(*report.distortion) + "\n";
  if (report.chart_wanted) text += "  " + chart_line(report.chart) + "\n";
  return text;
}

int run_verify(const VerifyArguments& arguments) {
  const Stopwatch stopwatch;
  require_report_place({arguments.file, arguments.sphere}, arguments.json);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  console.progress("certificate", 0);
  const Claim claim = arguments.sphere.empty() ? claim_of_file(arguments.file)
                                               : claim_of_pair(arguments.file, arguments.sphere);
  const Certificate certificate = certify_either_way(claim, arguments.threads);
  const Radius radius = measure_radius(claim.map.points);
  VerifyReport report = {.file = arguments.file,
                         .certificate = certificate,
                         .rays = claim.rays,
                         .mean_length = radius.mean,
                         .length_deviation = radius.deviation,
                         .notes = claim.notes};
  if (claim.has_shape && certificate.unusable_points.empty()) {
    const SphereMap unit = normalised(claim.map.points);  // a sphere of any radius is judged alike
    report.distortion =
        summarise(measure_distortion(claim.mesh, unit, arguments.threads), arguments.threads);
  }
  if (!(radius.deviation <= roundness)) {
    const std::string text = "these points are not on a sphere about the origin: their radius is " +
                             short_number(radius.mean) + " up to a factor of " +
                             short_number(1 + radius.deviation) + "; their directions are judged" +
                             claim.way_out;
    console.warning(text);
    report.notes.push_back(text);
  }
  report.chart_wanted = arguments.chart;
  if (arguments.chart) report.chart = chart_of(claim, certificate, arguments.threads);
  report.seconds = stopwatch.seconds();
  console.clear_progress();
  if (!arguments.json.empty()) write_file(arguments.json, to_json(report));
  const std::string text = text_of(report, claim.mesh.face_count());
  if (!is_stream(arguments.json) && !arguments.loudness.quiet) write_file("-", text);
  const bool chart_holds =
      !arguments.chart || (report.chart && report.chart->certificate.one_to_one());
  if (certificate.bijective() && chart_holds) return Ok;
  if (arguments.loudness.quiet) print_error(text.substr(0, text.size() - 1));
  return NotCertified;
}

}  // namespace

Command declare_verify(CLI::App& program) {
  const auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command = program.add_subcommand("verify", summary);
  command->add_option("FILE", arguments->file, "A written map, a sphere or a mesh; - for stdin")
      ->type_name(" ")
      ->required();
  command->add_option("SPHERE", arguments->sphere, "The sphere of mesh FILE, same connectivity")
      ->type_name(" ");
  command->add_flag("--chart", arguments->chart,
                    "Make the (u, v) chart for textures too, and prove it");
  add_json(*command, arguments->json);
  add_threads(*command, arguments->threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_verify(*arguments); }};
}

}  // namespace sphparam::cli
