// `sphparam bake`: reads what is baked and what for, has it baked, tells what came of it.

#include "sphparam/bake/bake.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "arguments/bake_arguments.h"
#include "arguments/part_files.h"
#include "commands/command.h"
#include "commands/data_files.h"
#include "commands/sources.h"
#include "commands/surfaces.h"
#include "console/places.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "sphparam/io/body_longitudes.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/sphere_file.h"
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

MappedMesh read_target(const MappedMesh& source, const BakeArguments& arguments, Session& session) {
  MeshSource target = read_mended(arguments.target, {}, session);
  if (read_sphere(target.file)) return map_source(std::move(target), "", session);
  throw UsageMistake("--for: " + display_name(arguments.target) +
                     ": carries no map, so it is on no sphere that it could share; " +
                     advice_for_target(source, arguments));
}

/// A surface as it is, with all that its materials say.
MeshFile read_from(const BakeArguments& arguments, Session& session) {
  ReadOptions options = input_limits();
  options.repeated_corners = true;  // needles are as good as any triangle
  MeshFile surface = read_surface(arguments.from, session, options);
  tell_losses_of_reading(arguments.from, surface.notes, session.console);
  keep_companions(surface);
  attach_data_files(surface, arguments.from, arguments.data, MissingValues::LeftOut, session);
  crease(surface, arguments.from, arguments.crease, session);
  turn_normals(surface, arguments.from, arguments.source_normals_down, session);
  return surface;
}

/// The mesh with its map; numbers and creases are of the surface that is baked.
MappedMesh read_mesh(const BakeArguments& arguments, Session& session) {
  session.hold_signals();
  const bool is_baked = arguments.from.empty();
  MeshSource source =
      read_mended(arguments.input, arguments.repair, session, is_baked ? arguments.data : Words{});
  if (is_baked) {
    crease(source.file, arguments.input, arguments.crease, session);
    turn_normals(source.file, arguments.input, arguments.source_normals_down, session);
  }
  return map_source(std::move(source), arguments.sphere, session, arguments.repair);
}

BakeSettings settings_of(const BakeArguments& arguments, const MappedMesh& source,
                         Session& session) {
  BakeSettings settings = arguments.settings;
  settings.fields.centre = arguments.centre.of(source.mesh());
  settings.source_name = display_name(arguments.from.empty() ? arguments.input : arguments.from);
  if (!arguments.from.empty()) settings.from = read_from(arguments, session);
  if (!arguments.target.empty()) settings.target = read_target(source, arguments, session);
  settings.threads = session.threads();
  settings.progress = PacedProgress(session.console, settings.width);
  return settings;
}

/// Errors in the words of the command line.
BakeReport bake_for_user(const MappedMesh& source, const std::vector<BakeRequest>& images,
                         const BakeSettings& settings, const BakeArguments& arguments,
                         PendingFiles& files) {
  try {
    return bake(source, images, settings, files);
  } catch (const BakeSettingError& error) {
    throw as_mistake(error);
  } catch (const FieldError& error) {
    throw as_mistake(error, settings);
  } catch (const OtherSphereError& error) {
    throw as_mistake(error, source, arguments);
  } catch (const HalfRangeError& error) {
    throw ImageError(std::string(error.what()) + ": --depth float has");
  } catch (const ImageError& error) {
    const std::string why = error.what();
    if (!why.starts_with("material ")) throw;
    const std::string& file = arguments.from.empty() ? arguments.input : arguments.from;
    throw ImageError(why + "; --texture IMAGE names another for basecolor, `sphparam asset " +
                     (is_stream(file) ? "FILE" : shell_file(file)) +
                     "` leaves out images that cannot be read");
  }
}

/// The arguments for one part: its files, where it has its own.
BakeArguments of_part(BakeArguments arguments, int part) {
  arguments.input = path_of_part(arguments.input, part);
  arguments.target = file_for_part(arguments.target, part);
  arguments.settings.texture = file_for_part(arguments.settings.texture, part);
  std::error_code hidden;
  const bool in_folder =
      arguments.output.ends_with('/') || std::filesystem::is_directory(arguments.output, hidden);
  if (!in_folder) arguments.output = path_of_part(arguments.output, part);
  return arguments;
}

/// A map that was made here for the images has the directions that came of it, in no file: of
/// numbers of a sphere, as measured on one, that is not where they belong.
void tell_turned(const MappedMesh& source, const std::vector<BakeRequest>& images,
                 const BakeSettings& settings, Session& session) {
  const auto is_scalar = [](const BakeRequest& image) {
    return image.field.starts_with("scalar:");
  };
  if (!source.mapped_here() || settings.convention == Convention::Gis ||
      std::ranges::none_of(images, is_scalar))
    return;
  const std::string off = directions_turned(source, settings.fields.centre, session.threads());
  if (!off.empty())
    session.console.warning("the directions of these images are the map's, not the body's: " + off);
}

/// Bakes the images of one mesh; returns the report, and adds to the lines that are told at the
/// end.
std::string bake_one(const BakeArguments& arguments, Session& session, Words& lines) {
  std::vector<BakeRequest> images = bake_requests(arguments);
  require_there({arguments.input, arguments.sphere, arguments.target, arguments.from,
                 arguments.settings.texture});
  const MappedMesh source = read_mesh(arguments, session);
  const BakeSettings settings = settings_of(arguments, source, session);
  images =
      requests_of_mesh(std::move(images), arguments, settings.from ? *settings.from : source.file(),
                       !source.mapped_here() && arguments.sphere.empty());
  tell_longitudes(source, settings.convention, settings.fields.body.has_value(),
                  settings.fields.centre, session);
  tell_turned(source, images, settings, session);
  const BakeReport baked = bake_for_user(source, images, settings, arguments, session.files);
  session.warn(baked.warnings);
  if (!baked.coordinate_system.empty())
    lines.push_back("  longitude and latitude: " + baked.coordinate_system);
  if (baked.projection) lines.push_back("  " + line_of(*baked.projection, settings));
  for (const BakedImage& image : baked.images) lines.push_back(line_of(image, settings));
  return to_json(BakeRecord{arguments.input, source, arguments.target, arguments.from, settings,
                            baked, session.stopwatch.seconds()});
}

int run_bake(BakeArguments& arguments) {
  settle_body(arguments);
  if (arguments.all_components && is_stream(arguments.output))
    throw UsageMistake("-o: --all-components makes several images: give a name, not a stream");
  if (arguments.all_components && !arguments.sphere.empty())
    throw UsageMistake(
        "--sphere is for one mesh, and --all-components bakes several: name the map of all "
        "parts as the mesh, as `map --all-components -o` does, and what it was made "
        "of with --from");
  if (!arguments.from.empty() && !arguments.target.empty())
    throw UsageMistake("--from and --for: the images are for the mesh itself with --from");
  Session session(arguments);
  Words lines;
  report_each("bake", arguments.all_components, arguments.input, session, [&](int part) {
    return bake_one(part > 0 ? of_part(arguments, part) : arguments, session, lines);
  });
  session.publish();
  for (const std::string& line : lines) session.console.say(line);
  session.console.detail("  " + short_number(session.stopwatch.seconds()) + " s");
  return Ok;
}

}  // namespace

Command declare_bake(CLI::App& program) {
  return make_command(program, "bake", bake_summary(), declare_bake_options, run_bake);
}

}  // namespace sphparam::cli
