#include "bake/source_doubts.h"

#include <algorithm>
#include <array>

#include "bake/georeference/georeference.h"
#include "bake/inside_out.h"
#include "sphere/body_centre.h"
#include "sphparam/bake/bake_warnings.h"
#include "sphparam/io/planetocentric.h"

namespace sphparam {
namespace {

std::string turning_line(const MappedMesh& source) {
  return is_inside_out(source) ? "the mesh is inside out: normals, rays and curvature are of its "
                                 "inside; --repair=orientation turns it over"
                               : "";
}

constexpr std::array body_fields = {"lon", "lat", "lonlat", "radius", "slope", "elevation"};

/// Bodies are seen from inside; coordinates of other things begin anywhere.
std::string centre_line(const MappedMesh& source, const std::vector<std::string>& fields,
                        const BakeSettings& settings) {
  const auto shown = [&](const char* field) { return std::ranges::count(fields, field) > 0; };
  const TriangleMesh& mesh = source.mesh();
  if (std::ranges::any_of(body_fields, shown))
    return line_of_outside(
        mesh, body_centre(planetocentric(source.provenance()), settings.fields.centre));
  const bool radial = settings.fields.height_radial || !settings.target;
  const bool shows_height = shown("height:radial") || (radial && shown("height"));
  if (!shows_height || winds_about(mesh, Vector3::Zero())) return "";
  return "height: the origin, from which it is measured, lies outside of the surface: --map radius "
         "--centre centroid is the distance from the middle of what it encloses";
}

}  // namespace

std::vector<std::string> doubts_about(const MappedMesh& source,
                                      const std::vector<std::string>& fields,
                                      const BakeSettings& settings) {
  if (settings.from) return {};
  std::vector<std::string> lines = {turning_line(source), centre_line(source, fields, settings)};
  std::erase(lines, "");
  return lines;
}

std::vector<std::string> bake_warnings(const MappedMesh& source,
                                       const std::vector<std::string>& fields,
                                       const BakeSettings& settings) {
  std::vector<std::string> lines = doubts_about(source, fields, settings);
  if (!settings.fields.body) return lines;
  const Vector3 centre = body_centre(planetocentric(source.provenance()), settings.fields.centre);
  for (std::string& line : doubts_about_body(source, *settings.fields.body, centre))
    lines.push_back(std::move(line));
  return lines;
}

}  // namespace sphparam
