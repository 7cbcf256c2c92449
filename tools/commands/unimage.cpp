// `sphparam unimage`: a geometry image back to the mesh it was made of, with its map.

#include "arguments/mesh_names.h"
#include "commands/command.h"
#include "console/places.h"
#include "reports/told_losses.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/remesh/geometry_image.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Turn a geometry image back into the mesh it was made of.\n"
    "\n"
    "Examples:\n"
    "  sphparam remesh statue.sph.ply --grid octa:257 --geometry-image gi.exr\n"
    "  sphparam unimage gi.exr -o statue_octa.sph.ply\n"
    "  sphparam unimage gi.exr --attribute thickness=thickness.exr -o statue_octa.sph.ply\n"
    "\n"
    "The image names its grid; vertices and faces are those of `remesh --grid`. Where samples of\n"
    "one vertex differ, the image was changed on one side of its cut, and is refused.\n";

struct UnimageArguments : CommonArguments {
  std::string input;
  std::string output;
  std::string normals;
  Words attributes;
};

GeometryImageFiles files_of(const UnimageArguments& arguments) {
  GeometryImageFiles files{.positions = arguments.input, .normals = arguments.normals};
  for (const std::string& text : arguments.attributes) {
    const auto attribute = name_and_file(text);
    if (!attribute) throw UsageMistake("--attribute: expected NAME=FILE, not " + text);
    files.attributes.push_back(*attribute);
  }
  return files;
}

int run_unimage(UnimageArguments& arguments) {
  Session session(arguments);
  require_mesh_name("-o", "the mesh", arguments.output);
  check_places({{"-o", arguments.output}});
  session.hold_signals();
  std::vector<std::string> warnings;
  const Remeshed mesh =
      load_geometry_image(files_of(arguments), session.threads(), session.progress(), &warnings);
  for (const std::string& warning : warnings) session.console.warning(warning);
  session.console.progress("write", 0);
  tell_losses(arguments.output,
              add_mapped(session.files, arguments.output, mesh, session.threads()),
              session.console);
  session.publish();
  session.console.say(display_name(arguments.input) + ": " + mesh.name() + ", " +
                      std::to_string(mesh.mesh().vertex_count()) +
                      " vertices, certified one-to-one → " + output_name(arguments.output));
  return Ok;
}

void declare_options(Declaration& command, UnimageArguments& arguments) {
  command.input("IMAGE", arguments.input, "Positions, .exr or .png, as `remesh` makes them")
      .output(arguments.output, "FILE",
              "The mesh: .ply, .vtk or .vtp with its map, or another format of meshes")
      .text("--normals", arguments.normals, "FILE", "The image of the normals")
      .texts("--attribute", arguments.attributes, "NAME=FILE",
             "An image of a property, as in thickness=FILE or color=FILE; may be given again")
      .threads(arguments)
      .console(arguments);
}

}  // namespace

Command declare_unimage(CLI::App& program) {
  return make_command(program, "unimage", summary, declare_options, run_unimage);
}

}  // namespace sphparam::cli
