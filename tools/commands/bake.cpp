// `sphparam bake`: reads what is baked and what for, has it baked, tells what came of it.

#include "sphparam/bake/bake.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "arguments/bake_arguments.h"
#include "arguments/suggestion.h"
#include "commands/mapped_source.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "sphparam/io/paths.h"
#include "sphparam/records/bake_record.h"
#include "sphparam/stopwatch.h"
#include "number_text.h"

namespace sphparam::cli {
namespace {

/// Shows how far the bake is and, of what goes texel by texel, how fast:
/// ", 12 million texels/s, 34 s left".
class PacedProgress {
 public:
  PacedProgress(Console& console, int width)
      : console_(console), texels_(0.5 * width * width), is_paced_(false) {}

  bool operator()(std::string_view stage, double done) {
    if (stage != stage_) {
      stage_ = stage;
      is_paced_ = stage == "bake" || stage == "range";
      stopwatch_ = {};
    }
    return console_.progress(stage, done, is_paced_ ? pace(done) : "");
  }

 private:
  std::string pace(double done) const {
    if (done <= 0) return "";
    char text[80];
    std::snprintf(text, sizeof text, ", %.3g million texels/s, %.0f s left",
                  1e-6 * texels_ * done / stopwatch_.seconds(),
                  stopwatch_.seconds() * (1 - done) / done);
    return text;
  }

  Console& console_;
  double texels_;
  std::string stage_;
  bool is_paced_;
  Stopwatch stopwatch_;
};

MappedMesh read_target(const BakeArguments& arguments, Console& console) {
  MappedMesh target = read_mapped_source(arguments.target, "", arguments.settings.threads, console);
  if (!target.mapped_here()) return target;
  throw NotCertifiedError(display_name(arguments.target) +
                          ": carries no map, so it is on no sphere that it could share; "
                          "`sphparam remesh` makes meshes on the source's sphere");
}

BakeSettings settings_of(const BakeArguments& arguments, Console& console) {
  BakeSettings settings = arguments.settings;
  settings.source_name = display_name(arguments.input);
  if (!arguments.target.empty()) settings.target = read_target(arguments, console);
  settings.progress = PacedProgress(console, settings.width);
  return settings;
}

UsageMistake other_sphere(const OtherSphereError& error, const MappedMesh& source,
                          const BakeSettings& settings) {
  return UsageMistake(std::string("--for: ") + error.what() + "; `sphparam remesh " +
                      settings.source_name +
                      " --grid ico:6 -o LOW.sph.ply` makes a mesh on its sphere" +
                      (source.mapped_here() ? ", of a map that is kept (`sphparam map`)" : ""));
}

UsageMistake impossible_field(const FieldError& error, const BakeSettings& settings) {
  const bool bare = dynamic_cast<const NoColoursError*>(&error) != nullptr;
  const std::string meant = nearest_word(error.unknown(), error.known());
  return UsageMistake(settings.source_name + ": " + error.what() +
                      (bare ? "; --texture IMAGE names its texture" : "") +
                      (meant.empty() ? "" : "; did you mean " + meant + "?"));
}

/// Errors in the words of the command line.
BakeReport bake_for_user(const MappedMesh& source, const std::vector<BakeRequest>& images,
                         const BakeSettings& settings, PendingFiles& files) {
  try {
    return bake(source, images, settings, files);
  } catch (const BakeSettingError& error) {
    throw as_mistake(error);
  } catch (const FieldError& error) {
    throw impossible_field(error, settings);
  } catch (const OtherSphereError& error) {
    throw other_sphere(error, source, settings);
  } catch (const HalfRangeError& error) {
    throw ImageError(std::string(error.what()) + ": --depth float has");
  }
}

int run_bake(const BakeArguments& arguments) {
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const OrderlyInterruption orderly;
  const Stopwatch stopwatch;
  const std::vector<BakeRequest> images = bake_requests(arguments);
  const MappedMesh source =
      read_mapped_source(arguments.input, arguments.sphere, arguments.settings.threads, console);
  const BakeSettings settings = settings_of(arguments, console);
  PendingFiles files;
  const BakeReport baked = bake_for_user(source, images, settings, files);
  for (const std::string& warning : baked.warnings) console.warning(warning);
  if (!arguments.json.empty()) {
    files.add(arguments.json, to_json(BakeRecord{arguments.input, source, arguments.target,
                                                 settings, baked, stopwatch.seconds()}));
  }
  if (interrupted()) throw Cancelled();
  files.publish();
  console.clear_progress();
  for (const BakedImage& image : baked.images) console.say(line_of(image, settings));
  console.detail("  " + short_number(stopwatch.seconds()) + " s");
  return Ok;
}

}  // namespace

Command declare_bake(CLI::App& program) {
  const auto arguments = std::make_shared<BakeArguments>();
  return {declare_bake_arguments(program, *arguments),
          [arguments] { return run_bake(*arguments); }};
}

}  // namespace sphparam::cli
