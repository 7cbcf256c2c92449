#include "commands/textures.h"

#include "console/exit_codes.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

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
