#include "showcase/page_entry.h"

#include <algorithm>
#include <utility>

#include "bake/make_scene.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/paths.h"
#include "sphparam/names.h"
#include "sphparam/records/verification_record.h"
#include "sphparam/sphere/sphere_share.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

/// "statue" of "folder/statue.sph.ply".
std::string name_of_map(const std::string& path) {
  return is_stream(path) ? display_name(path) : stem_of(path);
}

/// Told apart where files have the same.
std::string new_name(const std::string& path, const std::vector<PageEntry>& entries) {
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::any_of(entries,
                               [&](const PageEntry& other) { return other.entry.name == name; });
  };
  std::string name = name_of_map(path);
  for (int i = 2; is_taken(name); ++i) name = name_of_map(path) + " (" + std::to_string(i) + ")";
  return name;
}

PageEntry mapped_now(const std::string& name, const MeshFile& file, ParameterizeOptions options) {
  options.fillers = fillers_of(file);
  Entry entry = entry_of_method(options.method, file.mesh, options);
  Provenance lines = {{"version", version},
                      {"method", entry.name},
                      {"options", options_line(options)},
                      {"verdict", verdict(entry.certificate)}};
  entry.name = name;
  return make_page_entry(std::move(entry), std::move(lines), file, options.threads);
}

}  // namespace

PageEntry make_page_entry(Entry entry, Provenance provenance, const MeshFile& file, int threads) {
  measure_surface(entry, file, threads);
  PageEntry page_entry{std::move(entry), std::move(provenance), std::nullopt};
  if (!page_entry.entry.certificate.bijective()) return page_entry;
  // What comes from elsewhere may have rays of other lengths; made unit they are other rays.
  const Topology topology(file.mesh, threads);
  if (!certify(topology, page_entry.entry.map, threads).bijective()) return page_entry;
  const FillerMarks fillers = fillers_of(file);
  if (!fillers.empty()) {
    const SphereMap rays = normalised(page_entry.entry.map.points);
    page_entry.filler_share = sphere_share(file.mesh.triangles, rays, fillers);
  }
  page_entry.target = make_target(file, topology, page_entry.entry.map, true, threads);
  return page_entry;
}

PageEntry make_page_entry(const NamedMap& map, const MeshFile& file, int threads) {
  PageEntry entry = make_page_entry(entry_of_map(map.name, map.source, file.mesh, map.map, threads),
                                    map.provenance, file, threads);
  entry.warning = roundness_warning(map.map);
  return entry;
}

std::vector<PageEntry> load_page_entries(const MeshSource& mesh, const EntryFiles& files,
                                         const ParameterizeOptions& options,
                                         const std::function<void(const PageEntry&)>& mapped) {
  const MeshFile& file = mesh.file;
  const std::string first = name_of_map(mesh.path);
  std::vector<PageEntry> entries;
  const auto load = [&](const std::string& name, const std::string& path) {
    entries.push_back(
        make_page_entry(load_named_map(name, path, mesh, files.read), file, options.threads));
  };
  if (!files.sphere.empty()) {
    load(first, files.sphere);
  } else if (std::optional<SphereMap> map = read_sphere(file)) {
    const NamedMap own = {first, std::move(*map), display_name(mesh.path), read_provenance(file)};
    entries.push_back(make_page_entry(own, file, options.threads));
  } else {
    entries.push_back(mapped_now(first, file, options));
    if (mapped) mapped(entries.back());
  }
  for (const std::string& path : files.others) load(new_name(path, entries), path);
  return entries;
}

}  // namespace sphparam
