#include "showcase/exhibit.h"

#include <utility>

#include "bake/make_scene.h"

namespace sphparam::tools {

Exhibit make_exhibit(Contender contender, Provenance provenance, const MeshFile& file,
                     int threads) {
  Exhibit exhibit{std::move(contender), std::move(provenance), std::nullopt};
  if (!exhibit.contender.certificate.bijective()) return exhibit;
  // What comes from elsewhere may have rays of other lengths; made unit they are other rays.
  const Topology topology(file.mesh);
  if (!certify(topology, exhibit.contender.map, threads).bijective()) return exhibit;
  exhibit.target = make_target(file, topology, exhibit.contender.map, true, threads);
  return exhibit;
}

}  // namespace sphparam::tools
