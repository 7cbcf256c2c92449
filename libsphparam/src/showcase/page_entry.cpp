#include "showcase/page_entry.h"

#include <utility>

#include "bake/make_scene.h"

namespace sphparam {

PageEntry make_page_entry(Entry entry, Provenance provenance, const MeshFile& file, int threads) {
  PageEntry page_entry{std::move(entry), std::move(provenance), std::nullopt};
  if (!page_entry.entry.certificate.bijective()) return page_entry;
  // What comes from elsewhere may have rays of other lengths; made unit they are other rays.
  const Topology topology(file.mesh);
  if (!certify(topology, page_entry.entry.map, threads).bijective()) return page_entry;
  page_entry.target = make_target(file, topology, page_entry.entry.map, true, threads);
  return page_entry;
}

}  // namespace sphparam
