// Repairs, and the parts of a mesh.

#include <pybind11/stl.h>

#include "binding.h"
#include "call.h"
#include "sphparam/io/components.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/names.h"

namespace sphparam::python {
namespace {

RepairOptions repair_options(const py::dict& values) {
  RepairOptions options;
  Settings settings(values);
  settings.take("non_finite", options.non_finite)
      .take("duplicates", options.duplicates)
      .take("cracks", options.cracks)
      .take("orientation", options.orientation)
      .take("non_manifold", options.non_manifold)
      .take("components", options.components)
      .take("holes", options.holes)
      .take("handles", options.handles)
      .take("flat_faces", options.flat_faces)
      .take("unused", options.unused);
  settings.take("component", options.component)
      .take("least_kept", options.least_kept)
      .take("largest_hole", options.largest_hole)
      .take("keep_holes", options.keep_holes)
      .take("weld_share", options.weld_share)
      .take("weld_length", options.weld_length)
      .take("edge_share", options.edge_share)
      .take("edge_length", options.edge_length)
      .take("longest_handle", options.longest_handle)
      .take("longest_handle_length", options.longest_handle_length)
      .take("handle_choice", options.handle_choice,
            by_name({HandleChoice::Shortest, HandleChoice::Cut, HandleChoice::Fill,
                     HandleChoice::Area}));
  settings.require_all_known();
  return options;
}

/// Another mesh, mended; this one stays. `whole`: or a refusal, where it is no sphere even then.
std::unique_ptr<Source> repair(const Source& source, const py::dict& values, bool whole,
                               const py::object& progress) {
  const RepairOptions options = repair_options(values);
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  return call(progress, [mesh, options, whole](const Progress&) {
    if (mesh->inspection.faces == 0) mesh->inspection = inspect_mesh(mesh->file.mesh);
    return std::make_unique<Source>(
        Source{whole ? repaired(std::move(*mesh), options) : mended(std::move(*mesh), options)});
  });
}

/// The connected parts, the largest first, and their shares of the area; mended before, as far as
/// that comes before parts, where options are given.
py::list components(const Source& source, const py::object& values, const py::object& progress) {
  std::optional<RepairOptions> options;
  if (!values.is_none()) options = before_components(repair_options(py::cast<py::dict>(values)));
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  auto parts = call(progress, [mesh, options](const Progress&) {
    if (options) {
      mesh->inspection = inspect_mesh(mesh->file.mesh);
      *mesh = mended(std::move(*mesh), *options);
      if (!is_sound(mesh->inspection)) throw MeshRefusal(*mesh, std::nullopt);
    }
    return connected_parts(std::move(*mesh));
  });
  py::list list;
  for (MeshPart& part : parts)
    list.append(
        py::make_tuple(std::make_unique<Source>(Source{std::move(part.source)}), part.area_share));
  return list;
}

}  // namespace

void declare_repairs(py::module_& module) {
  module.def("repair", repair);
  module.def("components", components);
}

}  // namespace sphparam::python
