// Maps: made, loaded, proved, looked at.

#include <pybind11/stl.h>

#include <array>
#include <ctime>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/frame_check.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/names.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "sphparam/stopwatch.h"

namespace sphparam::python {
namespace {

/// Numbers of vertices are those that the caller's mesh has, before any repair.
struct Request {
  ParameterizeOptions options;
  std::vector<std::array<double, 3>> pins;  // vertex, theta, phi
};

void take_method(Settings& settings, ParameterizeOptions& options) {
  settings
      .take("method", options.method,
            {Method::Progressive, Method::Curvilinear, Method::Paper, Method::Radial},
            [](Method method) { return name_of(method); })
      .take("quality", options.quality, {Quality::Draft, Quality::Normal, Quality::Best},
            [](Quality quality) { return name_of(quality); })
      .take("balance", options.balance, {Balance::Lambda, Balance::Conformal, Balance::EqualArea},
            [](Balance balance) { return name_of(balance); })
      .take("energy", options.energy.kind,
            {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet},
            [](EnergyKind kind) { return name_of(kind); })
      .take("lambda", options.energy.lambda);
}

Request request_of(const py::dict& values) {
  Request request;
  ParameterizeOptions& options = request.options;
  Settings settings(values);
  take_method(settings, options);
  settings.take("threads", options.threads)
      .take("automatic_poles", options.automatic_poles)
      .take("repair_map", options.repair_paper)
      .take("measure_stages", options.measure_stages)
      .take("pins", request.pins);
  std::optional<std::pair<int, int>> poles;
  settings.take("poles", poles).take("meridian", options.meridian);
  if (poles) options.poles = Poles{poles->first, poles->second};
  settings.require_all_known();
  return request;
}

void settle_vertices(Request& request, const MeshFile& file) {
  ParameterizeOptions& options = request.options;
  if (!options.poles && !options.meridian && request.pins.empty()) return;
  const FileNumbers numbers(file);
  options = with_vertices_of_mesh(std::move(options), numbers);
  for (const auto& [number, theta, phi] : request.pins) {
    const Vertex vertex = numbers.vertex(static_cast<long>(number));
    if (vertex < 0) throw NoSuchVertex("pins", numbers.absence(static_cast<long>(number)));
    options.pins.push_back({vertex, {theta, phi}});
  }
}

/// The topology of what can be mapped. Throws MeshRefusal, with what repair would do.
Topology topology_of(MeshSource& source) {
  if (source.topology) {
    require_sphere(source.file.mesh, *source.topology);
    return std::move(*source.topology);
  }
  try {
    return require_sphere(source.file.mesh);
  } catch (const MeshError&) {
    source.inspection = inspect_mesh(source.file.mesh);
    throw MeshRefusal(source, try_repair(source));
  }
}

[[noreturn]] void refuse(const Source& source) {
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  call(py::none(), [mesh](const Progress&) {
    mesh->inspection = inspect_mesh(mesh->file.mesh);
    throw MeshRefusal(*mesh, try_repair(*mesh));
    return true;
  });
  throw std::logic_error("a mesh was to be refused");
}

/// Throws NotOneToOne where some pin, pole or meridian is elsewhere, or the map folds.
void require_wanted(const Parameterization& result, const ParameterizeOptions& options) {
  if (!result.certificate.bijective()) {
    throw NotOneToOne("the map is not one-to-one: " + verdict(result.certificate),
                      result.certificate);
  }
  const FrameCheck frame = check_frame(result, options);
  if (frame.holds()) return;
  std::string missed = !frame.pins    ? "a pin is"
                       : !frame.poles ? "the poles are"
                                      : "the meridian is";
  for (const std::string& warning : result.warnings)
    missed += (&warning == &result.warnings[0] ? " not where asked: " : "; ") + warning;
  throw NotOneToOne(missed, result.certificate);
}

/// Poles and meridian as the caller's mesh numbers them.
void by_file_numbers(Parameterization& result, const FileNumbers& numbers) {
  const auto number = [&](Vertex v) { return static_cast<Vertex>(numbers.number(v)); };
  if (result.poles) result.poles = Poles{number(result.poles->north), number(result.poles->south)};
  if (result.meridian) result.meridian = number(*result.meridian);
}

Mapped map_mesh(MeshSource source, Request request) {
  ParameterizeOptions& options = request.options;
  settle_vertices(request, source.file);
  const Stopwatch stopwatch;
  const std::clock_t begin = std::clock();
  Topology topology = topology_of(source);
  options.fillers = fillers_of(source.file);
  Parameterization result = parameterize(source.file.mesh, topology, options);
  const Spent spent{stopwatch.seconds(),
                    static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC};
  require_wanted(result, options);
  const FileNumbers numbers(source.file);
  Provenance provenance = provenance_of(result,
                                        {.method = name_of(options.method),
                                         .options = options_line(options),
                                         .pins = options.pins.size(),
                                         .verdict = verdict(result.certificate)},
                                        numbers);
  by_file_numbers(result, numbers);
  return {std::move(source), std::move(topology), std::move(provenance), std::move(result), spent,
          options.threads};
}

/// Of a source that nobody else has, whose memory is taken, or of a copy.
Mapped map(Source& source, bool taken, const py::dict& values, const py::object& progress) {
  const auto request = std::make_shared<Request>(request_of(values));
  const auto mesh = taken ? std::make_shared<MeshSource>(std::move(source.mesh))
                          : std::make_shared<MeshSource>(source.mesh);
  return call(progress, [mesh, request](const Progress& report) {
    request->options.progress = report;
    return map_mesh(std::move(*mesh), *request);
  });
}

/// A mesh and the map that its file or another one has; one is made where there is none.
Mapped load(const std::string& path, const std::string& sphere, const py::dict& values,
            const py::object& progress) {
  LoadOptions options{.sphere = sphere, .map = request_of(values).options};
  return call(progress, [path, options](const Progress& report) mutable {
    options.map.progress = report;
    return Mapped(load_mapped(path, options));
  });
}

/// A mesh with a map of somebody's, proved. Throws NotOneToOne.
Mapped with_points(const Source& source, const py::array& rays, int threads) {
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  bool finite = true;
  const auto points = std::make_shared<SphereMap>(SphereMap{points_of(rays, finite)});
  return call(py::none(), [=](const Progress&) {
    Topology topology = topology_of(*mesh);
    const Certificate certificate = certify(topology, *points, threads);
    if (!certificate.bijective())
      throw NotOneToOne("the map is not one-to-one: " + verdict(certificate), certificate);
    return Mapped(MappedMesh({.file = std::move(mesh->file),
                              .map = std::move(*points),
                              .topology = std::move(topology),
                              .notes = std::move(mesh->notes),
                              .name = mesh->path},
                             threads));
  });
}

void save(const Mapped& mapped, const std::string& path, int threads) {
  writing_call(py::none(), [mesh = mapped.mesh(), path, threads](const Progress&) {
    save_mapped(path, mesh, threads);
    return true;
  });
}

void save_sphere_file(const Mapped& mapped, const std::string& path, int threads) {
  writing_call(py::none(), [mesh = mapped.mesh(), path, threads](const Progress& report) {
    return save_sphere(path, mesh, {.threads = threads, .progress = report});
  });
}

py::dict certify_points(const Source& source, const py::array& rays, int threads) {
  bool finite = true;
  const auto map = std::make_shared<const SphereMap>(SphereMap{points_of(rays, finite)});
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  return as_dict(call(py::none(), [=](const Progress&) {
    if (auto topology = Topology::try_build(mesh->file.mesh.triangles,
                                            static_cast<int>(mesh->file.mesh.vertex_count()))) {
      return certify(*topology, *map, threads);
    }
    return certify(topology_of(*mesh), *map, threads);
  }));
}

py::dict verify_file(const std::string& path, const std::string& sphere, int threads) {
  const VerifiedMap found = call(py::none(), [=](const Progress&) {
    return verify_map(path, {.sphere = sphere, .threads = threads});
  });
  py::dict dict = as_dict(found.certificate);
  dict["is_round"] = found.is_round();
  return dict;
}

py::tuple locate(const Mapped& mapped, const py::array& rows, int threads) {
  bool finite = true;
  const auto directions = std::make_shared<const Points>(points_of(rows, finite));
  using Located = std::pair<std::vector<int>, Points>;
  Located found = call(py::none(), [=, mesh = mapped.mesh()](const Progress&) {
    const std::vector<SurfacePoint> points = mesh.locator().locate_all(*directions, threads);
    Located located{{}, Points(directions->rows(), 3)};
    located.first.reserve(points.size());
    for (const SurfacePoint& point : points) {
      located.second.row(static_cast<Eigen::Index>(located.first.size())) = point.barycentric;
      located.first.push_back(point.face);
    }
    return located;
  });
  return py::make_tuple(owning(std::move(found.first)), owning_rows(std::move(found.second)));
}

/// theta and phi of rays, as files have them.
py::tuple angles(const Mapped& mapped) {
  const Points& points = mapped.map().points;
  std::vector<double> theta, phi;
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const SphericalCoordinates coordinates = to_spherical(points.row(v));
    theta.push_back(coordinates.theta);
    phi.push_back(coordinates.phi);
  }
  return py::make_tuple(owning(std::move(theta)), owning(std::move(phi)));
}

py::dict distortion(const Mapped& mapped, int threads) {
  const MappedMesh mesh = mapped.mesh();
  auto measured = call(py::none(), [mesh, threads](const Progress&) {
    Distortion found = measure_distortion(mesh.mesh(), mesh.map(), threads);
    const DistortionSummary summary = summarise(found, threads);
    return std::pair(std::move(found), summary);
  });
  py::dict dict;
  dict["summary"] = as_dict(measured.second);
  const py::ssize_t faces = measured.first.area_ratio.size();
  dict["area_ratio"] = owning(std::move(measured.first.area_ratio), {faces});
  dict["angle_ratio"] = owning_rows(std::move(measured.first.angle_ratio));
  dict["sigma_max"] = owning(std::move(measured.first.sigma_max), {faces});
  dict["sigma_min"] = owning(std::move(measured.first.sigma_min), {faces});
  dict["source_area"] = owning(std::move(measured.first.source_area), {faces});
  return dict;
}

py::dict splits_of(const ChartCounts& counts) {
  py::dict dict;
  dict["pole_splits"] = counts.pole_splits;
  dict["meridian_splits"] = counts.meridian_splits;
  dict["fold_splits"] = counts.fold_splits;
  dict["snapped_vertices"] = counts.snapped_vertices;
  dict["nudged_vertices"] = counts.nudged_vertices;
  return dict;
}

py::dict chart(const Mapped& mapped, bool keep_topology, int threads, const py::object& progress) {
  SphericalChart made = call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
    return keep_topology
               ? wrapped_chart(mesh.mesh(), mesh.topology(), mesh.map(), threads)
               : spherical_chart(mesh.mesh(), mesh.topology(), mesh.map(), threads, report);
  });
  Points weights(static_cast<Eigen::Index>(made.surface_points.size()), 3);
  std::vector<int> faces;
  for (const SurfacePoint& point : made.surface_points) {
    weights.row(static_cast<Eigen::Index>(faces.size())) = point.barycentric;
    faces.push_back(point.face);
  }
  py::dict dict;
  dict["one_to_one"] = made.certificate.one_to_one();
  dict["north"] = made.north;
  dict["south"] = made.south;
  dict["counts"] = splits_of(made.counts);
  dict["faces"] = owning_rows(std::move(made.triangles));
  dict["points"] = owning_rows(std::move(made.points));
  dict["wedges"] = owning_rows(std::move(made.wedges));
  dict["uv"] = owning_rows(std::move(made.uv));
  dict["wedge_vertices"] = owning(std::move(made.wedge_vertices));
  dict["source_faces"] = owning(std::move(made.source_faces));
  dict["surface_faces"] = owning(std::move(faces));
  dict["surface_weights"] = owning_rows(std::move(weights));
  return dict;
}

/// How the map came about; nothing where it was read.
py::object account(const Mapped& mapped) {
  if (!mapped.made()) return py::none();
  const Parameterization& made = *mapped.made();
  py::dict dict;
  dict["made_by"] = made.made_by;
  dict["seconds"] = mapped.spent().wall;
  dict["processor_seconds"] = mapped.spent().processors;
  dict["poles"] = py::none();
  if (made.poles) dict["poles"] = py::make_tuple(made.poles->north, made.poles->south);
  dict["meridian"] = py::none();
  if (made.meridian) dict["meridian"] = *made.meridian;
  dict["pole_cost"] = made.pole_cost;
  dict["energy_gap"] = made.energy_gap;
  dict["pin_residuals"] = made.pin_residuals;
  dict["warnings"] = made.warnings;
  py::list stages;
  for (const StageRecord& stage : made.stages)
    stages.append(
        py::make_tuple(stage.name, stage.seconds, stage.folds,
                       stage.distortion ? py::object(as_dict(*stage.distortion)) : py::none()));
  dict["stages"] = stages;
  return std::move(dict);
}

/// The faces as they were written: quads of a grid too.
py::object polygons(const Mapped& mapped) {
  const std::optional<Polygons>& faces = mapped.mesh().polygons();
  if (!faces) return py::none();
  return py::make_tuple(owning(std::vector<int>(faces->corners)),
                        owning(std::vector<int>(faces->starts)));
}

std::unique_ptr<Source> source_of_mapped(const Mapped& mapped) {
  auto source = std::make_unique<Source>();
  source->mesh.file = mapped.mesh().file();
  source->mesh.path = mapped.mesh().name();
  return source;
}

py::list listed(const std::vector<Property>& properties) {
  py::list list;
  for (const Property& property : properties)
    list.append(py::make_tuple(property.name, values_of(property)));
  return list;
}

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
      .def_property_readonly("name", [](const Mapped& self) { return self.mesh().name(); })
      .def_property_readonly("notes", [](const Mapped& self) { return self.mesh().notes(); })
      .def_property_readonly("provenance",
                             [](const Mapped& self) { return self.mesh().provenance(); })
      .def_property_readonly("mapped_here",
                             [](const Mapped& self) { return self.mesh().mapped_here(); })
      .def_property_readonly("certificate",
                             [](const Mapped& self) { return as_dict(self.certificate()); })
      .def_property_readonly("account", account)
      .def_property_readonly("polygons", polygons)
      .def_property_readonly("repairs", [](const Mapped& self) { return as_list(self.repairs()); })
      .def_property_readonly("handles", [](const Mapped& self) { return as_list(self.handles()); })
      .def("vertex_values",
           [](const Mapped& self) { return listed(self.mesh().file().vertex_properties); })
      .def("face_values",
           [](const Mapped& self) { return listed(self.mesh().file().face_properties); });
}

}  // namespace

py::dict as_dict(const Certificate& certificate) {
  py::dict dict;
  dict["one_to_one"] = certificate.bijective();
  dict["verdict"] = verdict(certificate);
  dict["degree"] = certificate.degree;
  dict["covering"] = certificate.covering;
  dict["reversed"] = certificate.reversed;
  dict["folded"] = owning(std::vector<int>(certificate.folded));
  dict["degenerate"] = owning(std::vector<int>(certificate.degenerate));
  dict["unusable_points"] = owning(std::vector<int>(certificate.unusable_points));
  dict["branch_vertices"] = owning(std::vector<int>(certificate.branch_vertices));
  dict["max_length_error"] = certificate.max_length_error;
  return dict;
}

py::dict as_dict(const DistortionSummary& summary) {
  py::dict dict;
  dict["mean_abs_ln_area"] = summary.mean_abs_ln_area;
  dict["mean_abs_ln_angle"] = summary.mean_abs_ln_angle;
  dict["area_within_two"] = summary.area_within_two;
  dict["area_ratio_p01"] = summary.area_ratio_p01;
  dict["area_ratio_p50"] = summary.area_ratio_p50;
  dict["area_ratio_p99"] = summary.area_ratio_p99;
  dict["area_ratio_min"] = summary.area_ratio_min;
  dict["area_ratio_max"] = summary.area_ratio_max;
  dict["angle_ratio_max"] = summary.angle_ratio_max;
  dict["weighted_abs_log2_area"] = summary.weighted_abs_log2_area;
  dict["symmetric_dirichlet"] = summary.symmetric_dirichlet;
  dict["quasi_conformal_mean"] = summary.quasi_conformal_mean;
  dict["quasi_conformal_max"] = summary.quasi_conformal_max;
  dict["stretch_l2"] = summary.stretch_l2;
  dict["stretch_linf"] = summary.stretch_linf;
  return dict;
}

void declare_maps(py::module_& module) {
  declare_mapped(module);
  module.def("map", map);
  module.def("refuse", refuse);
  module.def("load", load);
  module.def("with_points", with_points);
  module.def("save", save);
  module.def("save_sphere", save_sphere_file);
  module.def("certify_points", certify_points);
  module.def("verify_file", verify_file);
  module.def("locate", locate);
  module.def("angles", angles);
  module.def("distortion", distortion);
  module.def("chart", chart);
  module.def("source_of_mapped", source_of_mapped);
}

}  // namespace sphparam::python
