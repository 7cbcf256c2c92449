// Meshes as arrays and files, what is wrong with them, and repair.

#include <pybind11/stl.h>

#include <algorithm>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "records/body_record.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/coarse_coordinates.h"
#include "sphparam/io/creases.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/self_crossings.h"

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

std::unique_ptr<Source> read(const FilePath& path, bool repeated_corners, bool non_finite,
                             const py::dict& limits) {
  ReadOptions options;
  take_limits(limits, options);
  options.repeated_corners = repeated_corners;
  options.non_finite = non_finite;
  return call(py::none(), [path, options](const Progress&) {
    return std::make_unique<Source>(Source{read_source(path, options)});
  });
}

ScalarType type_named(const std::string& name) {
  if (name == ply_name(ScalarType::Int64)) return ScalarType::Int64;  // no file of PLY has it
  ScalarType type;
  if (!parse_ply_name(name, type)) throw py::value_error("no type is called " + name);
  return type;
}

using Values = py::array_t<double, py::array::c_style>;

Property property_of(const std::string& name, const std::string& type, const Values& values) {
  return {name, type_named(type), {values.data(), values.data() + values.size()}};
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

py::tuple triple(const Vector3& v) { return py::make_tuple(v.x(), v.y(), v.z()); }

py::tuple rows_of(const Eigen::Matrix3d& table) {
  return py::make_tuple(triple(table.row(0)), triple(table.row(1)), triple(table.row(2)));
}

/// Centroid, inertia, principal moments and axes, extents.
py::object as_tuple(const std::optional<MassProperties>& body) {
  if (!body) return py::none();
  return py::make_tuple(triple(body->centroid), rows_of(body->inertia), triple(body->moments),
                        rows_of(body->axes), triple(body->extents));
}

py::dict inspect(const Source& source) {
  const auto mesh = std::make_shared<const TriangleMesh>(source.mesh.file.mesh);
  const auto [found, body] = call(py::none(), [mesh](const Progress&) {
    MeshInspection inspection = inspect_mesh(*mesh);
    const auto enclosed = enclosed_body(*mesh, inspection);
    return std::pair(std::move(inspection), enclosed);
  });
  py::dict dict = as_dict(found);
  dict["body"] = as_tuple(body);
  return dict;
}

/// Pairs, a mark a face, the first two faces and where they cross.
py::tuple self_crossings(const Source& source, int threads, const py::object& progress) {
  const auto mesh = std::make_shared<const TriangleMesh>(source.mesh.file.mesh);
  SelfCrossings found = call(progress, [mesh, threads](const Progress& report) {
    return find_self_crossings(*mesh, {.threads = threads, .progress = report});
  });
  found.marks.resize(static_cast<std::size_t>(mesh->face_count()));  // none: no face does
  return py::make_tuple(found.pairs, owning(std::move(found.marks)),
                        py::make_tuple(found.first[0], found.first[1]),
                        py::make_tuple(found.place.x(), found.place.y(), found.place.z()));
}

/// Returns what the format had no place for.
py::list write(const Source& source, const FilePath& path) {
  const auto mesh = std::make_shared<const MeshSource>(source.mesh);
  return as_texts(writing_call(py::none(), [mesh, path](const Progress&) {
    std::vector<std::string> losses;
    const MeshFile file = written_as_mended(*mesh, losses);
    PendingFiles files;
    const std::vector<std::string> more = add_mesh(files, path, file);
    files.publish();
    losses.insert(losses.end(), more.begin(), more.end());
    return losses;
  }));
}

py::array fillers(const Source& source) {
  FillerMarks marks = fillers_of(source.mesh.file);
  marks.resize(static_cast<std::size_t>(source.mesh.file.mesh.face_count()));  // none: all surface
  return owning(std::move(marks));
}

std::unique_ptr<Source> surface(const Source& source) {
  auto made = std::make_unique<Source>();
  made->mesh.file = without_fillers(source.mesh.file);
  made->mesh.path = source.mesh.path;
  made->mesh.repairs = source.mesh.repairs;
  made->mesh.handles = source.mesh.handles;
  made->mesh.added_share = source.mesh.added_share;
  return made;
}

/// Another mesh with hard edges; nothing where this one has normals, which say what is hard.
std::unique_ptr<Source> creased(const Source& source, double degrees) {
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  return call(py::none(), [mesh, degrees](const Progress&) {
    const bool made = add_creases(mesh->file, degrees).has_value();
    return made ? std::make_unique<Source>(Source{std::move(*mesh)}) : nullptr;
  });
}

template <class Table>
py::object optional_rows(const std::optional<Table>& table, py::handle owner) {
  return table ? py::object(shown_rows(*table, owner)) : py::none();
}

const MeshFile& file_of(const py::object& source) { return source.cast<const Source&>().mesh.file; }

void declare_source(py::module_& module) {
  py::class_<Source>(module, "Source", "A mesh on its way to a map.")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) { return shown_rows(file_of(self).mesh.positions, self); })
      .def_property_readonly(
          "faces",
          [](const py::object& self) { return shown_rows(file_of(self).mesh.triangles, self); })
      .def_property_readonly("corner_texcoords",
                             [](const py::object& self) {
                               return optional_rows(file_of(self).corner_texcoords, self);
                             })
      .def_property_readonly(
          "corner_normals",
          [](const py::object& self) { return optional_rows(file_of(self).corner_normals, self); })
      .def_property(
          "path", [](const Source& self) { return FilePath(self.mesh.path); },
          [](Source& self, const FilePath& path) { self.mesh.path = path; })
      .def_property_readonly("format", [](const Source& self) { return self.mesh.file.format; })
      .def_property_readonly("notes", [](const Source& self) { return as_texts(self.mesh.notes); })
      .def_property_readonly("losses",
                             [](const Source& self) {
                               std::vector<std::string> told = losses_among(self.mesh.notes);
                               for (std::string& coarse : coarse_coordinates_among(self.mesh.notes))
                                 told.push_back(std::move(coarse));
                               return as_texts(told);
                             })
      .def_property_readonly("materials",
                             [](const Source& self) { return as_texts(self.mesh.file.materials); })
      .def_property_readonly("comments",
                             [](const Source& self) { return as_texts(self.mesh.file.comments); })
      .def_property_readonly("is_sound",
                             [](const Source& self) { return is_sound(self.mesh.inspection); })
      .def_property_readonly("fillers", fillers)
      .def_property_readonly("has_map", [](const Source& self) { return has_map(self.mesh.file); })
      .def_property_readonly("repairs",
                             [](const Source& self) { return as_list(self.mesh.repairs); })
      .def_property_readonly("handles",
                             [](const Source& self) { return as_list(self.mesh.handles); })
      .def_property_readonly("added_share",
                             [](const Source& self) { return self.mesh.added_share; })
      .def_property_readonly("kept_share",
                             [](const Source& self) { return self.mesh.parts.area_share; })
      .def("vertex_values",
           [](const Source& self) { return columns_of(self.mesh.file.vertex_properties); })
      .def("face_values",
           [](const Source& self) { return columns_of(self.mesh.file.face_properties); })
      .def(
          "set_vertex_values",
          [](Source& self, const std::string& name, const std::string& type, const Values& values) {
            self.mesh.file.set_vertex_property(property_of(name, type, values));
          })
      .def("drop_vertex_values",
           [](Source& self, const std::string& name) {
             std::erase_if(self.mesh.file.vertex_properties,
                           [&](const Property& property) { return property.name == name; });
           })
      .def("drop_face_values",
           [](Source& self, const std::string& name) {
             std::erase_if(self.mesh.file.face_properties,
                           [&](const Property& property) { return property.name == name; });
           })
      .def("set_face_values", [](Source& self, const std::string& name, const std::string& type,
                                 const Values& values) {
        self.mesh.file.set_face_property(property_of(name, type, values));
      });
}

}  // namespace

bool is_sound(const MeshInspection& found) {
  return std::ranges::none_of(found.defects, [](const MeshDefect& defect) {
    return defect.kind == DefectKind::NonFinitePosition ||
           defect.kind == DefectKind::IndexOutOfRange;
  });
}

void take_limits(const py::dict& limits, ReadOptions& options) {
  Settings settings(limits);
  settings.take("file", options.max_file_bytes)
      .take("vertices", options.max_vertices)
      .take("faces", options.max_faces)
      .take("degree", options.max_polygon_degree)
      .take("line", options.max_line_bytes)
      .take("ply_elements", options.max_ply_elements)
      .take("ply_properties", options.max_ply_properties)
      .take("json", options.max_json_bytes)
      .take("json_depth", options.max_json_depth)
      .take("json_values", options.max_json_values)
      .take("json_objects", options.max_json_objects);
  settings.require_all_known();
}

void declare_meshes(py::module_& module) {
  declare_source(module);
  module.def("source_of", source_of);
  module.def("copied", [](const Source& source) { return std::make_unique<Source>(source); });
  module.def("read", read);
  module.def("write", write);
  module.def("surface", surface);
  module.def("creased", creased);
  module.def("inspect", inspect);
  module.def("self_crossings", self_crossings);
  module.def("readable_formats", [] { return readable_formats(); });
  module.def("written_extensions", [] { return written_extensions(); });
}

}  // namespace sphparam::python
