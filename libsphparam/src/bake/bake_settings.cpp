// What can be told of requests and settings alone, before any work.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "number_text.h"
#include "sphparam/bake/bake.h"
#include "sphparam/io/paths.h"

namespace sphparam {
namespace {

[[noreturn]] void refuse(const char* setting, double value, const std::string& wanted) {
  throw BakeSettingError(setting, "is " + shortest(value) + ": it must be " + wanted);
}

void require_between(const char* setting, double value, double least, double greatest) {
  if (value >= least && value <= greatest) return;
  refuse(setting, value, "from " + shortest(least) + " to " + shortest(greatest));
}

/// For what was cast from a number.
template <class Enum>
void require_one_of(const char* setting, Enum value, Enum last) {
  require_between(setting, static_cast<int>(value), 0, static_cast<int>(last));
}

void require_known(const BakeSettings& settings) {
  require_one_of("convention", settings.convention, Convention::Blender);
  require_one_of("interpolation", settings.interpolation, Interpolation::Sphere);
  require_one_of("wrap", settings.wrap, TextureWrap::Clamp);
  require_one_of("filter", settings.fields.filter, TextureFilter::Bicubic);
}

void require_domains(const BakeSettings& settings) {
  require_between("width", settings.width, 2, 65536);
  require_between("samples", settings.samples, 1, 32);
  require_between("refine_poles", settings.refine_poles, 1, 1024);
  require_between("rays", settings.fields.rays, 1, 65536);
  const double reach = settings.fields.max_ray_distance;
  if (!(reach > 0 && std::isfinite(reach)))
    refuse("max_ray_distance", reach, "a finite number above 0");
  if (const auto& range = settings.fields.scalar_range) {
    const bool are_ends = std::isfinite(range->first) && std::isfinite(range->second);
    if (!are_ends || !(range->first < range->second))
      throw BakeSettingError("scalar_range", "two finite numbers, the smaller one first");
  }
  const double calm = settings.calm_beyond;
  if (!(calm >= 0 && std::isfinite(calm)))
    refuse("calm_beyond", calm, "a finite number, at least 0");
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
  require_known(settings);
  require_whole_texels(settings);
  require_domains(settings);
  if (settings.from && settings.target)
    throw BakeSettingError("from", "a surface to bake from and another mesh to bake for");
  require_body(settings);
  std::set<std::filesystem::path> paths;
  for (const BakeRequest& image : images) {
    require_field_name(image.field);
    require_format(image.path, settings);
    // "./a.png" is a.png; links are seen when files get their names.
    if (!paths.insert(std::filesystem::path(image.path).lexically_normal()).second) {
      throw BakeSettingError("path", "several images would go to " + image.path);
    }
  }
}

}  // namespace sphparam
