// `sphparam bake`: reads what is baked and what for, has it baked, tells what came of it.

#include "sphparam/bake/bake.h"

#include <cstdio>

#include "arguments/bake_arguments.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "number_text.h"
#include "sphparam/io/paths.h"
#include "sphparam/records/bake_record.h"

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

MappedMesh read_target(const std::string& path, Session& session) {
  MappedMesh target = read_mapped(path, "", session);
  if (!target.mapped_here()) return target;
  throw NotCertifiedError(display_name(path) +
                          ": carries no map, so it is on no sphere that it could share; "
                          "`sphparam remesh` makes meshes on the source's sphere");
}

BakeSettings settings_of(const BakeArguments& arguments, Session& session) {
  BakeSettings settings = arguments.settings;
  settings.source_name = display_name(arguments.input);
  if (!arguments.target.empty()) settings.target = read_target(arguments.target, session);
  settings.threads = session.threads();
  settings.progress = PacedProgress(session.console, settings.width);
  return settings;
}

/// Errors in the words of the command line.
BakeReport bake_for_user(const MappedMesh& source, const std::vector<BakeRequest>& images,
                         const BakeSettings& settings, PendingFiles& files) {
  try {
    return bake(source, images, settings, files);
  } catch (const BakeSettingError& error) {
    throw as_mistake(error);
  } catch (const FieldError& error) {
    throw as_mistake(error, settings);
  } catch (const OtherSphereError& error) {
    throw as_mistake(error, source, settings);
  } catch (const HalfRangeError& error) {
    throw ImageError(std::string(error.what()) + ": --depth float has");
  }
}

int run_bake(BakeArguments& arguments) {
  settle_body(arguments);
  Session session(arguments);
  const std::vector<BakeRequest> images = bake_requests(arguments);
  const MappedMesh source = read_mapped(arguments.input, arguments.sphere, session);
  const BakeSettings settings = settings_of(arguments, session);
  tell_longitudes(source, settings.convention, session);
  const BakeReport baked = bake_for_user(source, images, settings, session.files);
  session.warn(baked.warnings);
  session.add_report([&] {
    return to_json(BakeRecord{arguments.input, source, arguments.target, settings, baked,
                              session.stopwatch.seconds()});
  });
  session.publish();
  if (!baked.coordinate_system.empty()) {
    session.console.say("  longitude and latitude: " + baked.coordinate_system);
  }
  for (const BakedImage& image : baked.images) session.console.say(line_of(image, settings));
  session.console.detail("  " + short_number(session.stopwatch.seconds()) + " s");
  return Ok;
}

}  // namespace

Command declare_bake(CLI::App& program) {
  return make_command(program, "bake", bake_summary(), declare_bake_options, run_bake);
}

}  // namespace sphparam::cli
