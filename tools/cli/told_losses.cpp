#include "cli/told_losses.h"

#include "cli/paths.h"
#include "mesh_io/losses.h"

namespace sphparam::tools {

void tell_losses(const Source& source, const std::string& path, Console& console) {
  for (const std::string& loss : losses_among(source.notes))
    console.say("  " + display_name(path) + ": " + loss);
}

}  // namespace sphparam::tools
