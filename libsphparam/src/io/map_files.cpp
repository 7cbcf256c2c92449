#include "sphparam/io/map_files.h"

#include <utility>

#include "embedding/constructions/float32_safe.h"
#include "io/files/read_back.h"
#include "io/formats/mesh_formats.h"
#include "number_text.h"
#include "sphparam/errors.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

/// The radius that FreeSurfer, HCP and MSM give their spheres; areas are compared at it.
constexpr double float_radius = 100;

std::string words(const std::optional<Poles>& poles, const FileNumbers& numbers) {
  if (!poles) return "none";
  return std::to_string(numbers.number(poles->north)) + " " +
         std::to_string(numbers.number(poles->south));
}

/// Throws NotCertifiedError unless the bytes of a written map hold what was found in memory.
void require_verdict(const std::string& expected, const std::string& path,
                     const Certificate& on_disk) {
  if (verdict(on_disk) != expected) {
    throw NotCertifiedError(path + ": as written, the map is " + verdict(on_disk));
  }
}

/// Then its proof reads all that could be lost.
bool carries_a_map_alone(const MeshFile& file) {
  constexpr std::size_t of_map = 5;  // theta, phi and rays
  return file.vertex_properties.size() <= of_map && file.face_properties.empty() &&
         !file.corner_texcoords && !file.corner_normals && file.base_colours.empty();
}

/// A map as a file can hold it, and what is to be said of it there.
struct HeldMap {
  SphereMap map;
  std::string verdict;
  double least_area = 0;  // of triangles, of the mean: what they had to be taken for
};

/// Formats of brains have coordinates of 32 bits. Rounding must not cost a certified map its
/// certificate; one that is folded anyway may get other folds.
HeldMap as_floats(const std::string& path, const FinishedMap& finished,
                  const SphereOptions& options) {
  auto [rounding, least_area] =
      round_float32_safe(finished.file.mesh, finished.topology, finished.map,
                         {.energy = options.energy,
                          .radius = float_radius,
                          .threads = options.threads,
                          .progress = options.progress});
  if (least_area > 0 && !options.may_remap) {
    throw NotCertifiedError(path +
                            ": numbers of 32 bits cannot hold this map with its pins, poles or "
                            "meridian; .ply, .obj and .off can");
  }
  const bool certified = finished.certificate.bijective();
  if (certified && !rounding.certificate.bijective()) {
    throw NotCertifiedError(path + ": numbers of 32 bits cannot hold this map (" +
                            verdict(rounding.certificate) + "); .ply, .obj and .off can");
  }
  const Certificate& held = certified ? finished.certificate : rounding.certificate;
  return {std::move(rounding.map), verdict(held), least_area};
}

/// Of a map that was made anew, poles and meridian were those of the other one.
Provenance provenance_of(const HeldMap& held, Provenance lines) {
  for (auto& [key, value] : lines)
    if (key == "verdict") value = held.verdict;
  if (held.least_area > 0) {
    std::erase_if(lines, [](const auto& line) {
      return line.first == "poles" || line.first == "meridian" || line.first == "upright";
    });
  }
  return lines;
}

}  // namespace

Provenance provenance_of(const Parameterization& result, const MapOrigin& origin,
                         const FileNumbers& numbers) {
  Provenance lines = {{"version", version},
                      {"method", origin.method},
                      {"stage", result.made_by},
                      {"options", origin.options},
                      {"poles", words(result.poles, numbers)}};
  if (result.made_anew) lines.emplace_back("anew", "nothing of the method's own map is left");
  if (!origin.citation.empty()) lines.emplace_back("after", origin.citation);
  if (result.meridian) {
    lines.emplace_back("meridian", std::to_string(numbers.number(*result.meridian)));
  }
  if (!origin.upright.empty()) lines.emplace_back("upright", origin.upright);
  for (auto& line : planetocentric_lines(result)) lines.push_back(std::move(line));
  if (result.balance) lines.emplace_back("lambda", shortest(result.balance->lambda));
  if (result.alignment) lines.emplace_back("alignment", shortest(*result.alignment));
  if (result.filler_share) {
    lines.emplace_back("fillers", percent(*result.filler_share) + " of the sphere");
  }
  if (origin.pins > 0) lines.emplace_back("pins", std::to_string(origin.pins));
  lines.emplace_back("verdict", origin.verdict);
  return lines;
}

std::vector<std::string> add_map(PendingFiles& files, const std::string& path,
                                 const MeshFile& with_map, const Topology& topology,
                                 const std::string& verdict, int threads) {
  std::vector<std::string> losses;
  const bool is_bare = carries_a_map_alone(with_map);
  files.add(path, serialise_mesh(path, with_map), [&](std::string_view written) {
    const MeshFile read = read_mesh(written, path, is_bare ? own_map : own_file);
    require_verdict(verdict, path,
                    certify_read_back(read, read_sphere(read).value(), topology, threads));
    if (!is_bare) losses = losses_of_writing(with_map, read);
  });
  return losses;
}

bool is_written_as_sphere(const std::string& path) {
  const std::string extension = is_stream(path) ? "" : inner_extension_of(path);
  const MeshFormat* const format = format_of_extension(extension.empty() ? ".ply" : extension);
  return format && format->write && !format->own_corners;
}

std::string sphere_extensions() {
  std::vector<std::string> extensions;
  for (const MeshFormat& format : mesh_formats())
    if (format.write && !format.own_corners) extensions.emplace_back(format.extensions.front());
  return joined({extensions.begin(), extensions.end() - 1}) + " or " + extensions.back();
}

double add_sphere(PendingFiles& files, const std::string& path, const FinishedMap& finished,
                  const SphereOptions& options) {
  if (is_written(path) && !is_written_as_sphere(path))
    throw WriteError(path,
                     "vertices have no numbers there, which tie a sphere to its mesh; it is "
                     "written as " +
                         sphere_extensions());
  const HeldMap held = has_float_spheres(path)
                           ? as_floats(path, finished, options)
                           : HeldMap{finished.map, verdict(finished.certificate)};
  const MeshFile sphere =
      sphere_mesh(finished.file, held.map, provenance_of(held, finished.provenance));
  const WriteOptions as_sphere{.is_sphere = true, .origin = options.origin};
  files.add(path, serialise_mesh(path, sphere, as_sphere), [&](std::string_view written) {
    const MeshFile read = read_mesh(written, path, own_map);
    require_verdict(
        held.verdict, path,
        certify_read_back(read, {read.mesh.positions}, finished.topology, options.threads));
  });
  return held.least_area;
}

double save_sphere(const std::string& path, const MappedMesh& mapped,
                   const SphereOptions& options) {
  PendingFiles files;
  SphereOptions told = options;
  if (told.origin.empty()) told.origin = mapped.name();
  const double least_area = add_sphere(
      files, path,
      {mapped.file(), mapped.topology(), mapped.map(), mapped.certificate(), mapped.provenance()},
      told);
  files.publish();
  return least_area;
}

}  // namespace sphparam
