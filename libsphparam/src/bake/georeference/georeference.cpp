#include "bake/georeference/georeference.h"

#include <filesystem>

#include "bake/choose_target.h"
#include "bake/georeference/sidecar.h"
#include "number_text.h"
#include "sphparam/io/paths.h"

namespace sphparam {
namespace {

/// Of the vertices, from the centre of a radial map or the origin.
double mean_radius(const MappedMesh& source, const FieldOptions& options,
                   const std::optional<Planetocentric>& radial) {
  const Vector3 origin = radial ? radial->centre : Vector3(0, 0, 0);
  const Vector3 centre = options.centre.value_or(origin);
  return (source.mesh().positions.rowwise() - centre.transpose()).rowwise().norm().mean();
}

/// Shape models are in kilometres or in metres, and none says so.
void warn_of_unit(double radius, const Body& body, BakeReport& report) {
  constexpr double far_off = 5;  // long bodies have a few times the radius that their axes have
  const double metres = radius * body.unit, wanted = body.semi_axes.mean();
  if (metres < far_off * wanted && metres > wanted / far_off) return;
  report.warnings.push_back("the vertices are " + short_number(metres) +
                            " m from the centre on the mean, the radius of the body is " +
                            short_number(wanted) + " m: the mesh is in another unit (--unit)");
}

void warn_of_stale(const std::string& image, BakeReport& report) {
  std::error_code none;
  if (is_stream(image) || !std::filesystem::exists(sidecar_path(image), none)) return;
  report.warnings.push_back(sidecar_path(image) +
                            " is of an earlier image: geographic programs will read it");
}

}  // namespace

void add_sidecars(const std::vector<PlannedImage>& images, const MappedMesh& source,
                  const BakeSettings& settings, PendingFiles& files, BakeReport& report) {
  if (!settings.fields.body) {
    for (const PlannedImage& image : images) warn_of_stale(image.request.path, report);
    return;
  }
  const Body& body = *settings.fields.body;
  const std::optional<Planetocentric> radial = planetocentric(source.provenance());
  const CoordinateSystem system =
      coordinate_system(body, radial, stem_of(source_name(source, settings)));
  report.coordinate_system = system.name;
  warn_of_unit(mean_radius(source, settings.fields, radial), body, report);
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
