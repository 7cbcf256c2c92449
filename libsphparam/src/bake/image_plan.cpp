#include "bake/image_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bake/field_registry.h"
#include "bake/fields/attribute_fields.h"
#include "bake/texels/coverage.h"
#include "mesh/box.h"
#include "number_text.h"
#include "sphparam/io/paths.h"

namespace sphparam {
namespace {

/// As asked for; else what the format has and the values need: numbers are data and numbered
/// labels.
SampleType depth_of(const BakeSettings& settings, ImageFormat format, FieldKind kind, bool numbers,
                    bool eight_bits = false) {
  if (settings.depth) return *settings.depth;
  if (format == ImageFormat::Exr) {
    return numbers || kind == FieldKind::Label ? SampleType::Float : SampleType::Half;
  }
  return numbers && !eight_bits && format != ImageFormat::Jpeg ? SampleType::Uint16
                                                               : SampleType::Uint8;
}

bool has_numbers(const SurfaceField& field) {
  return field.kind == FieldKind::Data || field.kind == FieldKind::Place ||
         (field.kind == FieldKind::Label && field.proper_channels() == 1);
}

/// How many whole numbers from 0, or from the least in integers, a type tells apart.
double exact_numbers(SampleType type) {
  switch (type) {
    case SampleType::Uint8:
      return 255;
    case SampleType::Uint16:
      return 65535;
    case SampleType::Half:
      return 1 << 11;
    default:
      return 1 << 24;
  }
}

/// How far a type has to count for the labels of a field: integers begin at the least one.
double needed_for(const SurfaceField& field, SampleType type) {
  const auto [least, greatest] = *field.range;
  const double origin = field.origin_of(0);
  return is_integer(type) ? greatest - least
                          : std::max(std::abs(least + origin), std::abs(greatest + origin));
}

/// What holds the labels that this type does not, if any does.
std::string other_depth(const SurfaceField& field, SampleType type) {
  const auto holds = [&field](SampleType other) {
    return needed_for(field, other) <= exact_numbers(other);
  };
  if (type != SampleType::Uint16 && holds(SampleType::Uint16))
    return "; u16 holds them, in a .png or .tif";
  if (type != SampleType::Float && holds(SampleType::Float))
    return "; float holds them, in a .tif or .exr";
  return "; no image holds these numbers: number them anew";
}

/// All digits of a whole number, of any size.
std::string digits_of(double whole) {
  char text[400];
  std::snprintf(text, sizeof text, "%.0f", whole);
  return text;
}

/// Numbers that are rounded would name other faces.
void require_exact_labels(const PlannedImage& image) {
  if (image.field.kind != FieldKind::Label || !image.field.range ||
      image.field.proper_channels() > 1)
    return;
  const SampleType type = image.file.sample_type;
  const double most = exact_numbers(type), needed = needed_for(image.field, type);
  if (needed <= most) return;
  throw BakeSettingError("depth", std::string(name_of(type)) + " holds whole numbers up to " +
                                      digits_of(most) + " exactly; " + image.field.name +
                                      " goes up to " + digits_of(needed) +
                                      other_depth(image.field, type));
}

/// From label to label as large a power of two of an integer type's steps as fits: range / full
/// scale is one exactly then, so that what is read by scale and offset is the label, no less.
void spread_labels(PlannedImage& image) {
  if (image.field.kind != FieldKind::Label || !image.field.range ||
      image.field.proper_channels() > 1 || !is_integer(image.file.sample_type))
    return;
  auto& [least, greatest] = *image.field.range;
  const double full = exact_numbers(image.file.sample_type);
  const int halvings = std::ilogb(full / std::max(greatest - least, 1.0));
  greatest = least + std::ldexp(full, -halvings);
}

void require_channels(const PlannedImage& image) {
  constexpr int colours_and_alpha = 4;
  const bool has_alpha = image.field.channels % 2 == 0;  // of one channel, or of three
  if (!has_alpha || most_channels(image.file.format) >= colours_and_alpha) return;
  throw BakeSettingError("path", std::string(name_of(image.file.format)) +
                                     " images have no alpha, which " + image.field.name +
                                     " has here; .png has");
}

/// Its range is known only once it is baked, and integers need to know it.
bool lacks_range(const PlannedImage& image) {
  return image.field.kind == FieldKind::Data && !image.field.range &&
         is_integer(image.file.sample_type);
}

}  // namespace

SurfaceField make_covered_field(const std::string& name, const BakeScene& scene) {
  SurfaceField field = make_field(name, scene);
  const FillerMarks& fillers = scene.source.fillers();
  if (fillers.empty() || field.name == surface_mask) return field;
  return with_coverage(std::move(field), fillers);
}

PlannedImage plan_image(const BakeRequest& request, BakeScene& scene,
                        const BakeSettings& settings) {
  PlannedImage image{.request = request,
                     .field = {.name = request.field, .channels = 3, .kind = FieldKind::Colour},
                     .drawn = test_image_named(request.field),
                     .file = {.width = settings.width,
                              .height = settings.width / 2,
                              .convention = settings.convention,
                              .tiles = settings.mip}};
  image.file.format = is_stream(request.path) ? ImageFormat::Png : *image_format_of(request.path);
  scene.ids_as_colours = is_integer(depth_of(settings, image.file.format, FieldKind::Label, false));
  if (!image.drawn) image.field = make_covered_field(request.field, scene);
  image.file.sample_type = depth_of(settings, image.file.format, image.field.kind,
                                    has_numbers(image.field), image.field.eight_bits);
  image.file.no_data = settings.fields.body && has_sidecar(request.path) &&
                       !is_integer(image.file.sample_type) && image.field.has_coverage &&
                       image.field.kind != FieldKind::Colour;
  require_channels(image);
  require_exact_labels(image);
  spread_labels(image);
  return image;
}

BakeOptions engine_options(const BakeSettings& settings, const char* stage) {
  BakeOptions options{.width = settings.width,
                      .height = settings.width / 2,
                      .samples = settings.samples,
                      .interpolation = settings.interpolation,
                      .threads = settings.threads};
  if (settings.progress) {
    options.progress = [&settings, stage](std::string_view, double done) {
      return settings.progress(stage, done);
    };
  }
  return options;
}

namespace {

bool is_scalar(const SurfaceField& field) { return field.name.starts_with("scalar:"); }

/// How far apart the numbers of 32 bits are where a field of this extent lies.
double float_step(const SurfaceField& field, double extent) {
  double most = 0;
  for (const double origin : field.origin)
    most = std::max({most, std::abs(origin), std::abs(origin + extent)});
  return std::ldexp(1.0, std::ilogb(most) - (std::numeric_limits<float>::digits - 1));
}

}  // namespace

std::string rounding_line(const SurfaceField& field, const BakeScene& scene) {
  if (!field.is_far()) return "";
  constexpr double nothing = 0x1p-17;  // of the extent: what is lost by is_far is more
  const bool of_lengths = !is_scalar(field);
  const double extent = of_lengths ? longest_side(scene.source.mesh()) : field.range->second;
  const double step = float_step(field, extent);
  if (field.kind == FieldKind::Label || extent == 0 || step < nothing * extent) return "";
  return field.name + ": so far from " + (of_lengths ? "the origin" : "0") +
         ", numbers of 32 bits are " + short_number(step) + " apart, " + percent(step / extent) +
         " of " + (of_lengths ? "the mesh's length" : "its range") +
         ": depth u16 (.png, .tif) keeps more" + (of_lengths ? ", or move the mesh nearer" : "");
}

std::vector<std::string> warnings_of(const std::vector<PlannedImage>& images,
                                     const BakeScene& scene, const BakeSettings& settings) {
  std::vector<std::string> warnings;
  for (const PlannedImage& image : images) {
    const SurfaceField& field = image.field;
    if (!is_integer(image.file.sample_type))
      if (std::string line = rounding_line(field, scene); !line.empty())
        warnings.push_back(std::move(line));
    if (settings.fields.heat && field.kind == FieldKind::Data)
      warnings.push_back(
          field.name + ": numbers, not colours: heat is of distortion, curvature and scalar:NAME");
  }
  return warnings;
}

void find_ranges(std::vector<PlannedImage>& images, const BakeScene& scene,
                 const BakeSettings& settings) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<PlannedImage*> unknown;
  std::vector<SurfaceField> fields;
  for (PlannedImage& image : images) {
    if (!lacks_range(image)) continue;
    unknown.push_back(&image);
    fields.push_back(image.field);
  }
  if (fields.empty()) return;
  std::vector<std::pair<double, double>> ranges(fields.size(), {infinity, -infinity});
  bake(scene, fields, engine_options(settings, "range"),
       [&](size_t i, int, int rows, const float* values) {
         const std::ptrdiff_t channels = fields[i].channels, proper = fields[i].proper_channels();
         const float* const end = values + std::ptrdiff_t{rows} * settings.width * channels;
         for (; values != end; values += channels) {
           const bool is_surface = !fields[i].has_coverage || values[proper] > 0;
           for (std::ptrdiff_t c = 0; is_surface && c < proper; ++c) {
             if (!std::isfinite(values[c])) continue;
             ranges[i].first = std::min(ranges[i].first, static_cast<double>(values[c]));
             ranges[i].second = std::max(ranges[i].second, static_cast<double>(values[c]));
           }
         }
       });
  for (size_t i = 0; i < unknown.size(); ++i) {
    const bool any = ranges[i].first <= ranges[i].second;
    unknown[i]->field.range = any ? ranges[i] : std::pair(0.0, 0.0);
  }
}

}  // namespace sphparam
