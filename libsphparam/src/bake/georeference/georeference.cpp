#include "bake/georeference/georeference.h"

#include <filesystem>

#include "bake/choose_target.h"
#include "bake/georeference/sidecar.h"
#include "number_text.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/planetocentric.h"

namespace sphparam {
namespace {

double mean_radius(const TriangleMesh& mesh, const Vector3& centre) {
  return (mesh.positions.rowwise() - centre.transpose()).rowwise().norm().mean();
}

/// Shape models are in kilometres or in metres, and none says so.
std::string unit_line(double radius, const Body& body) {
  constexpr double far_off = 5;  // long bodies have a few times the radius that their axes have
  const double metres = radius * body.unit, wanted = body.semi_axes.mean();
  if (metres < far_off * wanted && metres > wanted / far_off) return "";
  return "the vertices are " + short_number(metres) +
         " m from the centre on the mean, the radius of the body is " + short_number(wanted) +
         " m: the mesh is in another unit (--unit)";
}

/// With all digits: centres may differ in the last.
std::string point_text(const Vector3& p) {
  return "(" + shortest(p.x()) + ", " + shortest(p.y()) + ", " + shortest(p.z()) + ")";
}

std::string centre_line(const MappedMesh& source, const Vector3& centre) {
  const std::optional<Planetocentric> radial = planetocentric(source.provenance());
  if (!radial || is_about(*radial, centre, source.mesh())) return "";
  return "longitudes and latitudes are the map's, which is radial about " +
         point_text(radial->centre) + ", not about the body's centre, " + point_text(centre);
}

void warn_of_stale(const std::string& image, BakeReport& report) {
  std::error_code none;
  if (is_stream(image) || !std::filesystem::exists(sidecar_path(image), none)) return;
  report.warnings.push_back(sidecar_path(image) +
                            " is of an earlier image: geographic programs will read it");
}

}  // namespace

std::vector<std::string> doubts_about_body(const MappedMesh& source, const Body& body,
                                           const Vector3& centre) {
  std::vector<std::string> lines = {centre_line(source, centre),
                                    unit_line(mean_radius(source.mesh(), centre), body)};
  std::erase(lines, "");
  return lines;
}

void add_sidecars(const std::vector<PlannedImage>& images, const MappedMesh& source,
                  const BakeScene& scene, const BakeSettings& settings, PendingFiles& files,
                  BakeReport& report) {
  if (!settings.fields.body) {
    for (const PlannedImage& image : images) warn_of_stale(image.request.path, report);
    return;
  }
  const Body& body = *settings.fields.body;
  const Vector3& centre = *scene.options.centre;
  const CoordinateSystem system = coordinate_system(body, body_places(source, scene, settings),
                                                    stem_of(source_name(source, settings)));
  report.coordinate_system = system.name;
  for (std::string& line : doubts_about_body(source, body, centre))
    report.warnings.push_back(std::move(line));
  for (size_t i = 0; i < images.size(); ++i) {
    const std::string& path = images[i].request.path;
    if (is_stream(path) || !has_sidecar(path)) {
      report.warnings.push_back(output_name(path) +
                                ": no file beside it says where it lies; .tif and .png have one");
      continue;
    }
    report.images[i].sidecar = sidecar_path(path);
    files.add(report.images[i].sidecar, sidecar_of(images[i], settings, system));
  }
}

}  // namespace sphparam
