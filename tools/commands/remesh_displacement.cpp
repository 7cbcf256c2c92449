// The image is read back while it is checked, before it has its name; the proof is made of what was
// read.

#include "commands/remesh_displacement.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "sphparam/io/certified_files.h"
#include "commands/diagonal.h"
#include "console/exit_codes.h"
#include "commands/measurable.h"
#include "console/paths.h"
#include "commands/remesh_subdivision.h"
#include "displace/displacement_file.h"
#include "displace/rebuild.h"
#include "sphparam/io/paths.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "io/formats/polygon_ply.h"
#include "sphparam/stopwatch.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

constexpr std::int64_t distance_samples = 250'000;  // on each side
constexpr char farther_warning[] =
    "--displace makes it worse: surface and image together are farther from the mesh than the "
    "surface alone";

struct Size {
  int width, height;
};

std::optional<Size> size_named(const std::string& text) {
  Size size{};
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x') return std::nullopt;
  const auto height = std::from_chars(width.ptr + 1, end, size.height);
  const bool good = height.ec == std::errc{} && height.ptr == end && size.width >= 2 &&
                    size.width % 2 == 0 && size.height >= 1 &&
                    std::int64_t{size.width} * size.height <= most_texels;
  return good ? std::optional(size) : std::nullopt;
}

ImageDepth depth_of(const RemeshArguments& arguments) {
  const bool png = extension_of(arguments.displacement) == ".png";
  return arguments.depth.value_or(png ? ImageDepth::Uint16 : ImageDepth::Float);
}

Progress progress_on(Console& console) {
  return [&](std::string_view stage, double f) { return console.progress(stage, f); };
}

RebuildError error_of(const TriangleMesh& mesh, const TriangleMesh& source,
                      const RemeshArguments& arguments, Console& console) {
  const SurfaceDistance distance = distance_on_grid(source, mesh, arguments.grid,
                                                    {.samples = distance_samples,
                                                     .threads = arguments.threads,
                                                     .progress = progress_on(console)});
  return {distance.rms(), distance.max()};
}

Provenance provenance(const RemeshArguments& arguments, const DirectedBase& base) {
  return {{"version", version},
          {"method", "rebuild"},
          {"grid", display_name(arguments.grid)},
          {"subdivision", name_of(base.surface().topology().scheme())},
          {"verdict", "one-to-one"}};
}

/// Adds the rebuilt mesh, with the directions of its vertices where they are a map of it.
bool add_rebuilt(PendingFiles& files, const RemeshArguments& arguments, const DirectedBase& base,
                 const Rebuilt& rebuilt) {
  const std::string& path = arguments.rebuilt;
  MeshFile file;
  file.mesh = rebuilt.mesh;
  require_numbers(file, path);
  const Topology topology(file.mesh, arguments.threads);
  const bool certified = certify(topology, rebuilt.map, arguments.threads).bijective();
  if (certified) {
    add_mapped(files, path, attach_map(std::move(file), rebuilt.map, provenance(arguments, base)),
               rebuilt.faces, topology, arguments.threads);
  } else {
    const bool obj = extension_of(path) == ".obj";
    files.add(path, obj ? serialise_polygon_obj(file, rebuilt.faces)
                        : serialise_polygon_ply(std::move(file), rebuilt.faces));
  }
  return certified;
}

DisplacementReport::Proof prove(PendingFiles& files, const RemeshArguments& arguments,
                                const TriangleMesh& source, const DirectedBase& base,
                                const Image& displacement, Console& console) {
  const Stopwatch stopwatch;
  console.progress("rebuild", 0);
  const int cuts = cuts_for(base, vertices_to_rebuild(displacement, source.vertex_count()));
  const Rebuilt rebuilt = rebuild(base, displacement, cuts, arguments.threads);
  DisplacementReport::Proof proof;
  proof.vertices = rebuilt.mesh.vertex_count();
  proof.triangles = rebuilt.mesh.face_count();
  proof.base = error_of(rebuilt.base, source, arguments, console);
  proof.rebuilt = error_of(rebuilt.mesh, source, arguments, console);
  proof.certified = add_rebuilt(files, arguments, base, rebuilt);
  if (proof.farther_than_base()) console.warning(farther_warning);
  proof.seconds = stopwatch.seconds();
  return proof;
}

}  // namespace

void declare_displacement_options(CLI::App& command, RemeshArguments& arguments) {
  command
      .add_option("--displace", arguments.displacement,
                  "With --subdiv-fit: an equirectangular image of how far the mesh is from the "
                  "fitted surface along its normal: .exr, or .png in 16 bits")
      ->type_name("FILE");
  command
      .add_option("--displace-size", arguments.displacement_size, "Columns and rows of that image")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return size_named(text) ? std::string()
                                    : "expected columns and rows, as in 4096x2048, columns even, "
                                      "at most " +
                                          std::to_string(most_texels) + " texels, not " + text;
          },
          ""))
      ->type_name("WxH")
      ->capture_default_str();
  command
      .add_option("--rebuild", arguments.rebuilt,
                  "With --displace: the mesh that surface and image give, as fine as the image, "
                  "and how far it is from the mesh: .ply, .obj")
      ->type_name("FILE");
}

void check_displacement(const RemeshArguments& arguments) {
  const std::string &image = arguments.displacement, &mesh = arguments.rebuilt;
  if (!mesh.empty() && image.empty()) {
    throw UsageMistake("--rebuild is made of the image of --displace, which is missing");
  }
  if (image.empty()) return;
  if (!arguments.subdivision) {
    throw UsageMistake(
        "--displace is along the normals of a limit surface: give --subdiv-fit; heights over a "
        "mesh of flat faces are `bake --for MESH --map height`");
  }
  const std::string kind = extension_of(image);
  if (kind != ".exr" && kind != ".png") {
    throw UsageMistake("--displace: the image is written as .exr or .png, not as " +
                       output_name(image));
  }
  if ((depth_of(arguments) == ImageDepth::Uint16) != (kind == ".png")) {
    throw UsageMistake("--displace: half and float go into .exr, u16 into .png");
  }
  const std::string of_mesh = is_stream(mesh) ? ".ply" : extension_of(mesh);
  if (!mesh.empty() && of_mesh != ".ply" && of_mesh != ".obj") {
    throw UsageMistake("--rebuild: the mesh is written as .ply or .obj, not as " +
                       output_name(mesh));
  }
}

DisplacementReport add_displacement(PendingFiles& files, const RemeshArguments& arguments,
                                    const MappedMesh& mapped, const Remeshed& result,
                                    const SubdivisionFit& fit, Console& console) try {
  const Stopwatch stopwatch;
  const TriangleMesh& source = mapped.file().mesh;
  const SphereGrid grid{
      .directions = result.map.points, .faces = result.faces, .level_vertices = {}, .parents = {}};
  const Scheme scheme = fit.topology->scheme();
  const DirectedBase base(grid, fit.control, scheme, arguments.threads);
  const Size size = size_named(arguments.displacement_size).value();
  DisplacementReport report;
  report.displacement =
      make_displacement(base, source, Topology(source, arguments.threads), mapped.map(),
                        {.width = size.width,
                         .height = size.height,
                         .threads = arguments.threads,
                         .progress = progress_on(console)});
  const std::vector<char> bytes = encode_displacement(
      report.displacement, depth_of(arguments), display_name(arguments.grid), name_of(scheme));
  report.displacement.image = {};
  Image written;
  files.add(arguments.displacement, {bytes.begin(), bytes.end()}, [&](std::string_view read) {
    written = decode_displacement(read, arguments.displacement);
  });
  report.seconds = stopwatch.seconds();
  if (!arguments.rebuilt.empty())
    report.proof = prove(files, arguments, source, base, written, console);
  return report;
} catch (const std::range_error& error) {
  throw UsageMistake("--depth: displacement: " + std::string(error.what()));
}

std::string displacement_lines(const DisplacementReport& report, const TriangleMesh& source) {
  const auto percent = [diagonal = diagonal_of(source.positions)](double length) {
    return percent_of(diagonal, length);
  };
  const Displacement& made = report.displacement;
  std::string lines = "  displacement from " + percent(made.least) + " to " +
                      percent(made.greatest) + " of the diagonal";
  if (made.missed > 0) {
    lines += ", ";
    lines += std::to_string(made.missed);
    lines += made.missed == 1 ? " texel whose normal misses the mesh"
                              : " texels whose normals miss the mesh";
  }
  if (!report.proof) return lines;
  const auto line = [&](const char* what, const RebuildError& error) {
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

nlohmann::ordered_json to_json(const DisplacementReport& report, const RemeshArguments& arguments) {
  const Displacement& made = report.displacement;
  const Size size = size_named(arguments.displacement_size).value();
  nlohmann::ordered_json json;
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
  const auto as_json = [](const RebuildError& error) {
    return nlohmann::ordered_json{{"rms", error.rms}, {"max", error.max}};
  };
  nlohmann::ordered_json& proof = json["rebuilt"];
  proof["file"] = arguments.rebuilt;
  proof["vertices"] = report.proof->vertices;
  proof["triangles"] = report.proof->triangles;
  proof["certified"] = report.proof->certified;
  proof["base_error"] = as_json(report.proof->base);
  proof["error"] = as_json(report.proof->rebuilt);
  proof["warnings"] = nlohmann::ordered_json::array();
  if (report.proof->farther_than_base()) proof["warnings"].push_back(farther_warning);
  proof["seconds"] = report.proof->seconds;
  return json;
}

}  // namespace sphparam::cli
