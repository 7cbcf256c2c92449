#include <algorithm>
#include <stdexcept>

#include "bake/make_scene.h"
#include "io/attributes/appearance.h"
#include "option_domain.h"
#include "showcase/report_page.h"
#include "sphere/required_rays.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/report/report_page.h"

namespace sphparam {

ReportOptions report_options(const MeshFile& file, const PageOptions& options) {
  ReportOptions report;
  if (options.viewer) report.viewer = installed_viewer();
  report.viewer_is_missing = options.viewer && !report.viewer;
  const int size = report.look.size;
  report.up = upright_axes(file, options.up);
  report.look = seen_upright(report.up);
  report.look.size = std::min(size, options.size);
  report.image_width = options.size;
  if (options.textures)
    report.textures = *options.textures;
  else if (has_texcoords(file))
    report.textures.of_materials = read_textures(file, options.threads);
  report.facts = options.facts;
  report.threads = options.threads;
  report.progress = options.progress;
  return report;
}

std::string make_report(const std::string& name, const MeshFile& file,
                        const std::vector<NamedMap>& maps, const PageOptions& options) {
  if (maps.empty()) throw std::invalid_argument("a report needs a map");
  require_between("size", options.size, 64, 8192);
  for (const NamedMap& map : maps) require_rays("make_report", map.map, file.mesh.vertex_count());
  std::vector<PageEntry> entries;
  for (const NamedMap& map : maps) entries.push_back(make_page_entry(map, file, options.threads));
  return report_page(name, file, entries, report_options(file, options));
}

std::string make_report(const MappedMesh& mapped, const PageOptions& options) {
  const std::string name = stem_of(mapped.name());
  return make_report(name, mapped.file(),
                     {{.name = name,
                       .map = mapped.map(),
                       .source = mapped.name(),
                       .provenance = mapped.provenance()}},
                     options);
}

void write_report(const std::string& path, const MappedMesh& mapped, const PageOptions& options) {
  write_file(path, make_report(mapped, options));
}

}  // namespace sphparam
