// Values become samples a few rows at a time. Levels of tiled files are kept until the file before
// them is complete: a format for textures has them one after the other.

#include "bake/baked_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/image_level.h"
#include "image/integer_sample.h"
#include "number_text.h"
#include "sphparam/bake/bake_errors.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

/// Beyond these halves are infinite: positions of bodies in metres, say.
void require_halves(const float* values, size_t count) {
  constexpr float most = 65504;
  const float* const end = values + count;
  const float* const large =
      std::find_if(values, end, [](float x) { return std::isfinite(x) && std::abs(x) > most; });
  if (large != end) {
    throw HalfRangeError("half precision has no number as large as " + shortest(*large));
  }
}

ImageFileOptions file_options(const SurfaceField& field, const BakedFileOptions& options) {
  ImageFileOptions file{.width = options.width,
                        .height = options.height,
                        .channels = field.channels,
                        .format = options.format,
                        .sample_type = options.sample_type,
                        .tiles = options.tiles,
                        .metadata = options.metadata};
  const ConventionInfo& convention = info_of(options.convention);
  const auto add = [&](const char* name, std::string value) {
    file.metadata.emplace_back(name, std::move(value));
  };
  add("sphparam:map", field.name);
  if (!field.about.empty()) add("sphparam:about", field.about);
  add("sphparam:convention", convention.name);
  add("sphparam:u0", shortest(convention.offset));
  add("sphparam:turns", shortest(convention.turns));
  if (field.kind == FieldKind::Direction) {
    add("sphparam:min", "-1");
    add("sphparam:max", "1");
  } else if (const auto range = range_in_file(field, options.sample_type)) {
    add("sphparam:min", shortest(range->first));
    add("sphparam:max", shortest(range->second));
  }
  if (is_integer(options.sample_type) && field.is_far() && field.proper_channels() > 1)
    add("sphparam:offset", origin_text(field));
  for (const auto& [name, value] : field.texts) add(name.c_str(), value);
  const bool colour = field.kind == FieldKind::Colour;
  add("oiio:ColorSpace", !colour ? "raw" : is_integer(options.sample_type) ? "sRGB" : "Linear");
  if (options.format == ImageFormat::Exr && options.convention == Convention::Envmap) {
    add("textureformat", "LatLong Environment");  // OpenImageIO's for OpenEXR's attribute `envmap`
  }
  return file;
}

/// What an integer sample of 0 and of its greatest value stand for.
std::pair<double, double> ends_of(const SurfaceField& field) {
  if (field.kind == FieldKind::Direction) return {-1, 1};
  if (field.kind == FieldKind::Colour || field.scale) return {0, 1};
  return field.range.value_or(std::pair(0.0, 1.0));
}

template <class Sample>
std::vector<Sample> integers(const float* values, size_t count, const SurfaceField& field) {
  std::vector<Sample> samples(count);
  const auto [low, high] = ends_of(field);
  const double base = low, scale = high > low ? 1 / (high - low) : 0;
  const SrgbCurves& curves = SrgbCurves::get();
  const bool colour = field.kind == FieldKind::Colour;
  const auto channels = static_cast<size_t>(field.channels);
  const auto proper = static_cast<size_t>(field.proper_channels());
  for (size_t i = 0; i < count; ++i) {
    const auto value = static_cast<double>(values[i]);
    const double x = i % channels >= proper       ? value
                     : colour && i % channels < 3 ? static_cast<double>(curves.to_srgb(values[i]))
                                                  : (value - base) * scale;
    samples[i] = integer_sample<Sample>(x);
  }
  return samples;
}

}  // namespace

std::optional<std::pair<double, double>> range_in_file(const SurfaceField& field, SampleType type) {
  if (!is_integer(type) && !field.scale) return std::nullopt;
  if (!field.range || field.proper_channels() > 1) return field.range;
  return std::pair(field.range->first + field.origin[0], field.range->second + field.origin[0]);
}

std::string origin_text(const SurfaceField& field) {
  return shortest(field.origin[0]) + " " + shortest(field.origin[1]) + " " +
         shortest(field.origin[2]);
}

void add_origin(const SurfaceField& field, std::vector<float>& values) {
  const auto channels = static_cast<size_t>(field.channels);
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(static_cast<double>(values[i]) +
                                   field.origin_of(static_cast<int>(i % channels)));
}

namespace {

/// Requires: coverage.
void remove_holes(const SurfaceField& field, std::vector<float>& values) {
  const int channels = field.channels;
  for (auto texel = values.begin(); texel != values.end(); texel += channels)
    if (texel[channels - 1] == 0)
      std::fill_n(texel, channels - 1, std::numeric_limits<float>::quiet_NaN());
}

}  // namespace

BakedFile::BakedFile(const SurfaceField& field, const BakedFileOptions& options, ImagePlace file)
    : field_(field), options_(options), writer_(file_options(field, options), std::move(file)) {
  field_.evaluate = {};
  field_.evaluate_runs = {};
  field_.remark = {};
  if (options.tiles) {
    next_level_ =
        std::make_unique<ImageLevel>(options.width, options.height, field.channels, field.kind);
  }
}

BakedFile::~BakedFile() = default;

void BakedFile::encode(const float* values, int rows) {
  const size_t count = static_cast<size_t>(rows) * static_cast<size_t>(options_.width) *
                       static_cast<size_t>(field_.channels);
  switch (options_.sample_type) {
    case SampleType::Uint8:
      return writer_.write_rows(integers<std::uint8_t>(values, count, field_).data(), rows);
    case SampleType::Uint16:
      return writer_.write_rows(integers<std::uint16_t>(values, count, field_).data(), rows);
    case SampleType::Half:
    case SampleType::Float:
      return encode_floats(values, count, rows);
  }
}

void BakedFile::encode_floats(const float* values, size_t count, int rows) {
  std::vector<float> changed;
  if (field_.is_far() || options_.no_data) changed.assign(values, values + count);
  if (field_.is_far()) add_origin(field_, changed);
  if (options_.no_data) remove_holes(field_, changed);
  if (!changed.empty()) values = changed.data();
  if (options_.sample_type == SampleType::Half) require_halves(values, count);
  writer_.write_rows(values, rows);
}

/// The rows of one level: whole rows of tiles at once.
void BakedFile::write_level_rows(const float* values, int rows) {
  for (int row = 0; row < rows; row += ImageWriter::tile_size) {
    const size_t at = static_cast<size_t>(row) * static_cast<size_t>(options_.width) *
                      static_cast<size_t>(field_.channels);
    encode(values + at, std::min(ImageWriter::tile_size, rows - row));
  }
}

/// Of a texel one value is enough; what is no number lies nowhere, as what is no surface, and half
/// a step is rounding.
void BakedFile::count_beyond(const float* values, int rows) {
  texels_ += std::int64_t{rows} * options_.width;
  if (!is_integer(options_.sample_type) || field_.kind != FieldKind::Data || !field_.range) return;
  const auto [low, high] = *field_.range;
  const double full = options_.sample_type == SampleType::Uint8 ? 255 : 65535;
  const double margin = (high - low) / full / 2;
  const int channels = field_.channels, proper = field_.proper_channels();
  for (std::int64_t i = 0; i < std::int64_t{rows} * options_.width; ++i) {
    const float* const texel = values + i * channels;
    if (field_.has_coverage && !(texel[proper] > 0)) continue;
    beyond_ += std::any_of(texel, texel + proper, [&, least = low, most = high](float x) {
      return x < least - margin || x > most + margin;
    });
  }
}

double BakedFile::share_beyond() const {
  return texels_ == 0 ? 0 : static_cast<double>(beyond_) / static_cast<double>(texels_);
}

void BakedFile::write_rows(int rows, const float* values) {
  count_beyond(values, rows);
  std::vector<float> turned;
  if (options_.convention != Convention::Sphparam) {
    turned = in_convention(options_.convention, options_.width, field_.channels, rows, values);
    values = turned.data();
  }
  if (!options_.tiles) return encode(values, rows);
  next_level_->add_rows(values, rows);
  const auto count = static_cast<std::ptrdiff_t>(rows) * options_.width * field_.channels;
  pending_.insert(pending_.end(), values, values + count);
  const size_t strip = static_cast<size_t>(ImageWriter::tile_size) *
                       static_cast<size_t>(options_.width) * static_cast<size_t>(field_.channels);
  while (pending_.size() >= strip) {
    encode(pending_.data(), ImageWriter::tile_size);
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(strip));
  }
}

void BakedFile::close() {
  if (options_.tiles) {
    const auto row = static_cast<size_t>(options_.width) * static_cast<size_t>(field_.channels);
    if (!pending_.empty()) encode(pending_.data(), static_cast<int>(pending_.size() / row));
    while (options_.width > 1 || options_.height > 1) {
      next_level_->finish();
      const std::unique_ptr<ImageLevel> level = std::move(next_level_);
      options_.width = level->width();
      options_.height = level->height();
      writer_.begin_level(options_.width, options_.height);
      write_level_rows(level->values().data(), options_.height);
      next_level_ = std::make_unique<ImageLevel>(options_.width, options_.height, field_.channels,
                                                 field_.kind);
      next_level_->add_rows(level->values().data(), options_.height);
    }
  }
  writer_.close();
}

}  // namespace sphparam
