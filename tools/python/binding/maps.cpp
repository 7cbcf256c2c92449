// Maps: made, loaded, proved, written.

#include <pybind11/stl.h>

#include <ctime>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "io/inspected_source.h"
#include "map_request.h"
#include "mesh/enclosed_volume.h"
#include "sphere/radius.h"
#include "sphparam/frame_check.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_refusal.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/upright_frame.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/names.h"
#include "sphparam/records/verification_record.h"
#include "sphparam/stopwatch.h"

namespace sphparam::python {
namespace {

void inspect_by_file_numbers(MeshSource& source) {
  source.inspection = inspect_mesh(source.file.mesh);
  source.inspection.defects =
      by_file_numbers(std::move(source.inspection.defects), FileNumbers(source.file));
}

/// The topology of what can be mapped. Throws MeshRefusal, with what repair would do.
Topology topology_of(MeshSource& source, int threads) {
  try {
    if (!source.topology) return require_sphere(source.file.mesh, threads);
    require_sphere(source.file.mesh, *source.topology);
    return std::move(*source.topology);
  } catch (const MeshError&) {
    inspect_by_file_numbers(source);
    sphparam::refuse(source);
  }
}

[[noreturn]] void refuse(const Source& source) {
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  call(py::none(), [mesh](const Progress&) {
    inspect_by_file_numbers(*mesh);
    sphparam::refuse(*mesh);
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
  Topology topology = topology_of(source, options.threads);
  require_area(source);
  std::vector<std::string> doubts = settle(request, source.file, topology);
  const Stopwatch stopwatch;
  const std::clock_t begin = std::clock();
  options.fillers = fillers_of(source.file);
  Parameterization result = parameterize_standing(source.file, topology, options);
  const Making making{
      stopwatch.seconds(), static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC,
      enclosed(source.file.mesh) < 0 && !is_sheet(source.file.mesh, options.fillers),
      std::move(doubts)};
  require_wanted(result, options);
  const FileNumbers numbers(source.file);
  std::string upright;
  if (request.stands)
    upright = upright_words(result.map, source.file.mesh, topology, upright_axes(source.file),
                            options.fillers);
  Provenance provenance = provenance_of(result,
                                        {.method = name_of(options.method),
                                         .options = options_line(options),
                                         .pins = options.pins.size(),
                                         .upright = upright,
                                         .verdict = verdict(result.certificate)},
                                        numbers);
  by_file_numbers(result, numbers);
  return {std::move(source), std::move(topology), std::move(provenance), std::move(result), making,
          options.threads};
}

/// Of a source that nobody else has, whose memory is taken, or of a copy.
Mapped map(Source& source, bool taken, const py::dict& values, const py::object& progress) {
  const auto request = std::make_shared<Request>(map_request_of(values));
  const auto mesh = taken ? std::make_shared<MeshSource>(std::move(source.mesh))
                          : std::make_shared<MeshSource>(source.mesh);
  return call(progress, [mesh, request](const Progress& report) {
    request->options.progress = report;
    return map_mesh(std::move(*mesh), *request);
  });
}

/// A mesh and the map that its file or another one has; one is made where there is none.
Mapped load(const FilePath& path, const FilePath& sphere, const py::dict& limits,
            const py::dict& values, const py::object& progress) {
  LoadOptions options{.sphere = sphere, .map = map_request_of(values).options};
  take_limits(limits, options.read);
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
    shorten(points->points);
    Topology topology = topology_of(*mesh, threads);
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

/// Returns what the format had no place for.
py::list save(const Mapped& mapped, const FilePath& path, const std::string& holes, int threads) {
  const auto fillers = chosen<FillersInFile>(holes,
                                             {{"marked", FillersInFile::Marked},
                                              {"keep", FillersInFile::Kept},
                                              {"drop", FillersInFile::Left}},
                                             "holes");
  return as_texts(writing_call(py::none(), [=, mesh = mapped.mesh()](const Progress&) {
    PendingFiles files;
    std::vector<std::string> losses = add_mapped(files, path, mesh, threads, {}, fillers);
    files.publish();
    return losses;
  }));
}

void save_sphere_file(const Mapped& mapped, const FilePath& path, int threads) {
  writing_call(py::none(), [mesh = mapped.mesh(), path, threads](const Progress& report) {
    return save_sphere(path, mesh, {.threads = threads, .progress = report});
  });
}

py::dict certify_points(const Source& source, const py::array& rays, int threads) {
  bool finite = true;
  const auto map = std::make_shared<SphereMap>(SphereMap{points_of(rays, finite)});
  const auto mesh = std::make_shared<MeshSource>(source.mesh);
  return as_dict(call(py::none(), [=](const Progress&) {
    try {
      return certify_either_way(mesh->file.mesh, *map, threads);
    } catch (const MeshError&) {
      return certify(topology_of(*mesh, threads), *map, threads);  // throws, and says what helps
    }
  }));
}

/// Who reads theta and phi that are not those of the rays has another map: it does not hold then.
py::dict verify_file(const FilePath& path, const FilePath& sphere, const py::dict& limits,
                     int threads) {
  ReadOptions read;
  take_limits(limits, read);
  const VerifiedMap found = call(py::none(), [=](const Progress&) {
    return verify_map(path, {.sphere = sphere, .read = read, .threads = threads});
  });
  py::dict dict = as_dict(found.certificate);
  if (found.certificate.bijective() && !found.holds()) {
    dict["one_to_one"] = false;
    dict["verdict"] = "theta and phi off " + std::to_string(found.angles->off);
  }
  dict["warnings"] = as_texts(warnings_of(found));
  return dict;
}

}  // namespace

void declare_maps(py::module_& module) {
  module.def("map", map);
  module.def("refuse", refuse);
  module.def("load", load);
  module.def("with_points", with_points);
  module.def("save", save);
  module.def("save_sphere", save_sphere_file);
  module.def("certify_points", certify_points);
  module.def("verify_file", verify_file);
}

}  // namespace sphparam::python
