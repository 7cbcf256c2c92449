#include "commands/mapped_source.h"

#include <utility>

#include "commands/source.h"
#include "reports/told_losses.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

MappedMesh read_mapped_source(const std::string& path, const std::string& sphere, int threads,
                              Console& console, double lambda) {
  LoadOptions options{.sphere = sphere, .read = input_limits()};
  options.map.energy.lambda = lambda;
  options.map.threads = threads;
  options.map.progress = [&](std::string_view stage, double f) {
    return console.progress(stage, f);
  };
  MeshSource source = read_source(path);
  tell_losses(source, path, console);
  const MappedMesh mapped = mapped_mesh(std::move(source), options);
  if (mapped.mapped_here()) {
    console.clear_progress();
    console.say(mapped.name() + ": carries no map; mapped now (progressive)");
  }
  return mapped;
}

}  // namespace sphparam::cli
