// `sphparam match`: a map from one surface to another, one-to-one, and what it carries over.

#include "sphparam/correspondence/match.h"

#include <optional>

#include "arguments/limits.h"
#include "arguments/match_arguments.h"
#include "commands/command.h"
#include "commands/match_outputs.h"
#include "commands/sources.h"
#include "console/console.h"
#include "console/places.h"
#include "reports/snapped_wording.h"
#include "reports/told_losses.h"
#include "sphparam/correspondence/feature_file.h"
#include "sphparam/correspondence/landmark_file.h"
#include "sphparam/correspondence/matched_files.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/records/match_record.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Map one surface onto another, one-to-one.\n"
    "\n"
    "Examples:\n"
    "  sphparam match horse.obj cow.obj --landmarks pairs.txt -o horse_to_cow.ply\n"
    "  sphparam match horse.obj cow.obj --landmarks pairs.txt -o h.ply --write-values "
    "horse_as_cow.ply\n"
    "  sphparam match horse.obj cow.obj -o horse_to_cow.ply --morph horse_to_cow.glb\n"
    "  sphparam match lh.surf.gii template.surf.gii --features lh.sulc.shape.gii,sulc.shape.gii -o "
    "lh.sphere.reg.surf.gii\n"
    "\n"
    "B's map onto the sphere stays; the points of A on it move until the map from A over the "
    "sphere\n"
    "to B distorts least. Both maps are proved one-to-one, so what they make together is.\n"
    "Landmarks are pairs of vertices, a line each: that of A and that of B. They are met exactly.\n"
    "Without them the ends of what sticks out of A and B are paired as distorts least and looks\n"
    "most alike, and a start is made from there; the confidence in it is told.\n"
    "With --features, as for cortices, numbers at the vertices of A come to lie on those of B.\n"
    "The exit status is 5 where no map has them.\n";

/// A left and a right hemisphere are mirror images of each other, one and the same is none.
void tell_hemispheres(const MatchArguments& arguments, const MappedMesh& first,
                      const MappedMesh& second, Session& session) {
  const std::string of_first = structure_of(first.file(), arguments.first);
  const std::string of_second = structure_of(second.file(), arguments.second);
  const auto are = [&](const char* one, const char* other) {
    return of_first == one && of_second == other;
  };
  const bool opposite = are("CortexLeft", "CortexRight") || are("CortexRight", "CortexLeft");
  const bool same = are("CortexLeft", "CortexLeft") || are("CortexRight", "CortexRight");
  if (opposite && !arguments.mirror)
    session.console.warning("A is " + of_first + " and B is " + of_second +
                            ": --mirror matches the mirror image of A");
  else if (same && arguments.mirror)
    session.console.warning("A and B are both " + of_first +
                            ", and --mirror matches the mirror image of A: leave it out");
}

/// Before the meshes, as these may take minutes to map.
std::optional<LandmarkFile> landmark_file(const MatchArguments& arguments) {
  if (arguments.landmarks.empty()) return std::nullopt;
  return LandmarkFile(arguments.landmarks);
}

void read_features_of(MatchArguments& arguments, const MeshFile& first, const MeshFile& second) {
  if (arguments.features.empty()) return;
  keep_from_outputs(arguments.features);
  arguments.options.features = read_features(arguments.features, first, second, input_limits());
  arguments.options.features->weight = arguments.feature_weight;
}

struct Side {
  const char* name;
  std::string path, sphere;
};

/// Work on one of the two: which of them a refusal is about, that tells what is wrong with a mesh.
template <class Work>
auto told_of(const Side& side, const Work& work) try {
  return work();
} catch (const MeshRefusal&) {
  print_error(side.name + (" (" + display_name(side.path)) + ") cannot be mapped:");
  throw;
}

/// What can be mapped: one that cannot has other vertices than whoever names them thinks.
MeshSource read_side(const Side& side, const RepairArguments& repair, Session& session) {
  return told_of(side, [&] {
    MeshSource source = read_mended(side.path, repair, session);
    require_mappable(source);
    tell_replaced(source, session.console);
    return source;
  });
}

MappedMesh map_side(const Side& side, MeshSource source, const RepairArguments& repair,
                    Session& session) {
  return told_of(side, [&] { return map_source(std::move(source), side.sphere, session, repair); });
}

Match match(const MatchArguments& arguments, const MappedMesh& first, const MappedMesh& second,
            Session& session) try {
  MatchOptions options = arguments.options;
  options.threads = session.threads();
  options.progress = session.progress();
  return match_surfaces(first, second, options);
} catch (const MirroredLandmarks& error) {
  throw NotCertifiedError(
      std::string(error.what()) +
      (arguments.mirror ? "; leave --mirror out" : "; --mirror matches the mirror image of A"));
} catch (const UnreachableLandmarks& error) {
  throw NotCertifiedError(std::string(error.what()) + (arguments.landmarks.empty()
                                                           ? "; --landmarks takes a file of them"
                                                           : ""));
}

struct Surfaces {
  MappedMesh first, second;
  std::optional<std::vector<long>> rows_of_second;  // of its faces, in its file
};

/// Both, mapped. What they lack, and landmarks and features that they have not, are told before.
Surfaces read_surfaces(MatchArguments& arguments, const std::optional<LandmarkFile>& landmarks,
                       Session& session) {
  const Side a{"A", arguments.first, arguments.first_sphere},
      b{"B", arguments.second, arguments.second_sphere};
  MeshSource first = read_side(a, arguments.repair, session),
             second = read_side(b, arguments.repair, session);
  if (landmarks) {
    for (const MeshSource* source : {&first, &second}) tell_other_numbers(*source, session.console);
    LandmarkFile::Found found = landmarks->pairs(first.file, second.file);
    tell_snapped(arguments.landmarks, found.snapped, session);
    arguments.options.landmarks = std::move(found.pairs);
  }
  read_features_of(arguments, first.file, second.file);
  std::optional<std::vector<long>> rows = rows_in_file(second);
  return {map_side(a, std::move(first), arguments.repair, session),
          map_side(b, std::move(second), arguments.repair, session), std::move(rows)};
}

/// What A's triangles show of B's shape, where it is asked for.
std::optional<CarriedFidelity> fidelity(const MatchArguments& arguments, const Match& match,
                                        Session& session) {
  if (arguments.morph.empty() && arguments.shape.empty() && arguments.page.empty())
    return std::nullopt;
  return measure_carried(match.map, session.threads(), session.progress());
}

int run_match(MatchArguments& arguments) {
  require_sensible(arguments);
  Session session(arguments);
  const std::optional<LandmarkFile> landmarks = landmark_file(arguments);
  require_there(
      {arguments.first, arguments.second, arguments.first_sphere, arguments.second_sphere});
  session.hold_signals();
  auto [first, second, rows] = read_surfaces(arguments, landmarks, session);
  tell_hemispheres(arguments, first, second, session);
  if (arguments.mirror) first = mirror_image(first, session.threads());
  arguments.options.search = !landmarks && arguments.features.empty();
  tell_absent_values(arguments, second, session);
  const Match found = match(arguments, first, second, session);
  session.warn(found.warnings);
  MatchRecord record{.first = arguments.first,
                     .second = arguments.second,
                     .match = found,
                     .options = arguments.options,
                     .mirrored = arguments.mirror,
                     .distortion = summarise_distortion(found.map, session.threads()),
                     .first_mapped_now = first.mapped_here()};
  record.outputs = add_outputs(arguments, found, rows, session);
  record.carried = fidelity(arguments, found, session);
  record.seconds = session.stopwatch.seconds();
  session.add_report([&] { return to_json(record); });
  session.publish();
  session.console.say(to_text(record));
  if (record.carried) session.console.say("  " + carried_line(record));
  return Ok;
}

}  // namespace

Command declare_match(CLI::App& program) {
  return make_command(program, "match", summary, declare_options, run_match);
}

}  // namespace sphparam::cli
