#include "console/help.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>
#include <string>

#include "console/exit_codes.h"

namespace sphparam::cli {

const char program_summary[] =
    "Maps closed genus-0 triangle meshes one-to-one onto the sphere, and proves it.\n"
    "\n"
    "Examples:\n"
    "  sphparam helmet.glb                            an asset, whole: one chart, all its images\n"
    "  sphparam info statue.obj                       what it is, what is wrong with it\n"
    "  sphparam map statue.obj -o statue.sph.ply      map it, prove it, write it\n"
    "  sphparam bake statue.sph.ply --map normal-object,ao -o statue_{map}.png\n"
    "  sphparam export statue.sph.ply --image statue_ao.png -o statue.glb   for game engines\n"
    "  sphparam repair scan.ply -o mended.ply         mend it, whatever it is for\n"
    "  sphparam wrap asset.glb -o wrapped.ply         a closed surface about any triangles\n"
    "  sphparam survey scans/ -o survey.html          which of many map, which not and why\n"
    "  sphparam verify statue.sph.ply                 prove a written map again\n"
    "  sphparam render statue.sph.ply -o statue.png   look at it\n"
    "  sphparam compare statue.obj -o statue/         all methods, side by side\n"
    "  sphparam report statue.obj -o statue.html      a page to look at a map\n"
    "  sphparam remesh statue.sph.ply --grid ico:7 -o statue_ico7.sph.ply\n"
    "  sphparam measure statue.obj statue_ico7.sph.ply   how far two surfaces are apart\n";

namespace {

std::string footer() {
  std::string text =
      "Files: `-` is standard input or output. Messages go to standard error.\n"
      "-q, -v, --fail-on-warnings, --progress, --threads, --max-memory and --limit may stand "
      "before the subcommand too.\n"
      "\n"
      "Exit codes:\n";
  for (const ExitMeaning& exit : exit_meanings) {
    const std::string code = std::to_string(exit.code);
    text += std::string(5 - code.size(), ' ') + code + "  " + exit.meaning + "\n";
  }
  return text;
}

/// Help as CLI11 makes it, without its remarks in the description.
class Help : public CLI::Formatter {
 public:
  Help() { column_width(34); }
  std::string make_description(const CLI::App* app) const override {
    return app->get_description() + "\n";
  }
  /// In the list of subcommands, the first line of each one's description.
  std::string make_subcommand(const CLI::App* command) const override {
    const std::string text = command->get_description();
    std::stringstream line;
    CLI::detail::format_help(line, command->get_name(), text.substr(0, text.find('\n')),
                             get_column_width());
    return line.str();
  }
};

}  // namespace

void shape_help(CLI::App& program) {
  program.formatter(std::make_shared<Help>());
  program.footer(footer());
}

}  // namespace sphparam::cli
