// What lies where on the sphere: directions, angles, distortion, charts.

#include <limits>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam::python {
namespace {

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
  auto [theta, phi] = call(py::none(), [mapped](const Progress&) {
    const Points& points = mapped.map().points;
    std::pair<std::vector<double>, std::vector<double>> found;
    for (Eigen::Index v = 0; v < points.rows(); ++v) {
      const SphericalCoordinates coordinates = to_spherical(points.row(v));
      found.first.push_back(coordinates.theta);
      found.second.push_back(coordinates.phi);
    }
    return found;
  });
  return py::make_tuple(owning(std::move(theta)), owning(std::move(phi)));
}

/// Of a face without area there are no ratios.
void leave_out_flat_faces(Distortion& distortion) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (Eigen::Index f = 0; f < distortion.source_area.size(); ++f) {
    if (distortion.source_area[f] != 0) continue;
    distortion.area_ratio[f] = distortion.sigma_max[f] = distortion.sigma_min[f] = none;
    distortion.angle_ratio.row(f).setConstant(none);
  }
}

/// One row a face of the whole mesh: those of fillers are no numbers.
template <class Table>
Table on_all_faces(Table of_surface, const FillerMarks& fillers) {
  if (fillers.empty()) return of_surface;
  const auto faces = static_cast<Eigen::Index>(fillers.size());
  Table all = Table::Constant(faces, of_surface.cols(), std::numeric_limits<double>::quiet_NaN());
  Eigen::Index row = 0;
  for (Eigen::Index f = 0; f < faces; ++f) {
    if (!fillers[static_cast<std::size_t>(f)]) all.row(f) = of_surface.row(row++);
  }
  return all;
}

py::dict distortion(const Mapped& mapped, int threads) {
  const MappedMesh mesh = mapped.mesh();
  auto measured = call(py::none(), [mesh, threads](const Progress&) {
    Distortion found = measure_distortion(mesh.surface(), mesh.map(), threads);
    const DistortionSummary summary = summarise(found, threads);
    leave_out_flat_faces(found);
    return std::pair(std::move(found), summary);
  });
  Distortion& found = measured.first;
  const py::ssize_t faces = mesh.mesh().face_count();
  const auto column = [&](VectorX& values) {
    return owning(on_all_faces(std::move(values), mesh.fillers()), {faces});
  };
  py::dict dict;
  dict["summary"] = as_dict(measured.second);
  dict["area_ratio"] = column(found.area_ratio);
  dict["angle_ratio"] = owning_rows(on_all_faces(std::move(found.angle_ratio), mesh.fillers()));
  dict["sigma_max"] = column(found.sigma_max);
  dict["sigma_min"] = column(found.sigma_min);
  dict["source_area"] = column(found.source_area);
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

}  // namespace

void declare_sphere(py::module_& module) {
  module.def("locate", locate);
  module.def("angles", angles);
  module.def("distortion", distortion);
  module.def("chart", chart);
}

}  // namespace sphparam::python
