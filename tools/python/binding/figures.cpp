// Figures of surfaces: distances, spherical harmonics.

#include <pybind11/stl.h>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/sphere/sphere_map.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam::python {
namespace {

py::dict measure(const Source& first, const Source& second, std::int64_t samples,
                 std::uint64_t seed, bool extremes, int threads, const py::object& progress) {
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
                             .threads = threads,
                             .progress = report});
  });
  return as_dict(found);
}

py::dict expand(const Mapped& mapped, int degree, const std::vector<std::string>& scalars,
                bool least_squares, bool turned, int threads, const py::object& progress) {
  HarmonicExpansion found = call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
    HarmonicExpansion expansion = expand_in_harmonics(
        mesh, scalars,
        {.degree = degree, .least_squares = least_squares, .threads = threads, .progress = report});
    if (turned) align(expansion, mesh, HarmonicAlignment::SphereAndSurface, nullptr, threads);
    return expansion;
  });
  const Vector3 axes = degree > 0 ? first_order_ellipsoid(found.fit.coefficients.leftCols<3>())
                                  : Vector3(Vector3::Zero());
  py::dict dict;
  dict["functions"] = found.functions;
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

}  // namespace

void declare_figures(py::module_& module) {
  module.def("measure", measure);
  module.def("expand", expand);
  module.def("evaluate", evaluate);
}

}  // namespace sphparam::python
