// `sphparam bake`: everything that may fail for the user's reasons comes first, then all maps are
// baked together, row by row into files that get their names at the end.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "arguments/bake_arguments.h"
#include "arguments/suggestion.h"
#include "bake/bake_rows.h"
#include "bake/baked_chart.h"
#include "bake/baked_file.h"
#include "bake/field_registry.h"
#include "bake/fields/heat_field.h"
#include "bake/make_scene.h"
#include "bake/shared_sphere.h"
#include "commands/mapped_source.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "reports/bake_report.h"
#include "reports/wording.h"
#include "sphparam/chart/chart_failure.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/stopwatch.h"
#include "sphparam/version.h"
#include "texture/srgb.h"
#include "texture/test_images.h"

namespace sphparam::cli {
namespace {

/// An image on its way: what is baked, and where it goes.
struct Image {
  BakeOutput output;
  SurfaceField field;
  std::optional<TestImage> test;  // drawn, not baked
  BakedFileOptions options;
  std::unique_ptr<BakedFile> file;
};

ImageFormat format_of(const BakeOutput& output) {
  return is_stream(output.path) ? ImageFormat::Png : *image_format_of(output.path);
}

/// As asked for; else what the format has and the values need.
SampleType depth_of(const BakeArguments& arguments, ImageFormat format, FieldKind kind) {
  if (arguments.depth) return *arguments.depth;
  const bool data = kind == FieldKind::Data;
  if (format == ImageFormat::Exr) {
    return data || kind == FieldKind::Label ? SampleType::Float : SampleType::Half;
  }
  return data && format != ImageFormat::Jpeg ? SampleType::Uint16 : SampleType::Uint8;
}

class Baker {
 public:
  Baker(const BakeArguments& arguments, Console& console)
      : arguments_(arguments), console_(console), outputs_(bake_outputs(arguments)) {}

  void run() {
    read_scene();
    for (const BakeOutput& output : outputs_) images_.push_back(make_image(output));
    find_ranges();
    for (Image& image : images_) {
      image.options.metadata = metadata();
      PendingFiles::Pieces pieces = files_.open(image.output.path);
      image.file = std::make_unique<BakedFile>(
          image.field, image.options, ImagePlace{std::move(pieces.write), std::move(pieces.read)});
      add_scale(image);
    }
    draw_test_images();
    bake_images([&](Image& image, int, int rows, const float* values) {
      image.file->write_rows(rows, values);
    });
    for (Image& image : images_) {
      console_.progress("write", 0);
      image.file->close();
    }
    if (!arguments_.json.empty()) files_.add(arguments_.json, to_json(report()));
    if (interrupted()) throw Cancelled();
    files_.publish();
    console_.clear_progress();
  }

  BakeReport report() const {
    BakeReport report{.input = arguments_.input,
                      .target = arguments_.target,
                      .width = arguments_.width,
                      .height = arguments_.width / 2,
                      .samples = arguments_.samples,
                      .target_distance = target_distance_,
                      .convention = info_of(arguments_.convention).name,
                      .refine_poles = arguments_.refine_poles,
                      .triangles = scene_->source.mesh().face_count(),
                      .images = {},
                      .seconds = stopwatch_.seconds()};
    for (const Image& image : images_) {
      report.images.push_back({.map = image.field.name,
                               .about = image.field.about,
                               .path = image.output.path,
                               .sample_type = name_of(image.options.sample_type),
                               .channels = image.field.channels,
                               .range = image.field.range});
    }
    return report;
  }

 private:
  void read_scene() {
    const MappedMesh mapped =
        read_mapped_source(arguments_.input, arguments_.sphere, arguments_.threads, console_);
    scene_.reset(new BakeScene{make_source(mapped), target_of(mapped), arguments_.options,
                               arguments_.threads});
    scene_->mirrored = info_of(arguments_.convention).turns < 0;
    read_source_textures();
  }

  BakeTarget target_of(const MappedMesh& mapped) {
    const std::string& path = arguments_.target.empty() ? arguments_.input : arguments_.target;
    BakeTarget target;
    if (arguments_.target.empty()) {
      target = target_on(mapped, true);
    } else {
      const MappedMesh low = read_mapped_source(path, "", arguments_.threads, console_);
      if (low.mapped_here()) {
        throw NotCertifiedError(display_name(path) +
                                ": carries no map, so it is on no sphere that it could share; "
                                "`sphparam remesh` makes meshes on the source's sphere");
      }
      require_one_sphere(mapped, low);
      target = target_on(low, false);
    }
    if (!target.chart.certificate.one_to_one()) {
      throw NotCertifiedError(display_name(path) + ": " + chart_failure(target.chart));
    }
    return target;
  }

  /// A map of its own would give every texel of the low mesh another place of the high one.
  void require_one_sphere(const MappedMesh& high, const MappedMesh& low) {
    const double apart = disagreement(high, low, arguments_.threads);
    target_distance_ = apart;
    if (apart <= doubtful_disagreement) return;
    const std::string far = "in the same directions, half of its surface is more than " +
                            short_number(100 * apart) + " % of the diagonal away from that of " +
                            display_name(arguments_.input);
    if (apart <= other_sphere_disagreement) {
      console_.warning(display_name(arguments_.target) + ": " + far);
      return;
    }
    throw UsageMistake("--for: " + display_name(arguments_.target) +
                       ": is not on the same sphere: " + far + "; `sphparam remesh " +
                       display_name(arguments_.input) +
                       " --grid ico:6 -o LOW.sph.ply` makes a mesh on its sphere" +
                       (high.mapped_here() ? ", of a map that is kept (`sphparam map`)" : ""));
  }

  BakeTarget target_on(const MappedMesh& mapped, bool is_source) {
    try {
      return make_target(mapped, is_source, arguments_.threads, arguments_.refine_poles,
                         [&](std::string_view stage, double fraction) {
                           return console_.progress(stage, fraction);
                         });
    } catch (const std::invalid_argument& error) {
      if (arguments_.refine_poles <= 1) throw;
      throw UsageMistake(std::string("--refine-poles: ") + error.what());
    }
  }

  void read_source_textures() {
    const auto wants_texture = [](const BakeOutput& output) { return output.map == "basecolor"; };
    if (!std::ranges::any_of(outputs_, wants_texture)) return;
    console_.progress("texture", 0);
    BakeSource& source = scene_->source;
    if (arguments_.texture.empty()) {
      source.textures = read_textures(source.file(), arguments_.threads);
    } else {
      source.textures = {read_texture(arguments_.texture, arguments_.wrap, arguments_.threads)};
      source.one_texture_for_all = true;
    }
  }

  Image make_image(const BakeOutput& output) {
    Image image{.output = output,
                .field = {},
                .test = test_image_named(output.map),
                .options = {},
                .file = nullptr};
    const ImageFormat format = format_of(output);
    const SampleType number = depth_of(arguments_, format, FieldKind::Label);
    scene_->ids_as_colours = is_integer(number);
    if (image.test) {
      image.field = {.name = output.map, .channels = 3, .kind = FieldKind::Colour};
    } else {
      try {
        image.field = make_field(output.map, *scene_);
      } catch (const FieldError& error) {
        const std::string meant = nearest_word(error.unknown(), error.known());
        const bool bare = dynamic_cast<const NoColoursError*>(&error) != nullptr;
        throw UsageMistake(display_name(arguments_.input) + ": " + error.what() +
                           (bare ? "; --texture IMAGE names its texture" : "") +
                           (meant.empty() ? "" : "; did you mean " + meant + "?"));
      }
    }
    image.options = {.width = arguments_.width,
                     .height = arguments_.width / 2,
                     .format = format,
                     .sample_type = depth_of(arguments_, format, image.field.kind),
                     .convention = arguments_.convention,
                     .tiles = arguments_.mip};
    if (image.field.channels > most_channels(format)) {
      throw UsageMistake("-o: " + std::string(name_of(format)) + " images have no alpha, which " +
                         image.field.name + " has here; .png has");
    }
    require_exact_labels(image);
    return image;
  }

  /// Numbers that are rounded would name other faces.
  static void require_exact_labels(const Image& image) {
    if (image.field.kind != FieldKind::Label || !image.field.range) return;
    const bool half = image.options.sample_type == SampleType::Half;
    if (!half && image.options.sample_type != SampleType::Float) return;
    const double most = half ? 1 << 11 : 1 << 24;
    if (image.field.range->second <= most) return;
    throw UsageMistake("--depth: " + std::string(name_of(image.options.sample_type)) +
                       " holds whole numbers up to " + std::to_string(std::lround(most)) +
                       " exactly; " + image.field.name + " goes up to " +
                       std::to_string(std::lround(image.field.range->second)) +
                       (half ? "; float holds more" : ""));
  }

  /// Integers need to know where their values end: where a field cannot say, it is baked twice.
  void find_ranges() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<std::pair<double, double>> ranges(images_.size(), {infinity, -infinity});
    std::vector<Image*> unknown;
    for (Image& image : images_) {
      const bool needs = image.field.kind == FieldKind::Data && !image.field.range &&
                         is_integer(image.options.sample_type);
      if (needs) unknown.push_back(&image);
    }
    bake_some(unknown, "range", [&](size_t i, int, int rows, const float* values) {
      const auto count =
          static_cast<std::ptrdiff_t>(rows) * arguments_.width * unknown[i]->field.channels;
      const auto [least, greatest] = std::minmax_element(values, values + count);
      ranges[i].first = std::min(ranges[i].first, static_cast<double>(*least));
      ranges[i].second = std::max(ranges[i].second, static_cast<double>(*greatest));
    });
    for (size_t i = 0; i < unknown.size(); ++i) unknown[i]->field.range = ranges[i];
  }

  std::vector<std::pair<std::string, std::string>> metadata() const {
    std::vector<std::pair<std::string, std::string>> lines = {
        {"sphparam:version", version}, {"sphparam:source", display_name(arguments_.input)}};
    const bool linear = arguments_.interpolation == Interpolation::Uv;
    for (auto& text : texts_of_chart(linear, arguments_.refine_poles))
      lines.push_back(std::move(text));
    if (!arguments_.target.empty())
      lines.emplace_back("sphparam:for", display_name(arguments_.target));
    return lines;
  }

  /// The scale of a heat map, in a picture of its own: a texture has no place for it.
  void add_scale(const Image& image) {
    const std::optional<HeatScale> scale = heat_scale_of(image.field);
    if (!scale || image.test || is_stream(image.output.path)) return;
    constexpr int side = 480;
    const sphparam::Image blank(side, side, 3), whole = with_legend(blank, *scale);
    sphparam::Image strip(whole.width, whole.height - side, whole.channels);
    std::copy_n(whole.pixel(0, side), strip.pixels.size(), strip.pixels.begin());
    const std::vector<char> png = encode_image(strip, ImageFormat::Png);
    files_.add(scale_path(image.output.path), {png.data(), png.size()});
  }

  void draw_test_images() {
    const SrgbCurves& curves = SrgbCurves::get();
    for (Image& image : images_) {
      if (!image.test) continue;
      const int width = arguments_.width, height = width / 2;
      constexpr int rows_at_once = 64;
      for (int row = 0; row < height; row += rows_at_once) {
        const int rows = std::min(rows_at_once, height - row);
        std::vector<float> rgb(3 * static_cast<size_t>(rows) * static_cast<size_t>(width));
        draw_test_rows(*image.test, width, height, Convention::Sphparam, row, rows, rgb.data(),
                       arguments_.threads);
        for (float& x : rgb) x = curves.to_linear(x);
        image.file->write_rows(rows, rgb.data());
        if (!console_.progress(image.field.name, static_cast<double>(row) / height)) {
          throw Cancelled();
        }
      }
    }
  }

  template <class Sink>
  void bake_images(const Sink& sink) {
    std::vector<Image*> baked;
    for (Image& image : images_) {
      if (!image.test) baked.push_back(&image);
    }
    bake_some(baked, "bake", [&](size_t i, int row, int rows, const float* values) {
      sink(*baked[i], row, rows, values);
    });
  }

  template <class Sink>
  void bake_some(const std::vector<Image*>& images, const char* stage, const Sink& sink) {
    if (images.empty()) return;
    std::vector<SurfaceField> fields;
    for (const Image* image : images) fields.push_back(image->field);
    const Stopwatch stopwatch;
    const BakeOptions options{.width = arguments_.width,
                              .height = arguments_.width / 2,
                              .samples = arguments_.samples,
                              .interpolation = arguments_.interpolation,
                              .threads = arguments_.threads,
                              .progress = [&](std::string_view, double done) {
                                return console_.progress(stage, done, pace(stopwatch, done));
                              }};
    bake(*scene_, fields, options, sink);
  }

  /// ", 12 million texels/s, 34 s left"
  std::string pace(const Stopwatch& stopwatch, double done) const {
    if (done <= 0) return "";
    const double texels = 0.5 * arguments_.width * arguments_.width;
    char text[80];
    std::snprintf(text, sizeof text, ", %.3g million texels/s, %.0f s left",
                  1e-6 * texels * done / stopwatch.seconds(),
                  stopwatch.seconds() * (1 - done) / done);
    return text;
  }

  const BakeArguments& arguments_;
  Console& console_;
  const Stopwatch stopwatch_;
  std::vector<BakeOutput> outputs_;
  std::unique_ptr<BakeScene> scene_;
  std::optional<double> target_distance_;  // of the diagonal
  PendingFiles files_;
  std::vector<Image> images_;  // write to files_, so they go first
};

int run_bake(const BakeArguments& arguments) {
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const OrderlyInterruption orderly;
  Baker baker(arguments, console);
  baker.run();
  const BakeReport report = baker.report();
  for (const BakeReport::Image& image : report.images) {
    console.say(display_name(arguments.input) + ": " + image.map + ", " +
                std::to_string(report.width) + " × " + std::to_string(report.height) + " " +
                image.sample_type + " → " + output_name(image.path));
  }
  console.detail("  " + short_number(report.seconds) + " s");
  return Ok;
}

}  // namespace

Command declare_bake(CLI::App& program) {
  const auto arguments = std::make_shared<BakeArguments>();
  return {declare_bake_arguments(program, *arguments),
          [arguments] { return run_bake(*arguments); }};
}

}  // namespace sphparam::cli
