#include "sphparam/report/named_map.h"

#include <utility>

#include "sphparam/io/paths.h"
#include "sphparam/io/written_map.h"

namespace sphparam {

NamedMap load_named_map(const std::string& name, const std::string& path, const MeshSource& mesh,
                        const ReadOptions& options, const std::string& kind) {
  WrittenMap written = read_map_of(mesh, path, options, kind);
  return {.name = name,
          .map = std::move(written.map),
          .source = display_name(path),
          .provenance = std::move(written.provenance)};
}

}  // namespace sphparam
