// What can be told of requests and settings alone, before any work.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sphparam/bake/bake.h"
#include "sphparam/io/paths.h"

namespace sphparam {
namespace {

void require_between(const char* setting, double value, double least, double greatest) {
  if (value >= least && value <= greatest) return;
  throw BakeSettingError(setting, "is " + std::to_string(value) + ", not between " +
                                      std::to_string(least) + " and " + std::to_string(greatest));
}

void require_domains(const BakeSettings& settings) {
  constexpr double any = std::numeric_limits<double>::max();
  require_between("width", settings.width, 2, 65536);
  require_between("samples", settings.samples, 1, 32);
  require_between("refine_poles", settings.refine_poles, 1, 1024);
  require_between("rays", settings.fields.rays, 1, 65536);
  require_between("max_ray_distance", settings.fields.max_ray_distance,
                  std::numeric_limits<double>::min(), any);
}

/// Half the width is the height; a quarter turn moves whole texels.
void require_whole_texels(const BakeSettings& settings) {
  if (settings.width % 2 != 0) {
    throw BakeSettingError("width", "an image is half as high as wide, so its width must be even");
  }
  const ConventionInfo& convention = info_of(settings.convention);
  if (convention.offset == 0.25 && settings.width % 4 != 0) {
    throw BakeSettingError("convention",
                           std::string(convention.name) +
                               " is a quarter turn away, so the width must be a multiple of 4");
  }
}

void require_body(const BakeSettings& settings) {
  if (settings.fields.centre && !settings.fields.centre->allFinite()) {
    throw BakeSettingError("centre", "is not finite");
  }
  if (!settings.fields.body) return;
  const Body& body = *settings.fields.body;
  if (settings.convention != Convention::Gis) {
    throw BakeSettingError("body", "its images are in the convention gis, not " +
                                       std::string(info_of(settings.convention).name));
  }
  const bool positive = (body.semi_axes.array() > 0).all() && body.semi_axes.allFinite() &&
                        body.unit > 0 && std::isfinite(body.unit);
  if (!positive) throw BakeSettingError("body", "semi-axes and unit must be above 0 and finite");
}

void require_format(const std::string& path, const BakeSettings& settings) {
  const std::optional<ImageFormat> format =
      is_stream(path) ? ImageFormat::Png : image_format_of(path);
  if (!format) {
    const std::string ending = extension_of(path);
    throw BakeSettingError("path", "images are written as .png, .jpg, .tif or .exr, not " +
                                       (ending.empty() ? "without a name" : ending));
  }
  if (const int most = most_texels_a_side(*format); settings.width > most) {
    throw BakeSettingError("width", std::string(name_of(*format)) + " images have at most " +
                                        std::to_string(most) + " texels a row; .png has more");
  }
  if (settings.mip && format != ImageFormat::Exr) {
    throw BakeSettingError("mip", "only .exr files have levels");
  }
  if (settings.depth && std::ranges::count(sample_types_of(*format), *settings.depth) == 0) {
    throw BakeSettingError("depth", std::string(name_of(*format)) + " images have no " +
                                        name_of(*settings.depth) + " samples");
  }
}

}  // namespace

std::string sidecar_path(const std::string& image) { return image + ".aux.xml"; }

bool has_sidecar(const std::string& image) {
  const std::optional<ImageFormat> format = image_format_of(image);
  return format == ImageFormat::Png || format == ImageFormat::Tiff;
}

void require_bakeable(const std::vector<BakeRequest>& images, const BakeSettings& settings) {
  require_whole_texels(settings);
  require_domains(settings);
  if (settings.from && settings.target)
    throw BakeSettingError("from", "a surface to bake from and another mesh to bake for");
  require_body(settings);
  std::set<std::string> paths;
  for (const BakeRequest& image : images) {
    require_field_name(image.field);
    require_format(image.path, settings);
    if (!paths.insert(image.path).second) {
      throw BakeSettingError("path", "several images would go to " + image.path);
    }
  }
}

}  // namespace sphparam
