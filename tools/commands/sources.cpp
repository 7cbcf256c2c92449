#include "commands/sources.h"

#include <utility>

#include "arguments/limits.h"
#include "console/exit_codes.h"
#include "reports/told_losses.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

MeshSource read_source(const std::string& path) {
  return sphparam::read_source(path, input_limits());
}

MappedMesh read_mapped(const std::string& path, const std::string& sphere, Session& session,
                       double lambda) {
  session.hold_signals();
  LoadOptions options{.sphere = sphere, .read = input_limits()};
  options.map.energy.lambda = lambda;
  options.map.threads = session.threads();
  options.map.progress = session.progress();
  MeshSource source = read_source(path);
  tell_losses(source, session.console);
  const MappedMesh mapped = mapped_mesh(std::move(source), options);
  if (mapped.mapped_here())
    session.console.say(mapped.name() + ": carries no map; mapped now (progressive)");
  return mapped;
}

std::shared_ptr<const MeshTextures> read_shown_textures(const MeshFile& file,
                                                        const std::string& path,
                                                        const std::string& image,
                                                        Session& session) try {
  const std::string name = display_name(path);
  const ShownTextures shown = shown_textures(file, name, image, session.threads());
  const std::string advice =
      ": --texture IMAGE names it, or the glTF file with --sphere " + name + " has it";
  if (!shown.warning.empty())
    session.console.warning(shown.warning + (shown.left_behind ? advice : ""));
  return shown.textures;
} catch (const NoTexcoords& error) {
  throw UsageMistake(std::string("--texture: ") + error.what());
}

}  // namespace sphparam::cli
