// Meshes as arrays and files, what is wrong with them, and repair.

#include <pybind11/stl.h>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/names.h"

namespace sphparam::python {
namespace {

/// The mesh of two arrays, and whether its numbers are finite and its indices there.
py::tuple source_of(const py::array& vertices, const py::array& faces) {
  auto source = std::make_unique<Source>();
  TriangleMesh& mesh = source->mesh.file.mesh;
  bool finite = true, inside = true;
  mesh.positions = points_of(vertices, finite);
  mesh.triangles = triangles_of(faces, static_cast<int>(vertices.shape(0)), inside);
  source->mesh.path = "mesh";
  source->mesh.file.format = "arrays";
  return py::make_tuple(std::move(source), finite, inside);
}

std::unique_ptr<Source> read(const std::string& path, bool repeated_corners) {
  ReadOptions options;
  options.repeated_corners = repeated_corners;
  return call(py::none(), [path, options](const Progress&) {
    return std::make_unique<Source>(Source{read_source(path, options)});
  });
}

ScalarType type_named(const std::string& name) {
  ScalarType type;
  if (!parse_ply_name(name, type)) throw py::value_error("no type is called " + name);
  return type;
}

using Values = py::array_t<double, py::array::c_style>;

Property property_of(const std::string& name, const std::string& type, const Values& values) {
  return {name, type_named(type), {values.data(), values.data() + values.size()}};
}

py::list listed(const std::vector<Property>& properties) {
  py::list list;
  for (const Property& property : properties)
    list.append(py::make_tuple(property.name, values_of(property)));
  return list;
}

py::dict as_dict(const MeshInspection& found) {
  py::dict dict;
  dict["vertices"] = found.vertices;
  dict["used_vertices"] = found.used_vertices;
  dict["edges"] = found.edges;
  dict["faces"] = found.faces;
  dict["components"] = found.components;
  dict["boundary_loops"] = found.boundary_loops;
  dict["euler_characteristic"] = found.euler_characteristic;
  dict["genus"] = found.genus;
  dict["area"] = found.area;
  dict["volume"] = found.volume;
  dict["lower"] = py::make_tuple(found.lower.x(), found.lower.y(), found.lower.z());
  dict["upper"] = py::make_tuple(found.upper.x(), found.upper.y(), found.upper.z());
  dict["is_sphere"] = found.is_sphere();
  dict["defects"] = as_list(found.defects);
  return dict;
}

py::dict inspect(const Source& source) {
  const auto mesh = std::make_shared<const TriangleMesh>(source.mesh.file.mesh);
  return as_dict(call(py::none(), [mesh](const Progress&) { return inspect_mesh(*mesh); }));
}

HandleChoice choice_named(const std::string& word) {
  return named(
      word,
      {HandleChoice::Shortest, HandleChoice::Cut, HandleChoice::Fill, HandleChoice::Area},
      [](HandleChoice choice) { return name_of(choice); }, "handle_choice");
}

RepairOptions repair_options(const py::dict& values) {
  RepairOptions options;
  Settings settings(values);
  settings.take("duplicates", options.duplicates)
      .take("orientation", options.orientation)
      .take("non_manifold", options.non_manifold)
      .take("components", options.components)
      .take("holes", options.holes)
      .take("keep_holes", options.keep_holes)
      .take("handles", options.handles)
      .take("flat_faces", options.flat_faces)
      .take("unused", options.unused)
      .take("component", options.component)
      .take("least_kept", options.least_kept)
      .take("largest_hole", options.largest_hole)
      .take("longest_handle", options.longest_handle)
      .take("longest_handle_length", options.longest_handle_length);
  std::string choice = name_of(options.handle_choice);
  settings.take("handle_choice", choice);
  options.handle_choice = choice_named(choice);
  settings.require_all_known();
  return options;
}

/// Another mesh, mended; this one stays.
std::unique_ptr<Source> repair(const Source& source, const py::dict& values,
                               const py::object& progress) {
  const RepairOptions options = repair_options(values);
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  return call(progress, [mesh, options](const Progress&) {
    if (mesh->inspection.faces == 0) mesh->inspection = inspect_mesh(mesh->file.mesh);
    return std::make_unique<Source>(Source{repaired(std::move(*mesh), options)});
  });
}

void write(const Source& source, const std::string& path) {
  const auto file = std::make_shared<const MeshFile>(source.mesh.file);
  writing_call(py::none(), [file, path](const Progress&) {
    write_mesh(path, *file);
    return true;
  });
}

template <class Table>
py::object optional_rows(const std::optional<Table>& table, py::handle owner) {
  return table ? py::object(shown_rows(*table, owner)) : py::none();
}

}  // namespace

py::list as_list(const std::vector<RepairAction>& actions) {
  py::list list;
  for (const RepairAction& action : actions) {
    list.append(py::make_tuple(name_of(action.kind), action.count,
                               py::tuple(py::cast(action.elements)), action.message));
  }
  return list;
}

py::list as_list(const std::vector<HandleLoop>& loops) {
  py::list list;
  for (const HandleLoop& loop : loops) {
    Points points(static_cast<Eigen::Index>(loop.points.size()), 3);
    for (std::size_t i = 0; i < loop.points.size(); ++i)
      points.row(static_cast<Eigen::Index>(i)) = loop.points[i];
    list.append(py::make_tuple(loop.filled, loop.length, loop.share, loop.area_added,
                               owning_rows(std::move(points))));
  }
  return list;
}

void declare_meshes(py::module_& module) {
  py::class_<Source>(module, "Source", "A mesh on its way to a map.")
      .def_property_readonly("vertices",
                             [](const py::object& self) {
                               return shown_rows(
                                   self.cast<const Source&>().mesh.file.mesh.positions, self);
                             })
      .def_property_readonly("faces",
                             [](const py::object& self) {
                               return shown_rows(
                                   self.cast<const Source&>().mesh.file.mesh.triangles, self);
                             })
      .def_property_readonly("corner_texcoords",
                             [](const py::object& self) {
                               return optional_rows(
                                   self.cast<const Source&>().mesh.file.corner_texcoords, self);
                             })
      .def_property(
          "path", [](const Source& self) { return self.mesh.path; },
          [](Source& self, const std::string& path) { self.mesh.path = path; })
      .def_property_readonly("format", [](const Source& self) { return self.mesh.file.format; })
      .def_property_readonly("notes", [](const Source& self) { return self.mesh.notes; })
      .def_property_readonly("losses",
                             [](const Source& self) { return losses_among(self.mesh.notes); })
      .def_property_readonly("materials",
                             [](const Source& self) { return self.mesh.file.materials; })
      .def_property_readonly("comments", [](const Source& self) { return self.mesh.file.comments; })
      .def_property_readonly("has_map", [](const Source& self) { return has_map(self.mesh.file); })
      .def_property_readonly("repairs",
                             [](const Source& self) { return as_list(self.mesh.repairs); })
      .def_property_readonly("handles",
                             [](const Source& self) { return as_list(self.mesh.handles); })
      .def("vertex_values",
           [](const Source& self) { return listed(self.mesh.file.vertex_properties); })
      .def("face_values", [](const Source& self) { return listed(self.mesh.file.face_properties); })
      .def(
          "set_vertex_values",
          [](Source& self, const std::string& name, const std::string& type, const Values& values) {
            self.mesh.file.set_vertex_property(property_of(name, type, values));
          })
      .def("set_face_values", [](Source& self, const std::string& name, const std::string& type,
                                 const Values& values) {
        self.mesh.file.set_face_property(property_of(name, type, values));
      });
  module.def("source_of", source_of);
  module.def("copied", [](const Source& source) { return std::make_unique<Source>(source); });
  module.def("read", read);
  module.def("write", write);
  module.def("inspect", inspect);
  module.def("repair", repair);
  module.def("readable_formats", [] { return readable_formats(); });
  module.def("is_written", &is_written);
}

}  // namespace sphparam::python
