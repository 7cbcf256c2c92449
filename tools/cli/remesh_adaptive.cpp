#include "cli/remesh_adaptive.h"

#include <utility>

#include "cli/certified.h"
#include "cli/paths.h"

namespace sphparam::tools {

Adaptation adapt_source(MappedSource& mapped, std::int64_t samples,
                        const RemeshArguments& arguments, Console& console) {
  const Topology& topology = mapped.source.topology.value();
  const std::string name = display_name(arguments.input);
  Adaptation adapted = adapt_map(
      mapped.source.file.mesh, topology, mapped.map, samples,
      {.threads = arguments.threads,
       .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }});
  require_certified(certify(topology, adapted.map, arguments.threads), name + ", adapted");
  if (adapted.steps == 0) {
    console.warning(name +
                    ": triangles of the map are too thin to be moved: --adaptive does nothing");
  }
  mapped.map = std::move(adapted.map);
  return adapted;
}

}  // namespace sphparam::tools
