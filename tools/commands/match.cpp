// `sphparam match`: a map from one surface to another, one-to-one, and what it carries over.

#include "sphparam/correspondence/match.h"

#include "arguments/mesh_names.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "console/places.h"
#include "reports/told_losses.h"
#include "sphparam/correspondence/landmark_file.h"
#include "sphparam/correspondence/matched_files.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/map_files.h"
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
    "  sphparam match horse.obj cow.obj -o horse_to_cow.ply\n"
    "  sphparam match lh.surf.gii lh_template.sph.ply --landmarks pairs.txt -o "
    "lh.sphere.reg.surf.gii\n"
    "\n"
    "B's map onto the sphere stays; the points of A on it move until the map from A over the "
    "sphere\n"
    "to B distorts least. Both maps are proved one-to-one, so what they make together is.\n"
    "Landmarks are pairs of vertices, a line each: that of A and that of B. They are met exactly.\n"
    "Without them the ends of what sticks out of A and B are paired as distorts least and looks\n"
    "most alike, and a start is made from there; the confidence in it is told.\n"
    "The exit status is 5 where no map has them.\n";

struct MatchArguments : CommonArguments {
  std::string first, second;
  std::string first_sphere, second_sphere;  // empty: the meshes' own maps; so are, not wanted:
  std::string landmarks, output, shape, values, back;
  bool mirror = false;
  MatchOptions options;
};

void require_sensible(const MatchArguments& arguments) {
  require_one_stream({arguments.first, arguments.second, arguments.landmarks},
                     "the two meshes and --landmarks");
  const std::string extension = inner_extension_of(arguments.output);
  if (!keeps_map(arguments.output) && !has_float_spheres(arguments.output)) {
    throw UsageMistake(
        "-o: the map has a place in .ply, .vtk and .vtp, and its sphere alone in .gii and .mz3; "
        "the name must end so, not in " +
        extension);
  }
  require_mesh_name("--write-shape", "the triangles of A in the shape of B", arguments.shape);
  require_mesh_name("--write-values", "A with what B carries", arguments.values);
  require_mesh_name("--write-back", "the triangles of B in the shape of A", arguments.back);
  check_places({{"-o", arguments.output},
                {"--write-shape", arguments.shape},
                {"--write-values", arguments.values},
                {"--write-back", arguments.back},
                {"--json", arguments.json}});
}

/// The landmarks' file names vertices by their numbers in the meshes' files.
void read_landmarks_of(MatchArguments& arguments, const MappedMesh& first,
                       const MappedMesh& second) {
  arguments.options.search = arguments.landmarks.empty();
  if (arguments.options.search) return;
  arguments.options.landmarks =
      read_landmarks(arguments.landmarks, FileNumbers(first.file()), FileNumbers(second.file()));
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

/// The match in the format of its name: the mesh with its map, or the bare sphere.
void add_output(const MatchArguments& arguments, const Match& match, Session& session) {
  const MappedMesh& from = match.map.from();
  if (!keeps_map(arguments.output)) {
    const FinishedMap finished{from.file(), from.topology(), from.map(), from.certificate(),
                               from.provenance()};
    add_sphere(session.files, arguments.output, finished,
               {.may_remap = false,
                .origin = arguments.first,
                .threads = session.threads(),
                .progress = session.progress()});
    return;
  }
  tell_losses(arguments.output,
              add_mapped(session.files, arguments.output,
                         with_targets(match.map, session.threads()), session.threads()),
              session.console);
}

std::vector<std::pair<std::string, std::string>> add_outputs(const MatchArguments& arguments,
                                                             const Match& match, Session& session) {
  std::vector<std::pair<std::string, std::string>> outputs{{"map", arguments.output}};
  add_output(arguments, match, session);
  const auto add = [&](const char* key, const std::string& path, const auto& make) {
    if (path.empty()) return;
    outputs.emplace_back(key, path);
    tell_losses(path, add_mesh(session.files, path, make()), session.console);
  };
  const int threads = session.threads();
  add("shape", arguments.shape, [&] { return in_other_shape(match.map, threads); });
  add("values", arguments.values, [&] { return with_other_values(match.map, threads); });
  add("back", arguments.back, [&] { return in_other_shape(match.map.inverse(), threads); });
  return outputs;
}

/// Tells of values that are asked for and are not there.
void tell_absent_values(const MatchArguments& arguments, const MappedMesh& second,
                        Session& session) {
  if (arguments.values.empty() || !names_of_values(second.file()).empty()) return;
  session.warn(
      {"--write-values: no vertex of " + second.name() +
       " carries a value or a colour, so nothing is carried over; a texture: sphparam bake " +
       arguments.second + " --texture, then sphparam export " + arguments.output +
       " --image with what it made"});
}

int run_match(MatchArguments& arguments) {
  require_sensible(arguments);
  Session session(arguments);
  MappedMesh first = read_mapped(arguments.first, arguments.first_sphere, session);
  if (arguments.mirror) first = mirror_image(first, session.threads());
  const MappedMesh second = read_mapped(arguments.second, arguments.second_sphere, session);
  read_landmarks_of(arguments, first, second);
  tell_absent_values(arguments, second, session);
  const Match found = match(arguments, first, second, session);
  session.warn(found.warnings);
  MatchRecord record{.first = arguments.first,
                     .second = arguments.second,
                     .match = found,
                     .options = arguments.options,
                     .mirrored = arguments.mirror,
                     .distortion = summarise(measure_distortion(found.map, session.threads()))};
  record.outputs = add_outputs(arguments, found, session);
  record.seconds = session.stopwatch.seconds();
  session.add_report([&] { return to_json(record); });
  session.publish();
  session.console.say(to_text(record));
  return Ok;
}

void declare_options(Declaration& command, MatchArguments& arguments) {
  command
      .input("A", arguments.first,
             "A .sph.ply, or any mesh: it is mapped first; - for standard input")
      .input("B", arguments.second, "Another one")
      .output(arguments.output, "FILE",
              "A with its map on B's sphere, target_face and target_0, target_1, target_2 (.ply, "
              ".vtk, .vtp); or that sphere alone (.gii, .mz3)")
      .text("--landmarks", arguments.landmarks, "FILE",
            "Vertices that go to vertices, a pair a line: of A, of B (default: ends of A and B are "
            "paired)")
      .flag("--mirror", arguments.mirror, "Match the mirror image of A, which is what is written")
      .choice("--energy", arguments.options.energy.kind,
              {{"symmetric-dirichlet", EnergyKind::SymmetricDirichlet},
               {"angle-area", EnergyKind::AngleAndArea}},
              "Of A → B, what is minimised: stretch both ways, or angles and areas as of maps "
              "(default: symmetric-dirichlet)")
      .sphere(arguments.first_sphere)
      .text("--sphere-b", arguments.second_sphere, "FILE", "The same for B")
      .text("--write-shape", arguments.shape, "FILE", "The triangles of A in the shape of B")
      .written()
      .text("--write-values", arguments.values, "FILE",
            "A with the vertices' values and colours of B")
      .written()
      .text("--write-back", arguments.back, "FILE", "The triangles of B in the shape of A")
      .written()
      .json(arguments, "Certificates, distortion, landmarks")
      .threads(arguments)
      .console(arguments);
}

}  // namespace

Command declare_match(CLI::App& program) {
  return make_command(program, "match", summary, declare_options, run_match);
}

}  // namespace sphparam::cli
