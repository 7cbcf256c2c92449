#include "commands/match_outputs.h"

#include <algorithm>
#include <filesystem>

#include "commands/command.h"
#include "io/shell_word.h"
#include "mesh/box.h"
#include "number_text.h"
#include "place_text.h"
#include "reports/told_losses.h"
#include "sphparam/correspondence/matched_files.h"
#include "sphparam/gltf/morph.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/paths.h"
#include "sphparam/mesh/self_crossings.h"
#include "sphparam/report/match_page.h"
#include "sphparam/version.h"

namespace sphparam::cli {
namespace {

/// Where a vertex lies is no use in faces that nobody has.
void tell_unknown_targets(const MatchArguments& arguments, const MeshFile& written,
                          bool rows_are_known, Session& session) {
  const std::string name = "  " + output_name(arguments.output) + ": target_face ";
  const auto without = std::ranges::count(written.find_vertex_property("target_face")->values, -1);
  if (!rows_are_known)
    session.console.say(
        name + "numbers the triangles of B as it was mapped, which `sphparam repair " +
        shell_file(arguments.second) + typed_again(arguments.repair) + " -o MENDED` writes");
  else if (without > 0)
    session.console.say(name + "is -1 at " + counted(without, "vertex", "vertices") +
                        ", which lie on faces that B's file has not: the repair added them");
}

/// The match in the format of its name: the mesh with its map, or the bare sphere.
void add_map(const MatchArguments& arguments, const Match& match,
             const std::optional<std::vector<long>>& rows, Session& session) {
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
  const MappedMesh written =
      with_targets(match.map, session.threads(), rows.value_or(std::vector<long>{}));
  tell_losses(arguments.output,
              add_mapped(session.files, arguments.output, written, session.threads()),
              session.console);
  tell_unknown_targets(arguments, written.file(), rows.has_value(), session);
}

void add_morph(const MatchArguments& arguments, const Match& match, Session& session) {
  with_file_errors(arguments.first, arguments.morph, [&] {
    const Asset asset = make_morph(
        match.map, arguments.placement,
        {.up = arguments.up, .threads = session.threads(), .progress = session.progress()});
    const std::vector<std::string> losses = losses_among(asset.warnings);
    tell_losses(arguments.morph, losses, session.console);
    for (const std::string& warning : asset.warnings)
      if (!std::ranges::count(losses, warning)) session.console.warning(warning);
    add_asset(session.files, arguments.morph, asset);
  });
}

/// Triangles that were well on one shape may pass through one another on the other.
void tell_crossings(const std::string& path, const TriangleMesh& mesh, Session& session) {
  const SelfCrossings found = find_self_crossings(
      mesh,
      {.most_looks = usual_looks, .threads = session.threads(), .progress = session.progress()});
  if (found.pairs == 0) return;
  session.warn({output_name(path) + ": " + std::to_string(found.faces) + " of " +
                counted(mesh.face_count(), "triangle", "triangles") + " cross others (" +
                counted(found.pairs, "pair", "pairs") + ", the first at (" +
                place_text(found.place, longest_side(mesh)) +
                ")): what is proved is the map; finer triangles cross less"});
}

/// The command as it may be shown to others: files without their folders.
std::string command_line(const MatchArguments& arguments) {
  std::string line = "sphparam match";
  const auto add = [&](const std::string& option, const std::string& path) {
    if (!path.empty()) line += option + " " + std::filesystem::path(path).filename().string();
  };
  add("", arguments.first);
  add("", arguments.second);
  add(" --landmarks", arguments.landmarks);
  add(" -o", arguments.output);
  return line + (arguments.mirror ? " --mirror" : "");
}

void add_page(const MatchArguments& arguments, const Match& match, Session& session) {
  MatchPageOptions page{.landmarks = arguments.options.landmarks,
                        .viewer = arguments.viewer,
                        .up = arguments.up,
                        .threads = session.threads(),
                        .progress = session.progress()};
  page.facts = {{"command", command_line(arguments)},
                {"program", std::string("sphparam ") + version}};
  with_file_errors(arguments.first, arguments.page,
                   [&] { session.files.add(arguments.page, make_match_page(match, page)); });
}

}  // namespace

std::vector<std::pair<std::string, std::string>> add_outputs(
    const MatchArguments& arguments, const Match& match,
    const std::optional<std::vector<long>>& rows, Session& session) {
  std::vector<std::pair<std::string, std::string>> outputs{{"map", arguments.output}};
  add_map(arguments, match, rows, session);
  const auto add = [&](const char* key, const std::string& path, const auto& make) {
    if (path.empty()) return;
    outputs.emplace_back(key, path);
    const MeshFile made = make();
    tell_losses(path, add_mesh(session.files, path, made), session.console);
    if (path != arguments.values) tell_crossings(path, made.mesh, session);
  };
  const int threads = session.threads();
  add("shape", arguments.shape, [&] { return in_other_shape(match.map, threads); });
  add("values", arguments.values, [&] { return with_other_values(match.map, threads); });
  add("back", arguments.back, [&] { return in_other_shape(match.map.inverse(), threads); });
  const auto show = [&](const char* key, const std::string& path, const auto& add_it) {
    if (path.empty()) return;
    outputs.emplace_back(key, path);
    add_it(arguments, match, session);
  };
  show("morph", arguments.morph, add_morph);
  show("page", arguments.page, add_page);
  return outputs;
}

void tell_absent_values(const MatchArguments& arguments, const MappedMesh& second,
                        Session& session) {
  if (arguments.values.empty() || !names_of_values(second.file()).empty()) return;
  session.warn(
      {"--write-values: no vertex of " + display_name(arguments.second) +
       " carries a value or a colour, so nothing is carried over; a texture: sphparam bake " +
       shell_file(arguments.second) + " --texture, then sphparam export " +
       shell_file(arguments.output) + " --image with what it made"});
}

}  // namespace sphparam::cli
