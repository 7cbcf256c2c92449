// Figures of surfaces: distances, spherical harmonics.

#include <pybind11/stl.h>

#include <array>
#include <numbers>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "embedding/frame/nearest_rotation.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/records/harmonics_record.h"
#include "sphparam/remesh/resample.h"
#include "sphparam/sphere/radial_directions.h"
#include "sphparam/sphere/sphere_map.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam::python {
namespace {

py::dict measure(const Source& first, const Source& second, std::int64_t samples,
                 std::uint64_t seed, bool extremes, bool deviations, int threads,
                 const py::object& progress) try {
  using Mesh = std::shared_ptr<const TriangleMesh>;
  // What closes holes is no surface.
  const auto surface = [](const MeshFile& file) {
    return std::make_shared<TriangleMesh>(surface_of(file.mesh, fillers_of(file)));
  };
  const Mesh one = surface(first.mesh.file), other = surface(second.mesh.file);
  const SurfaceDistance found = call(progress, [=](const Progress& report) {
    return measure_distance(*one, *other,
                            {.samples = samples,
                             .seed = seed,
                             .extremes = extremes,
                             .deviations = deviations,
                             .threads = threads,
                             .progress = report});
  });
  return as_dict(found);
} catch (const UnmeasurableSurface& error) {
  throw py::value_error((error.side() == Side::First ? "first: " : "second: ") +
                        std::string(error.what()));
}

/// Degrees, RMS over the surface, of the map's directions from those of a body about this centre; 0
/// where there is no such body.
double degrees_off(const MappedMesh& mapped, const Vector3& centre) try {
  return 180 / std::numbers::pi *
         rms_angle(mapped.map(), body_directions(mapped.file(), centre),
                   vertex_areas(surface_of(mapped.mesh(), mapped.fillers())));
} catch (const VertexAtCentre&) {
  return 0;
}

/// `radius`: expanded too, from `centre`, else as the map says what its centre is.
py::dict expand(const Mapped& mapped, int degree, const std::vector<std::string>& scalars,
                bool least_squares, bool turned, bool radius,
                const std::optional<std::array<double, 3>>& given, int threads,
                const py::object& progress) {
  std::optional<Vector3> centre, from;
  if (given) from = Vector3(given->data());
  if (radius) centre = body_centre(planetocentric(mapped.mesh().provenance()), from);
  HarmonicExpansion found = call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
    HarmonicExpansion expansion = expand_in_harmonics(
        mesh, scalars,
        {.degree = degree, .least_squares = least_squares, .threads = threads, .progress = report},
        centre);
    if (turned) align(expansion, mesh, HarmonicAlignment::SphereAndSurface, nullptr, threads);
    return expansion;
  });
  const Vector3 axes = degree > 0 ? first_order_ellipsoid(found.fit.coefficients.leftCols<3>())
                                  : Vector3(Vector3::Zero());
  py::dict dict;
  dict["functions"] = found.functions;
  dict["centre"] = py::none();
  if (centre) dict["centre"] = py::make_tuple(centre->x(), centre->y(), centre->z());
  dict["degrees_off"] = centre ? degrees_off(mapped.mesh(), *centre) : 0;
  dict["rms"] = found.position_rms();
  dict["plain_rms"] = found.plain_position_rms();
  dict["diagonal"] = found.diagonal;
  dict["ellipsoid"] = py::make_tuple(axes.x(), axes.y(), axes.z());
  std::vector<std::string> doubts;
  if (found.alignment) doubts = doubts_about(*found.alignment);
  if (found.fit.quadrature_change.value_or(0) > settled_quadrature)
    doubts.emplace_back("the integral has not settled with the most nodes that there are");
  dict["doubts"] = doubts;
  dict["power"] = owning_rows(power_per_degree(found.fit.coefficients));
  dict["values"] = owning_rows(std::move(found.values));
  dict["coefficients"] = owning_rows(std::move(found.fit.coefficients));
  return dict;
}

py::array evaluate(const py::array_t<double, py::array::c_style>& coefficients,
                   const py::array& rows, int threads) {
  bool finite = true;
  const Points directions = normalised(points_of(rows, finite)).points;
  Functions table(coefficients.shape(0), coefficients.shape(1));
  std::copy(coefficients.data(), coefficients.data() + coefficients.size(), table.data());
  return owning_rows(
      call(py::none(), [=](const Progress&) { return synthesise(table, directions, threads); }));
}

/// A table of the PDS.
void write_shadr(const FilePath& path, const py::array_t<double, py::array::c_style>& radius) {
  HarmonicExpansion expansion;
  expansion.functions = {"radius"};
  expansion.fit.coefficients.resize(radius.size(), 1);
  std::copy(radius.data(), radius.data() + radius.size(), expansion.fit.coefficients.data());
  writing_call(py::none(), [path, text = to_shadr(expansion)](const Progress&) {
    PendingFiles files;
    files.add(path, text);
    files.publish();
    return true;
  });
}

}  // namespace

void declare_figures(py::module_& module) {
  module.def("measure", measure);
  module.def("expand", expand);
  module.def("evaluate", evaluate);
  module.def("write_shadr", write_shadr);
}

}  // namespace sphparam::python
