#include "reports/told_losses.h"

#include "console/paths.h"
#include "sphparam/io/losses.h"

namespace sphparam::cli {

void tell_losses(const MeshSource& source, const std::string& path, Console& console) {
  for (const std::string& loss : losses_among(source.notes))
    console.say("  " + display_name(path) + ": " + loss);
}

}  // namespace sphparam::cli
