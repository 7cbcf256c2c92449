#include "commands/sources.h"

#include <utility>

#include "arguments/input_limits.h"
#include "reports/told_losses.h"

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

}  // namespace sphparam::cli
