#include "arguments/match_arguments.h"

#include "arguments/energy_words.h"
#include "arguments/mesh_names.h"
#include "console/exit_codes.h"
#include "console/places.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {
namespace {

void require_map_name(const std::string& path) {
  if (keeps_map(path) || has_float_spheres(path)) return;
  throw UsageMistake(
      "-o: the map has a place in .ply, .vtk and .vtp, and its sphere alone in .gii and .mz3; "
      "the name must end so, not in " +
      inner_extension_of(path));
}

void require_morph_name(const std::string& path) {
  if (path.empty() || is_stream(path) || extension_of(path) == ".glb") return;
  throw UsageMistake("--morph: the morph is written as .glb, not as " + output_name(path));
}

void require_page_name(const std::string& path) {
  const std::string extension = extension_of(path);
  if (path.empty() || is_stream(path) || extension == ".html" || extension == ".htm") return;
  throw UsageMistake("--page: the page is written as .html, not as " + output_name(path));
}

void declare_outputs(Declaration& command, MatchArguments& arguments) {
  command.text("--write-shape", arguments.shape, "FILE", "The triangles of A in the shape of B")
      .written()
      .text("--write-values", arguments.values, "FILE",
            "A with the vertices' values and colours of B")
      .written()
      .text("--write-back", arguments.back, "FILE", "The triangles of B in the shape of A")
      .written()
      .text("--morph", arguments.morph, "FILE",
            "A with an animation that turns it into B and back (.glb)")
      .written()
      .choice("--morph-place", arguments.placement,
              {{"scaled", Placement::Scaled},
               {"moved", Placement::Moved},
               {"as-is", Placement::AsItIs}},
              "How B comes to where A is: turned, moved and scaled to A's area; without scaling; "
              "or as its file has it (default: scaled)")
      .text("--page", arguments.page, "FILE",
            "A page that shows the match: both in one colouring, a 3D morph, distortion, figures")
      .written()
      .flag_off("--no-viewer", arguments.viewer, "Pages with pictures alone, without scripts");
}

}  // namespace

void require_sensible(const MatchArguments& arguments) {
  if (arguments.features.size() % 2 != 0) {
    throw UsageMistake("--features: pairs are needed, of A and of B, and there are " +
                       std::to_string(arguments.features.size()) + " names");
  }
  if (arguments.options.alike && !arguments.landmarks.empty())
    throw UsageMistake(
        "--alike: --landmarks say already what lies where on both; leave one of the two out");
  require_one_stream({arguments.first, arguments.second, arguments.landmarks},
                     "the two meshes and --landmarks");
  require_map_name(arguments.output);
  require_mesh_name("--write-shape", "the triangles of A in the shape of B", arguments.shape);
  require_mesh_name("--write-values", "A with what B carries", arguments.values);
  require_mesh_name("--write-back", "the triangles of B in the shape of A", arguments.back);
  require_morph_name(arguments.morph);
  require_page_name(arguments.page);
  check_places({{"-o", arguments.output},
                {"--write-shape", arguments.shape},
                {"--write-values", arguments.values},
                {"--write-back", arguments.back},
                {"--morph", arguments.morph},
                {"--page", arguments.page},
                {"--json", arguments.json}});
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
            "Vertices that go to vertices, or points, a pair a line: of A, of B (default: ends of "
            "A and "
            "B are paired)")
      .list(
          "--features", arguments.features, "OF_A,OF_B,…",
          "Numbers a vertex that are to agree, such as sulcal depth: files (.shape.gii, .func.gii, "
          "lh.sulc, .mgh …) or properties of the meshes (default: none)")
      .number("--feature-weight", arguments.feature_weight, "W", {1e-9, 1e9, "1e-9 to 1e9"},
              "Of their mean square difference, in spreads, against the energy, of which isometry "
              "has 2")
      .flag(
          "--alike", arguments.options.alike,
          "A and B lie alike in space, as their files have them: without landmarks, ends and turns "
          "are also judged by where places are, the first turn of --features by that alone")
      .flag("--mirror", arguments.mirror, "Match the mirror image of A, which is what is written")
      .choice("--energy", arguments.options.energy.kind, energy_words,
              "Of A → B, what is minimised: stretch both ways, or angles and areas as of maps "
              "(default: symmetric-dirichlet)")
      .text("--sphere", arguments.first_sphere, "FILE", "The map of A, in a file of its own")
      .text("--sphere-b", arguments.second_sphere, "FILE", "The same for B");
  declare_outputs(command, arguments);
  command.up(arguments.up).json(arguments, "Certificates, distortion, landmarks");
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace sphparam::cli
