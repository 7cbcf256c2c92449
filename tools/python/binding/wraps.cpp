// Closed surfaces about any triangles.

#include "binding.h"
#include "call.h"
#include "sphparam/io/fillers.h"
#include "sphparam/records/wrap_record.h"
#include "sphparam/wrap/wrap.h"
#include "texts.h"

namespace sphparam::python {
namespace {

WrapOptions options_of(const py::dict& values) {
  WrapOptions options;
  Settings settings(values);
  settings.take("voxel", options.voxel)
      .take("resolution", options.resolution)
      .take("distance", options.distance)
      .take("gap", options.gap)
      .take("largest", options.largest)
      .take("triangles", options.faces)
      .take("threads", options.threads);
  settings.require_all_known();
  return options;
}

py::dict figures_of(const Wrap& wrap) {
  py::dict dict;
  dict["voxel"] = wrap.voxel;
  dict["distance"] = wrap.distance;
  dict["lattice"] = py::make_tuple(wrap.lattice[0], wrap.lattice[1], wrap.lattice[2]);
  dict["parts"] = wrap.parts;
  dict["gap"] = wrap.gap;
  dict["insides"] = wrap.insides;
  dict["cavities"] = wrap.cavities;
  dict["handles"] = wrap.handles;
  dict["added_share"] = wrap.added_share;
  dict["kept_share"] = wrap.kept_share;
  dict["skin"] = wrap.skin;
  dict["volume"] = wrap.volume;
  dict["area"] = wrap.area;
  dict["outside"] = wrap.outside;
  dict["apart"] = as_dict(wrap.apart);
  return dict;
}

/// What closes holes is no surface: it is left out, as it is of all measures.
py::tuple wrap(const Source& soup, const py::dict& values, const py::object& progress) {
  const WrapOptions wanted = options_of(values);
  const MeshFile& file = soup.mesh.file;
  const auto triangles =
      std::make_shared<const TriangleMesh>(surface_of(file.mesh, fillers_of(file)));
  auto [made, crossings] = call(progress, [wanted, triangles](const Progress& report) {
    WrapOptions options = wanted;
    options.progress = report;
    Wrap found = wrap_soup(*triangles, options);
    std::optional<SelfCrossings> crossing = crossings_of(found, options.threads);
    return std::pair(std::move(found), std::move(crossing));
  });
  const py::dict figures = figures_of(made);
  figures["crossings"] = crossings ? crossings->pairs : 0;
  const bool cross = crossings && crossings->pairs > 0;
  const std::string warning = cross ? crossings_warning(*crossings, made) : "";
  MeshSource mesh;
  mesh.path = "mesh";
  mesh.file.format = "arrays";
  mesh.file.mesh = std::move(made.mesh);
  return py::make_tuple(std::make_unique<Source>(Source{std::move(mesh)}), figures,
                        as_text(warning));
}

}  // namespace

void declare_wraps(py::module_& module) { module.def("wrap", wrap); }

}  // namespace sphparam::python
