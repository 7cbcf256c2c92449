#include "commands/remesh_adaptive.h"

#include <utility>

#include "sphparam/io/certified_files.h"
#include "console/paths.h"

namespace sphparam::cli {

Adaptation adapt_source(MappedMesh& mapped, std::int64_t samples,
                        const RemeshArguments& arguments, Console& console) {
  const Topology& topology = mapped.topology();
  const std::string name = display_name(arguments.input);
  Adaptation adapted = adapt_map(
      mapped.file().mesh, topology, mapped.map(), samples,
      {.threads = arguments.threads,
       .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }});
  if (adapted.steps == 0) {
    console.warning(name +
                    ": triangles of the map are too thin to be moved: --adaptive does nothing");
  }
  mapped = mapped.with_map(adapted.map, mapped.provenance());
  return adapted;
}

}  // namespace sphparam::cli
