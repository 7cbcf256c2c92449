// A mesh with its proved map, and what is known of it.

#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <iterator>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/io/creases.h"
#include "sphparam/io/fillers.h"
#include "sphparam/stopped_by.h"
#include "sphparam/words.h"

namespace sphparam::python {

Mapped::Mapped(MappedMesh mesh) : state_(std::make_shared<State>()) {
  state_->mesh = std::move(mesh);
}

Mapped::Mapped(MeshSource source, Topology topology, Provenance provenance, Parameterization made,
               Making making, int threads)
    : state_(std::make_shared<State>()) {
  state_->parts = {.file = std::move(source.file),
                   .map = {},
                   .provenance = std::move(provenance),
                   .topology = std::move(topology),
                   .notes = std::move(source.notes),
                   .mapped_here = true,
                   .name = std::move(source.path)};
  state_->made = std::move(made);
  state_->making = making;
  state_->threads = threads;
  state_->repairs = std::move(source.repairs);
  state_->handles = std::move(source.handles);
  state_->added_share = source.added_share;
}

void Mapped::make_mesh() const {
  const std::atomic<bool> never = false;
  const StoppedBy stop(never);
  try {
    state_->parts->map = state_->made->map;  // arrays show the one that is there
    state_->mesh.emplace(std::move(*state_->parts), state_->threads);
  } catch (...) {
    state_->failure = std::current_exception();
  }
  state_->parts.reset();
  state_->was_made = true;
}

const MappedMesh& Mapped::mesh() const {
  if (!state_->made) return *state_->mesh;
  const auto make_once = [mapped = *this](const Progress&) {
    std::call_once(mapped.state_->is_made, [&] { mapped.make_mesh(); });
    return true;
  };
  const bool is_of_python = PyGILState_GetThisThreadState();  // and no thread of the library
  if (!state_->was_made) {
    is_of_python ? call(py::none(), make_once) : make_once({});
  }
  if (state_->failure) std::rethrow_exception(state_->failure);
  return *state_->mesh;
}

const SphereMap& Mapped::map() const { return made() ? made()->map : state_->mesh->map(); }

const Certificate& Mapped::certificate() const {
  return made() ? made()->certificate : state_->mesh->certificate();
}

namespace {

/// What there is to say of how the map came out, also that it is not quite what it is called.
std::vector<std::string> told_of(const Parameterization& made, const Making& making) {
  std::vector<std::string> lines = making.doubts;
  std::ranges::copy(made.warnings, std::back_inserter(lines));
  if (made.radial && (made.radial->folds > 0 || made.radial->moved > 0))
    lines.push_back(radial_line(*made.radial));
  return lines;
}

/// How the map came about; nothing where it was read.
py::object account(const Mapped& mapped) {
  if (!mapped.made()) return py::none();
  const Parameterization& made = *mapped.made();
  py::dict dict;
  dict["made_by"] = made.made_by;
  dict["seconds"] = mapped.making().wall;
  dict["processor_seconds"] = mapped.making().processors;
  dict["inside_out"] = mapped.making().inside_out;
  dict["poles"] = py::none();
  if (made.poles) dict["poles"] = py::make_tuple(made.poles->north, made.poles->south);
  dict["meridian"] = py::none();
  if (made.meridian) dict["meridian"] = *made.meridian;
  dict["pole_cost"] = made.pole_cost;
  dict["energy_gap"] = made.energy_gap;
  dict["pin_residuals"] = made.pin_residuals;
  dict["warnings"] = as_texts(told_of(made, mapped.making()));
  dict["filler_share"] = made.filler_share;
  dict["alignment"] = made.alignment;
  dict["radial"] = py::none();
  if (const auto& radial = made.radial)
    dict["radial"] =
        py::make_tuple(py::make_tuple(radial->centre.x(), radial->centre.y(), radial->centre.z()),
                       radial->folds, radial->folded_area, radial->moved, radial->largest_movement);
  py::list stages;
  for (const StageRecord& stage : made.stages)
    stages.append(
        py::make_tuple(stage.name, stage.seconds, stage.folds,
                       stage.distortion ? py::object(as_dict(*stage.distortion)) : py::none()));
  dict["stages"] = stages;
  return dict;
}

/// What a header says, key by key.
py::list lines_of(const Provenance& provenance) {
  py::list list;
  for (const auto& [key, value] : provenance)
    list.append(py::make_tuple(as_text(key), as_text(value)));
  return list;
}

/// The faces as they were written: quads of a grid too.
py::object polygons(const Mapped& mapped) {
  const std::optional<Polygons>& faces = mapped.mesh().polygons();
  if (!faces) return py::none();
  return py::make_tuple(owning(std::vector<int>(faces->corners)),
                        owning(std::vector<int>(faces->starts)));
}

/// The mesh alone; `whole`: with what closes its holes.
std::unique_ptr<Source> source_of_mapped(const Mapped& mapped, bool whole) {
  auto source = std::make_unique<Source>();
  const MeshFile& file = mapped.mesh().file();
  source->mesh.file = whole ? file : without_fillers(file);
  source->mesh.path = mapped.mesh().name();
  source->mesh.repairs = mapped.repairs();
  source->mesh.handles = mapped.handles();
  source->mesh.added_share = mapped.added_share();
  return source;
}

/// Its mesh with hard edges, and the same map, proved as one that is read is; nothing where the
/// mesh has normals.
std::optional<Mapped> creased_map(const Mapped& mapped, double degrees, int threads) {
  using Found = std::optional<Mapped>;
  return call(py::none(), [=, mesh = mapped.mesh()](const Progress&) -> Found {
    MeshFile file = mesh.file();
    if (!add_creases(file, degrees)) return std::nullopt;
    return Mapped(MappedMesh({.file = std::move(file),
                              .map = mesh.map(),
                              .provenance = mesh.provenance(),
                              .topology = mesh.topology(),
                              .polygons = mesh.polygons(),
                              .notes = mesh.notes(),
                              .mapped_here = mesh.mapped_here(),
                              .name = mesh.name()},
                             threads));
  });
}

/// One a face.
py::array fillers(const Mapped& mapped) {
  FillerMarks marks = mapped.mesh().fillers();
  marks.resize(static_cast<std::size_t>(mapped.mesh().mesh().face_count()));  // none: all surface
  return owning(std::move(marks));
}

}  // namespace

void declare_mapped(py::module_& module) {
  py::class_<Mapped>(module, "Mapped", "A mesh with its proved map.")
      .def_property_readonly("vertices",
                             [](const py::object& self) {
                               return shown_rows(self.cast<const Mapped&>().mesh().mesh().positions,
                                                 self);
                             })
      .def_property_readonly("faces",
                             [](const py::object& self) {
                               return shown_rows(self.cast<const Mapped&>().mesh().mesh().triangles,
                                                 self);
                             })
      .def_property_readonly("points",
                             [](const py::object& self) {
                               return shown_rows(self.cast<const Mapped&>().map().points, self);
                             })
      .def_property_readonly("name", [](const Mapped& self) { return as_text(self.mesh().name()); })
      .def_property_readonly("notes",
                             [](const Mapped& self) { return as_texts(self.mesh().notes()); })
      .def_property_readonly("provenance",
                             [](const Mapped& self) { return lines_of(self.mesh().provenance()); })
      .def_property_readonly("mapped_here",
                             [](const Mapped& self) { return self.mesh().mapped_here(); })
      .def_property_readonly("certificate",
                             [](const Mapped& self) { return as_dict(self.certificate()); })
      .def_property_readonly("account", account)
      .def_property_readonly("polygons", polygons)
      .def_property_readonly("fillers", fillers)
      .def_property_readonly("repairs", [](const Mapped& self) { return as_list(self.repairs()); })
      .def_property_readonly("handles", [](const Mapped& self) { return as_list(self.handles()); })
      .def("vertex_values",
           [](const Mapped& self) { return columns_of(self.mesh().file().vertex_properties); })
      .def("face_values",
           [](const Mapped& self) { return columns_of(self.mesh().file().face_properties); });
  module.def("source_of_mapped", source_of_mapped);
  module.def("creased_map", creased_map);
}

}  // namespace sphparam::python
